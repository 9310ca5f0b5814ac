"""Noise of Euler's method against the smoothness of the exact solver, in a fine sweep of one input.

Mathavan's collision by N steps of impulse has two sources of noise. It ends on a whole step, so results jump where one step more
is taken; and where the balls come to stick before they part, the slip changes its sign at every step, and what is left over at the
end depends on the input like a saw. The limit of infinitely many steps has neither: what is left is rounding, as the exact solver
computes in single precision where that keeps its tolerance. A gradient by finite differences sees only this: its error is the
jump over the step of the input.

A jump is how far a step between neighbouring results lies outside of what the steps before and after it span: a smooth curve has
none, and a corner, as where sticking begins, has none.

    python smoothness.py --draws 10001 --out smoothness.svg
"""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np
import numpy.typing as npt
from tqdm import tqdm

import carom
import picture

Doubles = npt.NDArray[np.float64]
RADIUS = 0.028575  # m
SPEED = 1.5  # of the cue ball, m/s
FOLLOW = 0.1  # of a rolling ball's spin: nearly stun
NARROW, WIDE = (21.9, 22.1), (10.0, 50.0)  # ranges of the cut angle, degrees; slip ends early at full cuts
STEPS = (100, 300, 1000, 3000, 10000, 30000)


def throw(cut: Doubles, **options: Any) -> Doubles:
    """How far friction turns the object ball off the line of centres, degrees, of shape as the cut angles; options of collide."""
    angle = np.radians(cut)
    centres = 2 * RADIUS * np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=-1)
    pairs = carom.impacts(v_a=(SPEED, 0, 0), w_a=(0, FOLLOW * SPEED / RADIUS, 0), r_b=centres, radius=RADIUS)
    pairs["mu_ball"] = carom.mu_ball(pairs)
    motion, status = carom.collide(pairs, **options)
    assert (status == carom.Status.OK).all()
    v = motion["b"]["v"]
    return np.asarray(cut - np.degrees(np.arctan2(v[:, 1], v[:, 0])))


def jumps(results: Doubles) -> Doubles:
    """How far each step between neighbours lies outside of what the steps before and after it span, of shape (n - 3,)."""
    step = np.diff(results)
    before, here, after = step[:-2], step[1:-1], step[2:]
    outside = np.maximum(np.minimum(before, after) - here, here - np.maximum(before, after))
    jumps: Doubles = np.maximum(outside, 0.0)
    return jumps


def largest_jumps(draws: int, steps: tuple[int, ...] = STEPS) -> tuple[float, dict[int, float]]:
    """The largest jump over the wide range: of the exact solver, and of Euler's method by its N, degrees."""
    cut = np.linspace(*WIDE, draws)
    euler = {}
    for n in tqdm(steps, desc="Euler's N", disable=None):
        euler[n] = float(jumps(throw(cut, solver="euler", steps=n, threads=carom.ALL_THREADS)).max())
    return float(jumps(throw(cut)).max()), euler


def draw(out: str, draws: int, exact: float, euler: dict[int, float]) -> None:
    """The picture: the sweep, a small part of it, the largest jump by N."""
    figure, (wide, narrow, by_steps) = picture.start(3, (11.4, 4.0))

    cut = np.linspace(*WIDE, 801)
    wide.plot(cut, throw(cut, solver="euler"), color=picture.ORANGE, lw=1.2)
    wide.plot(cut, throw(cut), color=picture.BLUE, lw=1.2)
    middle = sum(NARROW) / 2
    wide.axvline(middle, color=picture.GREY, lw=1, ls=":")
    wide.text(middle + 0.9, 1.72, "enlarged on the right", color=picture.GREY)
    wide.set(title="The whole sweep: one curve", xlabel="cut angle (degrees)", ylabel="throw (degrees)")

    # The small part, less the chord of the exact curve.
    cut = np.linspace(*NARROW, 401)
    smooth, noisy = throw(cut), throw(cut, solver="euler")
    chord = np.interp(cut, NARROW, smooth[[0, -1]])
    narrow.plot(cut, 1000 * (noisy - chord), color=picture.ORANGE, lw=0.9, marker=".", ms=2.5)
    narrow.plot(cut, 1000 * (smooth - chord), color=picture.BLUE)
    narrow.text(0.03, 0.95, "Euler, N = 1000", color=picture.ORANGE, transform=narrow.transAxes, va="top")
    narrow.text(0.97, 0.95, "exact", color=picture.BLUE, transform=narrow.transAxes, va="top", ha="right")
    narrow.set(title="A two-hundredth of it", xlabel="cut angle (degrees)", xlim=NARROW)
    narrow.set_ylabel("throw less a straight line (0.001 degrees)")
    low, high = narrow.get_ylim()
    narrow.set_ylim(low, high + 0.15 * (high - low))

    n = np.array(list(euler))
    by_steps.loglog(n, list(euler.values()), "o-", color=picture.ORANGE)
    by_steps.axhline(exact, color=picture.BLUE)
    digits, power = f"{exact:.0e}".split("e")
    words = rf"exact: ${digits} \times 10^{{{int(power)}}}$ degrees"
    by_steps.text(n[-1], 0.5 * exact, words, color=picture.BLUE, va="top", ha="right")
    by_steps.text(n[2] * 1.3, euler[int(n[2])] * 1.5, "Euler", color=picture.ORANGE)
    by_steps.set(title="The largest jump of the sweep", xlabel="Euler's steps N", ylabel="jump of the throw (degrees)")
    by_steps.set_ylim(exact / 10, 1)
    picture.save(figure, out)


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--draws", type=int, default=10001, help="cut angles of the sweep")
    parser.add_argument("--out", default="smoothness.svg", help="the picture, .svg or .png")
    given = parser.parse_args(arguments)
    exact, euler = largest_jumps(given.draws)
    print(f"largest jump of {given.draws} throws: exact {exact:.1e} degrees; Euler", end=" ")
    print(", ".join(f"N = {n}: {jump:.1e}" for n, jump in euler.items()))
    draw(given.out, given.draws, exact, euler)


if __name__ == "__main__":
    main()
