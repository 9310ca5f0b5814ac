"""How well carom predicts recorded shots: the tables and pictures of docs/understanding/reality.md.

    python reality.py TRACKS.csv --table 2.84,1.42 --radius 0.03075 --pictures FOLDER

What single events say, and then, for each model of the cushion, constants are fitted to every second shot and used for the others, and
the other way round. The table has the RMSE of the shots that the constants were not fitted to, of both halves: of each shot only the
strike, six numbers, is fitted. Markdown on standard output; the pictures are SVG.
"""

import argparse
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

import carom.fit
import carom.tracks
from carom import _events, _from_events, _summary

Doubles = npt.NDArray[np.float64]
Recordings = list[carom.tracks.Recording]


def law(values: Doubles, by: Doubles, edges: Sequence[float]) -> list[str]:
    """Medians of values over ranges of another number, with their errors and how many."""
    rows = []
    for low, high in zip(edges[:-1], edges[1:]):
        part = values[(by >= low) & (by < high)]
        if len(part) >= 5:
            middle, error = _events.median(part)
            rows.append(f"| {low:g} to {high:g} | {middle:.3f} ± {error:.3f} | {len(part)} |")
    return rows


def patch(a: float, mu: float, e: float, v_t: Doubles, v_n: Doubles) -> Doubles:
    """What a round patch of contact of the greatest radius a R takes from the roll along a cushion: docs/understanding/reality.md."""
    # while it sticks its shear turns the spin about the normal by (5/3) (a/R)^2 of the square of the rate of the normal impact
    sticks = (1.0 - np.cos(np.pi * a * np.sqrt(5.0 / 3.0 * 2.0 / np.pi))) * v_t
    # friction, with the pressure of Hertz, bears no more than this; a^2 and the force rise and fall like a half wave of the sine
    bears = 2.5 * 3.0 * np.pi / 16.0 * 0.874 * mu * a * (1.0 + e) * v_n
    least: Doubles = np.minimum(sticks, bears)
    return least


def explanations(lost: Doubles, impacts: Any, mu: float, e: float) -> None:
    """How well laws of the loss of roll along a cushion agree with it: each with its best numbers."""
    v_t, v_n = np.abs(impacts["v_t"]), impacts["v_n"]
    seen, v = np.sign(impacts["v_t"]) * lost, np.hypot(impacts["v_t"], impacts["v_n"])
    part = v_t > 0.1
    seen, v, v_t, v_n = seen[part], v[part], v_t[part], v_n[part]
    error = np.hypot(impacts["u_error"][part], 0.03 * v)
    grid = np.linspace(0.0, 0.3, 61)
    laws: dict[str, list[tuple[tuple[float, ...], Doubles]]] = {
        "none": [((), 0.0 * v_t)],
        "c v_t": [((c,), c * v_t) for c in grid],
        "d v_n": [((d,), d * v_n) for d in grid],
        "least of c v_t and d v_n": [((c, d), np.minimum(c * v_t, d * v_n)) for c in grid for d in grid],
        "patch of radius a R": [((a,), patch(a, mu, e, v_t, v_n)) for a in np.linspace(0.0, 0.3, 121)],
    }
    print("\n| loss of roll along the cushion | best numbers | chi² | median left, % of v |\n|---|---|--:|--:|")
    for name, sets in laws.items():
        # outliers beyond three deviations count linearly
        misfits = [(18.0 * (np.sqrt(1.0 + ((seen - given) / error) ** 2 / 9.0) - 1.0).sum(), numbers, given) for numbers, given in sets]
        chi2, numbers, given = min(misfits, key=lambda one: one[0])
        print(f"| {name} | {', '.join(f'{x:.3f}' for x in numbers)} | {chi2:.0f} | {100 * np.median(np.abs(seen - given) / v):.1f} |")


