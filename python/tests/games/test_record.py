"""Recordings: a match recorded and replayed, what is refused, and the command's verdict on the same
text.
"""

import os
import subprocess

import pytest
from conftest import same_bits

import carom
from carom.record import replay

TABLE = carom.tables.pool_9ft()


RACK = carom.racks.nineball(TABLE, cushion_model="stronge")


def a_game() -> carom.Match:
    game = carom.Match("nineball", TABLE, balls=RACK, cushion_model="stronge")
    assert not game.stroke(carom.cue(speed=8.0, phi=90.2), t_final=0.5)
    assert game.resume()
    if game.phase == "place":
        game.place(0.6, 0.5)
    assert game.stroke(carom.cue(speed=2.5, phi=70.0))
    return game


def test_a_game_is_replayed_with_the_same_bits(tmp_path):
    game = a_game()
    final, text = game.shot.final, game.end()
    path = tmp_path / "game.jsonl"
    path.write_text(text, encoding="utf-8")
    shots = list(replay(path))
    assert [shot.same for shot in shots] == [True] * 3
    assert [shot.shot for shot in shots] == [1, 2, 3]
    assert same_bits(shots[-1].final, final)
    # As carom.simulate() plays it.
    whole = carom.simulate(
        TABLE,
        RACK,
        carom.cue(speed=8.0, phi=90.2),
        cushion_model="stronge",
    )
    assert same_bits(shots[1].final, whole.final)
    assert (shots[1].played.events, shots[1].played.time) == (whole.count, whole.time)
    assert list(replay(text.splitlines())) != []
    command = os.path.join(os.environ.get("CAROM_BUILD", ""), "carom")
    if os.access(command, os.X_OK) and not os.path.isdir(command):
        message = subprocess.run(
            [command, "verify", str(path)], capture_output=True, text=True, check=True
        ).stdout
        assert "3 shots, every bit agrees" in message


def test_a_forged_stroke_ends_otherwise():
    text = a_game().end()
    assert text.count('"speed":2.5') == 1
    assert [
        shot.same for shot in replay(text.replace('"speed":2.5', '"speed":2.6').splitlines())
    ] == [True, True, False]


@pytest.mark.parametrize(
    ("what", "instead", "status", "message"),
    [
        (
            '"revision":',
            '"revision":9',
            "ERROR_REVISION",
            "line 1: the recording was made with physics revision 926, not 26; its shots have other bits here",
        ),
        ('"phi":', '"phy":', "ERROR_RECORD", "line 6: shot.phy is not a key of the format"),
        ('{"end"', "", "ERROR_RECORD", "line 12"),
    ],
)
def test_what_is_refused(what, instead, status, message):
    text = a_game().end().replace(what, instead, 1)
    with pytest.raises(carom.CaromError, match=message) as refused:
        list(replay(text.splitlines()))
    assert refused.value.status == carom.Status[status]


def test_nothing_follows_the_end():
    game = a_game()
    with pytest.raises(
        carom.CaromError,
        match=r'line 11: the recording is truncated: there is no line \{"end": \.\.\.\}',
    ):
        list(replay(game.lines))
    lines = len(game.lines)
    game.end()
    assert len(game.lines) == lines + 1
    for act in (lambda: game.stroke(carom.cue(speed=1.0)), game.end):
        with pytest.raises(carom.CaromError, match="over|no match"):
            act()
    assert len(game.lines) == lines + 1
