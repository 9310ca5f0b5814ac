"""random_matches.py ACTS RULED: the acts that random_matches.c wrote, judged in Python."""

import sys

import carom

MAY = ["pass", "push", "free_ball", "place", "rack", "other_rack", "stay", "spot"]
PHASES = ("none", "stroke", "place", "moving", "over")


def bits(members):
    return sum(1 << k for k in members)


def act(match, words):
    """One act, by its words."""
    what, numbers = words[0], [float(word) for word in words[1:]]
    if what == "choose":
        match.choose(MAY[int(words[1])])
    elif what == "place":
        match.place(*numbers)
    elif what == "call":
        match.call(int(words[1]), int(words[2]))
    elif what == "clock":
        match.clock()
    elif what == "concede":
        match.concede(int(words[1]))
    elif what in ("extend", "timeout", "next", "undo", "redo"):
        getattr(match, what)()
    elif what != "again":
        ball, speed, phi, theta, a, b = numbers
        match.stroke(carom.cue(speed=speed, phi=phi, theta=theta, tip=(-a, b), ball=int(ball)))


def outcome(match, words):
    """What came of it."""
    try:
        act(match, words)
    except carom.CaromError as refused:
        return str(refused)
    may = bits(MAY.index(word) for word in match.may)
    winner = -1 if match.winner is None else match.winner
    events = len(match.shot.events) if match.shot else 0
    again = f"{events} events\n" if words == ["again"] else ""
    words = match.ruling.words if match.ruling else ""
    return again + (
        f"taken: phase {PHASES.index(match.phase)}, seat {match.seat}, "
        f"winner {8 if match.drawn else winner}, may {may}, "
        f"ball {match.cue_ball}, on {bits(match.on)}, touching {bits(match.touching)}: {words}"
    )


with open(sys.argv[1]) as acts, open(sys.argv[2], "w") as ruled:
    match, begins = None, []
    for line in acts:
        if line == "match\n":
            match, begins, known = None, [], 0
        elif line.startswith("{"):
            begins.append(line)
        else:
            if match is None:
                match = carom.Match.load(begins)
                ruled.writelines(match.lines)
                known = len(match.lines)
            if line == "again\n":
                match = match.copy()
            said = outcome(match, line.split())
            ruled.writelines(match.lines[known:])
            known = len(match.lines)
            ruled.write(f"{said}\n")
