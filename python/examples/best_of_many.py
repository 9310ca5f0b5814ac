"""The best of 100,000 ways to play one pot: not the one that goes in, but the one that goes in with the widest margin.

A cut of 31 degrees into a corner pocket, after which the cue ball may go down too. A grid of aims, speeds and heights of the tip
is played, every shot until all balls rest. Those that pot the ball and keep the cue ball on the table have a margin: the distance
to the nearest shot of the grid that does not, in units of a player's errors; what lies outside of the grid counts as missed. The
widest margin is the shot to play. It is then played with random errors, beside the shot aimed by geometry alone, which forgets
that friction throws the object ball.

    python best_of_many.py --draws 100000 --seed 1 --out best_of_many.png
"""

from __future__ import annotations

import argparse
import time
from typing import Literal, NamedTuple

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import ListedColormap
from matplotlib.patches import Circle
from tqdm import tqdm

import carom
import picture

Doubles = npt.NDArray[np.float64]
CUE_BALL, OBJECT_BALL = (0.24, 1.35), (0.74, 1.65)  # m
POCKET = 5  # of the table's: the corner at the far right
# A player's errors, standard deviations: aim (degrees), speed (relative), height of the tip (radii).
ERRORS = {"aim": 0.15, "speed": 0.05, "height": 0.05}
MISSED, SCRATCHED, POTTED = 0, 1, 2
CUSHION: Literal["mathavan"] = "mathavan"
CHUNK = 4096  # shots between two signs of progress

table = carom.tables.pool_9ft()
layout = carom.balls([CUE_BALL, OBJECT_BALL])


class Grid(NamedTuple):
    """What is tried: aim (degrees from the geometric one), speed of the cue (m/s), height of the tip (radii)."""

    aim: Doubles
    speed: Doubles
    height: Doubles

    @property
    def shape(self) -> tuple[int, int, int]:
        return (len(self.aim), len(self.speed), len(self.height))


def grid_of(draws: int) -> Grid:
    """A grid of about that many shots, finest in the aim; speeds in equal ratios."""
    fine = (draws / 100_000) ** (1 / 3)
    aims, speeds, heights = (max(5, round(n * fine)) for n in (100, 40, 25))
    return Grid(np.linspace(-1.0, 0.5, aims), np.geomspace(0.9, 4.5, speeds), np.linspace(-0.6, 0.6, heights))


def geometric_aim() -> float:
    """The direction to where the cue ball touches the object ball on the line to the pocket, degrees."""
    centre, goal = np.array(OBJECT_BALL), table.pockets["centre"][POCKET]
    way = (goal - centre) / np.linalg.norm(goal - centre)
    touch = centre - 2 * layout["kind"]["radius"][1] * way - np.array(CUE_BALL)
    return float(np.degrees(np.arctan2(touch[1], touch[0])))


def cue(aim: npt.ArrayLike, speed: npt.ArrayLike, height: npt.ArrayLike) -> carom.dtypes.Records:
    """Cues, the aim counted from the geometric one."""
    return carom.cue(phi=geometric_aim() + np.asarray(aim), speed=speed, b=height)


def outcome(shots: carom.Shots) -> npt.NDArray[np.int8]:
    """MISSED, SCRATCHED or POTTED (into the right pocket, the cue ball on the table), of the shape of the batch."""
    down = shots.final["label"] == carom.Label.POCKETED
    where = np.linalg.norm(shots.final["r"][..., 1, :2] - table.pockets["centre"][POCKET], axis=-1)
    potted = down[..., 1] & (where < table.pockets["radius"][POCKET])
    return np.where(down[..., 0], SCRATCHED, np.where(potted, POTTED, MISSED)).astype(np.int8)


def play(cues: carom.dtypes.Records) -> npt.NDArray[np.int8]:
    """The outcome of each cue, in chunks, with progress and rate."""
    flat = cues.reshape(-1)
    results = np.empty(flat.size, np.int8)
    with tqdm(total=flat.size, desc="playing", unit=" shots", unit_scale=True, disable=None) as progress:
        for at in range(0, flat.size, CHUNK):
            chunk = flat[at : at + CHUNK]
            shots = carom.simulate_batch(table, layout, chunk, cushion_model=CUSHION, threads=carom.ALL_THREADS)
            assert (shots.status >= 0).all(), shots.failures()
            results[at : at + CHUNK] = outcome(shots)
            progress.update(chunk.size)
    return results.reshape(cues.shape)


