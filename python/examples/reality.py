"""How well carom predicts recorded shots: the tables and pictures of docs/understanding/reality.md.

    python reality.py TRACKS.csv --table 2.84,1.42 --radius 0.03075 --pictures FOLDER
    python reality.py TRACKS.csv --table 2.84,1.42 --radius 0.03075 --few 7
    python reality.py TRACKS.csv --table 2.84,1.42 --radius 0.03075 --forecast 2,4

For each model of the cushion, constants are fitted to every second shot and used for the others,
and the other way round. The first table has the RMSE of the shots that the constants were not
fitted to, of both halves: of each shot only the strike, six numbers, is fitted. Then follow the
floor, which is the RMSE of a perfect model; how far single impacts are from each model, output by
output; how the error grows with the part of a shot that the strike is fitted to; and the laws of
single events. With --few N there is only what few shots tell of the table, over N draws of them,
asked of the other half; with --forecast, how many places after the first seconds lie in the regions
that `fit.forecast` gives. Markdown on standard output; the pictures are SVG.
"""

import argparse
import sys
import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import carom.tracks.fit
from carom.tracks import _events, _from_events, _summary

Doubles = NDArray[np.float64]
Recordings = list[carom.tracks.Recording]


def law(values: Doubles, keys: Doubles, edges: Sequence[float]) -> list[str]:
    """Medians of values over ranges of another number, with their errors and how many."""
    rows = []
    for low, high in zip(edges[:-1], edges[1:]):
        part = values[(keys >= low) & (keys < high)]
        if len(part) >= 5:
            middle, error = _events.median(part)
            rows.append(f"| {low:g} to {high:g} | {middle:.3f} ± {error:.3f} | {len(part)} |")
    return rows


def held_out(
    recordings: Recordings,
    table: tuple[float, float],
    radius: float,
    models: Sequence[Any],
    free: Sequence[str],
    seed: int,
) -> carom.tracks.fit.Fit:
    """The RMSE of unseen shots by each model; the fit of the first half by the best."""
    print(
        "| cushion | RMSE, median, cm | 9 in 10 below, cm | mean, cm | shots | "
        "processor time of a search, ms a shot |\n|---|" + "--:|" * 5
    )
    best: tuple[float, carom.tracks.fit.Fit] | None = None
    for model in models:
        parts, spent = [], 0.0
        for fold in (0, 1):
            half = recordings[fold::2]
            fitted = carom.tracks.fit.fit(
                half, table, radius, cushion_model=model, free=free, seed=seed
            )
            begin = time.process_time()
            found = carom.tracks.fit.fit(
                recordings[1 - fold :: 2],
                table,
                radius,
                cushion_model=model,
                constants=fitted.constants,
                free="none",
            )
            spent += time.process_time() - begin
            parts.append(100.0 * found.rmse[found.counts])
        rmse = np.concatenate(parts)
        figures = float(np.median(rmse)), float(np.percentile(rmse, 90)), float(rmse.mean())
        cells = [f"{value:.2f}" for value in figures]
        cells += [str(len(rmse)), f"{1e3 * spent / len(rmse):.0f}"]
        print(f"| {model} | {' | '.join(cells)} |", flush=True)
        if best is None or figures[0] < best[0]:
            best = figures[0], fitted
    assert best is not None
    return best[1]


def floor(fit: carom.tracks.fit.Fit, shots: int, seed: int) -> None:
    """The RMSE that is left where the model is perfect: recordings of plays, with the noise of
    these.
    """
    sample = carom.tracks.synthetic(
        shots,
        table=fit.ground.size,
        radius=fit.radius,
        cushion_model=fit.cushion_model,
        constants=fit.constants,
        noise=fit.recordings[0].noise,
        seed=seed,
    )
    found = carom.tracks.fit.fit(
        sample.recordings,
        fit.table,
        fit.radius,
        cushion_model=fit.cushion_model,
        constants=sample.constants,
        free="none",
        seed=seed,
    )
    print(
        f"\nThe floor: {100 * found.median_rmse:.2f} cm in the median, 9 in 10 below {100 * found.p90_rmse:.2f} cm, {shots} shots."
    )


