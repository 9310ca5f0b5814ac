"""Recordings: a game recorded and replayed, what is refused, and the command's verdict on the same
text.
"""

import os
import subprocess

import pytest

import carom
from carom.record import Recorder, replay

TABLE = carom.tables.pool_9ft()


def a_game() -> Recorder:
    rack = carom.racks.nineball(TABLE, cushion_model="stronge")
    game = Recorder(TABLE, rack, cushion_model="stronge")
    assert (
        game.shoot(carom.cue(speed=8.0, phi=90.2), t_final=0.5).status
        == carom.Status.STOPPED_AT_TIME
    )
    assert game.resume().status == carom.Status.OK
    game.place(0, 0.6, 0.5)
    assert game.shoot(carom.cue(speed=2.5, phi=70.0)).status == carom.Status.OK
    return game


def test_a_game_is_replayed_with_the_same_bits(tmp_path):
    game = a_game()
    text = game.end()
    path = tmp_path / "game.jsonl"
    path.write_text(text, encoding="utf-8")
    shots = list(replay(path))
    assert [shot.same for shot in shots] == [True] * 3
    assert [shot.shot for shot in shots] == [1, 2, 3]
    assert shots[-1].final.tobytes() == game.balls["state"].tobytes()
    # As carom.simulate() plays it.
    whole = carom.simulate(
        TABLE,
        carom.racks.nineball(TABLE, cushion_model="stronge"),
        carom.cue(speed=8.0, phi=90.2),
        cushion_model="stronge",
    )
    assert shots[1].final.tobytes() == whole.final.tobytes()
    assert (shots[1].played.events, shots[1].played.time) == (whole.count, whole.time)
    assert list(replay(text.splitlines())) != []
    command = os.path.join(os.environ.get("CAROM_BUILD", ""), "carom")
    if os.access(command, os.X_OK) and not os.path.isdir(command):
        said = subprocess.run(
            [command, "verify", str(path)], capture_output=True, text=True, check=True
        ).stdout
        assert "3 shots, every bit agrees" in said


def test_a_forged_stroke_ends_otherwise():
    text = a_game().end()
    assert text.count('"speed":2.5') == 1
    assert [
        shot.same for shot in replay(text.replace('"speed":2.5', '"speed":2.6').splitlines())
    ] == [True, True, False]


@pytest.mark.parametrize(
    ("what", "instead", "status", "said"),
    [
        ('"revision":', '"revision":9', "ERROR_REVISION", "line 1: the recording is of revision 9"),
        ('"phi":', '"phy":', "ERROR_RECORD", "line 5: shot.phy is no key of the format"),
        ('{"end"', "", "ERROR_RECORD", "line 9"),
    ],
)
def test_what_is_refused(what, instead, status, said):
    text = a_game().end().replace(what, instead, 1)
    with pytest.raises(carom.CaromError, match=said) as refused:
        list(replay(text.splitlines()))
    assert refused.value.status == carom.Status[status]


def test_the_text_ends_with_its_end():
    game = a_game()
    with pytest.raises(carom.CaromError, match="cut off"):
        list(replay(game.lines))
    with pytest.raises(carom.CaromError, match="is in the way|overlap"):
        rests = game.balls["state"]["label"][1:] == 0
        game.place(0, *game.balls["state"]["r"][1:][rests][0, :2])
    with pytest.raises(carom.CaromError, match="cue.speed"):
        game.shoot(too_fast())
    lines = len(game.lines)
    game.end()
    assert len(game.lines) == lines + 1
    with pytest.raises(ValueError, match="ended"):
        game.balls = game.balls


def too_fast():
    cue = carom.cue(speed=1.0)
    cue["speed"] = 1e9
    return cue
