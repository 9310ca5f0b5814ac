"""Ten million random collisions: where the cue ball goes, and what has to balance.

A cue ball hits a ball at rest: any part of it with the same chance, at 0.5 to 5 m/s, with any spin from full draw to rolling and
some side. The picture is the density of all of them over the cut angle and the angle by which the cue ball is deflected once it
rolls again, (5 v + 2 R (w_y, -w_x)) / 7. Its lower edge is the ball that rolls, the players' rule of 30 degrees. The ridge is stun:
there nearly all the friction between the balls acts across, and a little more or less follow changes the deflection least. Without
friction there is no ridge (`--friction 0`).

What has to hold is checked of every one: the energy does not rise, and momentum balances. What acts between the balls adds up to
nothing. The cloth acts where they touch it: its friction has no moment about an axis that lies in the cloth, and its pressure none
about the one under the line of centres. Hence the angular momentum about that axis is kept: the sum over both balls of
M R (v_x + 2 R w_y / 5), with y along the line of centres and x across.

The balls of a chunk are drawn from a stream of their own, so that no bit depends on the number of threads. NumPy and carom release
the GIL: threads of Python, each with chunks of its own, use all processors.

    python ten_million.py --draws 10000000 --seed 1 --threads 2 --out ten_million.png
"""

from __future__ import annotations

import argparse
import os
import time
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from matplotlib.colors import LogNorm
from tqdm import tqdm

import carom
import picture

Doubles = npt.NDArray[np.float64]
RADIUS, MASS = 0.028575, 0.170097  # m, kg
CHUNK = 100_000  # impacts: 21 MB in, 10 MB out
CUTS, DEFLECTIONS = (0.0, 90.0), (0.0, 180.0)  # of the density, degrees
BINS = (360, 540)


class Tally(NamedTuple):
    """Of a chunk, or of many: counts over BINS, the worst of each balance, and the time in carom.collide."""

    counts: npt.NDArray[np.int64]
    collisions: int
    momentum: float  # largest change of what is kept across the line of centres, over M times the speed
    gain: float  # largest gain of energy, over that before
    seconds: float

    def plus(self, other: Tally) -> Tally:
        return Tally(
            self.counts + other.counts,
            self.collisions + other.collisions,
            max(self.momentum, other.momentum),
            max(self.gain, other.gain),
            self.seconds + other.seconds,
        )


def random_impacts(random: np.random.Generator, count: int, friction: float | None) -> carom.dtypes.Records:
    """Cue balls that run along x; friction between the balls by the speed of slip, if it is not given."""
    speed = random.uniform(0.5, 5.0, count)
    offset = random.uniform(0.0, 1.0, count)  # sine of the cut angle: any part of the ball with the same chance
    follow, side = random.uniform(-1.0, 1.0, count), random.uniform(-0.3, 0.3, count)
    pairs = np.zeros(count, carom.dtypes.impact)
    a, b = pairs["a"], pairs["b"]
    a["v"][:, 0] = speed
    a["w"][:, 1], a["w"][:, 2] = follow * speed / RADIUS, side * speed / RADIUS
    b["r"][:, 0], b["r"][:, 1] = 2 * RADIUS * np.sqrt(1 - offset**2), 2 * RADIUS * offset
    for ball in (a, b):
        ball["radius"], ball["mass"], ball["mu_cloth"] = RADIUS, MASS, 0.2
    pairs["restitution"] = 0.95
    pairs["mu_ball"] = carom.mu_ball(pairs) if friction is None else friction
    return pairs


def kept(r: Doubles, a: Doubles, b: Doubles) -> Doubles:
    """The angular momentum along the line of centres r about the cloth, over R, of motions (v, w) of shape (n, 6), kg m/s."""
    v, w = a[:, :3] + b[:, :3], a[:, 3:] + b[:, 3:]
    along = r / (2 * RADIUS)
    across = np.stack([along[:, 1], -along[:, 0]], axis=-1)
    return np.asarray(MASS * ((v[:, :2] * across).sum(axis=-1) + 0.4 * RADIUS * (w[:, :2] * along).sum(axis=-1)))


def energy(motion: Doubles) -> Doubles:
    """Kinetic energy of motions (v, w) of shape (n, 6), J."""
    return np.asarray(0.5 * MASS * ((motion[:, :3] ** 2).sum(axis=-1) + 0.4 * RADIUS**2 * (motion[:, 3:] ** 2).sum(axis=-1)))


def deflection(motion: Doubles) -> Doubles:
    """The angle from x to the way of balls that move by (v, w), of shape (n, 6), once they roll; degrees, 0 to 180."""
    x = 5 * motion[:, 0] + 2 * RADIUS * motion[:, 4]
    y = 5 * motion[:, 1] - 2 * RADIUS * motion[:, 3]
    angles: Doubles = np.degrees(np.abs(np.arctan2(y, x)))
    return angles


