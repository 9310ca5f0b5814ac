"""Matches: what is refused, choices, shots in parts, recordings that are judged, rules of one's own."""

import pickle

import numpy as np
import pytest

import carom

TABLE = carom.tables.pool_9ft()
BREAK = carom.cue(speed=9.0, phi=90.2)


def begun(**options):
    match = carom.Match("eightball", TABLE, seed=7, **options)
    assert match.phase == "place" and match.bounds.high[1] == TABLE.length / 4
    return match


def test_what_the_rules_forbid_changes_nothing():
    match = begun()
    lines = match.lines[:]
    for act, message in [
        (lambda: match.place(0.6, 1.0), "place: .*0.635"),
        (lambda: match.stroke(BREAK), "stroke: .*in hand"),
        (lambda: match.call(16), "call: ball 16 .* may: 1, 2"),
        (lambda: match.choose("pass"), "choose: the choices are: none"),
        (match.resume, "continue: no ball moves"),
    ]:
        with pytest.raises(carom.CaromError, match=message) as refused:
            act()
        assert refused.value.status == carom.Status.ERROR_ACT
    assert match.lines == lines and match.phase == "place"


def test_a_shot_in_parts_is_ruled_at_its_end():
    match = begun()
    match.place(0.6, 0.6)
    assert not match.stroke(BREAK, t_final=0.3)
    assert match.phase == "moving" and match.ruling is None and match.shot.time == 0.3
    with pytest.raises(carom.CaromError, match="balls move"):
        match.stroke(BREAK)
    half = carom.Match.load(match.lines)
    assert match.resume() and half.resume()
    assert half.lines == match.lines and half.text == match.text
    assert match.ruling.shot.count == match.shot.count > 100
    assert match.ruling.balls.tobytes() == match.balls.tobytes()
    match.concede(0)
    assert match.winner == 1 and carom.Match.load(match.end().splitlines()).winner == 1


def test_a_match_with_equal_innings_is_drawn():
    table, perfect = carom.tables.threecushion(), carom.player(0)
    match = carom.Match("straightrail", table, seed=1, state={"target": 1, "innings": 1})
    match.take(match.plan(shots=100, player=perfect)[0])
    assert match.phase == "stroke" and match.player == 1 and match.state["innings"] == 3
    assert not match.drawn and match.text == "the other has the equalizing inning"
    match.take(match.plan(shots=100, player=perfect)[0])
    assert match.phase == "over" and match.drawn and match.winner is None
    assert match.ruling.turn == "draw" and carom.Match.load(match.end().splitlines()).drawn


def test_a_file_that_was_cut_off_behind_a_shot_goes_on():
    match = begun(player=1)
    match.place(0.6, 0.6)
    match.stroke(BREAK)
    index = next(k for k, line in enumerate(match.lines) if line.startswith('{"shot"'))
    restored = carom.Match.load(match.lines[: index + 1])
    assert restored.lines == match.lines and restored.player == match.player
    assert pickle.loads(pickle.dumps(match)).lines == match.lines
    forged = [line.replace('"player":1', '"player":0') for line in match.lines]
    with pytest.raises(carom.CaromError, match="line"):
        carom.Match.load(forged)


def test_a_game_that_was_saved_has_the_bounds_of_a_scratch():
    for phi in np.arange(84.0, 96.0, 0.1):
        match = carom.Match("straight", TABLE, balls=carom.racks.eightball(TABLE, seed=5))
        match.stroke(carom.cue(speed=9.0, phi=phi))
        if match.phase == "place":
            break
    restored = carom.Match.load(match.lines)
    assert restored.bounds == match.bounds and restored.bounds.high[1] == TABLE.length / 4
    assert (restored.phase, restored.player) == ("place", match.player)
    with pytest.raises(carom.CaromError, match="place: .*0.635"):
        restored.place(0.6, 0.64)
    assert restored.plan(shots=100, best=1)[0]["place"][1] <= TABLE.length / 4


def test_choices_are_taken():
    match = begun()
    match.place(0.6, 0.6)
    match.stroke(carom.cue(speed=1.5, phi=90.0))  # no legal break
    assert {"rack", "other_rack"} <= {*match.may} and match.player == 1
    match.choose("other_rack")
    assert match.player == 0 and match.state["opening"] == 1


class Last(carom.Rules):
    """Whoever pots ball 2 wins."""

    race = "shared"
    broken = False

    def on(self, state, in_play):
        return in_play - {0}

    def left(self, state, in_play):
        return 1, 1

    def judge(self, state, in_play, facts, call):
        if self.broken:
            raise KeyError("broken")
        state[0] += 1
        return carom.Turn("win" if 2 in facts.potted else "pass")


def test_rules_of_ones_own():
    rules = Last()
    layout = carom.balls([[0.6, 0.6], [0.6, 1.8], [0.3, 1.5]])
    match = carom.Match(rules, TABLE, balls=layout)
    cue, lines = carom.cue(speed=1.0), match.lines[:]
    rules.broken = True
    with pytest.raises(KeyError, match="broken"):
        match.stroke(cue)
    assert match.lines == lines and match.phase == "stroke"
    rules.broken = False
    match.stroke(cue)
    assert match.player == 1 and match.state["user"][0] == 1 and match.text == "the other plays"
    assert np.array_equal(carom.Match.load(match.lines, rules=rules).balls, match.balls)
    with pytest.raises(carom.CaromError, match="carom_rules_kind"):
        carom.Match.load(match.lines)
    with pytest.raises(ValueError, match="no rack"):
        carom.Match(rules, TABLE)


def test_plans_are_those_of_the_match():
    # In pyramid the 1, which lies behind the 2 in line with a corner, promises more than the yellow.
    table = carom.tables.pyramid()
    rack = carom.racks.pyramid(table)
    rack["state"]["label"][3:] = carom.Label.POCKETED
    rack["state"]["r"][:3, :2] = [[0.9, 3.3], [0.4, 0.4], [0.12, 0.12]]
    match = carom.Match("pyramid", table, balls=rack)
    best = match.plan(shots=1000, best=1)[0]
    assert (best["cue"]["ball"], best["ball"]) == (1, 2)
    match.take(best)
    assert match.player == 0

    # A ball behind the head string may not be met first by a cue ball that was placed there.
    balls = carom.racks.eightball(TABLE)
    balls["state"]["label"][3:] = carom.Label.POCKETED
    balls["state"]["r"][:3, :2] = [[0.6, 0.3], [0.06, 0.06], [0.9, 2.0]]
    match = carom.Match("straight", TABLE, balls=balls, hand="kitchen")
    match.place(0.6, 0.3)
    free = carom.plan(TABLE, match.balls, rules="straight", state=match.state, shots=300)[0]
    best = match.plan(shots=300)[0]
    assert (free["ball"], best["ball"]) == (1, 2)

    match.concede(0)
    with pytest.raises(carom.CaromError, match="plan: the match is over"):
        match.plan(shots=100)
