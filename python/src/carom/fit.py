"""Fitting carom to recorded shots: each shot's strike, and the constants of a table.

    python -m carom.fit TRACKS.csv --table 2.84,1.42 --radius 0.03075 --cushion-model han -o fit.json

or, in Python, `carom.fit.fit(carom.tracks.read("TRACKS.csv"), (2.84, 1.42), 0.03075)`. docs/using/tracks.md explains the method and
what the numbers mean.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, cast

import numpy as np
import numpy.typing as npt

from carom import _constants, _from_events, _joint, _strikes, pictures
from carom.dtypes import Doubles
from carom.results import Shot
from carom.shots import ShotCushion, simulate
from carom.tracks import Recording, TrackError, events, read

__all__ = ["Fit", "fit", "main"]

Free = Literal["none", "default", "joint"]
Progress = Callable[[str, float], None]
# What a constant that is found by whole shots is off by for synthetic recordings, where the other constants are a little wrong.
_BY_SHOTS = {"mu_spin": 3e-4, "mu_ball": 2e-3}
_GENERATIONS, _OF_HALVES = 90, 30  # of the joint search, by all shots and by each half of them
_FASTEST = 8.0  # m/s: no ball is faster


@dataclass(frozen=True, eq=False)
class Fit:
    """Recorded shots, and what they were fitted by.

    Attributes
    ----------
    recordings : list of Recording
    table : (float, float)
        Extents of x and y, m.
    radius : float
        m.
    cushion_model : str
    constants : dict
        What the shots are played with: fields of `carom.dtypes.ball_kind`, and nose_height (m).
    spread : dict
        Of each constant that was fitted, how far it is off by the evidence itself: a standard deviation.
    strikes : ndarray, shape (shots, 6)
        v_x, v_y, R w_x, R w_y, R w_z (m/s) of the struck ball just after the strike, and its time (s). NaN where there is none.
    status : list of str
        "ok", or why the shot does not count.
    rmse : ndarray, shape (shots,)
        Root of the mean squared distance between recorded and played places over all samples of all balls, m; NaN without a play.
    """

    recordings: list[Recording]
    table: tuple[float, float]
    radius: float
    cushion_model: ShotCushion
    constants: dict[str, float]
    spread: dict[str, float]
    strikes: Doubles
    status: list[str]
    rmse: Doubles

    def _counted(self) -> Doubles:
        return self.rmse[[status == "ok" for status in self.status]]

    @property
    def median_rmse(self) -> float:
        """m, over the shots that are ok."""
        return float(np.median(self._counted())) if len(self._counted()) else float("nan")

    @property
    def p90_rmse(self) -> float:
        """m: 9 in 10 of the shots that are ok are better."""
        return float(np.percentile(self._counted(), 90)) if len(self._counted()) else float("nan")

    def shot(self, i: int) -> Shot:
        """Shot i played; its clock begins at the strike, `strikes[i, 5]`.

        Raises
        ------
        ValueError
            No strike was found.
        """
        strike, recording = self.strikes[i], self.recordings[i]
        if not np.isfinite(strike).all():
            raise ValueError(f"shot {recording.id}: no strike was found: {self.status[i]}")
        centres = _strikes.apart(recording.rest, self.table, self.radius)
        balls = _constants.layout(centres, self.radius, self.constants)
        balls["state"]["v"][recording.cue, :2] = strike[:2]
        balls["state"]["w"][recording.cue] = strike[2:5] / self.radius
        table = _constants.rectangle(self.table, self.constants["nose_height"])
        return simulate(table, balls, cushion_model=self.cushion_model, friction="constant")

    def positions(self, i: int, times: npt.ArrayLike) -> Doubles:
        """The centres of shot i's balls as played at times of the recording's clock, m, shape (..., balls, 2)."""
        at = np.asarray(times, np.float64)
        return self.shot(i).positions(at - self.strikes[i, 5])[..., :2]

    def plot(self, i: int) -> pictures.Picture:
        """Shot i: lines as played, dots as recorded. Its `svg` is the text of a file."""
        shot = self.shot(i)
        return pictures.Picture(pictures.picture(shot.table, shot, [track[:, 1:] for track in self.recordings[i].tracks]))

    def to_dict(self) -> dict[str, Any]:
        """What the command writes, of numbers that JSON has."""
        shots: list[dict[str, Any]] = []
        for recording, strike, status, rmse in zip(self.recordings, self.strikes, self.status, self.rmse):
            found = bool(np.isfinite(strike).all())
            v_x, v_y, w_x, w_y, w_z, start = strike.tolist()
            cue = {
                "ball": recording.balls[recording.cue], "v_x": v_x, "v_y": v_y,
                "w_x": w_x / self.radius, "w_y": w_y / self.radius, "w_z": w_z / self.radius, "start": start,
            } if found else None  # fmt: skip
            shots.append({"id": recording.id, "status": status, "rmse": float(rmse) if found else None, "cue": cue})
        return {
            "constants": self.constants,
            "spread": self.spread,
            "cushion_model": self.cushion_model,
            "table": list(self.table),
            "radius": self.radius,
            "shots": shots,
            "median_rmse": self.median_rmse if len(self._counted()) else None,
            "p90_rmse": self.p90_rmse if len(self._counted()) else None,
        }


def _status(shot: Recording, radius: float) -> str:
    """ "ok", or why a recording cannot be played from a strike."""
    moves = shot.moves
    if not np.isfinite(moves).any():
        return "no ball moves"
    # a ball that moves at once was hit before the recording, where the struck ball is too far away
    cue, rest = shot.cue, shot.rest
    for ball, time in enumerate(moves):
        gap = float(np.hypot(*(rest[ball] - rest[cue]))) - 2.0 * radius
        if ball != cue and time < 0.06 and gap > _FASTEST * (time + 0.03):
            return f"begins after the strike: balls {shot.balls[cue]} and {shot.balls[ball]} move at once, {gap:.2g} m apart"
    return "ok"


def _by_shots(
    plays: _strikes.Plays, strikes: Doubles, values: dict[str, float], rows: list[int], random: np.random.Generator,
    progress: Progress | None,
) -> tuple[dict[str, float], dict[str, float]]:  # fmt: skip
    """All constants, mu_spin and mu_ball searched by the shots of `rows`; and the errors of these two, from halves of the shots."""

    def search(some: list[int], told: Progress | None = None) -> dict[str, float]:
        return _joint.one_by_one(_joint.Objective(plays, strikes, values, some), told)

    found = search(rows, progress)
    if len(rows) < 8:
        return found, {}
    order = random.permutation(rows)
    halves = [search(sorted(half.tolist())) for half in np.array_split(order, 2)]
    return found, {name: math.hypot(0.5 * (halves[0][name] - halves[1][name]), method) for name, method in _BY_SHOTS.items()}


def _together(
    plays: _strikes.Plays, strikes: Doubles, values: dict[str, float], rows: list[int], seed: int, progress: Progress | None
) -> tuple[dict[str, float], dict[str, float]]:
    """All constants, fitted together, and their errors: half the difference of halves."""

    def search(some: list[int], generations: int, told: Progress | None = None) -> dict[str, float]:
        return _joint.together(_joint.Objective(plays, strikes, values, some), generations, seed, told)

    found = search(rows, _GENERATIONS, progress)
    if len(rows) < 8:
        return found, {}
    order = np.random.default_rng(seed).permutation(rows)
    halves = [search(sorted(half.tolist()), _OF_HALVES) for half in np.array_split(order, 2)]
    return found, {name: 0.5 * abs(halves[0][name] - halves[1][name]) for name in _joint.DEVIATIONS if name in found}


def fit(
    recordings: Sequence[Recording],
    table: tuple[float, float],
    radius: float,
    *,
    cushion_model: ShotCushion = "han",
    constants: Mapping[str, float] | None = None,
    free: Free = "default",
    seed: int = 0,
    threads: int = 0,
    progress: Progress | None = None,
) -> Fit:
    """Fit recorded shots.

    Parameters
    ----------
    recordings : sequence of Recording
        From `carom.tracks.read`, all of the same number of balls.
    table : (float, float)
        Extents of x and y, m.
    radius : float
        Of the balls, m.
    cushion_model : {"mathavan", "stronge", "han", "mirror"}
    constants : mapping, optional
        What is known; the usual ones for what is not given.
    free : {"none", "default", "joint"}
        What is fitted: "none", each shot's strike alone; "default", also the constants that single events tell (mu_slide, mu_roll,
        restitution, those of the cushion), and mu_spin and mu_ball by whole shots. What too few events tell stays as given. "joint": from there, all constants together by
        whole shots, which fits better as constants absorb what the models leave out; needs the package cma.
    seed : int
        Of what is drawn: the same seed, the same bits.
    threads : int
        Most threads; 0 is the calling one alone, -1 all processors. No bit depends on it.
    progress : callable(what, part), optional
        Is told what is being done, and the part of it that is done, 0 to 1.

    Returns
    -------
    Fit

    Raises
    ------
    ValueError
        An argument is wrong: which, and what would be right.
    """
    recordings = list(recordings)
    if not recordings:
        raise ValueError("recordings: at least one shot is needed")
    counts = {len(shot.balls) for shot in recordings}
    if len(counts) > 1:
        odd = next(shot for shot in recordings if len(shot.balls) != len(recordings[0].balls))
        raise ValueError(
            f"recordings: shot {odd.id} has {len(odd.balls)} balls, shot {recordings[0].id} {len(recordings[0].balls)}; "
            f"all shots must have the same number"
        )
    if not (min(table) > 4.0 * radius > 0.0):
        raise ValueError(f"table, radius: the extents {table} m must be above four radii, {4.0 * radius:g} m, and those above 0")
    if free not in ("none", "default", "joint"):
        raise ValueError(f"free: must be 'none', 'default' or 'joint', not {free!r}")
    values = _constants.complete(constants or {}, cushion_model)
    spread: dict[str, float] = {}
    status = [_status(shot, radius) for shot in recordings]
    played = [k for k, text in enumerate(status) if text != "no ball moves"]
    strikes, rmse = np.full((len(recordings), 6), np.nan), np.full(len(recordings), np.nan)
    if played:
        shots = [recordings[k] for k in played]
        if free != "none":
            if progress:
                progress("events", 0.0)
            measured, spread = _from_events.measured(events(shots, table, radius), radius, cushion_model, seed)
            values = {**values, **measured}
        plays = _strikes.Plays(shots, table, radius, values, cushion_model, threads)
        found, _ = _strikes.find(plays, progress)
        if free != "none":
            counted = [row for row, k in enumerate(played) if status[k] == "ok"]
            values, by_shots = _by_shots(plays, found, values, counted, np.random.default_rng(seed), progress)
            spread = {**spread, **by_shots}
            plays.set(values)
            found, _ = _strikes.find(plays, progress)
            if free == "joint":
                values, spread = _together(plays, found, values, counted, seed, progress)
                plays.set(values)
                found, _ = _strikes.find(plays, progress)
        strikes[played] = _strikes.polish(plays, found)
        rmse[played] = plays.rmse(strikes[played])
    for k in played:
        if not np.isfinite(rmse[k]):
            status[k], strikes[k], rmse[k] = "no strike could be played", np.nan, np.nan
    return Fit(recordings, table, radius, cushion_model, values, spread, strikes, status, rmse)


def _extents(text: str) -> tuple[float, float]:
    try:
        width, length = map(float, text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} must be W,L, the extents of x and y in m, such as 2.84,1.42") from None
    return width, length


def _read_constants(path: Path) -> dict[str, float]:
    """Constants of a JSON file: an object of them, or what this command wrote."""
    try:
        given: Any = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise TrackError(f"{path}: no JSON ({error})") from None
    if isinstance(given, dict) and isinstance(given.get("constants"), dict):
        given = given["constants"]
    if not isinstance(given, dict):
        raise TrackError(f'{path}: an object of constants is needed, such as {{"mu_slide": 0.2}}')
    return cast(dict[str, float], given)


def _show(what: str, part: float) -> None:
    print(f"\r{what}: {100.0 * part:3.0f} %  ", end="\n" if part >= 1.0 else "", file=sys.stderr, flush=True)


def main(arguments: Sequence[str] | None = None) -> int:
    """The command; its exit status is 0, or 2 for bad usage or unreadable input, when nothing is written."""
    parser = argparse.ArgumentParser(prog="python -m carom.fit", description="Fits recorded shots: each strike, and constants.")
    parser.add_argument("tracks", type=Path, help="recorded tracks: a CSV with shot,ball,t,x,y, or JSON Lines; .xz and .gz too")
    parser.add_argument("--table", type=_extents, required=True, metavar="W,L", help="extents of x and y, m")
    parser.add_argument("--radius", type=float, required=True, metavar="R", help="of the balls, m")
    parser.add_argument("--cushion-model", default="han", choices=["mathavan", "stronge", "han", "mirror"])
    parser.add_argument("--constants", type=Path, metavar="IN.json", help="known constants; the usual ones otherwise")
    parser.add_argument("--free", default="default", choices=["none", "default", "joint"], help="what is fitted besides the strikes")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--threads", type=int, default=0, help="0: one; -1: all processors")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="OUT.json")
    given = parser.parse_args(arguments)
    try:
        constants = _read_constants(given.constants) if given.constants else {}
        _constants.complete(constants, given.cushion_model, str(given.constants))
        recordings = read(given.tracks, table=given.table, radius=given.radius)
        found = fit(
            recordings, given.table, given.radius, cushion_model=given.cushion_model, constants=constants, free=given.free,
            seed=given.seed, threads=given.threads, progress=_show if sys.stderr.isatty() else None,
        )  # fmt: skip
        given.output.write_text(json.dumps(found.to_dict(), indent=1) + "\n", encoding="utf-8")
    except (OSError, ValueError) as error:
        print(f"carom.fit: {error}", file=sys.stderr)
        return 2
    counted = sum(status == "ok" for status in found.status)
    print(f"{counted} of {len(recordings)} shots: RMSE median {100 * found.median_rmse:.2f} cm, p90 {100 * found.p90_rmse:.2f} cm")
    return 0


if __name__ == "__main__":
    sys.exit(main())