def margins(good: npt.NDArray[np.bool_], grid: Grid) -> Doubles:
    """The distance of each good shot to the nearest that is not, in standard deviations of a player; 0 for the others."""
    # One more layer all round, which is missed; then the square of the distance, an axis at a time.
    squared = np.where(np.pad(good, 1), np.inf, 0.0)
    for axis, at in enumerate((grid.aim / ERRORS["aim"], np.log(grid.speed) / ERRORS["speed"], grid.height / ERRORS["height"])):
        places = np.concatenate([[2 * at[0] - at[1]], at, [2 * at[-1] - at[-2]]])
        apart = (places[:, None] - places[None, :]) ** 2
        lines = np.moveaxis(squared, axis, -1)
        squared = np.moveaxis(np.stack([(lines + row).min(axis=-1) for row in apart], axis=-1), -1, axis)
    distances: Doubles = np.sqrt(squared[1:-1, 1:-1, 1:-1])
    return distances


def widest(margin: Doubles) -> tuple[int, int, int]:
    """The index of the widest margin."""
    i, j, k = np.unravel_index(margin.argmax(), margin.shape)
    return int(i), int(j), int(k)


def executions(best: tuple[float, float, float], count: int, seed: int) -> carom.dtypes.Records:
    """The same shot with a player's random errors, that many times."""
    aim, speed, height = best
    errors = np.random.default_rng(seed).standard_normal((3, count))
    heights = np.clip(height + ERRORS["height"] * errors[2], -0.85, 0.85)
    return cue(aim + ERRORS["aim"] * errors[0], speed * np.exp(ERRORS["speed"] * errors[1]), heights)


def draw_shot(axes: Axes, best: tuple[float, float, float], shares: dict[str, float], seed: int) -> None:
    """The table with the best shot, and faintly what a player makes of it."""
    picture.draw_table(axes, table)
    played = carom.simulate_batch(table, layout, executions(best, 40, seed), cushion_model=CUSHION, room=256)
    faint = [(played[k], 0.16, 1.0) for k in range(len(played))]
    for shot, alpha, width in [*faint, (carom.simulate(table, layout, cue(*best), cushion_model=CUSHION), 1.0, 2.0)]:
        way = shot.positions(np.linspace(0, shot.time, 1200))
        for ball, hue in enumerate((picture.BLUE, picture.RED)):
            axes.plot(way[:, ball, 1], -way[:, ball, 0], color=hue, lw=width, alpha=alpha, zorder=2, solid_capstyle="round")
    for (x, y), hue, text, at in (
        (CUE_BALL, picture.BLUE, "cue ball", (-0.06, 0.03)),
        (OBJECT_BALL, picture.RED, "object ball", (0.02, 0.09)),
    ):
        axes.add_patch(Circle((y, -x), 0.0286, fc="white", ec=hue, lw=2, zorder=4))
        axes.text(y + at[0], -x + at[1], text, color=hue, ha="right" if at[0] < 0 else "left", zorder=4)
    rest = shot.final["r"][0]
    axes.add_patch(Circle((rest[1], -rest[0]), 0.0286, fc=picture.BLUE, ec="white", lw=1, zorder=4))
    axes.set_title("The widest margin, and 40 attempts at it")
    axes.set_anchor("N")
    words = [
        f"With a player's errors ({ERRORS['aim']:g} degrees of aim, {ERRORS['speed']:.0%} of speed,",
        f"{ERRORS['height']:g} radii of height) are potted:",
        *(f"    {share:.0%} {name}" for name, share in shares.items()),
    ]
    axes.text(0, -0.04, "\n".join(words), transform=axes.transAxes, va="top", linespacing=1.6)


