"""Matches: what is refused, choices, shots in parts, recordings that are judged, rules of one's own."""

import pickle

import numpy as np
import pytest
from conftest import by_line, refused, same_bits

import carom
from carom.games.rules import GAMES
from carom.plans import Kind

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
        (lambda: match.stroke(BREAK), "stroke: the cue ball is in hand: place it"),
        (lambda: match.call(16), "call: ball 16 .* may: 1, 2"),
        (lambda: match.choose("pass"), "choose: the choices are: none"),
        (match.resume, "resume: no ball moves: play a stroke"),
    ]:
        with pytest.raises(carom.CaromError, match=message) as caught:
            act()
        assert caught.value.status == carom.Status.ERROR_ACT
    assert match.lines == lines and match.phase == "place"


def test_a_shot_in_parts_is_ruled_at_its_end():
    match = begun()
    match.place(0.6, 0.6)
    assert not match.stroke(BREAK, t_final=0.3)
    assert match.phase == "moving" and match.ruling is None and match.shot.time == 0.3
    parts = match.copy()
    assert not parts.resume(t_final=0.6) and parts.shot.time == 0.6
    with pytest.raises(carom.CaromError, match="balls move"):
        match.stroke(BREAK)
    half = carom.Match.load("".join(match.lines))
    assert half.phase == "moving" and same_bits(half.shot.events, match.shot.events)
    moving = half.shot
    assert match.resume() and half.resume() and parts.resume()
    others = [other.shot for other in (half, parts, carom.Match.load(match.lines))]
    for shot in (carom.resume(moving), *others):
        assert same_bits(shot.events, match.shot.events)
    assert half.lines == match.lines and half.ruling.words == match.ruling.words
    assert match.ruling.shot.count == match.shot.count > 100
    assert same_bits(match.ruling.balls, match.balls)
    match.concede(0)
    assert match.winner == 1 and carom.Match.load(match.end().splitlines()).winner == 1


def test_a_match_with_equal_innings_is_drawn():
    table, perfect = carom.tables.threecushion(), carom.player(0)
    match = carom.Match("straightrail", table, seed=1, state={"target": 1, "innings": 1})
    match.take(match.plan(shots=100, player=perfect)[0])
    assert match.phase == "stroke" and match.side == 1 and match.state["innings"] == 3
    assert not match.drawn and match.ruling.words == "the other has the equalizing inning"
    match.take(match.plan(shots=100, player=perfect)[0])
    assert match.phase == "over" and match.drawn and match.winner is None
    assert match.ruling.turn == "draw" and carom.Match.load(match.end().splitlines()).drawn


def test_a_file_that_was_cut_off_behind_a_shot_goes_on():
    match = begun(side=1)
    match.place(0.6, 0.6)
    match.stroke(BREAK)
    index = next(k for k, line in enumerate(match.lines) if line.startswith('{"shot"'))
    restored = carom.Match.load(match.lines[: index + 1])
    assert restored.lines == match.lines and restored.side == match.side
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
    assert (restored.phase, restored.side) == ("place", match.side)
    with pytest.raises(carom.CaromError, match="place: .*0.635"):
        restored.place(0.6, 0.64)
    assert restored.plan(shots=100, best=1)[0]["place"][1] <= TABLE.length / 4


def test_choices_are_taken():
    match = begun()
    match.place(0.6, 0.6)
    match.stroke(carom.cue(speed=1.5, phi=90.0))  # no legal break
    assert {"rack", "other_rack"} <= {*match.may} and match.side == 1
    match.choose("other_rack")
    assert match.side == 0 and match.state["opening"] == 1


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
    assert (
        match.side == 1 and match.state["user"][0] == 1 and match.ruling.words == "the other plays"
    )
    assert np.array_equal(carom.Match.load(match.lines, rules=rules).balls, match.balls)
    with pytest.raises(carom.CaromError, match="must be a game of carom.plan"):
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
    assert match.side == 0

    # A ball behind the head string may not be met first by a cue ball that was placed there.
    balls = carom.racks.eightball(TABLE)
    balls["state"]["label"][3:] = carom.Label.POCKETED
    balls["state"]["r"][:3, :2] = [[0.6, 0.3], [0.06, 0.06], [0.9, 2.0]]
    match = carom.Match("straight", TABLE, balls=balls, hand="kitchen")
    match.place(0.6, 0.3)
    free = carom.plan(TABLE, match.balls, rules="straight", state=match.state, shots=300)[0]
    best = match.plan(shots=300)[0]
    assert (free["ball"], free["kind"]) == (1, Kind.POT) and best["kind"] != Kind.POT

    match.concede(0)
    with pytest.raises(carom.CaromError, match="plan: the match is over"):
        match.plan(shots=100)


