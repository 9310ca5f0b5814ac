"""Plans: the choices are those of C whatever the threads, win more with smaller errors, and
arguments in error are named.
"""

import dataclasses
import os
import runpy
import signal
import threading
from pathlib import Path

import numpy as np
import pytest
from conftest import by_line, name_of, refused, refused_by_name, same_bits
from numpy.testing import assert_allclose

import carom
from carom._rows import numbered
from carom.plans import Kind

TABLE = carom.tables.pool_9ft()
LAYOUT = carom.balls([[0.4, 0.9], [0.3, 1.9], [0.9, 1.7], [0.7, 0.5]])


def test_kinds_of_strokes_are_those_of_c_and_have_words():
    values = numbered("carom_plan_kind")
    assert {kind.name.lower(): kind.value for kind in Kind} == values
    assert (Kind.BANK.text, Kind.COMBINATION.text) == ("bank", "combination")
    assert all(kind.text for kind in Kind) and len({kind.text for kind in Kind}) == len(Kind)
    best = carom.plan(TABLE, LAYOUT, rules="potting", shots=100)
    assert all(Kind(kind).text for kind in best["kind"])


def test_plan():
    best = carom.plan(TABLE, LAYOUT, rules="potting", shots=300)
    repeat = carom.plan(TABLE, LAYOUT, rules="potting", shots=300, threads=2)
    assert (
        best.dtype == carom.dtypes.plan_stroke and 1 <= len(best) <= 5 and same_bits(best, repeat)
    )
    assert best["ball"][0] in (1, 2, 3) and 0.3 < best["value"][0] <= 1.0 and best["keep"][0] > 0.5
    # the stroke pots the ball that it says
    shots = carom.simulate_batch(TABLE, LAYOUT, best["cue"][:1], features=True)
    assert shots.features.pocket[0, best["ball"][0]] == best["pocket"][0]
    weak = carom.plan(TABLE, LAYOUT, rules="potting", shots=300, player=carom.player(6.0), best=1)
    assert len(weak) == 1 and weak["value"][0] < best["value"][0] - 0.1


def test_kitchen_bars_balls_behind_it():
    """From behind the head string the stroke may not first meet a ball there, whichever the game;
    within the same corners, without that leave, it may.
    """
    balls = carom.balls([[0.6, 0.6], [0.35, 0.30], [0.9, 2.1]])
    corners = [[0.0, 0.0], [TABLE.width, TABLE.length / 4]]
    values = [
        carom.plan(TABLE, balls, rules="nineball", in_hand=in_hand, shots=600, best=1)["value"][0]
        for in_hand in ("kitchen", corners)
    ]
    assert values[0] < values[1] - 0.2


class Points(carom.Rules):
    """Three-cushion by its facts."""

    race = "alone"

    def on(self, state, in_play):
        return in_play - {0}

    def left(self, state, in_play):
        return 1, 1

    def judge(self, state, in_play, facts, call):
        point = facts.second >= 0 and facts.cushions_before[1] >= 3
        assert facts.second not in (0, facts.first) or facts.first == facts.second == -1
        return carom.Turn("keep" if point else "pass", points=float(point))


def test_points_of_three_cushion():
    """The plan scores as often as it says, by the library's rules and by the same in Python."""
    table = carom.tables.threecushion()
    layout, cue = carom.racks.threecushion(table), carom.cue(game="billiard")
    best = carom.plan(table, layout, cue, rules="threecushion", shots=600)
    assert abs(best["value"][0] - best["keep"][0]) < 1e-12 and best["keep"][0] > 0.2
    assert set(best["pocket"]) == {-1} and best["ball"][0] in (1, 2)
    for rules in ("threecushion", Points()):
        hit = [
            carom.referee(
                table, layout, carom.with_errors(best["cue"][0], carom.player(), 1, k), rules=rules
            )
            for k in range(40)
        ]
        points = [ruling.points for ruling in hit]
        assert abs(np.mean(points) - best["keep"][0]) < 0.35 and [
            ruling.turn == "keep" for ruling in hit
        ] == [point == 1.0 for point in points]


def test_a_layout_is_planned_by_the_numbers_of_its_balls():
    """Not by their order, as the command does: the lowest ball is on, wherever it stands in the
    list.
    """
    places = {"5": [0.3, 1.9], "cue": [0.4, 0.9], "2": [0.9, 1.7], "9": [0.7, 0.5]}
    layout = carom.by_number(carom.balls(list(places.values())), list(places), "nineball")
    assert layout.shape == (10,) and all(
        layout["state"]["r"][int(name.replace("cue", "0")), :2].tolist() == place
        for name, place in places.items()
    )
    assert np.flatnonzero(layout["state"]["label"] == carom.Label.POCKETED).tolist() == [
        1,
        3,
        4,
        6,
        7,
        8,
    ]
    best = carom.plan(TABLE, layout, rules="nineball", shots=300, best=1)[0]
    shot = carom.simulate_batch(TABLE, layout, best["cue"][np.newaxis], features=True)
    assert shot.features.contact[0, 0] == 2
    assert same_bits(carom.by_number(layout[[0, 9, 5, 2]], [0, 9, 5, 2], "nineball", cue=0), layout)
    assert carom.by_number(layout, range(10), "eightball", cue=0).shape == (16,)


def test_aim():
    layout = carom.balls([[0.6, 0.8], [0.4, 1.7]])
    for tip in ((0.0, 0.25), (0.4, 0.0), (-0.3, -0.2)):
        pot = carom.aim(TABLE, layout, carom.cue(tip=tip), ball=1, pocket="foot-left")
        shot = carom.simulate(TABLE, layout, pot.cue)
        assert (1, 2) in [
            (event["a"], event["b"])
            for event in shot.events
            if event["type"] == carom.EventType.POCKET
        ]
        assert (
            pot.phi[0] < pot.cue["phi"] < pot.phi[1]
            and pot.speed[0] < pot.cue["speed"] < pot.speed[1]
        )
        assert 5.0 < pot.cut < 20.0 and pot.margin > 1.0


