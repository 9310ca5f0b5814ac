"""Error bars of a shot: where the balls may go when a player's stroke is a little off, by derivatives of one shot.

A player's errors are independent: standard deviations of the speed, the direction and the two places of the tip. Each ball's place at
a time, to first order, is off by J dx, with the Jacobian J of carom.tangents(); so its covariance is J S J^T with S = diag(sd^2). A
band of one standard deviation across the path follows, and an ellipse where the ball ends.

Every contact of two balls multiplies what is off, and balls soon meet something else than before: beyond its reach a derivative
says nothing. So the band ends where the standard deviation is 0.3 m. Whether it is right is tested by playing thousands of strokes
with random errors, of many layouts: half the width of the middle 68 % of the ends, over the standard deviation that was predicted.

    python error_bars.py --draws 60 --seed 1 --out error_bars.svg
"""

from __future__ import annotations

import argparse
import itertools
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.patches import Ellipse
from tqdm import tqdm

import carom
import picture

Doubles = npt.NDArray[np.float64]
NAMES = ("cue.speed", "cue.phi", "cue.a", "cue.b")
ERRORS = np.array([0.01, 0.05, 0.01, 0.01])  # of a player: of the speed itself, degrees, R, R
MOST = 0.3  # m: the largest standard deviation that is shown

table = carom.tables.pool_9ft()


class Bars(NamedTuple):
    """What is predicted of a shot: deviations of its errors, covariances of the ends, and reach over deviation of each error."""

    deviations: Doubles  # (4,)
    ends: Doubles  # (balls, 2, 2), m^2
    reach: Doubles  # (4,)


def deviations(cue: carom.dtypes.Records) -> Doubles:
    """The standard deviations of the four numbers of a stroke."""
    return ERRORS * [float(cue["speed"]), 1.0, 1.0, 1.0]


def covariances(J: Doubles, deviation: Doubles) -> Doubles:
    """J S J^T of Jacobians of places, (..., 2, 4): (..., 2, 2)."""
    scaled = J * deviation
    return np.asarray(scaled @ np.swapaxes(scaled, -1, -2))


def predict(balls: carom.dtypes.Records, cue: carom.dtypes.Records) -> tuple[carom.Shot, Bars]:
    """A shot, and its error bars."""
    shot = carom.simulate(table, balls, cue)
    found, deviation = carom.tangents(shot, NAMES), deviations(cue)
    return shot, Bars(deviation, covariances(found.final["r"], deviation), found.reach / deviation)


def sample(balls: carom.dtypes.Records, cue: carom.dtypes.Records, strokes: int, random: np.random.Generator) -> carom.Shots:
    """As many strokes with random errors."""
    off = random.normal(size=(strokes, 4)) * deviations(cue)
    cues = np.repeat(np.asarray(cue).reshape(1), strokes)
    for k, name in enumerate(("speed", "phi", "a", "b")):
        cues[name] += off[:, k]
    return carom.simulate_batch(table, balls, cues, threads=carom.ALL_THREADS)


def layouts(draws: int, random: np.random.Generator) -> list[tuple[carom.dtypes.Records, carom.dtypes.Records]]:
    """Three balls at random, the first struck towards the second."""
    found: list[tuple[carom.dtypes.Records, carom.dtypes.Records]] = []
    while len(found) < draws:
        centres = random.uniform([0.15, 0.15], [1.1, 2.3], (3, 2))
        gaps = np.hypot(*(centres[[0, 0, 1]] - centres[[1, 2, 2]]).T)
        if gaps.min() < 0.15:
            continue
        to = centres[1] - centres[0]
        phi = np.degrees(np.arctan2(to[1], to[0]) + random.uniform(-0.7, 0.7) * 0.05715 / gaps[0])
        cue = carom.cue(speed=random.uniform(0.6, 2.0), phi=phi, a=random.uniform(-0.3, 0.3), b=random.uniform(-0.2, 0.4))
        found.append((carom.balls(centres), cue))
    return found


def compare(draws: int, strokes: int, seed: int) -> Doubles:
    """Predicted and sampled standard deviations of ends, m, (n, 2): of all balls that move and stay on the table."""
    random, rows = np.random.default_rng(seed), list[tuple[float, float]]()
    for balls, cue in tqdm(layouts(draws, random), desc="playing", unit=" layouts", disable=None):
        shot, bars = predict(balls, cue)
        ends = sample(balls, cue, strokes, random).final["r"][..., :2]
        low, high = np.quantile(ends, [0.1587, 0.8413], axis=0)
        for ball in range(len(balls)):
            predicted = float(np.sqrt(np.trace(bars.ends[ball])))
            if predicted > 0.0 and shot.final["label"][ball] != carom.Label.POCKETED:
                rows.append((predicted, float(np.hypot(*(0.5 * (high - low)[ball])))))
    return np.array(rows)


