"""How many times as fast as pooltool: breaks of nine-ball and eight-ball, and three-cushion, by
pooltool and by carom in one process.

    python pooltool_speed.py [REPEATS]
    python pooltool_speed.py NOTEBOOK.ipynb...

Both play the same Systems, and it is checked first that their events and histories agree. Every
time is processor time after both are warm. The first three rows are means of 30 different Systems,
at most REPEATS, each on a table of its own and played once; the fourth is what a stroke that meets
nothing costs. The others are of one break of nine-ball: the least of REPEATS plays (default 30;
pooltool: a fifth as many), with the memory and the table of the last play at hand. Needs pooltool
0.6.

Notebooks, such as those of docs/examples of pooltool's repository, are run by both, without
pictures of plotly: pooltool.simulate is replaced. Told are its calls and the processor time of
these and of all cells; cells that fail are told, and it is checked that both print the same.
"""

from __future__ import annotations

import contextlib
import importlib.util
import io
import json
import os
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any
from unittest import mock

import numpy as np
import pooltool

import carom
import carom.pooltool

NINEBALL = pooltool.GameType.NINEBALL
BATCH = 200
BREAKS = 30


def opening(game: Any, seed: int, speed: float) -> Any:
    """A System: the rack of a game of pooltool's, the cue ball struck at the first other ball."""
    np.random.seed(seed)
    table = pooltool.Table.from_game_type(game)
    balls = pooltool.get_rack(game, table, spacing_factor=1e-3)
    first, second = ("cue", "1") if "cue" in balls else ("white", "red")
    system = pooltool.System(cue=pooltool.Cue(cue_ball_id=first), table=table, balls=balls)
    way = balls[second].xyz - balls[first].xyz
    # In three-cushion it passes the red ball or meets it on either side.
    aside = 0.0 if first == "cue" else float(np.random.uniform(-3.0, 3.0))
    system.strike(V0=speed, phi=float(np.degrees(np.arctan2(way[1], way[0]))) + aside, b=0.1)
    return system


def look(system: Any) -> int:
    """Looks at every object of a simulated System: agents before and after, histories.

    The number of states.
    """
    states = [
        state
        for event in system.events
        for agent in event.agents
        for state in (agent.initial, agent.final)
    ]
    return len(states) + sum(
        len(ball.history.states) + len(ball.history_cts.states) for ball in system.balls.values()
    )


def check(mine: Any, theirs: Any) -> None:
    """Stops where the events differ, or the histories by more than rounding amplified by a break."""
    assert [(e.event_type, e.ids) for e in mine.events] == [
        (e.event_type, e.ids) for e in theirs.events
    ]
    for name, ball in theirs.balls.items():
        for field in ("history", "history_cts"):
            ours, expected = (
                getattr(mine.balls[name], field).vectorize(),
                getattr(ball, field).vectorize(),
            )
            for got, right in zip(ours, expected, strict=True):
                np.testing.assert_allclose(got, right, atol=1e-5)


def least(repeats: int, system: Any, play: Callable[[Any], object]) -> float:
    """The least processor time of a play, ms; each of a copy of the System, the copying left out."""
    times = []
    for _ in range(repeats):
        copy = system.copy()
        begin = time.process_time()
        play(copy)
        times.append(time.process_time() - begin)
    return 1e3 * min(times)


def once(systems: list[Any], play: Callable[[Any], object]) -> float:
    """The mean processor time of one play of each, ms."""
    return float(np.mean([least(1, system, play) for system in systems]))


def run_notebook(path: Path, play: Callable[..., Any]) -> tuple[str, int, float, float]:
    """What the cells print, how often they call pooltool.simulate, and the processor time of that
    and of all, s.
    """
    calls: list[float] = []

    def simulate(*system: Any, **options: Any) -> Any:
        begin = time.process_time()
        played = play(*system, **options)
        calls.append(time.process_time() - begin)
        return played

    cells = [
        cell
        for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]
        if cell["cell_type"] == "code"
    ]
    names: dict[str, Any] = {}
    # Nothing is shown; what is not installed takes all calls.
    drawing = mock.MagicMock()
    shown = {
        name: drawing for name in ("plotly", "plotly.graph_objects", "plotly.express", "plotly.io")
    }
    missing = [
        name
        for name in ("matplotlib", "matplotlib.pyplot", "pandas")
        if importlib.util.find_spec(name.split(".")[0]) is None
    ]
    pictures = shown | {name: drawing for name in missing}
    begin = time.process_time()
    with (
        contextlib.redirect_stdout(io.StringIO()) as output,
        mock.patch.dict(sys.modules, pictures),
        mock.patch.object(pooltool, "simulate", simulate),
    ):
        for k, cell in enumerate(cells, 1):
            try:
                exec("".join(cell["source"]), names)
            except Exception as error:
                print(f"cell {k} failed: {type(error).__name__}: {error}")
    return output.getvalue(), len(calls), sum(calls), time.process_time() - begin