def test_aim_by_a_way():
    bank, combination = [[0.9, 1.5]], [[0.55, 1.3], [0.45, 1.75]]
    ways = (
        (bank, 1, "foot-left", ["right"]),
        (combination, 2, 2, [1]),
        (combination, 2, "foot-right", [1, "left"]),
        (bank, 1, "foot-right", ["left", 1]),
    )
    for places, ball, pocket, via in ways:
        layout = carom.balls([[0.6, 0.8], *places])
        pot = carom.aim(TABLE, layout, carom.cue(speed=4.0), ball=ball, pocket=pocket, via=via)
        events = carom.simulate(TABLE, layout, pot.cue).events
        fallen = next(
            k
            for k, event in enumerate(events)
            if event["type"] == carom.EventType.POCKET and event["a"] == ball
        )
        of_ball = [
            event
            for event in events[:fallen]
            if event["type"] in (carom.EventType.BALL_BALL, carom.EventType.RAIL)
            and ball in (event["a"], event["b"])
        ]
        contacts = [
            event["a"] + event["b"] - ball
            if event["type"] == carom.EventType.BALL_BALL
            else TABLE.rail_names[event["b"]]
            for event in of_ball
        ]
        way = [0] if ball in via else ([] if 1 in via else [0]) + via
        if ball in via:  # a kick: the cue ball meets the rail first
            assert [
                TABLE.rail_names[event["b"]]
                for event in events[:fallen]
                if event["type"] == carom.EventType.RAIL
            ][0] == via[0]
        assert contacts[: len(way)] == way, contacts  # then it may touch what is beside the pocket
        assert TABLE.pocket_names[events[fallen]["b"]] == ("foot-left" if pocket == 2 else pocket)


def test_elevation_of_an_aim():
    layout = carom.balls([[0.62, 0.03], [0.4, 2.2]])
    level = carom.aim(TABLE, layout, carom.cue(speed=3.0), ball=1, pocket="foot-left")
    raised = carom.aim(
        TABLE, layout, carom.cue(speed=3.0, theta=np.nan), ball=1, pocket="foot-left"
    )
    assert level.cue["theta"] == 0.0 and 10.0 < level.elevation < 20.0
    assert raised.cue["theta"] == raised.elevation == pytest.approx(level.elevation, abs=0.1)


def test_chances_of_strokes():
    best = carom.plan(TABLE, LAYOUT, rules="potting", shots=1000)
    away = carom.cue(speed=1.0, phi=float(best["cue"]["phi"][0]) + 20.0)
    cues = np.array([best["cue"][0], away])
    chances = carom.chances(TABLE, LAYOUT, cues, rules="potting", shots=2000, seed=7)
    repeat = carom.chances(TABLE, LAYOUT, cues, rules="potting", shots=2000, seed=7, threads=2)
    assert (
        chances.dtype == carom.dtypes.plan_stroke
        and chances.shape == (2,)
        and same_bits(chances, repeat)
        and chances["seen"].tolist() == [1000, 1000]
    )
    assert (
        abs(chances["keep"][0] - best["keep"][0]) < 0.1
        and chances["keep"][1] < chances["keep"][0] - 0.3
    )
    assert (chances["ball"][0], chances["pocket"][0]) == (best["ball"][0], best["pocket"][0])
    single = carom.chances(
        TABLE, LAYOUT, best["cue"][0], rules="potting", shots=100, player=carom.player(0.0)
    )
    assert single.shape == () and single["keep"] in (0.0, 1.0) and single["error"] < 1e-6


def test_values_of_layouts():
    before_a_pocket = carom.balls([[0.5, 0.5], [0.12, 0.12], [0.9, 1.7]])
    easy = carom.value(TABLE, before_a_pocket, rules="nineball")
    hard = carom.value(TABLE, carom.balls([[0.5, 0.5], [0.62, 2.5], [0.9, 1.7]]), rules="nineball")
    assert 0.0 < hard < easy - 0.1 < 1.0
    assert carom.value(TABLE, before_a_pocket, rules="nineball", player=carom.player(6.0)) < easy
    away = before_a_pocket.copy()
    away["state"]["label"][0] = carom.Label.POCKETED
    assert 0.5 < carom.value(TABLE, away, rules="nineball", in_hand=True) <= 1.0


def test_ball_in_hand():
    layout = LAYOUT.copy()
    layout["state"]["label"][0] = carom.Label.POCKETED
    best = carom.plan(TABLE, layout, rules="nineball", shots=200, in_hand="anywhere")
    assert (
        (best["place"] > 0.0).all()
        and (best["place"] < [TABLE.width, TABLE.length]).all()
        and best["ball"][0] >= 1
    )


def test_ball_in_hand_in_a_part():
    best = carom.plan(
        TABLE, LAYOUT, rules="potting", shots=200, in_hand=[[0.0, 0.0], [TABLE.width, 0.4]]
    )
    assert 0.0 < best["place"][0, 1] < 0.4


def test_the_opponent_counts():
    # whoever misses against a weak opponent gets another turn
    values = [
        carom.plan(
            TABLE,
            LAYOUT,
            rules="nineball",
            shots=300,
            player=carom.player(2.0),
            opponent=carom.player(e),
            best=1,
        )["value"][0]
        for e in (0.2, 8.0)
    ]
    assert values[1] > values[0] + 0.05


def test_goals_and_safeties():
    goal = carom.Goal("near", place=(0.9, 1.2), distance=0.3)
    asked = {"rules": "nineball", "shots": 2000}
    near = carom.plan(TABLE, LAYOUT, goal=goal, best=1, **asked)[0]
    far = carom.plan(TABLE, LAYOUT, goal=goal._replace(distance=0.05), best=1, **asked)[0]
    assert near["value"] > far["value"] + 0.2
    safe = carom.plan(TABLE, LAYOUT, safeties=True, **asked)
    assert {*safe["kind"]} == {Kind.SAFETY}


def test_sequence():
    asked = {"rules": "nineball", "shots": 300}
    run = carom.sequence(TABLE, LAYOUT, plays=40, **asked)
    steps = run.strokes
    assert steps["ruling"]["turn"]["outcome"][-1] == numbered("carom_turn_outcome")["win"]
    assert run.plays == 40 and abs(run.chance - steps["choice"]["value"][0]) < 0.35
    rest = steps["ruling"]["balls"]["state"]["r"][:-1, 0, :2]
    assert (np.ptp(steps["zone"][:-1], axis=1) > 0.02).all()
    assert (np.abs(steps["zone"][:-1].mean(axis=1) - rest) < 0.6).all()
    assert np.isnan(carom.sequence(TABLE, LAYOUT, plays=0, **asked).chance)


def test_run_out():
    """A turn that ends before the game is won is worth nothing to a plan to run out."""
    layout = carom.balls([[0.4, 0.9], [0.3, 1.9], [0.9, 1.7], [0.7, 0.5], [0.2, 0.3]])
    wins, runs = (
        carom.plan(TABLE, layout, rules="nineball", shots=300, best=1, run_out=out)["value"][0]
        for out in (False, True)
    )
    assert runs < wins - 0.02


def test_ratings():
    errors = [float(carom.player(fargo=rating)["phi"]) for rating in (200, 400, 500, 600, 700, 850)]
    assert errors == sorted(errors, reverse=True) and errors[0] > 5 * errors[-1] > 0.0
    rated = [carom.player(fargo=700, rules=game)["phi"] for game in ("eightball", "straight")]
    assert errors[4] < rated[0] < rated[1] < errors[2]