def band(axes: Axes, shot: carom.Shot, cue: carom.dtypes.Records, ball: int, color: str) -> None:
    """The path of a ball, one standard deviation across it to both sides, and the ellipse of its end: as far as MOST."""
    own = shot.events[(shot.events["a"] == ball) | ((shot.events["type"] == carom.EventType.BALL_BALL) & (shot.events["b"] == ball))]
    corners = np.array([0.0, *own["time"], shot.time])
    times = np.unique(np.concatenate([np.linspace(0.0, shot.time, 200), corners, np.maximum(corners - 1e-6, 0.0)]))
    found = carom.tangents(shot, NAMES, times=times)
    covariance = covariances(found.at["r"][:, ball], deviations(cue))
    states = shot.states(times)
    r, v = states["r"][:, ball, :2], states["v"][:, ball, :2]
    speed = np.hypot(v[:, 0], v[:, 1])
    across = np.stack([-v[:, 1], v[:, 0]], axis=-1) / np.maximum(speed, 1e-12)[:, None]
    wide = np.sqrt(np.einsum("ti,tij,tj->t", across, covariance, across))
    whole = np.sqrt(np.trace(covariance, axis1=1, axis2=2))
    shown = len(times) if whole.max() <= MOST else int(np.argmax(whole > MOST))
    axes.plot(r[:, 1], -r[:, 0], color=color, lw=0.8, ls=":", zorder=3)
    axes.plot(r[:shown, 1], -r[:shown, 0], color=color, lw=1.4, zorder=3)
    # one band for each piece between corners of the path
    moving = speed[:shown] > 0.0
    for begin, end in itertools.pairwise(corners):
        piece = np.flatnonzero((times[:shown] >= begin) & (times[:shown] < end) & moving)
        if len(piece) > 1:
            left, right = r[piece] + (across * wide[:, None])[piece], r[piece] - (across * wide[:, None])[piece]
            outline = np.concatenate([left, right[::-1]])
            axes.fill(outline[:, 1], -outline[:, 0], color=color, alpha=0.25, lw=0, zorder=2)
    if shown == len(times):
        values, vectors = np.linalg.eigh(covariance[-1])
        way = vectors[:, 1]
        size = 2.0 * np.sqrt(np.maximum(values, 0.0))
        turn = np.degrees(np.arctan2(-way[0], way[1]))
        axes.add_patch(Ellipse((r[-1, 1], -r[-1, 0]), size[1], size[0], angle=turn, fc="none", ec=color, lw=1.4, zorder=5))


def draw(out: str, rows: Doubles, seed: int) -> None:
    """The picture: one shot with its bands and strokes that were played, and the comparison over all layouts."""
    figure, (above, compared) = picture.start(2, (11.6, 4.4), width_ratios=(1.9, 1))
    balls = carom.balls([[0.40, 0.45], [0.62, 1.30], [1.03, 1.62]])
    cue = carom.cue(speed=1.35, phi=73.6, a=0.1, b=0.25)
    shot, bars = predict(balls, cue)
    picture.draw_table(above, table)
    ends = sample(balls, cue, 200, np.random.default_rng(seed)).final["r"][..., :2]
    for ball, color in enumerate((picture.BLUE, picture.ORANGE, picture.GREEN)):
        if not (bars.ends[ball] > 0.0).any():
            continue
        above.plot(ends[:, ball, 1], -ends[:, ball, 0], ".", color=color, ms=2.5, alpha=0.5, zorder=4)
        band(above, shot, cue, ball, color)
    for ball in range(len(balls)):
        x, y = balls["state"]["r"][ball, :2]
        above.plot(y, -x, "o", color="white", mec=picture.INK, ms=7, zorder=6)
    above.set_title("One standard deviation to both sides, by one shot and its derivatives")
    errors = ", ".join(f"{value:.2g} σ" for value in bars.reach)
    words = f"Dots: ends of 200 strokes that were played.\nThe reach of speed, direction and the places of the tip is {errors}."
    above.text(0, -0.02, words, transform=above.transAxes, va="top", linespacing=1.6)

    trusted = rows[:, 0] <= MOST
    compared.loglog(*rows[~trusted].T, ".", color=picture.PALE, ms=5)
    compared.loglog(*rows[trusted].T, ".", color=picture.BLUE, ms=5)
    compared.axvline(MOST, color=picture.RED, lw=1)
    ends_of = np.array([rows[:, 0].min(), 3.0])
    compared.loglog(ends_of, ends_of, color=picture.INK, lw=0.8)
    compared.set(title="Ends of all layouts", xlabel="predicted deviation (m)", ylabel="deviation of played strokes (m)", ylim=(None, 3.0))
    compared.text(MOST * 1.2, rows[:, 1].min(), "not shown", color=picture.RED, rotation=90, va="bottom")
    picture.save(figure, out)


def tell(rows: Doubles) -> None:
    """How the prediction compares, by its size."""
    ratio = rows[:, 1] / rows[:, 0]
    for low, high in ((0.0, 0.01), (0.01, 0.03), (0.03, 0.1), (0.1, MOST), (MOST, 1.0), (1.0, np.inf)):
        some = ratio[(rows[:, 0] >= low) & (rows[:, 0] < high)]
        if len(some):
            near = np.mean((some > 0.8) & (some < 1.25))
            words = f"{len(some):3} balls, played / predicted {np.median(some):.2f} in the median, {near:4.0%} within 25 %"
            print(f"predicted {low:4g} to {high:4g} m: {words}")


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--draws", type=int, default=60, help="layouts")
    parser.add_argument("--strokes", type=int, default=2000, help="strokes with random errors of each layout")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", default="error_bars.svg", help="the picture, .svg or .png")
    given = parser.parse_args(arguments)
    rows = compare(given.draws, given.strokes, given.seed)
    tell(rows)
    draw(given.out, rows, given.seed)


if __name__ == "__main__":
    main()