def outputs(seen: carom.tracks.Events, radius: float, models: Sequence[Any], seed: int) -> None:
    """How far the motion after single impacts is from each model with its best constants, in % of
    the speed before.
    """
    good = _from_events.chosen(seen.impacts)
    speed = np.hypot(good["v_n"], good["v_t"])
    print(
        "\n| cushion | along | across | roll along | roll across | chi² | impacts |\n|---|--:|--:|--:|--:|--:|--:|"
    )
    for model in models:
        values, _ = _from_events.measured(seen, radius, model, seed)
        if "restitution_cushion" not in values:
            continue
        names = ("restitution_cushion", "mu_cushion", "nose_height", "roll_loss")
        e, mu, height, loss = (values.get(name, 0.0) for name in names)
        motions = _from_events.predicted(good, radius, model, e, mu, height or radius, loss)
        off = [motions[:, 0] - good["w_t"], motions[:, 1] - good["w_n"]]
        off += [
            motions[:, 0] - motions[:, 2] - good["w_t"] + good["u_t"],
            motions[:, 1] - motions[:, 3] - good["w_n"] + good["u_n"],
        ]
        sizes = " | ".join(
            f"{148.26 * np.median(np.abs(values - np.median(values)) / speed):.2f}"
            for values in off
        )
        chi2 = 9.0 * np.log1p(motions[:, 4] / 9.0).sum()
        print(f"| {model} | {sizes} | {chi2:.0f} | {len(good)} |")


def growth(fit: carom.tracks.fit.Fit, seed: int) -> None:
    """The RMSE of strikes that are fitted to the first seconds alone."""
    print("\n| strike fitted to the first | RMSE of these, median, cm |\n|---|--:|")
    for end in (0.5, 1.0, 2.0, 3.0, 5.0, 8.0):
        parts = [
            replace(
                shot,
                tracks=tuple(
                    track[(track[:, 0] <= shot.moves.min() + end) | (np.arange(len(track)) == 0)]
                    for track in shot.tracks
                ),
            )
            for shot in fit.recordings
        ]
        found = carom.tracks.fit.fit(
            parts,
            fit.table,
            fit.radius,
            cushion_model=fit.cushion_model,
            constants=fit.constants,
            free="none",
            seed=seed,
        )
        print(f"| {end:g} s | {100 * found.median_rmse:.2f} |")


def few_shots(
    recordings: Recordings, table: tuple[float, float], radius: float, draws: int, seed: int
) -> None:
    """Medians of draws of so many shots of an odd number, by which the table's constants are
    fitted: the RMSE of up to 20 of an even number, or of others where the file has no such half.
    """
    halves: tuple[Recordings, Recordings] = ([], [])
    for shot in recordings:
        halves[int(shot.id) % 2 if str(shot.id).isdigit() else 1].append(shot)
    even, odd = halves
    both = min(len(even), len(odd)) >= 10
    print("Asked of the other half of the file." if both else "Asked of the same half of the file.")
    print("| shots fitted | RMSE of others: median, cm | 9 in 10 below, cm |\n|--:|--:|--:|")
    pool = odd if both else recordings
    for count in (n for n in (0, 1, 3, 5, 10, 20) if n + 10 * (not both) <= len(pool)):
        figures = []
        for draw in range(draws):
            random = np.random.default_rng((seed, draw))
            drawn = [pool[k] for k in random.permutation(len(pool))]
            test_shots = [even[k] for k in random.permutation(len(even))] if both else drawn[count:]
            constants = (
                carom.tracks.fit.fit(
                    drawn[:count], table, radius, free="table", seed=seed
                ).constants
                if count
                else None
            )
            found = carom.tracks.fit.fit(
                test_shots[:20], table, radius, constants=constants, free="none", seed=seed
            )
            figures.append((100 * found.median_rmse, 100 * found.p90_rmse))
        print(
            f"| {count} | {' | '.join(f'{value:.2f}' for value in np.median(figures, axis=0))} |",
            flush=True,
        )