def chunk(seed: np.random.SeedSequence, count: int, friction: float | None) -> Tally:
    """Draw, collide and look at one chunk."""
    pairs = random_impacts(np.random.default_rng(seed), count, friction)
    begin = time.perf_counter()
    after, status = carom.collide(carom.dtypes.plain(pairs))
    seconds = time.perf_counter() - begin
    assert (status == carom.Status.OK).all()

    # The balances, over the scales of the cue ball before.
    before = carom.dtypes.plain(pairs)
    a, b, r = before[:, 3:9], before[:, 15:21], before[:, 12:14]
    change = kept(r, after[:, :6], after[:, 6:]) - kept(r, a, b)
    gain = energy(after[:, :6]) + energy(after[:, 6:]) - energy(a)
    scale = MASS * before[:, 3]

    # The deflection once the cue ball rolls, and the density.
    turned, cut = deflection(after[:, :6]), np.degrees(np.arctan2(r[:, 1], r[:, 0]))
    column = np.minimum((cut - CUTS[0]) * (BINS[0] / (CUTS[1] - CUTS[0])), BINS[0] - 1).astype(np.int64)
    row = np.minimum((turned - DEFLECTIONS[0]) * (BINS[1] / (DEFLECTIONS[1] - DEFLECTIONS[0])), BINS[1] - 1).astype(np.int64)
    counts = np.bincount(column * BINS[1] + row, minlength=BINS[0] * BINS[1]).reshape(BINS)
    return Tally(counts, count, float(np.abs(change / scale).max()), float((gain / energy(a)).max()), seconds)


def collide_many(draws: int, seed: int, threads: int, friction: float | None = None) -> Tally:
    """All of them, in chunks over threads, with progress and rate."""
    sizes = [CHUNK] * (draws // CHUNK) + [draws % CHUNK] * (draws % CHUNK > 0)
    seeds = np.random.SeedSequence(seed).spawn(len(sizes))
    total = Tally(np.zeros(BINS, np.int64), 0, 0.0, -np.inf, 0.0)
    with ThreadPoolExecutor(threads) as pool:
        with tqdm(total=draws, desc="colliding", unit=" pairs", unit_scale=True, disable=None) as progress:
            for tally in pool.map(chunk, seeds, sizes, [friction] * len(sizes)):
                total = total.plus(tally)
                progress.update(tally.collisions)
    return total


def rolling_rule(cut: Doubles) -> Doubles:
    """The deflection of a rolling cue ball by smooth balls without loss, degrees: the rule of 30 degrees."""
    angle = np.radians(cut)
    return np.asarray(np.degrees(np.arctan2(np.sin(angle) * np.cos(angle), np.sin(angle) ** 2 + 0.4)))


def draw(out: str, total: Tally) -> None:
    """The picture: the density, with the two rules that players know."""
    figure, (axes,) = picture.start(1, (8.4, 5.2))
    area = (CUTS[1] - CUTS[0]) / BINS[0] * (DEFLECTIONS[1] - DEFLECTIONS[0]) / BINS[1]
    density = total.counts.T / area / total.collisions
    edges = np.linspace(*CUTS, BINS[0] + 1), np.linspace(*DEFLECTIONS, BINS[1] + 1)
    shown = np.where(density > 0, density, np.nan)
    mesh = axes.pcolormesh(*edges, shown, cmap="magma", norm=LogNorm(1e-5, density.max()), rasterized=True)
    axes.set_facecolor("black")
    axes.grid(False)
    cut = np.linspace(*CUTS, 200)
    axes.plot(cut, rolling_rule(cut), color="white", lw=0.9, ls="--")
    axes.plot(cut, 90 - cut, color="white", lw=0.9, ls=":")
    axes.text(18, 15, "rolling, without loss and friction:\nthe rule of 30 degrees (dashed)", color="white", va="center")
    thin = {"arrowstyle": "-", "color": "white", "lw": 0.8}
    words = "stun, without loss and friction:\nthe rule of 90 degrees (dotted)"
    axes.annotate(words, (36, 54), (51, 95), color="white", arrowprops=thin)
    axes.annotate("stun, as it is", (17, 67), (36, 125), color="white", arrowprops=thin)
    axes.set(title=f"{total.collisions:,} random collisions", xlabel="cut angle (degrees)")
    axes.set_ylabel("deflection of the cue ball, once it rolls (degrees)")
    axes.set_xticks(range(0, 91, 15))
    axes.set_yticks(range(0, 181, 30))
    figure.colorbar(mesh, ax=axes, label="share of the collisions per square degree")
    picture.save(figure, out)


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--draws", type=int, default=10_000_000, help="collisions")
    parser.add_argument("--seed", type=int, default=1, help="of the random impacts")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)), help="threads of Python")
    parser.add_argument("--friction", type=float, help="between the balls, 0 to 1, instead of that by the speed of slip")
    parser.add_argument("--out", default="ten_million.png", help="the picture, .svg or .png")
    given = parser.parse_args(arguments)
    begin = time.perf_counter()
    total = collide_many(given.draws, given.seed, given.threads, given.friction)
    took = time.perf_counter() - begin
    rate = total.collisions / took
    print(f"{total.collisions:,} collisions in {took:.2f} s by {given.threads} threads: {rate:,.0f} a second, all told")
    print(f"of that in carom.collide, a thread: {1e9 * total.seconds / total.collisions:.0f} ns a pair")
    print(f"momentum: worst change {total.momentum:.1e} of M v; energy: largest gain {total.gain:.1e} of it")
    draw(given.out, total)


if __name__ == "__main__":
    main()