def draw_map(axes: Axes, x: Doubles, y: Doubles, outcomes: npt.NDArray[np.int8], margin: Doubles, most: float) -> ScalarMappable:
    """Outcomes over two inputs: pale where missed or scratched, else coloured by the margin."""
    kinds = ListedColormap(["#efefef", "#f3c9b6"])
    axes.pcolormesh(x, y, np.where(outcomes == POTTED, np.nan, outcomes), cmap=kinds, vmin=MISSED, vmax=SCRATCHED, rasterized=True)
    axes.grid(False)
    shown = np.where(outcomes == POTTED, margin, np.nan)
    return axes.pcolormesh(x, y, shown, cmap="viridis", vmin=0, vmax=most, rasterized=True)


def draw(out: str, grid: Grid, outcomes: npt.NDArray[np.int8], margin: Doubles, shares: dict[str, float], seed: int) -> None:
    """The picture: the shot on its table, two sections through the grid."""
    i, j, k = widest(margin)
    best = (float(grid.aim[i]), float(grid.speed[j]), float(grid.height[k]))
    figure, (shot, by_speed, by_height) = picture.start(3, (12.2, 4.1), width_ratios=(1.75, 1, 1))
    draw_shot(shot, best, shares, seed)
    most = float(margin.max())
    draw_map(by_speed, grid.aim, grid.speed, outcomes[:, :, k].T, margin[:, :, k].T, most)
    colours = draw_map(by_height, grid.aim, grid.height, outcomes[:, j, :].T, margin[:, j, :].T, most)
    by_speed.set(
        title=f"Tip {abs(best[2]):.2f} radii {'above' if best[2] > 0 else 'below'} the centre",
        ylabel="speed of the cue (m/s)",
        yscale="log",
    )
    by_speed.set_yticks([1, 2, 3, 4], ["1", "2", "3", "4"])
    by_speed.minorticks_off()
    by_height.set(title=f"Speed {best[1]:.1f} m/s", ylabel="height of the tip (radii)")
    for axes, y in ((by_speed, best[1]), (by_height, best[2])):
        axes.set_xlabel("aim beside the geometric one (degrees)")
        axes.plot(best[0], y, "o", ms=9, mfc="none", mec="white", mew=2)
        axes.axvline(0, color=picture.INK, lw=0.8, ls=":")
    by_speed.text(-0.95, 1.0, "missed", color="#777777")
    by_speed.text(-0.33, 2.45, "cue ball\ndown", color="#9c4a26", va="center")
    by_height.text(0.03, -0.5, "by\ngeometry", color=picture.INK, va="center")
    figure.colorbar(colours, ax=by_height, label="margin (player's errors)", pad=0.02)
    picture.save(figure, out)


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--draws", type=int, default=100_000, help="shots to choose from, about")
    parser.add_argument("--seed", type=int, default=1, help="of the player's errors")
    parser.add_argument("--out", default="best_of_many.png", help="the picture, .svg or .png")
    given = parser.parse_args(arguments)

    grid = grid_of(given.draws)
    begin = time.perf_counter()
    outcomes = play(cue(*np.meshgrid(*grid, indexing="ij")))
    took = time.perf_counter() - begin
    print(f"{outcomes.size} shots in {took:.2f} s: {outcomes.size / took:,.0f} a second; {(outcomes == POTTED).mean():.1%} potted")
    margin = margins(outcomes == POTTED, grid)
    i, j, k = widest(margin)
    best = (float(grid.aim[i]), float(grid.speed[j]), float(grid.height[k]))
    print(f"widest margin {margin.max():.2f} errors: aim {best[0]:+.2f} degrees, {best[1]:.2f} m/s, tip at {best[2]:+.2f} radii")
    shares = {}
    for name, shot in (("aimed so", best), ("aimed by geometry alone", (0.0, best[1], best[2]))):
        shares[name] = float((play(executions(shot, 4000, given.seed)) == POTTED).mean())
        print(f"with a player's errors, {name}: {shares[name]:.1%} of 4000 potted")
    draw(given.out, grid, outcomes, margin, shares, given.seed)


if __name__ == "__main__":
    main()