def single_events(recordings: Recordings, table: tuple[float, float], radius: float) -> None:
    seen = carom.tracks.events(recordings, table, radius)
    (a, a_error), (b, b_error) = seen.roll
    print("| law | measured |\n|---|---|")
    print(f"| deceleration of sliding | {seen.slide[0]:.3f} ± {seen.slide[1]:.3f} m/s² |")
    print(f"| deceleration of rolling | ({a:.4f} ± {a_error:.4f}) + ({b:.4f} ± {b_error:.4f}) v², m/s², v in m/s |")
    hits = seen.hits[(seen.hits["chi2"] < 3) & (seen.hits["v_n"] > 0.5) & (seen.hits["w_error"] < 0.1) & (seen.hits["z_error"] < 0.1)]
    e = (hits["z_n"] - hits["w_n"]) / hits["v_n"]
    if len(e):
        print(f"| restitution of balls | {np.median(e):.3f}, {len(e)} hits |")
    good = _from_events.chosen(seen.impacts)
    print("\n| speed into the cushion, m/s | speed out over speed in, rolling balls | impacts |\n|---|---|---|")
    print("\n".join(law(-good["w_n"] / good["v_n"], good["v_n"], [0.45, 0.8, 1.2, 1.8, 4.0])))

    # what the roll along a cushion falls by, beyond the models of Han and of Mathavan
    for model in ("han", "mathavan"):
        values, _ = _from_events.measured(seen, radius, model, 0)
        if "mu_cushion" not in values:
            continue
        names = ("restitution_cushion", "mu_cushion", "nose_height")
        made = _from_events.predicted(good, radius, model, *(values[name] for name in names))
        loss = (made[:, 0] - made[:, 2] - good["w_t"] + good["u_t"]) / good["v_t"]
        angle = np.degrees(np.arctan2(np.abs(good["v_t"]), good["v_n"]))
        fast = np.abs(good["v_t"]) > 0.3
        print(f"\nBeyond {model}:\n\n| angle from the normal, degrees | loss of roll along the cushion, over v_t | impacts |\n|---|---|---|")
        print("\n".join(law(loss[fast], angle[fast], [15, 30, 45, 60, 80])))
        print("\n| speed into the cushion, m/s | loss of roll along the cushion, over v_t | impacts |\n|---|---|---|")
        print("\n".join(law(loss[fast], good["v_n"][fast], [0.45, 0.8, 1.2, 1.8, 4.0])))
        explanations(loss * good["v_t"], good, values["mu_cushion"], values["restitution_cushion"])


def held_out(recordings: Recordings, table: tuple[float, float], radius: float, models: Sequence[Any], seed: int) -> carom.fit.Fit:
    print("\n| cushion | constants | RMSE, median, cm | 9 in 10 below, cm | mean, cm | processor time, ms a shot |\n|---|---|--:|--:|--:|--:|")
    best: tuple[float, carom.fit.Fit] | None = None
    for model in models:
        for free in ("events", "default"):
            rmse, spent = [], 0.0
            for fold in (0, 1):
                found = carom.fit.fit(recordings[fold::2], table, radius, cushion_model=model, free=free, seed=seed)
                begin = time.process_time()
                test = carom.fit.fit(
                    recordings[1 - fold :: 2], table, radius, cushion_model=model, constants=found.constants, free="none", seed=seed
                )
                spent += time.process_time() - begin
                rmse.append(100.0 * test.counted())
            columns = (" and ".join(f"{of(cm):.1f}" for cm in rmse) for of in (np.median, lambda cm: np.percentile(cm, 90), np.mean))
            print(
                f"| {model} | {'single events' if free == 'events' else 'single events, then whole shots'} | {' | '.join(columns)} | "
                f"{1e3 * spent / sum(map(len, rmse)):.0f} |",
                flush=True,
            )
            middle = float(np.median(np.concatenate(rmse)))
            if best is None or middle < best[0]:
                best = middle, found
    assert best is not None
    return best[1]


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("tracks", type=Path)
    parser.add_argument("--table", type=carom.fit._extents, required=True, metavar="W,L")
    parser.add_argument("--radius", type=float, required=True, metavar="R")
    parser.add_argument("--models", default="han,stronge,mathavan,mirror")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--pictures", type=Path, metavar="FOLDER")
    given = parser.parse_args(arguments)
    recordings = carom.tracks.read(given.tracks, table=given.table, radius=given.radius)
    recordings = [shot for shot in recordings if np.isfinite(shot.moves).any()]
    single_events(recordings, given.table, given.radius)
    fit = held_out(recordings, given.table, given.radius, given.models.split(","), given.seed)
    if given.pictures:
        given.pictures.mkdir(parents=True, exist_ok=True)
        pictures = {"rmse": _summary.histogram(fit)}
        pictures.update(zip(("rolling", "sliding", "cushion", "hits"), (svg for _, svg in _summary.laws(fit))))
        for name, svg in pictures.items():
            (given.pictures / f"reality-{name}.svg").write_text(svg + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