def forecasts(
    recordings: Recordings,
    table: tuple[float, float],
    radius: float,
    afters: Sequence[float],
    seed: int,
    pictures: Path | None,
) -> None:
    """Which part of the places of shots that were not fitted lies in the regions of forecasts; with
    a folder, a picture of each shot.
    """
    print(
        "| known, s | shots | places | in 68 % | in 95 % | radius of 68 %, median, cm |\n|--:|--:|--:|--:|--:|--:|"
    )
    halves = [
        carom.tracks.fit.fit(recordings[fold::2], table, radius, free="table", seed=seed)
        for fold in (0, 1)
    ]
    for duration in afters:
        inside, radii, shots = [np.zeros((2, 0), bool)], [np.zeros(0)], 0
        for fold, fit in enumerate(halves):
            for shot in recordings[1 - fold :: 2]:
                try:
                    seen = fit.forecast(shot, after=duration, seed=seed)
                except ValueError:  # no strike was found
                    continue
                rows, balls = seen.later()
                if len(rows):
                    each = np.arange(len(rows))
                    middle, radius_of = seen.regions(rows[:, 0])
                    off = np.linalg.norm(rows[:, 1:] - middle[each, balls], axis=-1)
                    inside.append(off <= radius_of[:, each, balls])
                    radii.append(radius_of[0, each, balls])
                    shots += 1
                    if pictures:
                        pictures.mkdir(parents=True, exist_ok=True)
                        (pictures / f"forecast-{duration:g}-{shot.id}.svg").write_text(
                            seen.plot().svg
                        )
        whole = np.concatenate(inside, axis=1)
        print(
            f"| {duration:g} | {shots} | {whole.shape[1]} | {100 * whole[0].mean():.0f} % | {100 * whole[1].mean():.0f} % | "
            f"{100 * np.median(np.concatenate(radii)):.1f} |",
            flush=True,
        )


def single_events(seen: carom.tracks.Events) -> None:
    (a, a_error), (b, b_error) = seen.roll
    print("\n| law | measured |\n|---|---|")
    print(f"| deceleration of sliding | {seen.slide[0]:.3f} ± {seen.slide[1]:.3f} m/s² |")
    print(
        f"| deceleration of rolling | ({a:.4f} ± {a_error:.4f}) + ({b:.4f} ± {b_error:.4f}) v², m/s², v in m/s |"
    )
    hits = seen.hits[
        (seen.hits["chi2"] < 3)
        & (seen.hits["v_n"] > 0.5)
        & (seen.hits["w_error"] < 0.1)
        & (seen.hits["z_error"] < 0.1)
    ]
    e = (hits["z_n"] - hits["w_n"]) / hits["v_n"]
    if len(e):
        print(f"| restitution of balls | {np.median(e):.3f}, {len(e)} hits |")
    good = _from_events.chosen(seen.impacts)
    print(
        "\n| speed into the cushion, m/s | speed out over speed in, rolling balls | impacts |\n|---|---|---|"
    )
    print("\n".join(law(-good["w_n"] / good["v_n"], good["v_n"], [0.45, 0.8, 1.2, 1.8, 4.0])))


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("tracks", type=Path)
    parser.add_argument("--table", type=carom.tracks.fit._extents, required=True, metavar="W,L")
    parser.add_argument("--radius", type=float, required=True, metavar="R")
    parser.add_argument("--models", default="smooth,han,stronge,mathavan")
    parser.add_argument(
        "--free", default="default", help="constants that are fitted, as in carom.fit"
    )
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument(
        "--few", type=int, metavar="N", help="only what few shots tell, over N draws of them"
    )
    parser.add_argument(
        "--forecast",
        type=lambda text: [float(part) for part in text.split(",")],
        metavar="T,...",
        help="only how well forecasts from the first T seconds hold",
    )
    parser.add_argument("--pictures", type=Path, metavar="FOLDER")
    options = parser.parse_args(arguments)
    reading = carom.tracks.read(options.tracks, table=options.table, radius=options.radius)
    recordings = [shot for shot in reading if np.isfinite(shot.moves).any()]
    models = options.models.split(",")
    if options.forecast:
        forecasts(
            recordings,
            options.table,
            options.radius,
            options.forecast,
            options.seed,
            options.pictures,
        )
        return 0
    if options.few:
        few_shots(recordings, options.table, options.radius, options.few, options.seed)
        return 0
    seen = carom.tracks.events(recordings, options.table, options.radius)
    single_events(seen)
    outputs(seen, options.radius, models, options.seed)
    print()
    fit = held_out(
        recordings, options.table, options.radius, models, options.free.split(","), options.seed
    )
    floor(fit, len(recordings), options.seed)
    growth(fit, options.seed)
    if options.pictures:
        options.pictures.mkdir(parents=True, exist_ok=True)
        pictures = {"rmse": _summary.histogram(fit), "bands": _summary.bands(fit)}
        pictures.update(
            zip(("rolling", "sliding", "cushion", "hits"), (svg for _, svg in _summary.laws(fit)))
        )
        for name, svg in pictures.items():
            (options.pictures / f"reality-{name}.svg").write_text(svg + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