def test_strokes_with_errors():
    """Those of C, which the test players tests, for a seed and a number."""
    cue, player = carom.cue(speed=2.0, phi=40.0), carom.player(2.0)
    sample = np.array([carom.with_errors(cue, player, 5, k) for k in range(4000)])
    assert_allclose([sample["speed"].mean(), sample["phi"].std()], [2.0, 0.2], rtol=0.06)
    assert same_bits(sample[7], carom.with_errors(cue, player, 5, 7))
    player["phi"] = 0.0
    assert carom.with_errors(cue, player, 5)["phi"] == 40.0


def _down(layout, balls):
    layout_after = layout.copy()
    layout_after["state"]["label"][balls] = carom.Label.POCKETED
    return layout_after


def _changed(record, **fields):
    for name, value in fields.items():
        record[name] = value
    return record


RACK = carom.racks.eightball(TABLE)


# ---- Rules
# ----------------------------------------------------------------------------------------------------------------

ORDER = carom.balls(
    [[0.4, 0.4], [0.15, 0.15], [0.9, 1.7], [0.7, 2.2]]
)  # the one before the pocket at the origin


def test_a_referee():
    best = carom.plan(TABLE, ORDER, rules="nineball", shots=300)[0]
    ruling = carom.referee(TABLE, ORDER, best["cue"], rules="nineball")
    assert (ruling.turn, ruling.foul, ruling.hand, ruling.potted, ruling.first) == (
        "keep",
        carom.Foul.NONE,
        "no",
        (1,),
        1,
    )
    assert same_bits(
        ruling.balls["state"], carom.simulate(TABLE, ORDER, best["cue"]).final
    ) and not any(ruling.state.tobytes())
    # eight-ball without a call passes the turn, with it the groups are known
    passed = carom.referee(TABLE, ORDER, best["cue"])
    called = carom.referee(TABLE, ORDER, best["cue"], call=(1, int(best["pocket"])))
    assert (passed.turn, called.turn, int(called.state["group"])) == ("pass", "keep", 1)
    # a foul, and the third of a player
    away = carom.cue(speed=1.0, phi=90.0)
    foul = carom.referee(TABLE, ORDER, away, rules="nineball", state={"fouls": (1, 2)})
    assert (foul.turn, foul.foul, foul.hand, foul.state["fouls"].tolist()) == (
        "pass",
        carom.Foul.NO_BALL,
        "anywhere",
        [2, 2],
    )
    assert foul.foul.text == "the cue ball met no ball"
    assert carom.referee(TABLE, ORDER, away, rules="nineball", state=foul.state).turn == "lose"


def test_the_choices_after_a_break_are_calls():
    """Eight-ball has the balls racked again, which needs all of them."""
    rack, state, cue = carom.racks.eightball(TABLE), {"may": 16 | 32}, carom.cue()
    for call, turn in (((-4, -1), "keep"), ((-5, -1), "pass")):
        ruling = carom.referee(TABLE, rack, cue, state=state, call=call)
        assert (ruling.turn, ruling.foul, ruling.hand) == (turn, carom.Foul.NONE, "kitchen")
        assert int(ruling.state["opening"]) == 1 and int(ruling.state["may"]) == 0


class Corner(carom.Rules):
    """Balls count in one pocket, the number of which is in the state; others come back."""

    race = "alone"

    def on(self, state, in_play):
        return in_play - {0}

    def pockets(self, state):
        return {state[0]}

    def left(self, state, in_play):
        return len(in_play) - 1, 1

    def judge(self, state, in_play, facts, call):
        good = [ball for ball, pocket in facts.potted.items() if ball and pocket == state[0]]
        state[1] += len(good)
        if facts.foul(self.on(state, in_play)) == carom.Foul.CUE_BALL:
            return carom.Turn("pass", "kitchen", carom.Foul.CUE_BALL)
        return carom.Turn(
            "keep" if good else "pass", spot=facts.potted.keys() - set(good), points=len(good)
        )


def test_rules_of_ones_own():
    for pocket in range(6):
        best = carom.plan(
            TABLE, LAYOUT, rules=Corner(), state=[pocket, 5, 0, 0, 0, 0, 0, 0], shots=300
        )
        assert set(best["pocket"]) <= {pocket, -1}
        repeat = carom.plan(
            TABLE, LAYOUT, rules=Corner(), state=[pocket, 5, 0, 0, 0, 0, 0, 0], shots=300, threads=2
        )
        assert same_bits(best, repeat)
    best = carom.plan(TABLE, ORDER, rules="nineball", shots=300)[0]
    corner, pot = int(best["pocket"]), best["cue"]
    ruling = carom.referee(TABLE, ORDER, pot, rules=Corner(), state=[corner, 5, 0, 0, 0, 0, 0, 0])
    assert (ruling.turn, ruling.points, ruling.potted, ruling.state[:2].tolist()) == (
        "keep",
        1.0,
        (1,),
        [corner, 6],
    )
    rulings = carom.referee(
        TABLE, ORDER, pot, rules=Corner(), state=[(corner + 1) % 6, 5, 0, 0, 0, 0, 0, 0]
    )
    assert rulings.turn == "pass" and rulings.balls["state"]["r"][1, :2].tolist() == [
        TABLE.width / 2,
        0.75 * TABLE.length,
    ]


