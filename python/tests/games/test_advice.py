"""Ways, reasons, breaks and practice: what `carom ways`, `plan --why`, `break` and `practice` print."""

import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

import carom
from carom.plans import Kind

TABLE = carom.tables.pool_9ft()
LAYOUT = carom.balls([[0.6, 0.8], [0.9, 1.5], [0.3, 1.9]])
COMMAND = Path(os.environ.get("CAROM_BUILD", ".")) / "carom"


def test_ways_to_pot():
    found = carom.ways(TABLE, LAYOUT, carom.cue(speed=3.0, b=0.0), ball=1, scan=4000, rails=1)
    ways = found.ways
    assert len(ways) == len(found.parts) > 3 and set(ways["ball"]) == {1}
    assert (np.diff(ways["chance"]) <= 0.0).all() and found.good > 0 == found.left_out
    assert {Kind(kind).text for kind in ways["kind"].tolist()} >= {"pot", "bank"}
    for way, parts in zip(ways, found.parts):
        shot = carom.simulate(TABLE, LAYOUT, way["cue"].reshape(()))
        assert shot.potted(1) and not shot.potted(0)
        assert all(isinstance(part, int) or part in TABLE.rail_names for part in parts)
    corner = carom.ways(TABLE, LAYOUT, carom.cue(speed=3.0), pocket="foot-left", scan=4000)
    assert {TABLE.pocket_names[pocket] for pocket in corner.ways["pocket"]} == {"foot-left"}


def test_ways_to_score_and_to_a_place():
    table = carom.tables.threecushion()
    balls = carom.racks.threecushion(table)
    cue = carom.cue(speed=5.0, game="billiard")
    found = carom.ways(table, balls, cue, scan=4000, most=20)
    assert found.scanned == 4000 and set(found.ways["kind"]) == {-1}
    best = carom.simulate(table, balls, found.ways["cue"][0].reshape(()))
    assert (best.events["type"] == carom.EventType.RAIL).sum() >= 3
    alone = carom.ways(TABLE, LAYOUT[:1], carom.cue(speed=2.0), place=(0.6, 1.5), scan=4000)
    there = carom.simulate(TABLE, LAYOUT[:1], alone.ways["cue"][0].reshape(()))
    assert np.hypot(*(there.final["r"][0, :2] - (0.6, 1.5))) < 0.15


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"goal": "win"}, "goal: unknown value 'win'.*'pot', 'score'"),
        ({"goal": "place"}, "place: the goal"),
        ({"ball": 3}, "ball: .* 0 to 2"),
        ({"pocket": "middle"}, "pocket: unknown pocket 'middle'; use one of .*foot-left"),
        ({"cues": carom.cue(speed=[])}, "cues: at least one"),
        ({"most": 0}, "most: "),
        ({"player": 1}, "player: "),
    ],
)
def test_ways_refuse(changes, message):
    with pytest.raises((ValueError, TypeError), match=message):
        carom.ways(TABLE, LAYOUT, **changes)


def test_why():
    made = {"rules": "nineball", "shots": 200, "seed": 3}
    choice = carom.plan(TABLE, LAYOUT, **made)[0]
    reasons = carom.why(TABLE, LAYOUT, choice, **made)
    assert reasons.first == 1 and 0.0 < reasons.part <= 1.0 and reasons.words
    assert 0.0 <= reasons.misses <= 1.0 and set(reasons.cost) == {"aim", "speed", "tip", "eye"}
    assert sum(reasons.cost.values()) == pytest.approx(reasons.flawless_value - reasons.value)
    assert reasons.next is None or reasons.next.shape == ()
    choice["kind"] = Kind.PASS
    with pytest.raises(ValueError, match="choice: it is to pass"):
        carom.why(TABLE, LAYOUT, choice, **made)
    with pytest.raises(ValueError, match="choice: one is needed"):
        carom.why(TABLE, LAYOUT, np.repeat(choice, 2), **made)


def test_breaks():
    rack = carom.racks.nineball(TABLE)
    found = carom.breaks("nineball", TABLE, rack, carom.cue(speed=9.0), racks=80, seed=1)
    assert found.breaks == 80 and found.fell.shape == (10, 6)
    assert found.balls == pytest.approx(found.fell[1:].sum())
    assert found.scratches == pytest.approx(found.fell[0].sum())
    assert 0.0 < found.makes <= 1.0 and 0.0 < found.wins < 1.0 and found.spread > 0.0
    snooker = carom.tables.snooker()
    other = carom.breaks(
        "snooker", snooker, carom.racks.snooker(snooker), carom.cue(speed=3.0), racks=2
    )
    assert other.fell.shape == (22, 6)
    with pytest.raises(ValueError, match="aim: unknown value 'x'.*'full', 'direction'"):
        carom.breaks("nineball", TABLE, rack, aim="x")
    with pytest.raises(ValueError, match="racks: "):
        carom.breaks("nineball", TABLE, rack, racks=0)


@pytest.mark.skipif(not COMMAND.exists(), reason="the command is not built")
def test_breaks_are_those_of_the_command():
    row = [COMMAND, "break", "--rules", "nineball", "--racks", "64", "--speed", "9", "--csv"]
    head, values = subprocess.check_output(row, text=True).splitlines()
    told = dict(zip(head.split(","), values.split(",")))
    stroke = carom.cue(speed=9.0, a=-float(told["right"]), b=float(told["above"]))
    unbounded = carom.player()  # as the command has it
    unbounded["speed_least"], unbounded["speed_most"], unbounded["tip_most"] = 0.01, 1000.0, 1.0
    rack = carom.racks.nineball(TABLE)
    found = carom.breaks("nineball", TABLE, rack, stroke, player=unbounded, racks=64)
    same = {"makes": found.makes, "balls": found.balls, "plays_on": found.plays_on}
    same |= {"scratch": found.scratches, "wing": found.wing, "spread": found.spread}
    same |= {"wins": found.wins, "wins_error": found.error, "x": found.place[0]}
    for name, value in same.items():
        assert float(told[name]) == pytest.approx(value, abs=1e-6), name


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    """A match of eight strokes."""
    match = carom.Match("nineball", TABLE, seed=7, seats=["Ann", "Bo"])
    player = carom.player(3.0)
    for number in range(8):
        best = match.plan(shots=100, player=player)[0]
        match.take(best, carom.with_errors(best["cue"], player, 1, number))
    path = tmp_path_factory.mktemp("matches") / "match.carom"
    match.save(path)
    return path


def test_practice(recorded):
    found = carom.practice(recorded)
    costs = [group.miss_cost + group.place_cost for group in found]
    assert costs == sorted(costs, reverse=True)
    assert sum(group.strokes for group in found) == 8
    text = recorded.read_text().splitlines()
    for group in found:
        assert len(group.reviewed) == group.strokes >= group.kept
        for stroke in group.reviewed:
            assert stroke.review.group == group.group
            assert next(iter(json.loads(text[stroke.line - 1]))) in ("shot", "game", "act")
    by_name = carom.practice(recorded, "Ann")
    assert {stroke.seat for group in by_name for stroke in group.reviewed} == {0}
    assert sum(group.strokes for group in by_name) == sum(
        group.strokes for group in carom.practice(recorded, 0)
    )
    with pytest.raises(ValueError, match="seat: unknown name 'Cy'; .*Ann, Bo"):
        carom.practice(recorded, "Cy")
