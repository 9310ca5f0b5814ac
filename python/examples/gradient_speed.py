"""What a value and its gradient cost in JAX, beside `carom.simulate` and `carom.tangents`: how far a ball rests from its goal, by the cue.

    python gradient_speed.py [ROUNDS]

Each round plays the same 50 strokes in four ways, one way after the other: by simulate alone, by simulate and tangents, by a compiled
`jax.value_and_grad` one at a time, and by its `jax.vmap` as one batch. The gradients are compared first. Printed are medians over the rounds
(default 40): processor time of a stroke, and its ratio to that of simulate and tangents. Needs JAX.
"""

from __future__ import annotations

import importlib
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np

import carom
import carom.jax

jax: Any = importlib.import_module("jax")
jnp: Any = importlib.import_module("jax.numpy")
jax.config.update("jax_enable_x64", True)
TABLE, BALLS, GOAL = carom.tables.pool_9ft(), carom.balls([[0.4, 0.5], [0.6, 1.5]]), np.array([0.6, 1.8])
STROKES = np.array([1.5, 79.0]) + np.random.default_rng(1).uniform(-0.1, 0.1, (50, 2))


def shot(stroke: Any) -> carom.Shot:
    return carom.simulate(TABLE, BALLS, carom.cue(speed=stroke[0], phi=stroke[1]))


def by_hand(stroke: Any) -> tuple[float, Any]:
    """The square of the distance, m^2, and its gradient."""
    played = shot(stroke)
    off = played.final["r"][1, :2] - GOAL
    return float((off**2).sum()), 2.0 * off @ carom.tangents(played, ["cue.speed", "cue.phi"]).final["r"][1]


def miss(stroke: Any) -> Any:
    ends = carom.jax.final(TABLE, BALLS, carom.cue(), {"cue.speed": stroke[0], "cue.phi": stroke[1]})
    return ((ends.r[1] - GOAL) ** 2).sum()


def spent(play: Callable[[Any], Any], given: Any) -> float:
    """Processor time of a stroke, us."""
    begin = time.process_time()
    for each in given:
        jax.block_until_ready(play(each))
    return 1e6 * (time.process_time() - begin) / len(STROKES)


def main() -> None:
    one, many, strokes = jax.jit(jax.value_and_grad(miss)), jax.jit(jax.vmap(jax.value_and_grad(miss))), jnp.asarray(STROKES)
    for stroke, value, slope in zip(STROKES, *many(strokes)):
        expected, by_tangents = by_hand(stroke)
        np.testing.assert_allclose([value, *slope], [expected, *by_tangents], rtol=1e-9)
    ways: dict[str, tuple[Callable[[Any], Any], Any]] = {
        "simulate": (shot, STROKES),
        "simulate, tangents": (by_hand, STROKES),
        "value_and_grad": (one, list(strokes)),
        "vmap, one of 50": (many, [strokes]),
    }
    times = np.array([[spent(*way) for way in ways.values()] for _ in range(1 + (int(sys.argv[1]) if len(sys.argv) > 1 else 40))])[1:]
    print(f"{'':20} {'us':>8} {'ratio':>6}")
    for name, each, ratio in zip(ways, np.median(times, axis=0), np.median(times / times[:, 1:2], axis=0)):
        print(f"{name:20} {each:8.1f} {ratio:6.2f}")


if __name__ == "__main__":
    main()
