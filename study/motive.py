"""The motive of the seed paper: how much of a pooltool shot is the collision of two balls, and what
a faster one gives. `python3 -m study.motive`, by a Python that has pooltool and carom's package:

    python3 -m venv build/motive
    build/motive/bin/pip install ./python pooltool-billiards
    build/motive/bin/python3 -m study.motive -o build/results/report/motive.csv

Four of pooltool's own systems are simulated in turns: by pooltool with its own collision (Mathavan,
N = 1000, compiled by Numba), by pooltool with carom's exact collision instead, and by
carom's drop-in for the whole engine. Times are processor time, medians over the turns.

    events, exact_events     of the shot, by pooltool and with carom's collision
    collisions               of two balls, by pooltool
    pooltool_ms              a shot by pooltool
    collision_ms, share      spent in its collisions of balls, and as a part of the shot
    with_paper               how many times as fast the shot is with collisions 1.93 times as fast
    exact_in_it, drop_in     how many times as fast with carom's collision, and with its engine
    spread                   median absolute deviation of pooltool_ms, as a part of it
"""

import argparse
import csv
import datetime
import importlib.util
import statistics
import sys
import time

PAPER = 1.93  # the paper's speedup of a collision
NEEDED = {"pooltool": "pooltool-billiards", "carom": "./python"}


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        models = [line.partition(": ")[2].strip() for line in file if line.startswith("model name")]
    return models[0] if models else "NA"


class Timed:
    """A collision model of pooltool's that adds up the processor time of its calls."""

    def __init__(self, model):
        self.model, self.spent, self.calls = model, 0.0, 0

    def __getattr__(self, name):
        return getattr(self.__dict__["model"], name)

    def resolve(self, *arguments, **named):
        begin = time.process_time_ns()
        result = self.model.resolve(*arguments, **named)
        self.spent += time.process_time_ns() - begin
        self.calls += 1
        return result


def opening(pooltool, game, seed, speed, aside=0.0):
    """The first stroke of a game: the cue ball at the rack or at the red ball."""
    import numpy

    numpy.random.seed(seed)
    table = pooltool.Table.from_game_type(game)
    balls = pooltool.get_rack(game, table, spacing_factor=1e-3)
    cue, target = ("cue", "1") if "cue" in balls else ("white", "red")
    system = pooltool.System(cue=pooltool.Cue(cue_ball_id=cue), table=table, balls=balls)
    x, y = (balls[target].xyz - balls[cue].xyz)[:2]
    system.strike(V0=speed, phi=float(numpy.degrees(numpy.arctan2(y, x))) + aside, b=0.1)
    return system


def systems(pooltool):
    games = pooltool.GameType
    return {
        "example": pooltool.System.example(),
        "three-cushion": opening(pooltool, games.THREECUSHION, 3, 5.0, 1.0),
        "nine-ball break": opening(pooltool, games.NINEBALL, 1, 8.0),
        "eight-ball break": opening(pooltool, games.EIGHTBALL, 1, 8.0),
    }


def engine(model):
    """pooltool's engine with this model of two balls."""
    from pooltool.physics.engine import PhysicsEngine
    from pooltool.physics.resolve.resolver import default_resolver

    resolver = default_resolver()
    resolver.ball_ball = model
    return PhysicsEngine(resolver=resolver)


def simulate(way, start, model):
    """The system after the shot, and its processor time in ms."""
    system, by = start.copy(), engine(model)
    begin = time.process_time_ns()
    way(system, engine=by, inplace=True)
    return system, (time.process_time_ns() - begin) * 1e-6


def measure(start, repeats):
    """The row of a system."""
    import carom.pooltool
    from pooltool.physics.resolve.ball_ball.frictional_mathavan import FrictionalMathavan

    own, exact = FrictionalMathavan(num_iterations=1000), carom.pooltool.ExactBallBall()
    ways = {
        "pooltool": (carom.pooltool.original, own),
        "exact": (carom.pooltool.original, exact),
        "drop_in": (carom.pooltool.simulate, own),
    }
    for way, model in ways.values():  # compiles what Numba compiles
        simulate(way, start, model)
    times, spent, done = {name: [] for name in ways}, [], {}
    for _ in range(repeats):
        for name, (way, model) in ways.items():
            done[name], ms = simulate(way, start, model)
            times[name].append(ms)
        timed = Timed(own)
        simulate(carom.pooltool.original, start, timed)
        spent.append(timed.spent * 1e-6)
    events = [[(event.event_type, event.ids) for event in done[name].events] for name in ways]
    if events[0] != events[2]:
        raise RuntimeError("carom's drop-in gives other events than pooltool")
    middle = {name: statistics.median(values) for name, values in times.items()}
    collision = statistics.median(spent)
    share = collision / middle["pooltool"]
    deviations = [abs(ms - middle["pooltool"]) for ms in times["pooltool"]]
    return {
        "events": len(events[0]),
        "exact_events": len(events[1]),
        "collisions": timed.calls,
        "pooltool_ms": f"{middle['pooltool']:.4g}",
        "collision_ms": f"{collision:.4g}",
        "share": f"{share:.3g}",
        "with_paper": f"{1.0 / (1.0 - share + share / PAPER):.4g}",
        "exact_in_it": f"{middle['pooltool'] / middle['exact']:.4g}",
        "drop_in": f"{middle['pooltool'] / middle['drop_in']:.4g}",
        "spread": f"{statistics.median(deviations) / middle['pooltool']:.2g}",
    }


def table(repeats, out):
    import carom
    import pooltool

    print(f"# processor: {processor()}", file=out)
    print(f"# date: {datetime.date.today().isoformat()}", file=out)
    print(f"# pooltool: {pooltool.__version__}; carom: {carom.__version__}", file=out)
    print(f"# turns: {repeats}", file=out)
    writer = None
    for name, start in systems(pooltool).items():
        row = {"system": name} | measure(start, repeats)
        if writer is None:
            writer = csv.DictWriter(out, list(row), lineterminator="\n")
            writer.writeheader()
        writer.writerow(row)
        out.flush()


def main(words):
    parser = argparse.ArgumentParser(prog="study.motive", description=__doc__.partition("\n\n")[0])
    parser.add_argument("--repeats", type=int, default=7, help="turns (default %(default)s)")
    parser.add_argument("-o", "--output", help="write the table there, default stdout")
    options = parser.parse_args(words)
    if options.repeats < 1:
        parser.error(f"--repeats is a whole number from 1, not {options.repeats}")
    missing = [name for module, name in NEEDED.items() if not importlib.util.find_spec(module)]
    if missing:
        print(f"study.motive: install them first: pip install {' '.join(missing)}", file=sys.stderr)
        return 2
    if not options.output:
        table(options.repeats, sys.stdout)
        return 0
    with open(options.output, "w", encoding="utf-8", newline="") as out:
        table(options.repeats, out)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
