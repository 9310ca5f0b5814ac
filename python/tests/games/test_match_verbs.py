"""The words, the pictures and the file of a match."""

from pathlib import Path

import pytest

import carom

TABLE = carom.tables.pool_9ft()


class Own(carom.Rules):
    def on(self, state, in_play):
        return in_play

    def judge(self, state, facts):
        return carom.Turn("keep")


@pytest.fixture
def match():
    match = carom.Match("nineball", TABLE, seed=3, seats=["Ann", "Bo"])
    match.place(0.6, 0.5)
    return match


def test_a_match_is_read_as_it_was_written(match, tmp_path):
    path = tmp_path / "match.carom"
    for stop in (None, 0.4):
        if stop is not None:
            match.stroke(carom.cue(speed=8.0), t_final=stop)
        match.save(path)
        again = carom.load(path)
        assert type(again) is carom.Match and again.lines == match.lines
        assert again.phase == match.phase and again.seats[0].name == "Ann"
    with pytest.raises(ValueError, match="shape: .* contains a match"):
        carom.load(path, shape=1)
    assert "Ann" in repr(again) and again.phase == "moving"


def test_words(match):
    assert repr(match) == f"<carom.Match: nineball, Ann - Bo, 0 strokes, {match.words}>"
    match.stroke(carom.cue(speed=8.0))
    assert ", 1 strokes, " not in repr(match) and ", 1 stroke, " in repr(match)
    own = carom.Match(Own(), TABLE, balls=carom.balls([[0.4, 0.5], [0.6, 1.5]]))
    assert repr(own).startswith("<carom.Match: Own, seat 0 - seat 1, 0 strokes, ")


def test_pictures(match, monkeypatch, tmp_path):
    opened = []
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.setattr("webbrowser.open", lambda address: opened.append(address) or True)
    assert match._repr_html_().count("<polyline") == len(TABLE.rails)
    match.show()
    match.stroke(carom.cue(speed=8.0), t_final=0.4)
    assert match.phase == "moving" and match._repr_html_().count("<polyline") > len(TABLE.rails)
    match.resume()
    assert match.words in match._repr_html_()
    match.show(speed=2.0)
    first, second = (Path(address.removeprefix("file://")).read_text() for address in opened)
    assert "<animateTransform" not in first and "<animateTransform" in second