def test_partners_play_a_set_with_handicaps_limits_and_time():
    match = carom.Match(
        "straight",
        TABLE,
        seats=["Ann", {"name": "Bo", "handicap": 15, "rating": 600}, "Cy", "Di"],
        alternate=True,
        limits={"speed": 12.0, "own_cue": True, "tip": None},
        set={"race": 2, "order": "winner", "clock": 30.0, "extensions": 1},
    )
    assert [seat.name for seat in match.seats] == ["Ann", "Bo", "Cy", "Di"]
    assert match.seats[1][1:4] == (1, 15, 600.0) and match.limits["tip"] == 0.0
    assert match.standing == ((0, 1, 0, 1), (0, 15), (0, 0), None)
    assert match.words == "Ann (seat 0): a position of the cue ball in hand, or a choice"
    match.take(match.plan(shots=100, best=1)[0], seat=0)
    assert match.seat in (1, 2) and match.state["seat"] == match.seat
    assert len(match.plan(shots=100, best=1)) == 1 and match.undo()
    match.extend()
    cue = match.cue
    for field, wrong, message in [
        ("speed", 12.5, "stroke: cue.speed must be at most 12 m/s in this match"),
        ("mass", 0.5, "stroke: stick and tip must be the same as for seat 0"),
    ]:
        faulty = cue.copy()
        faulty[field] = wrong
        with pytest.raises(carom.CaromError, match=message):
            match.stroke(faulty)
    for act, message in [
        (match.extend, "extend: none is left"),
        (match.timeout, "timeout: none is left"),
        (match.next, "next: no match has been won"),
        (lambda: match.clock(seat=2), "clock: seat 0 is at the table"),
    ]:
        with pytest.raises(carom.CaromError, match=message):
            act()
    cue["phi"], cue["speed"] = 200.0, 1.0
    match.stroke(cue)
    assert (match.seat, match.side) == (1, 1)
    match.concede(3)
    assert match.winner == 0 and match.words == "Ann (seat 0) and Cy (seat 2) have won"
    match.next()
    assert match.set["number"] == 2 and match.set["won"] == (1, 0) and match.side == 0
    match.concede()
    match.next()
    match.concede(0)
    assert match.standing.set_winner == 1 and match.standing.won == (1, 2)
    assert carom.Match.load(match.end()).lines == match.lines


# A call, the class of its error, and a pattern with which its message begins.
REFUSALS = [
    (
        lambda: carom.Match("eightball", TABLE, seats=1),
        ValueError,
        r"seats: this game is not played with 1 seats; help\(carom\.Match\) describes seats",
    ),
    (
        lambda: carom.Match("eightball", TABLE, seats="Ann"),
        TypeError,
        "seats: 'Ann' is not a number of seats, or a list of names or mappings with name, side, handicap, rating, cue",
    ),
    (
        lambda: carom.Match("eightball", TABLE, seats=[{"nam": "Ann"}, "Bo"]),
        TypeError,
        r"seats\[0\]: unknown member 'nam'; did you mean 'name'\? Use name, side, handicap, rating or cue",
    ),
    (
        lambda: carom.Match("eightball", TABLE, seats=[{"side": 1}, {"side": 3}]),
        carom.CaromError,
        "begin: seats: side must be 0, 1 and so on",
    ),
    (
        lambda: carom.Match("eightball", TABLE, limits={"speeds": 1}),
        TypeError,
        r"limits: unknown member 'speeds'; did you mean 'speed'\? Use speed, theta, tip, mass_least, mass_most, end_mass_least,",
    ),
    (
        lambda: carom.Match("eightball", TABLE, set={"race": 1001}),
        carom.CaromError,
        "begin: set.race must be 1 to 1000",
    ),
    (
        lambda: carom.Match("eightball", TABLE, set={"order": "loosers"}),
        ValueError,
        r"set: order: unknown value 'loosers'; did you mean 'loser'\? Use 'alternate', 'winner' or 'loser'",
    ),
    (
        lambda: carom.Match("eightball", TABLE, balls=carom.racks.eightball(TABLE)[:5]),
        carom.CaromError,
        ".*ball 8 on the table; the drill of potting",
    ),
    (
        lambda: carom.Match.load(""),
        carom.CaromError,
        'line 1: the recording is empty; a match begins with a line "recording" and further lines up to "game"',
    ),
    (
        lambda: carom.Match.load(begun().lines[:3]),
        carom.CaromError,
        'line 4: the recording has no line game; a match begins with a line "recording" and further lines up to "game"',
    ),
]


@pytest.mark.parametrize(("call", "error", "message"), by_line(REFUSALS))
def test_beginnings_that_are_refused(call, error, message):
    refused(call, error, message)


