"""hostile.py ROWS MATCH: the lines that hostile.c wrote, received by a match of Python."""

import sys
from pathlib import Path

import carom


def state_of(game):
    """What a refused line may not change."""
    return game.lines, game.phase, game.seat, game.actor, game.shots


begin, act, rows = [], [], []
for line in Path(sys.argv[1]).read_text().split("\n")[:-1]:
    word, rest = line.split(" ", 1)
    if word == "begin":
        begin.append(rest)
    elif word == "place":
        game = carom.Match.load(begin)
        assert game.actor is None
        assert game.receive(rest, 0)
    elif word == "act":
        act.append(rest + "\n")
    else:
        rows.append(rest.split("|", 2))
for name, seat, text in rows:
    state, why = state_of(game), ""
    try:
        assert not game.receive(text, int(seat)), f"{name} is accepted"
        assert text.strip() == "" or text.startswith('{"event"'), f"{name} is not refused"
    except carom.CaromError as refused:
        why = str(refused)
        assert why, f"{name} has no reason"
    assert state_of(game) == state, f"{name} changed the match"

    # The honest act: its line, then the lines of its ruling, then all again.
    twin = game.copy()
    assert twin.receive(act[0], 0), f"{name}: the honest line is not accepted behind it"
    assert twin.lines == game.lines + act, f"{name}: the honest act has other lines behind it"
    assert not any(twin.receive(line, 0) for line in act + act), f"{name}: a line is new"
    assert (twin.lines, twin.actor) == (game.lines + act, 0)

# A note, and some that are refused.
talk = game.copy()
talk.note(seat=1, comment='He said "nice"', offer="draw", seconds=12.5, x_club="A \\ B")
said = talk.lines[-1]
assert talk.notes == [
    {
        "seat": 1,
        "comment": 'He said "nice"',
        "offer": "draw",
        "seconds": 12.5,
        "x_club": "A \\ B",
    }
]
for wrong in ({"comment": "two\nlines"}, {"offer": "money"}, {"chat": "hello"}, {"seat": 2}, {}):
    try:
        talk.note(**{"seat": 0, **wrong, **({"comment": "hello"} if "seat" in wrong else {})})
    except carom.CaromError as refused:
        assert str(refused)
    else:
        raise AssertionError(f"{wrong} is not refused")
    assert talk.lines == [*game.lines, said]
assert talk.receive(act[0], 0)
assert talk.lines == [*game.lines, said, *act]
assert carom.Match.load(talk.lines).notes == talk.notes
print(said, end="")

# A ruling of a file that is read only in part: no line is lost, whatever comes next.
lines = Path(sys.argv[2]).read_text().splitlines(keepends=True)
whole = [*game.lines, *act]
following = lines[len(whole)]
assert len(act) > 1
assert lines[: len(whole)] == whole
for partial in (game.copy(), carom.Match.load([*game.lines, act[0]])):
    if partial.lines == game.lines:
        partial.read(act[0])
    assert partial.lines == whole
    noted = partial.copy()
    noted.read(said)
    assert noted.lines == [*game.lines, act[0], said, *act[1:]]
    try:
        partial.place(9.0, 9.0)
    except carom.CaromError as refused:
        assert str(refused)
    else:
        raise AssertionError("a place off the table is not refused")
    assert partial.lines == whole
    for judged in (partial.copy(), noted):
        before = judged.lines
        assert not judged.receive(act[1], 0)
        assert judged.receive(following, None)
        assert judged.lines[: len(before) + 1] == [*before, following]
    spoken = partial.copy()
    spoken.note(seat=1, comment="between")
    assert spoken.lines[:-1] == whole
    for line in act[1:]:
        partial.read(line)
    assert partial.lines == whole

# The whole match, to its end.
for line in lines[len(game.lines) :]:
    game.receive(line, None)
assert game.lines == lines
print(f"{len(rows)} rows")