def test_a_plan_is_stopped():
    class Long(Corner):
        calls = 0

        def judge(self, state, in_play, facts, call):
            Long.calls += 1
            if Long.calls == 3000:  # enough for a stroke that pots a ball
                self.ends()
            return super().judge(state, in_play, facts, call)

    rules, stop, state = Long(), threading.Event(), [0] * 8
    rules.ends = stop.set
    best = carom.plan(TABLE, LAYOUT, rules=rules, state=state, shots=1_000_000, stop=stop)
    assert len(best) == 1 and best["value"][0] > 0.0 and Long.calls < 100_000
    Long.calls, rules.ends = 0, lambda: os.kill(os.getpid(), signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        carom.plan(TABLE, LAYOUT, rules=rules, state=state, shots=1_000_000)
    assert Long.calls < 100_000
    late = carom.plan(TABLE, LAYOUT, rules="potting", seconds=1e-9)
    assert len(late) == 1 and late["seen"][0] == 0


def test_the_bot_for_ten_ball(capsys):
    runpy.run_path(str(Path(__file__).parents[2] / "examples" / "ten_ball.py"))
    output = capsys.readouterr().out.splitlines()
    assert (
        len(output) > 5 and output[-1] == f"after {len(output)} strokes: player 0 has won"
    )  # the one with a rating of 750


class Every(Corner):
    """Rules with all methods that C may call, one of which raises."""

    race = "points"
    raises = ""

    def __init__(self):
        self.requests = set()

    def ask(self, method):
        self.requests.add(method)
        if method == self.raises:
            raise KeyError(f"in {method}")

    def on(self, state, in_play):
        self.ask("on")
        return super().on(state, in_play)

    def judge(self, state, in_play, facts, call):
        self.ask("judge")
        return carom.Turn("pass", spot={*facts.potted, *facts.off} - {0})

    def left(self, state, in_play):
        self.ask("left")
        return 2, 2

    def pockets(self, state):
        self.ask("pockets")
        return range(6)

    def points(self, state, in_play, ball):
        self.ask("points")
        assert ball in in_play or ball == -1
        return 1.0

    def settle(self, state, table, balls, turn):
        self.ask("settle")
        state[0] = 7
        turn = super().settle(state, table, balls, turn)
        return dataclasses.replace(turn, points=table.length)


class Valued(Every):
    """With a value too, without which the library asks for points."""

    def value(self, state, layout, in_hand):
        self.ask("value")
        return len(layout) / 16


def test_every_method_of_rules():
    best = carom.plan(TABLE, ORDER, rules="nineball", shots=300)[0]
    every, valued = Every(), Valued()
    ruling = carom.referee(TABLE, ORDER, best["cue"], rules=every)
    # what settle() of the class does is what the library does without one
    spots = type("Spots", (Every,), {"settle": carom.Rules.settle})()
    without = carom.referee(TABLE, ORDER, best["cue"], rules=spots)
    assert ruling.put == {1} and same_bits(ruling.balls, without.balls)
    assert (ruling.state[0], ruling.points, without.points) == (7, TABLE.length, 0.0)
    kinds = {"shots": 100}
    carom.plan(TABLE, LAYOUT, rules=every, **kinds)
    assert every.requests == {"on", "judge", "left", "pockets", "points", "settle"}
    carom.plan(TABLE, LAYOUT, rules=valued, **kinds)
    assert "value" in valued.requests and "points" not in valued.requests

    for method in every.requests | {"value"}:
        every.raises = valued.raises = ""
        match = carom.Match(valued, TABLE, balls=ORDER)
        every.raises = valued.raises = method
        raised = 0
        for call in (
            lambda: carom.plan(TABLE, LAYOUT, rules=every, **kinds),
            lambda: carom.plan(TABLE, LAYOUT, rules=valued, **kinds),
            lambda: carom.referee(TABLE, ORDER, best["cue"], rules=every),
            lambda: match.stroke(best["cue"]),
        ):
            try:
                call()
            except KeyError as wrong:
                assert wrong.args == (f"in {method}",)
                raised += 1
        assert raised > 0, method
    every.raises = valued.raises = ""
    carom.plan(TABLE, LAYOUT, rules=valued, **kinds)  # what was raised once is over
    carom.Match(valued, TABLE, balls=ORDER).stroke(best["cue"])


@pytest.mark.parametrize("place", [(np.nan, 0.5), (9.0, 0.5), (0.6, 1.6)])
def test_balls_are_not_settled_where_none_can_lie(place):
    class Wrong(Every):
        def settle(self, state, table, balls, turn):
            balls["state"]["r"][1, :2] = place
            balls["state"]["r"][2, :2] = 0.6, 1.6
            return turn

    match = carom.Match(Wrong(), TABLE, balls=LAYOUT)
    lines = match.lines[:]
    with pytest.raises(carom.CaromError, match=r"settle: balls\[[12]\]"):
        match.stroke(carom.cue(speed=1.0, phi=200.0))
    assert match.lines == lines and match.phase == "stroke"


def test_errors_of_rules():
    class Wrong(Corner):
        calls = 0

        def judge(self, state, in_play, facts, call):
            Wrong.calls += 1
            raise KeyError("a mistake of the caller")

    with pytest.raises(KeyError, match="a mistake of the caller"):
        carom.plan(TABLE, LAYOUT, rules=Wrong(), shots=100)
    assert Wrong.calls < 3  # it ends the plan
    with pytest.raises(KeyError, match="a mistake of the caller"):
        carom.referee(TABLE, LAYOUT, carom.cue(speed=1.0), rules=Wrong())


def test_straight_pool_and_snooker():
    """Scores, a new rack, and the D come as C has them."""
    table = carom.tables.pool_9ft()
    layout = carom.by_number(
        carom.balls([[0.4, 0.9], [0.3, 1.9], [0.9, 1.7]]), ["cue", 3, 9], "straight"
    )
    best = carom.plan(table, layout, rules="straight", shots=600)[0]
    ball, pocket = best["ball"], best["pocket"]
    ruling = carom.referee(table, layout, best["cue"], rules="straight", call=(ball, pocket))
    assert ruling.facts.first == ruling.first == ball and ruling.facts.potted == {ball: pocket}
    assert (ruling.turn, ruling.score, ruling.points, ruling.hand) == ("keep", (1, 0), 1.0, "no")
    # one ball is left: the others are racked
    at_rest = ruling.balls["state"]["label"] == carom.Label.STATIONARY
    assert np.count_nonzero(at_rest) == 16 and ruling.state["target"] == 100
    missed = carom.referee(
        table, layout, carom.cue(speed=0.5, phi=180.0), rules="straight", state=ruling.state
    )
    assert missed.score == (0, 0) and missed.state["lost"][1] == 1

    table = carom.tables.snooker()
    rack, cue = carom.racks.snooker(table), carom.cue(game="snooker")
    first = carom.plan(table, rack, cue, rules="snooker", in_hand="d", shots=300)[0]
    x, y = first["place"] - [table.width / 2, 0.737]
    assert np.hypot(x, y) < 0.2921 and y < 1e-4


def test_an_aim_that_follows_keeps_the_place_across_the_path():
    """Of what is moved by h, the place where the ball falls stays within h^2; without following it
    moves by h.
    """
    random, wrt, pots = (
        np.random.default_rng(7),
        ["cue.speed", "cue.b", "balls[1].r[0]", "balls[0].r[1]"],
        0,
    )
    closed = {"cushion_model": "smooth", "ball_model": "inelastic"}
    while pots < 8:
        layout = carom.balls(random.uniform([0.2, 0.4], [1.07, 2.1], (2, 2)))
        try:
            target = carom.cue(speed=random.uniform(1.5, 3.0), b=random.uniform(-0.2, 0.3))
            cue = carom.aim(
                TABLE, layout, target, ball=1, pocket=int(random.integers(6)), **closed
            ).cue
            shot = carom.simulate(TABLE, layout, cue, **closed)
            slope = carom.aim_slope(shot, 1, wrt)
        except ValueError:
            continue
        if not (np.abs(carom.tangents(shot, wrt).reach) > 1e-4).all():
            continue
        pots += 1
        fell = shot.events[shot.events["type"] == carom.EventType.POCKET][0]["before"][0]
        across = np.array([-fell["v"][1], fell["v"][0]]) / np.hypot(*fell["v"][:2])

        def moved(j, h, follow):
            balls, stroke = layout.copy(), cue.copy()
            stroke["phi"] += follow * h
            if j < 2:
                stroke[("speed", "b")[j]] += h
            else:
                balls["state"]["r"][1 - (j - 2), j - 2] += h
            shot = carom.simulate(TABLE, balls, stroke, **closed)
            return (
                across
                @ (
                    shot.events[shot.events["type"] == carom.EventType.POCKET][0]["before"][0]["r"]
                    - fell["r"]
                )[:2]
            )

        for j in range(4):
            # central differences of the place, whose error is of the order of h^2
            h = 1e-5
            still, off = (
                (moved(j, h, follow) - moved(j, -h, follow)) / (2 * h)
                for follow in (slope[j], slope[j] + 1.0)
            )
            assert abs(still) < 1e-4 * abs(off) + 1e-7 and abs(off) > 1e-4, (j, still, off)
    with pytest.raises(ValueError, match="ball 0 does not fall"):
        carom.aim_slope(shot, 0, wrt)
    with pytest.raises(
        ValueError,
        match=r"by: 'balls\[0\]\.v\[2\]' does not change the direction of ball 1; use a parameter such as 'cue\.phi'",
    ):
        carom.aim_slope(shot, 1, wrt, by="balls[0].v[2]")


# ---- What is refused
# ------------------------------------------------------------------------------------------------


def aim(ball=1, pocket="foot-left", speed=2.0, **more):
    layout = carom.balls([[0.6, 0.8], [0.4, 1.7]])
    return carom.aim(TABLE, layout, carom.cue(speed=speed), ball=ball, pocket=pocket, **more)


def plan(table=TABLE, balls=RACK, **more):
    return carom.plan(table, balls, shots=100, **more)


def answers(game, **answer):
    """A ruling or a plan by rules whose method answers this."""
    ((method, value),) = answer.items()
    rules = type("Wrong", (game,), {method: lambda *_: value})()
    if method in ("judge", "settle"):
        layout = carom.racks.eightball(TABLE, seed=1)
        return carom.referee(TABLE, layout, carom.cue(speed=0.6, phi=90.0), rules=rules)
    return plan(balls=LAYOUT, rules=rules)


def wider():
    """A table that says that its bed is wider than it is: balls would be dealt beyond its rails."""
    parts = {"rails": TABLE.rails, "jaws": TABLE.jaws, "pockets": TABLE.pockets}
    return carom.Table(TABLE.width + 0.1, TABLE.length, **parts)


# A call, arguments that it takes, and the arguments in whose place it gets values of another kind.
ARGUMENTS = [
    (
        carom.plan,
        {"table": TABLE, "balls": LAYOUT, "rules": "potting", "shots": 100},
        [
            "table",
            "balls",
            "rules",
            "group",
            "state",
            "player",
            "opponent",
            "shots",
            "seconds",
            "in_hand",
            "best",
            "seed",
            "threads",
            "stop",
            "options",
        ],
    ),
    (
        carom.aim,
        {"table": TABLE, "balls": LAYOUT, "cue": carom.cue(), "ball": 1, "pocket": 0},
        ["table", "balls", "cue", "ball", "pocket", "options"],
    ),
    (carom.player, {}, ["errors", "fargo", "rules"]),
    (
        carom.with_errors,
        {"cue": carom.cue(), "player": carom.player(), "seed": 1},
        ["cue", "player", "seed", "number"],
    ),
    (
        carom.potting.Potting,
        {},
        [
            "balls",
            "strokes",
            "table",
            "ball_set",
            "noise",
            "parameters",
            "reward",
            "speeds",
            "cushion_model",
            "threads",
        ],
    ),
]


@pytest.mark.parametrize(("function", "good", "names"), ARGUMENTS, ids=name_of)
def test_a_value_of_another_kind_is_refused_by_the_name_of_its_argument(function, good, names):
    refused_by_name(function, good, names)


# A call, the class of its error, and a pattern with which its message begins.
REFUSALS = [
    (
        lambda: carom.Match("fourball", carom.tables.fourball(), state={"innings": 1}),
        ValueError,
        "innings: out of range; in the game 'fourball' it must be 0, as the game has none",
    ),
    (
        lambda: carom.plan(TABLE, LAYOUT, rules="threecushion", shots=100),
        ValueError,
        "table: it has pockets, but threecushion needs a table without them",
    ),
    (
        lambda: carom.plan(TABLE, RACK[:10], rules="straight"),
        ValueError,
        "balls: there are 10, but straight needs the cue ball and 1 to 15; pocketed balls count too",
    ),
    (
        lambda: carom.referee(
            carom.tables.snooker(), LAYOUT, carom.cue(game="snooker"), rules="snooker"
        ),
        ValueError,
        "balls: there are 4, but snooker needs the cue ball and 1 to 21; pocketed balls count too",
    ),
    (
        lambda: carom.by_number(LAYOUT, ["cue", "5", "5", "9"], "nineball"),
        ValueError,
        "ids: ball '5' is unknown or occurs twice; the balls of nineball are the cue ball and 1 to 9, each once",
    ),
    (
        lambda: carom.by_number(LAYOUT, ["cue", "5", "10", "9"], "nineball"),
        ValueError,
        ".*ball '10'",
    ),
    (
        lambda: carom.by_number(LAYOUT, ["cue", "5", "red", "9"], "eightball"),
        ValueError,
        "ids: ball 'red' is unknown or occurs twice; the balls of eightball are the cue ball and 1 to 15, each once",
    ),
    (lambda: carom.by_number(LAYOUT, ["cue", "0", "1", "9"], "nineball"), ValueError, ".*ball '0'"),
    (
        lambda: carom.by_number(LAYOUT, ["1", "2", "3", "9"], "nineball"),
        ValueError,
        "cue: 'cue' is not exactly one of the ids: 1, 2, 3, 9",
    ),
    (
        lambda: carom.by_number(LAYOUT, ["cue", "5"], "nineball"),
        ValueError,
        r"ids: there are 2 ids for balls of shape \(4,\); pass one id per ball and balls of shape \(balls,\)",
    ),
    (
        lambda: carom.by_number(LAYOUT, ["cue", "5", "2", "9"], "elevenball"),
        ValueError,
        r"rules: unknown value 'elevenball'; did you mean 'tenball'\? Use 'eightball', 'nineball', 'straight', 'snooker', 'onepocket',",
    ),
    (
        lambda: carom.by_number(LAYOUT, ["cue", "red5", "pink", "red20"], "snooker"),
        ValueError,
        ".*ball 'red20'",
    ),
    (
        lambda: carom.chances(TABLE, LAYOUT, [1.0], rules="potting"),
        TypeError,
        r"cues: the dtype is float64; pass the result of carom\.cue\(\)",
    ),
    (lambda: carom.plan(TABLE, LAYOUT, run_out=2), ValueError, "run_out"),
    (
        lambda: carom.player(fargo=0),
        ValueError,
        r"fargo: 0\.0 is out of range; ratings are 200 to 850",
    ),
    (lambda: carom.plan(TABLE, LAYOUT, rules="elevenball"), ValueError, "rules"),
    (lambda: carom.plan(TABLE, LAYOUT, shots=10), ValueError, "shots"),
    (lambda: carom.player(-1.0), ValueError, "errors"),
    (lambda: carom.plan(TABLE, LAYOUT, in_hand=[1.0, 2.0]), ValueError, "in_hand"),
    (lambda: carom.plan(TABLE, LAYOUT, player=carom.cue()), TypeError, "player"),
    (
        lambda: carom.player(rules="snooker"),
        ValueError,
        "rules: a game is given without a rating; pass fargo, too",
    ),
    (
        lambda: carom.player(1.0, fargo=500),
        ValueError,
        "errors, fargo: a player has errors or a rating, not both",
    ),
    (
        lambda: carom.plan(TABLE, LAYOUT, seconds=-1),
        ValueError,
        "seconds: -1 is out of range; it must be 0 to 1e6",
    ),
    (
        lambda: carom.plan(TABLE, LAYOUT, rules=carom.Rules(), shots=100),
        NotImplementedError,
        "Rules needs the method on",
    ),
    (
        lambda: carom.plan(TABLE, LAYOUT, rules=Corner, shots=100),
        ValueError,
        r"rules: Corner is a class; pass an instance, Corner\(\)",
    ),
    (
        lambda: carom.plan(TABLE, LAYOUT[:1], shots=100),
        ValueError,
        "balls: there are 1; a plan needs the cue ball and at least one more",
    ),
    (
        lambda: carom.plan(TABLE, LAYOUT, in_hand="head", shots=100),
        ValueError,
        "in_hand: unknown value 'head'; use 'no', 'anywhere', 'kitchen', 'd' or 'baulk'",
    ),
    (
        lambda: carom.plan(TABLE, LAYOUT, rules=Corner(), state=[1, 2]),
        ValueError,
        r"state: \[1, 2\] are not 8 integers of at least 0",
    ),
    (
        lambda: carom.plan(TABLE, LAYOUT, state={"grup": 1}),
        ValueError,
        r"state: unknown member 'grup'; did you mean 'group'\? Use opening, group, fouls, score, lost, pocket, may, on, free_ball, target,",
    ),
    (
        lambda: carom.plan(TABLE, LAYOUT, state={"group": "reds"}),
        ValueError,
        "state: group: unknown value 'reds'; use 'open', 'solids' or 'stripes'",
    ),
    (
        lambda: carom.plan(TABLE, LAYOUT, state={"group": 3}),
        ValueError,
        "group: out of range; in the game 'eightball' it must be 0, 1 or 2",
    ),
    (lambda: carom.plan(TABLE, LAYOUT, state={"group": 0.5}), ValueError, "state: group: "),
    (
        lambda: carom.plan(TABLE, LAYOUT, state=[0] * 8),
        TypeError,
        r"state: the dtype is int64; pass the result of carom\.referee\(\)\.state",
    ),
    (
        lambda: carom.rating([(500, 1, 1), (500, -1, 1)]),
        carom.CaromError,
        r"scores\[1\] = .*games won and lost 0 to 1e9",
    ),
    (
        lambda: carom.rating([1, 2, 3]),
        ValueError,
        r"scores: the shape is \(3,\), but must be \(opponents, 3\): against, won, lost",
    ),
    (
        lambda: aim(pocket="head-right"),
        ValueError,
        "pocket: no aim at head-right: no direction of the cue sends ball 1 there along this path",
    ),
    (lambda: aim(ball=2), ValueError, "ball: there is no ball 2; use 0 to 1"),
    (
        lambda: aim(pocket="foot"),
        ValueError,
        r"pocket: unknown value 'foot'; did you mean 'foot-left'\? Use 'foot-left', 'foot-right', 'head-left', 'head-right', 'side-left' or",
    ),
    (
        lambda: aim(via=["top"]),
        ValueError,
        "via: unknown value 'top'; use 'foot', 'head', 'left' or 'right'",
    ),
    (
        lambda: aim(via=[1, "left", 1]),
        ValueError,
        r"via: \[1, 'left', 1\] is not a path; pass up to 4 names of rails and indices of balls, each ball once, without the cue ball, and",
    ),
    (
        lambda: aim(speed=0.6),
        ValueError,
        "pocket: no aim at foot-left: ball 1 stops before it gets there; use a higher speed",
    ),
    (
        lambda: plan(state=[0] * 8, group="open"),
        ValueError,
        "state, group: the state contains the group, too; omit one",
    ),
    (
        lambda: plan(state=[0] * 8, opening=True),
        ValueError,
        "state, opening: the state contains the opening, too; omit one",
    ),
    (
        lambda: plan(rules="nineball", group="solids", balls=RACK[:10]),
        ValueError,
        "group: out of range; in the game 'nineball' it must be 0, as the game has none",
    ),
    (
        lambda: plan(rules="potting", opening=True),
        ValueError,
        "opening: out of range; in the game 'potting' it must be 0, as the game has none",
    ),
    (
        lambda: plan(rules="nineball"),
        ValueError,
        "balls: there is no ball 10 in nineball; its balls are the cue ball and 1 to 9",
    ),
    (
        lambda: plan(balls=_down(RACK, slice(1, None))),
        carom.CaromError,
        "balls: no ball is left to play: all balls that count are down, or the eight is",
    ),
    (
        lambda: plan(balls=_down(RACK, slice(1, None)), rules="potting"),
        carom.CaromError,
        ".*no ball is left to play",
    ),
    (lambda: plan(balls=_down(RACK, 8)), carom.CaromError, ".*no ball is left to play"),
    (
        lambda: plan(player=_changed(carom.player(), phi=-1.0)),
        ValueError,
        r"player: phi: -1\.0 is out of range; it must be 0 to 1000",
    ),
    (
        lambda: plan(opponent=_changed(carom.player(), tip_most=3.0)),
        ValueError,
        r"opponent: tip_most: 3\.0 is out of range; it must be 0 to 1",
    ),
    (
        lambda: plan(
            table=carom.tables.threecushion(),
            balls=carom.racks.threecushion(carom.tables.threecushion()),
            rules="potting",
        ),
        ValueError,
        "table: it has no pockets, but potting needs them",
    ),
    (
        lambda: answers(Corner, judge=None),
        TypeError,
        r"judge: it returned None, but must return a carom\.Turn",
    ),
    (
        lambda: answers(Corner, judge=carom.Turn("passes")),
        ValueError,
        r"Turn\.turn: unknown value 'passes'; did you mean 'pass'\? Use 'keep', 'pass', 'win', 'lose' or 'draw'",
    ),
    (
        lambda: answers(Corner, judge=carom.Turn("pass", spot=[99])),
        ValueError,
        r"Turn\.spot: 99 is not an integer from 0 to 31",
    ),
    (
        lambda: answers(Corner, judge=carom.Turn("pass", spot=[30])),
        ValueError,
        r"Turn\.spot: there is no ball 30; the layout has balls 0 to 15",
    ),
    (
        lambda: answers(Corner, judge=carom.Turn("pass", spot=[0, 1])),
        ValueError,
        r"Turn\.spot: balls \[0, 1\] cannot be spotted; spot balls that are pocketed or off the table, but not the cue ball",
    ),
    (
        lambda: answers(Corner, left=(-1, 8)),
        ValueError,
        "left: -1 is not an integer from 0 to 2147483647",
    ),
    (
        lambda: answers(Corner, pockets={9}),
        ValueError,
        "pockets: 9 is not an integer from 0 to 7",
    ),
    (
        lambda: answers(Corner, pockets={"foot-left"}),
        ValueError,
        "pockets: 'foot-left' is not an integer from 0 to 7",
    ),
    (
        lambda: answers(Corner, on={-1}),
        ValueError,
        "on: -1 is not an integer from 0 to 31",
    ),
    (
        lambda: answers(Every, value="half"),
        TypeError,
        "value: 'half' is not a chance of 0 to 1, or without an opponent a number of balls",
    ),
    (lambda: answers(Every, points=None), TypeError, "points: None is not a number of points"),
    (
        lambda: answers(Every, settle=None),
        TypeError,
        r"settle: it returned None, but must return a carom\.Turn",
    ),
    (
        lambda: answers(Every, value=np.nan),
        ValueError,
        "value: nan is not a chance of 0 to 1, or without an opponent a number of balls",
    ),
    (
        lambda: answers(Every, value=1.5),
        ValueError,
        r"value: 1\.5 is not a chance of 0 to 1, or without an opponent a number of balls",
    ),
    (lambda: answers(Every, points=np.inf), ValueError, "points: inf is not a number of points"),
    (lambda: answers(Every, on=None), TypeError, "on: None is not a list of integers"),
    (lambda: answers(Every, left=3), TypeError, "left: 3 is not a list of integers"),
    (
        lambda: answers(Every, left=(1, 2, 3)),
        ValueError,
        r"left: \[1, 2, 3\] are not two numbers; return what the player and the other need",
    ),
    (
        lambda: carom.potting.Potting(balls=0),
        ValueError,
        "balls: 0 is not an integer from 1 to 15",
    ),
    (
        lambda: carom.potting.Potting(strokes=0),
        ValueError,
        "strokes: 0 is not an integer from 1 to 2147483647",
    ),
    (
        lambda: carom.potting.Potting(speeds=(2.0, 1.0)),
        ValueError,
        r"speeds: \(2\.0, 1\.0\) are not two positive and finite speeds, the lower one first",
    ),
    (
        lambda: carom.potting.Potting(noise=(1.0, -1.0, 0.0)),
        ValueError,
        r"noise: \(1\.0, -1\.0, 0\.0\) are not three standard deviations, in degrees, m/s and radii",
    ),
    (
        lambda: carom.potting.Potting(table=carom.tables.threecushion()),
        ValueError,
        "table: it has no pockets; this game needs a table with them",
    ),
    (
        lambda: carom.potting.Potting(table=wider()),
        ValueError,
        r"table: there is a rail at x = 1\.27 m, y = 0\.0891585 m, inside the bed; rails must surround 0 <= x <= width = 1\.37 m, 0 <= y <=",
    ),
    (
        lambda: carom.potting.Potting(parameters={"mu": (0, 1)}),
        ValueError,
        r"parameters: unknown field 'mu'; did you mean 'mu_slide'\? help\(carom\.balls\) lists all",
    ),
    (
        lambda: carom.potting.Potting(parameters={"mass": (2, 1)}),
        ValueError,
        r"parameters: mass: \(2, 1\) are not two bounds, the lower one first",
    ),
    (
        lambda: carom.potting.Potting(parameters={"mu_slide": (-1, 1)}),
        carom.CaromError,
        ".*mu_slide",
    ),
    (
        lambda: carom.potting.Potting(balls=1).layout([[0.5, 0.5]]),
        ValueError,
        r"layout: the shape is \(1, 2\), but must be \(2, 2\), the cue ball first",
    ),
    (
        lambda: carom.potting.Potting(balls=1).layout([[0.5, 0.5], [0.5, 0.51]]),
        carom.CaromError,
        ".*overlap",
    ),
    (
        lambda: carom.potting.Potting(balls=1).cues([0.0, np.nan, 0.0, 0.0]),
        ValueError,
        r"actions: \[ 0\. nan  0\.  0\.\], of shape \(4,\), are not finite numbers of shape \(\.\.\., 4\)",
    ),
    (
        lambda: carom.potting.Potting(balls=1).actions(np.inf, 1.0),
        ValueError,
        r"phi, speed, a, b: inf, 1\.0, 0\.0, 0\.0 are not all finite",
    ),
    (
        lambda: carom.potting.Potting(noise=True),
        TypeError,
        "noise: True is not three standard deviations, in degrees, m/s and radii",
    ),
    (
        lambda: carom.plan(
            carom.tables.threecushion(),
            carom.racks.threecushion(carom.tables.threecushion())[:2],
            rules="threecushion",
            shots=100,
        ),
        ValueError,
        "balls: there are 2, but threecushion needs three",
    ),
    (
        lambda: carom.aim(
            TABLE,
            carom.balls([[0.62, 1.6], [0.4, 2.2], [0.6391, 1.546]]),
            carom.cue(speed=3.0, theta=np.nan, b=-0.5),
            ball=1,
            pocket="foot-left",
        ),
        ValueError,
        r"pocket: no aim at foot-left: the stick needs an elevation of 60\.1 degrees to clear what is behind the cue ball, above the limit",
    ),
    (
        lambda: carom.plan(
            carom.tables.pool_9ft(),
            carom.by_number(
                carom.balls([[0.6, 1.4], [0.95, 2.1], [0.3, 2.1]]), ["cue", 3, 9], "onepocket"
            )[:10],
            rules="onepocket",
        ),
        ValueError,
        "balls: there are 10, but onepocket needs the cue ball and 1 to 15; pocketed balls count too",
    ),
    (
        lambda: carom.plan(
            carom.tables.pool_9ft(),
            carom.by_number(
                carom.balls([[0.6, 1.4], [0.95, 2.1], [0.3, 2.1]]), ["cue", 3, 9], "onepocket"
            ),
            rules="onepocket",
            opening=True,
        ),
        ValueError,
        "opening: out of range; in the game 'onepocket' it must be 0, as the game has none",
    ),
    (
        lambda: carom.aim_slope(TABLE, 1, ["cue.speed", "cue.b", "balls[1].r[0]", "balls[0].r[1]"]),
        TypeError,
        "shot: ",
    ),
    (lambda: carom.odds((600,)), ValueError, "ratings"),
    (lambda: carom.odds((600, 500), 101), ValueError, "games"),
    (
        lambda: carom.odds((600, 500), break_points=1001),
        ValueError,
        r"ratings, break_points: \[600, 500\], 1001 is out of range; ratings are 0 to 1000 and break_points -1000 to 1000",
    ),
    (lambda: carom.odds((600, 500), side=2), ValueError, "side"),
    (lambda: carom.odds((600, 500), order="luck"), ValueError, "order"),
    (lambda: carom.best_breaks("nineball", TABLE, RACK[:10], breaks=15), ValueError, "breaks"),
    (lambda: carom.best_breaks("nineball", TABLE, RACK[:10], best=9), ValueError, "best"),
    (lambda: carom.best_breaks("nineball", TABLE, RACK[:10], gap=-1.0), carom.CaromError, "rack"),
    (lambda: carom.best_breaks("straight", TABLE, RACK[:10]), ValueError, "rack"),
    (
        lambda: plan(balls=LAYOUT, rules="nineball", goal=carom.Goal("close")),
        ValueError,
        "goal: unknown value 'close'; use 'win', 'hidden', 'snooker', 'near' or 'apart'",
    ),
    (
        lambda: plan(
            balls=LAYOUT, rules="nineball", goal=carom.Goal("near", place=(0.9, 1.2), distance=0.0)
        ),
        carom.CaromError,
        "",
    ),
    (lambda: plan(balls=LAYOUT[[0, 0, 1]]), carom.CaromError, ""),
    (
        lambda: carom.chances(TABLE, LAYOUT, carom.cue(speed=[2.0])[:0], rules="potting"),
        ValueError,
        "cues: there are 0; pass 1 to 1000",
    ),
    (
        lambda: carom.chances(
            TABLE, LAYOUT, _changed(carom.cue(speed=[2.0, 1.0]), speed=[2.0, -1.0]), rules="potting"
        ),
        carom.CaromError,
        "cues",
    ),
    (
        lambda: carom.value(TABLE, _down(LAYOUT, 0), rules="nineball"),
        carom.CaromError,
        ".*it must be in play",
    ),
    (
        lambda: carom.referee(TABLE, LAYOUT, carom.cue(), state={"may": 16 | 32}, call=(-4, -1)),
        ValueError,
        ".*there is no ball 4; the layout has balls 0 to 3",
    ),
    (
        lambda: carom.referee(TABLE, LAYOUT, carom.cue(), state={"may": 16 | 32}, call=(-5, -1)),
        ValueError,
        ".*there is no ball 4; the layout has balls 0 to 3",
    ),
    (lambda: carom.referee(TABLE, LAYOUT, _changed(carom.cue(), speed=-1.0)), carom.CaromError, ""),
    (lambda: carom.review(TABLE, LAYOUT, carom.cue(), rules="potting"), carom.CaromError, "rules"),
]


@pytest.mark.parametrize(("call", "error", "message"), by_line(REFUSALS))
def test_refusals(call, error, message):
    refused(call, error, message)


def test_odds():
    """Odds are binomial without a break; sets are a chain."""
    p = 2 / 3
    odds = carom.odds((600, 500), (2, 1))
    assert_allclose([odds.game, odds.match, odds.set], [p, p**2, p**2])
    assert_allclose(odds.score[2, 0], p**2)
    assert_allclose([odds.score[0, 1], odds.score[1, 1]], [1 - p, p * (1 - p)])
    assert odds.fair == (2, 1) and sum(odds.score.values()) == pytest.approx(1.0)
    sets = carom.odds((600, 500), sets=(2, 1), order="winner", side=0, break_points=100)
    assert sets.score[2, 0] == pytest.approx(0.8 * 0.5) and sets.game == odds.game


def test_breaks():
    """The breaks come with their results, the best first, as C says."""
    rack = carom.racks.nineball(TABLE, seed=3)
    weak = carom.player(2.0)
    best = carom.best_breaks("nineball", TABLE, rack, player=weak, breaks=32, best=4)
    wins = best["counts"]["wins"] / best["counts"]["breaks"]
    assert (np.diff(wins) <= 0).all() and (best["counts"]["breaks"] == 32).all()
    assert (best["place"][:, 1] <= 0.635).all() and (best["cue"]["speed"] <= 9.0).all()
    assert np.isfinite(best["cost"]).tolist() == [True, False, False, False]
    slow = carom.best_breaks(
        "nineball", TABLE, rack, carom.cue(speed=5.0), opponent=weak, breaks=32, best=1
    )
    assert slow["cue"]["speed"][0] <= 5.0


def test_reviews():
    """A stroke beside the aim that a plan finds is off by so much, and costs a miss; the drill is
    of its pot.
    """
    table = carom.tables.pool_9ft()
    layout = carom.balls([[0.5, 1.2], [0.9, 1.3], [0.35, 1.9]])
    balls = carom.by_number(layout, ["cue", 9, 8], "nineball")
    aim = carom.aim(table, balls, carom.cue(speed=2.0), ball=8, pocket="foot-left").cue
    played = aim.copy()
    played["phi"] += 3.0
    asked = {"rules": "nineball", "player": carom.player(2.0)}
    review = carom.review(table, balls, played, **asked)
    assert (review.ball, review.pocket, review.kept) == (8, 2, False)
    assert review.off == pytest.approx(3.0) and review.aim["phi"] == pytest.approx(aim["phi"])
    assert review.miss_cost > 0.05 and 0.2 < review.told <= 1.0
    assert review.miss_cost + review.place_cost == pytest.approx(review.value - review.came)
    assert 200 <= review.drill.rating <= 850 and review.drill.radius == 0.0
    played["phi"] += 177.0
    other = carom.review(table, balls, played, **asked)
    assert (other.group, other.ball, other.drill) == ("no pot", None, None)


def test_rating():
    """Without games it is that of the prior; each opponent is a row."""
    assert carom.rating([]) == pytest.approx((426.37834, 219.09101, 696.51005))
    rows = [(500, 7, 3), (600, 2, 4)]
    assert carom.rating(rows) == pytest.approx((541.01983, 409.47716, 672.87243))
