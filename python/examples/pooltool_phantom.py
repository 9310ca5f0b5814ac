"""Collisions of balls that are apart: how often they happen in pooltool, and in carom's drop-in.

    python pooltool_phantom.py [SHOTS]

The cue ball is struck straight at one other ball, above or below its centre (default: 40 shots with
random distances, speeds and tip offsets). After the contact both balls move along one line. Two
balls that roll in one direction slow down alike, so the terms of degree 4 and 3 vanish from the
equation of degree 4 for the time of their contact. pooltool's solver divides by the first of them:
where it is exactly 0, the time is wrong, and pooltool moves balls that are apart into contact and
collides them. carom's solver works without these terms.

The program lists each shot in which a simulator collides balls that are more than 0.1 mm apart, and
compares where the balls rest. Needs pooltool 0.6.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any

import numpy as np
import pooltool

import carom.pooltool

APART = 1e-4  # m: balls that are farther apart do not touch
ELSEWHERE = 1e-3  # m: two positions of rest that differ by more are different


def straight_shot(rng: np.random.Generator) -> Any:
    """A System: the cue ball struck at a ball straight ahead, 0.15 to 0.6 m away."""
    table = pooltool.Table.default()
    distance = rng.uniform(0.15, 0.6)
    balls = {
        "cue": pooltool.Ball.create("cue", xy=(table.w / 2, 0.4)),
        "1": pooltool.Ball.create("1", xy=(table.w / 2, 0.4 + distance)),
    }
    cue = pooltool.Cue(cue_ball_id="cue")
    cue.set_state(V0=rng.uniform(1, 4), phi=90.0, a=0.0, b=rng.uniform(-0.4, 0.4), theta=0.0)
    return pooltool.System(table=table, balls=balls, cue=cue)


def gaps(system: Any) -> list[tuple[float, float]]:
    """The time of each collision of balls, s, and the distance of their surfaces just before, m."""
    found = []
    for event in system.events:
        if event.event_type == pooltool.EventType.BALL_BALL:
            first, second = (agent.initial for agent in event.agents)
            distance = np.linalg.norm(first.xyz - second.xyz)
            found.append((event.time, distance - first.params.R - second.params.R))
    return found


def rest(system: Any) -> Any:
    """Where the balls rest, m."""
    return np.array([ball.xyz for ball in system.balls.values()])


def compare(shots: int) -> dict[str, list[int]]:
    """Play the shots with both simulators, and print each in which one collides balls that are apart.

    Returns the numbers of the shots in which pooltool does so, in which carom does, which one of
    them does not finish, and in which a ball rests elsewhere.
    """
    rng = np.random.default_rng(1)
    simulators: dict[str, Callable[..., Any]] = {
        "pooltool": pooltool.simulate,
        "carom": carom.pooltool.simulate,
    }
    numbers: dict[str, list[int]] = {
        name: [] for name in (*simulators, "not finished", "elsewhere")
    }
    for shot in range(shots):
        system = straight_shot(rng)
        ends = []
        for name, simulate in simulators.items():
            try:
                played = simulate(system.copy())
            # pooltool after 0.6.0 raises where the term of degree 4 is 0.
            except ValueError as error:
                numbers["not finished"].append(shot)
                print(f"shot {shot}: {name} stops: {error}")
                continue
            ends.append(rest(played))
            apart = [(time, gap) for time, gap in gaps(played) if gap > APART]
            if apart:
                numbers[name].append(shot)
                time, gap = max(apart, key=lambda row: row[1])
                print(
                    f"shot {shot}: {name} has {len(apart)} collisions of balls that are apart,"
                    f" by up to {1e3 * gap:.1f} mm (at {time:.3f} s)"
                )
        if len(ends) == 2:
            distance = np.linalg.norm(ends[0] - ends[1], axis=1).max()
            if distance > ELSEWHERE:
                numbers["elsewhere"].append(shot)
                print(
                    f"shot {shot}: a ball rests {1e3 * distance:.1f} mm from its position in carom"
                )
    return numbers


def main() -> None:
    shots = int(sys.argv[1]) if len(sys.argv) > 1 else 40
    numbers = compare(shots)
    print(f"{shots} straight shots, pooltool {pooltool.__version__}")
    print(f"pooltool collides balls that are apart in {len(numbers['pooltool'])} shots")
    print(f"pooltool does not finish {len(numbers['not finished'])} shots")
    print(f"carom.pooltool collides balls that are apart in {len(numbers['carom'])} shots")
    print(f"a ball rests elsewhere in {len(numbers['elsewhere'])} shots")


if __name__ == "__main__":
    main()