def test_a_peer_sends_its_own_acts_alone():
    ann = begun()
    bob = carom.Match.load(ann.lines)
    for act in (lambda: ann.place(0.6, 0.6), lambda: ann.stroke(BREAK)):
        known = len(ann.lines)
        act()
        sent, lines = ann.lines[known:], bob.lines
        with pytest.raises(carom.CaromError, match="seat 1 has sent an act of seat 0"):
            bob.receive(sent[0], 1)
        with pytest.raises(carom.CaromError, match="line"):
            bob.receive(sent[0].replace("0.6", "0.7").replace("90.2", "90.3"), 0)
        assert bob.lines == lines
        changes = [bob.receive(line, 0) for line in ["", *sent]]
        assert changes == [False, True, *[False] * (len(sent) - 1)]
        assert bob.lines == ann.lines
    assert same_bits(bob.shot.events, ann.shot.events)
    bob.read(ann.lines[-1].replace("game", "event"))
    assert bob.lines == ann.lines


def test_acts_are_undone_and_done_again():
    match = begun()
    assert not match.undo() and not match.redo()
    match.place(0.6, 0.6)
    match.stroke(BREAK)
    whole = match.lines
    assert match.undo() and match.phase == "stroke" and match.undo() and match.phase == "place"
    twin = match.copy()
    assert match.redo() and match.redo() and not match.redo() and match.lines == whole
    twin.place(0.5, 0.5)
    assert not twin.redo() and twin.balls["state"]["r"][0, 0] == 0.5


def test_every_game_is_planned_with_its_own_cue():
    # match.cue_ball is ball 1 of the second player of three-cushion, straight rail and four-ball.
    tables = {"snooker": "snooker", "blackball": "blackball", "pyramid": "pyramid"}
    tables |= {"threecushion": "threecushion", "straightrail": "threecushion"}
    tables |= {"fourball": "fourball", "billiards": "snooker"}
    stick = ["mass", "end_mass", "tip_radius"]
    for game in GAMES:
        table = getattr(carom.tables, tables.get(game, "pool_9ft"))()
        seats = ["", {"rating": 500}, ""][: 3 if game == "cutthroat" else 2]
        match = carom.Match(game, table, seed=1, side=1, seats=seats)
        best = match.plan(shots=100, best=1)[0]
        assert best["cue"][stick] == match.cue[stick] == match.seats[1].cue[stick], game
        match.prepare(best)
        assert match.phase == "stroke" and not match.take(best, t_final=1e-3), game
        assert match.phase == "moving" and match.shot.time == 1e-3, game
    assert carom.Match("snooker", carom.tables.snooker()).cue["mass"] == 0.478


class Killer(carom.Rules):
    """Who pots nothing loses a life; the last one has won."""

    race = "seats"
    any_cue_ball = True

    def on(self, state, in_play):
        return in_play - {0}

    def left(self, state, in_play):
        return 1, 1

    def value(self, state, layout, in_hand):
        return state[state.seat] / sum(state)

    def judge(self, state, in_play, facts, call):
        if not facts.potted.keys() - {facts.cue_ball}:
            state[state.seat] -= 1
        alive = [k for k in (*range(state.seat + 1, 8), *range(state.seat + 1)) if state[k]]
        state.seat = alive[0]
        return carom.Turn("win" if len(alive) == 1 else "pass")


def test_killer_of_five_seats():
    rules, lives = Killer(), [2, 2, 2, 2, 2, 0, 0, 0]
    layout = carom.balls([[0.6, 0.6], [0.6, 1.8], [0.3, 1.5]])
    match = carom.Match(rules, TABLE, balls=layout, state=lives, seats=5)
    turns = []
    while match.phase != "over":
        turns.append(match.seat)
        cue = match.cue
        cue["speed"], cue["ball"] = 0.2, len(turns) % 3
        match.stroke(cue)
    assert turns == [0, 1, 2, 3, 4] + [0, 1, 2, 3] and match.winner == 4
    assert match.standing == ((0, 1, 2, 3, 4), (0, 0, 0, 0, 1), (0,) * 5, None)
    assert match.ruling.facts.cue_ball == 0 and match.words == "seat 4 has won"
    state = carom.rules.Words(lives, seat=3)
    assert carom.plan(TABLE, layout, rules=rules, state=state, shots=100)["value"][0] > 0.0
    assert carom.referee(TABLE, layout, cue, rules=rules, state=state).seat == 4
    again = carom.Match.load(match.lines, rules=rules)
    assert again.winner == 4 and again.undo() and again.seat == 3 and again.redo()
    match = carom.Match(rules, TABLE, balls=layout, state=lives, seats=5)
    rules.judge = lambda *_: 1 / 0
    with pytest.raises(ZeroDivisionError):
        match.plan(shots=100)
    match.concede(0)  # what a plan raised is over
    assert match.seat == 1


