"""What values and gradients cost in JAX and PyTorch, beside `carom.simulate`, `carom.tangents` and
`carom.jacobian`: how far a ball rests from its goal.

    python gradient_speed.py torch [ROUNDS]

Each round plays 50 strokes one at a time, by simulate and tangents and by the library, then batches
of 50 and 2000, by one `carom.jacobian` and by the library. The gradients are compared first.
Printed are medians over the rounds (default 40): processor time of a stroke, and its ratio.
"""

from __future__ import annotations

import importlib
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np

import carom

TABLE, BALLS, GOAL, NAMES = (
    carom.tables.pool_9ft(),
    carom.balls([[0.4, 0.5], [0.6, 1.5]]),
    np.array([0.6, 1.8]),
    ["cue.speed", "cue.phi"],
)
STROKES = np.array([1.5, 79.0]) + np.random.default_rng(1).uniform(-0.1, 0.1, (2000, 2))


def by_hand(stroke: Any) -> tuple[float, Any]:
    """The square of the distance, m^2, and its gradient."""
    shot = carom.simulate(TABLE, BALLS, carom.cue(speed=stroke[0], phi=stroke[1]))
    off = shot.final["r"][1, :2] - GOAL
    return float((off**2).sum()), 2.0 * off @ carom.tangents(shot, NAMES).final["r"][1]


def library(name: str) -> Callable[[Any], Any]:
    """What gives values and gradients of strokes (..., 2)."""
    final, module = importlib.import_module(f"carom.{name}").final, importlib.import_module(name)
    goal = GOAL if name == "jax" else module.from_numpy(GOAL)

    def miss(strokes: Any) -> Any:
        ends = final(
            TABLE, BALLS, carom.cue(), {"cue.speed": strokes[..., 0], "cue.phi": strokes[..., 1]}
        )
        return ((ends.r[..., 1, :] - goal) ** 2).sum(-1)

    def by_torch(strokes: Any) -> Any:
        x = module.from_numpy(strokes).requires_grad_()
        values = miss(x)
        values.sum().backward()
        return values, x.grad

    if name == "torch":
        return by_torch
    module.config.update("jax_enable_x64", True)
    alone, mapped = (
        module.jit(module.value_and_grad(miss)),
        module.jit(module.vmap(module.value_and_grad(miss))),
    )
    return lambda strokes: module.block_until_ready(
        (alone if strokes.ndim == 1 else mapped)(strokes)
    )


def spent(play: Callable[[Any], Any], argument: Any, count: int) -> float:
    """Processor time of a stroke, us."""
    begin = time.process_time()
    for each in argument:
        play(each)
    return 1e6 * (time.process_time() - begin) / count


def main() -> None:
    play, few, rounds = (
        library(sys.argv[1]),
        STROKES[:50],
        int(sys.argv[2]) if len(sys.argv) > 2 else 40,
    )
    for stroke, *found in zip(few, *play(few)):
        for expected, *others in zip(by_hand(stroke), found, play(stroke)):
            np.testing.assert_allclose(
                [np.array(values.tolist()) for values in others], [expected] * 2, rtol=1e-9
            )

    def batch(points: Any) -> Any:
        return carom.jacobian(TABLE, BALLS, carom.cue(speed=points[:, 0], phi=points[:, 1]), NAMES)  # noqa: E731

    for name, ours, argument, count in (
        ("one", by_hand, few, 50),
        ("batch of 50", batch, [few], 50),
        ("batch of 2000", batch, [STROKES], 2000),
    ):
        times = np.array(
            [[spent(each, argument, count) for each in (ours, play)] for _ in range(rounds)]
        )
        ratio = np.median(times[:, 1] / times[:, 0])
        print(
            f"{name:14} {np.median(times[:, 0]):6.1f} us, by {sys.argv[1]} {np.median(times[:, 1]):6.1f} us, ratio {ratio:.2f}"
        )


if __name__ == "__main__":
    main()