def notebooks(paths: list[str]) -> None:
    os.environ["MPLBACKEND"] = "agg"
    theirs, ours = pooltool.simulate, carom.pooltool.simulate
    for play in (theirs, ours):
        play(opening(NINEBALL, 1, 8.0))
    for path in paths:
        (output, calls, slow, all_slow), (ours_told, _, fast, all_fast) = (
            run_notebook(Path(path), play) for play in (theirs, ours)
        )
        failed = [
            line for line in output.splitlines() if line.startswith("cell ") and " failed: " in line
        ]
        print(
            f"{Path(path).stem}: {calls} calls, {slow:.3f} s by pooltool, {fast:.3f} s by carom, {slow / max(fast, 1e-9):.1f} times as fast"
        )
        print(
            "\n".join(
                [
                    f"  all cells {all_slow:.2f} s and {all_fast:.2f} s, printed text {'the same' if output == ours_told else 'differs'}",
                    *failed,
                ]
            )
        )


def main() -> None:
    if sys.argv[1:] and sys.argv[1].endswith(".ipynb"):
        notebooks(sys.argv[1:])
        return
    repeats = int(sys.argv[1]) if len(sys.argv) > 1 else 30
    few, breaks = max(repeats // 5, 1), min(repeats, BREAKS)
    system = opening(NINEBALL, 1, 8.0)
    lone = pooltool.System(
        cue=pooltool.Cue(cue_ball_id="cue"),
        table=system.table.copy(),
        balls={"cue": system.balls["cue"].copy()},
    )
    lone.strike(V0=0.5, phi=90.0)
    theirs, ours = pooltool.simulate, carom.pooltool.simulate

    def games(kind: Any) -> tuple[str, float, float]:
        others = [opening(kind, 2 + k, 6.0 + 4.0 * k / breaks) for k in range(breaks)]

        def time_of(play: Any) -> float:
            return once(others, lambda system: play(system, inplace=True))

        return f"drop-in, {breaks} of {kind}", time_of(theirs), time_of(ours)

    mine, right = ours(system, continuous=True), theirs(system, continuous=True)
    check(mine, right)
    table, balls, cue = (
        carom.pooltool.table_of(system.table),
        carom.pooltool.balls_of(system),
        carom.pooltool.cue_of(system),
    )
    cues = np.broadcast_to(cue, (BATCH,)).copy()

    times = right.balls["cue"].history_cts.vectorize()[2]

    def in_a_batch(_: Any) -> object:
        return carom.simulate_batch(table, balls, cues, room=256, world="pooltool")

    def trajectories(_: Any) -> object:
        return carom.simulate_batch(table, balls, cues, world="pooltool").positions(times)

    # The batch's trajectories are those of pooltool's continuous histories.
    paths = np.stack(
        [right.balls[name].history_cts.vectorize()[0][:, 0] for name in system.balls], axis=1
    )
    np.testing.assert_allclose(
        carom.simulate_batch(table, balls, cues[:1], world="pooltool").positions(times)[0],
        paths,
        atol=1e-5,
    )

    alone = least(few, system, lambda s: theirs(s, inplace=True))
    continuous = least(few, system, lambda s: theirs(s, inplace=True, continuous=True))
    rows = (
        *map(games, (NINEBALL, pooltool.GameType.EIGHTBALL, pooltool.GameType.THREECUSHION)),
        (
            "drop-in, nothing is met",
            least(few, lone, lambda s: theirs(s, inplace=True)),
            least(repeats, lone, lambda s: ours(s, inplace=True)),
        ),
        ("drop-in", alone, least(repeats, system, lambda s: ours(s, inplace=True))),
        (
            "drop-in, all objects looked at",
            alone,
            least(repeats, system, lambda s: look(ours(s, inplace=True))),
        ),
        (
            "continuous=True",
            continuous,
            least(repeats, system, lambda s: ours(s, inplace=True, continuous=True)),
        ),
        (
            "continuous=True, all objects",
            continuous,
            least(repeats, system, lambda s: look(ours(s, inplace=True, continuous=True))),
        ),
        (
            "carom.simulate",
            alone,
            least(repeats, system, lambda _: carom.simulate(table, balls, cue, world="pooltool")),
        ),
        (f"carom.simulate_batch, one of {BATCH}", alone, least(few, system, in_a_batch) / BATCH),
        (f"trajectories, one of {BATCH}", continuous, least(few, system, trajectories) / BATCH),
    )
    states = look(mine)
    print(
        f"{len(right.events) - 2} events, {len(system.balls)} balls, {right.t:.2f} s, {states} states with the continuous ones,"
    )
    print(f"trajectories at {len(times)} times, pooltool {pooltool.__version__}")
    print(f"{'':32} {'pooltool':>9} {'carom':>9} {'ratio':>6}    (ms)")
    for name, slow, fast in rows:
        print(f"{name:32} {slow:9.2f} {fast:9.3f} {slow / fast:6.0f}")


if __name__ == "__main__":
    main()