@pytest.mark.parametrize(("diameter", "fair"), [(0.05245, True), (0.0525, True), (0.05262, False)])
def test_touching_ball_of_snooker_in_the_sizes_of_the_rules(diameter, fair):
    """The cue ball touches a red, so that is on, and is played away onto the pink, which pots
    another red. Balls measure 52.5 mm, give or take 0.05 mm, and touch below 0.1 mm.
    """
    table = carom.tables.snooker()
    cue_ball, red = np.array([0.9, 2.2]), np.array([table.width - 0.06, table.length / 2 + 0.002])
    way = (red - cue_ball) / np.linalg.norm(red - cue_ball)
    balls = carom.racks.snooker(table)
    balls["state"]["label"][3:16] = int(carom.Label.POCKETED)
    places = {0: cue_ball, 1: cue_ball - [diameter, 0], 2: red, 20: cue_ball + 0.35 * way}
    for ball, place in places.items():
        balls["state"]["r"][ball, :2] = place
    phi = np.degrees(np.arctan2(way[1], way[0])) - 0.1
    cue = carom.cue(ball_speed=1.6, phi=phi, a=0, b=0, game="snooker")
    ruling = carom.referee(table, balls, cue, rules="snooker", state={"on": 0})
    assert tuple(ruling.potted) == (2,)
    assert (not ruling.foul) == fair


def test_notes():
    match = begun()
    match.note(date="2026-11-30", event="Clube «Carambola»", x_elo=1700, x_app="kiosk 3")
    match.place(0.6, 0.6)
    assert not match.stroke(BREAK, t_final=0.3)
    match.note(seat=0, comment='a "long" break\\', seconds=0.1 + 0.2)
    assert match.resume()
    match.note(seat=1, offer="draw")
    match.note(seat=0, answer="no")
    notes = [
        {"date": "2026-11-30", "event": "Clube «Carambola»", "x_elo": 1700, "x_app": "kiosk 3"},
        {"seat": 0, "comment": 'a "long" break\\', "seconds": 0.3},
        {"seat": 1, "offer": "draw"},
        {"seat": 0, "answer": "no"},
    ]
    assert match.notes == notes

    # The game has the bits and hashes that it has without them.
    silent = begun()
    silent.place(0.6, 0.6)
    silent.stroke(BREAK, t_final=0.3)
    silent.resume()
    assert [line for line in match.lines if '"note"' not in line] == silent.lines
    assert same_bits(match.balls, silent.balls) and match.state == silent.state

    # They are read again, byte for byte, and copied; an undone act takes those behind it with it.
    for other in (carom.Match.load(match.lines), match.copy(), pickle.loads(pickle.dumps(match))):
        assert other.lines == match.lines and other.notes == notes
    undone = match.copy()
    assert undone.undo() and undone.notes == notes[:2]
    assert undone.redo() and undone.lines == match.lines


def test_a_note_between_an_act_and_its_ruling():
    match = begun()
    match.place(0.6, 0.6)
    match.stroke(BREAK)
    note = '{"note":{"comment":"a good break","seconds":"0x1.8p+1"}}\n'
    lines = [line for each in match.lines for line in (each, note)]
    loaded = carom.Match.load(lines)
    assert loaded.lines == lines
    assert loaded.notes[-1] == {"comment": "a good break", "seconds": 3.0}


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ({}, "says nothing"),
        ({"comment": "two\nlines"}, "comment must have no control characters"),
        ({"comment": "\x85"}, "comment must have no control characters"),
        ({"comment": "é" * 512}, "comment must have at most 1023 bytes"),
        ({"offer": "money"}, "offer must be draw or take_back"),
        ({"answer": "maybe"}, "answer must be yes or no"),
        ({"seconds": -1}, "seconds must be 0 or more"),
        ({"seconds": float("nan")}, "seconds must be a number"),
        ({"comment": "hello", "seat": 2}, "seat 2 is not one of the match"),
        ({"chat": "hello"}, "note.chat is not a key of the format"),
        ({"x_": "hello"}, "must have keys of x_"),
        ({f"x_{k}": k for k in range(9)}, "x_8 is one key too many"),
        ({"x_a": float("inf")}, "x_a must be a text in quotes or a number"),
    ],
)
def test_notes_that_are_refused(words, message):
    match = begun()
    lines = match.lines
    with pytest.raises(carom.CaromError, match=message):
        match.note(**words)
    assert match.lines == lines and match.notes == []
    match.place(0.6, 0.6)


def test_notes_of_wrong_types_are_refused():
    match = begun()
    for words in ({"comment": 7}, {"x_a": None, "date": 2026}, {"x_a": True}, {"x_a": [1]}):
        with pytest.raises(TypeError, match="it must be a text"):
            match.note(**words)
