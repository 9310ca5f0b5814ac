"""Fitting carom to recorded shots: each shot's strike, and the constants of a table.

    python -m carom.fit TRACKS.csv --table 2.84,1.42 --radius 0.03075 -o fit.json

or, in Python, `carom.fit.fit(carom.tracks.read("TRACKS.csv"), (2.84, 1.42), 0.03075)`.
docs/using/fit.md explains the method and what the numbers mean.
"""

from __future__ import annotations

import argparse
import contextlib
import functools
import hashlib
import json
import math
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, cast

import numpy as np

from carom._rows import Seed, listing, seed_of
from carom._shot_options import ShotCushion
from carom.dtypes import Doubles, Records
from carom.layouts import GAMES
from carom.tracks import _constants, _covariance, _from_events, _joint
from carom.tracks import _recordings, _search, _strikes, _summary
from carom.tracks import Recording, TrackError, events, read
from carom.tracks._forecast import ROUGH, Forecast
from carom.tracks._kicks import Kicks, contact
from carom.tracks._summary import Fit

__all__ = ["Fit", "Kicks", "contact", "fit", "main"]
__dir__ = listing(__name__)

Progress = Callable[[str, float], None]
_FASTEST = 8.0  # m/s: no ball is faster
_CROOKED = 8e-3  # m: tracks that are farther off are told
_MANY = 5.0  # standard deviations of a coordinate: an RMSE above is not that of the noise
_LAW = {
    "law_a",
    "law_b",
    # a friction between balls that changes with the slip: a search without the change begins beside it,
}
_BOTH = 1  # and after this stage that one goes on whose misfit is the smaller


def _status(shot: Recording, radius: float) -> str:
    """ "ok", or why a recording cannot be played from a strike."""
    moves = shot.moves
    if not np.isfinite(moves).any():
        return "no ball moves"
    # a ball that moves at once was hit before the recording, where the struck ball is too far away
    # to have reached it
    cue, rest, begin = shot.cue, shot.rest, _strikes.origin(shot)
    speeds = [
        np.hypot(*np.diff(track[rows, 1:], axis=0).T) / np.diff(track[rows, 0])
        for track in shot.tracks
        for rows in [(track[:, 0] >= begin) & (track[:, 0] < begin + 0.2)]
    ]
    for ball, time in enumerate(moves - begin):
        gap = float(np.hypot(*(rest[ball] - rest[cue]))) - 2.0 * radius
        fastest = min(1.5 * max([*speeds[cue], *speeds[ball], 1.0]), _FASTEST)
        if ball != cue and time < 0.06 and gap > fastest * (time + 0.03):
            return f"begins after the strike: balls {shot.balls[cue]} and {shot.balls[ball]} move at once, {gap:.2g} m apart"
    return "ok"


def _priors(
    free: Sequence[str],
    priors: Mapping[str, tuple[float, float]],
    values: Mapping[str, float],
    cushion_model: ShotCushion,
) -> dict[str, tuple[float, float]]:
    """Mean and deviation of each constant that whole shots are to tell."""
    # a change with the speed is not sought where the usual cushion has none, nor a height where it
    # has no friction
    usual, some = (
        _constants.usual(cushion_model),
        ("mu_cushion", "roll_loss", "restitution_log", "mu_log"),
    )
    left_out = {name for name in some if not usual[name]} | (
        {"nose_height"} if not usual["mu_cushion"] else set()
    )
    wider = _joint.TABLE if list(free) == ["table"] else {}
    usually = [name for name in wider or _joint.PRIORS if name not in left_out]
    names = usually if list(free) in (["default"], ["table"]) else list(free)
    known = [name for name in _constants.KINDS if name in values]
    unknown = [name for name in [*names, *priors] if name not in known]
    if unknown:
        raise ValueError(
            f"free, priors: there is no constant {unknown[0]!r} to fit; known are {', '.join(known)}"
        )
    for name, (mean, deviation) in priors.items():
        if not (math.isfinite(mean) and math.isfinite(deviation) and deviation > 0.0):
            raise ValueError(
                f"priors: {name} must have a finite mean and a deviation above 0, not {mean!r}, {deviation!r}"
            )
    found = {}
    for name in names:
        width, low, high = _joint.prior(name, values[name])
        width = wider.get(name, width)
        if name not in _joint.PRIORS and not low <= values[name] <= high:
            raise ValueError(
                f"free: {name} must begin at {low:g} to {high:g}, not at its default of {values[name]:g}: constants gives it"
            )
        if name not in priors and width is None:
            raise ValueError(
                f"free: {name} needs its mean and deviation in priors, as its range is wide and it begins with 0"
            )
        found[name] = priors.get(name, (values[name], width or 0.0))
    return found


class _Saved:
    """The parts of a fit that are done, as JSON, kept in a file while the fit runs."""

    def __init__(self, path: Path | None, arguments: Sequence[Any]) -> None:
        shots, *others = arguments
        text = repr(
            [(shot.id, shot.balls, [track.tolist() for track in shot.tracks]) for shot in shots]
        ) + repr((others, "Newton"))
        self.path, self.parts, self.key = (
            path,
            dict[str, Any](),
            hashlib.sha256(text.encode()).hexdigest(),
        )
        if path is not None and path.exists():
            with contextlib.suppress(ValueError, TypeError, KeyError):  # another file: begin anew
                saved = json.loads(path.read_text(encoding="utf-8"))
                self.parts = saved["parts"] if saved["key"] == self.key else {}

    def get(self, name: str, compute: Callable[[], Any]) -> Any:
        """A part, which is computed if it is not there."""
        if name not in self.parts:
            self.parts[name] = compute()
            if self.path is not None:
                new = self.path.with_name(self.path.name + ".new")
                new.write_text(json.dumps({"key": self.key, "parts": self.parts}), encoding="utf-8")
                new.replace(self.path)
        return self.parts[name]

    def done(self) -> None:
        if self.path is not None:
            self.path.unlink(missing_ok=True)


def _sound(
    recordings: list[Recording],
    table: tuple[float, float],
    radius: float,
    train: Sequence[int] | None,
    calibrate: bool,
) -> tuple[list[Recording], list[list[str]], float, list[str]]:
    """The recordings of a fit without what is wrong in them, what was mended in each, the noise, m,
    and what is to be told.
    """
    noise = _recordings.noise_of(recordings if train is None else [recordings[k] for k in train])
    recordings, notes = _recordings.sound(recordings, noise)
    lie, remarks = _recordings.lie_of(recordings, table, radius), list[str]()
    if lie.far > max(_CROOKED, 4.0 * lie.error):
        remarks.append(
            f"the tracks lie {lie}: {'put right' if calibrate else '--calibrate puts them right'}"
        )
    for _ in range(2 if calibrate else 0):
        # the second time finds impacts that were too far from their cushions
        recordings = [
            replace(
                shot,
                tracks=tuple(
                    np.column_stack([track[:, 0], lie.places(track[:, 1:])])
                    for track in shot.tracks
                ),
            )
            for shot in recordings
        ]
        lie = _recordings.lie_of(recordings, table, radius)
    counts = {len(shot.balls) for shot in recordings}
    if len(counts) > 1:
        odd = next(shot for shot in recordings if len(shot.balls) != len(recordings[0].balls))
        raise ValueError(
            f"recordings: shot {odd.id} has {len(odd.balls)} balls, shot {recordings[0].id} {len(recordings[0].balls)}; "
            f"all shots must have the same number"
        )
    if not (min(table) > 4.0 * radius > 0.0):
        raise ValueError(
            f"table, radius: the extents {table} m must be above four radii, {4.0 * radius:g} m, and those above 0"
        )
    return recordings, notes, noise, remarks


def _told_by_events(
    values: dict[str, float],
    remarks: list[str],
    measured: Mapping[str, float],
    errors: Mapping[str, float],
) -> tuple[dict[str, float], dict[str, float]]:
    """The constants after single events, and their errors: what events tell worse than that it is a
    table stays as given.
    """
    worse = [
        name for name in measured if errors.get(name, 0.0) > (_joint.prior(name)[0] or math.inf)
    ]
    if worse:
        remarks.append(
            f"single events tell {', '.join(worse)} worse than tables differ: begun as given"
        )
    better = {name: value for name, value in measured.items() if name not in worse}
    return {**values, **better}, {
        name: error for name, error in errors.items() if name not in worse
    }


@dataclass(frozen=True)
class _Job:
    """What is asked of a fit, and what it keeps of its work."""

    recordings: list[Recording]
    table: tuple[float, float]
    radius: float
    cushion_model: ShotCushion
    free: list[str]
    priors: Mapping[str, tuple[float, float]]
    seed: int
    threads: int
    progress: Progress | None
    saved: _Saved

    def plays(self, shots: Sequence[int], values: dict[str, float]) -> _strikes.Plays:
        """The recordings of these shots, as they are played with these constants."""
        chosen = [self.recordings[k] for k in shots]
        return _strikes.Plays(
            chosen, self.table, self.radius, values, self.cushion_model, self.threads
        )

    def report(self, what: str, part: float) -> None:
        if self.progress:
            self.progress(what, part)


def _fit_to_events(
    job: _Job, fitted: Sequence[int], values: dict[str, float], remarks: list[str]
) -> tuple[dict[str, float], dict[str, float]]:
    """The constants that single events of these shots tell, and their errors."""
    job.report("events", 0.0)
    shots = [job.recordings[k] for k in fitted]

    def measured() -> Any:
        found = events(shots, job.table, job.radius)
        return _from_events.measured(found, job.radius, job.cushion_model, job.seed, values)

    return _told_by_events(values, remarks, *job.saved.get("events", measured))


def _search_constants(job: _Job, first: _joint.Search) -> _joint.Search:
    """Searches the constants, at first also without a change of the friction with the slip; returns
    the search at its end.
    """
    searches = {"": first}
    if set(first.names) >= _LAW and not _LAW & job.priors.keys():
        searches["flat "] = _joint.without_slip(first)
    for number in range(_joint.STAGES):
        job.report("constants", number / (_joint.STAGES + 2))
        for law, search in searches.items():
            stage = functools.partial(search.stage, number, job.seed)
            search.resume(job.saved.get(f"{law}constants {number}", stage))
        if number == _BOTH:
            law = min(searches, key=lambda law: searches[law].middle)
            searches = {law: searches[law]}
    (search,) = searches.values()
    finish = functools.partial(search.finish, job.seed, _joint.ROUNDS)
    search.resume(job.saved.get("end", finish))
    return search


def _fit_to_shots(
    job: _Job,
    fitted: Sequence[int],
    values: dict[str, float],
    spread: dict[str, float],
    remarks: list[str],
) -> tuple[dict[str, float], dict[str, float], tuple[str, ...], Doubles | None]:
    """The constants that these shots as a whole tell, the errors of all, and the names and the
    covariance of those that were fitted.
    """
    plays = job.plays(fitted, values)
    found = job.saved.get(
        "strikes", lambda: _search.find(plays, job.seed, job.progress)[0].tolist()
    )
    expected = _priors(job.free, job.priors, values, job.cushion_model)
    search = _search_constants(
        job, _joint.Search(plays, np.array(found), range(len(fitted)), expected)
    )
    job.report("spread", _joint.STAGES / (_joint.STAGES + 2))
    if search.middle >= _joint.MOST:
        remarks.append(
            "half of the shots are off by centimetres: whole shots tell no constants, which stay as they were before"
        )
        return values, spread, (), None

    values, names = search.constants(search.values), tuple(search.names)
    evidence = {name: error for name, error in spread.items() if name not in job.priors}
    covariance = _covariance.of_constants(search, evidence)
    if covariance is not None:
        errors = np.sqrt(covariance.diagonal()).tolist()
        spread = {**spread, **dict(zip(names, errors))}
    remarks += [
        f"{name} is at its bound, {values[name]:g}: the recordings do not tell it, or the cushion's model does not fit them"
        for name in names
        if values[name] in _joint.prior(name)[1:]
    ]
    return values, spread, names, covariance


def fit(
    recordings: Sequence[Recording],
    table: tuple[float, float],
    radius: float,
    *,
    cushion_model: ShotCushion = "smooth",
    constants: Mapping[str, float] | Records | np.void | None = None,
    free: str | Sequence[str] = "default",
    priors: Mapping[str, tuple[float, float]] | None = None,
    train: Sequence[int] | None = None,
    seed: Seed = 0,
    threads: int = 0,
    progress: Progress | None = None,
    state: Path | None = None,
    calibrate: bool = False,
) -> Fit:
    """Fit recorded shots.

    Parameters
    ----------
    recordings : sequence of Recording
        From `carom.tracks.read`, all of the same number of balls.
    table, radius
        Extents (float, float) of x and y, and the radius of the balls, m.
    cushion_model : str
        A model with which a fit can begin: `python -m carom.fit --help` lists them.
    constants : mapping or `carom.dtypes.ball_kind`, optional
        Known constants. Those of game="billiard" stand for those that are not given: a film of
        pool needs `carom.balls([[0, 0]])["kind"][0]`.
    free : "none", "events", "table", "default", or names of constants
        What is fitted besides each shot's strike. "none": nothing. "events": the constants that
        single events tell: mu_slide, mu_roll, drag, restitution, and those of the cushion. What too
        few events tell stays as given. "default": these first, and then all together with mu_spin,
        law_a and law_b, by whole shots. "table": restitution_cushion, mu_cushion, nose_height,
        mu_slide, mu_roll and drag, by whole shots, as what else a model has is a law that other
        tables share: for few shots. Names: these constants alone, by whole shots: any field of
        `carom.dtypes.ball_kind` but radius and mu_ball, also a cushion's own numbers.
    priors : mapping, optional
        Mean and deviation of constants that are fitted by whole shots. Without: about the value
        before, as wide as the constants of different tables are.
    train : sequence of int, optional
        The shots, from 0, that constants are fitted to; all without. The others then tell how well
        the constants predict.
    seed : int or numpy.random.Generator
        Of what the search for constants draws; strikes by known constants do not depend on it. In
        one environment the bits depend on the seed alone.
    threads : int
        Most threads: 0 is the calling one alone, -1 all processors.
    progress : callable(what, part), optional
        Is told the name of the work and the part of it that is done, 0 to 1.
    state : path, optional
        A file that keeps what is done so far. A fit that was interrupted goes on from there when it
        is called again with the same arguments, and has the same bits; the file is removed at the
        end.
    calibrate : bool
        Whether places are put right first where the table lies crooked in the tracks, is too large
        or small, or bent: by impacts on cushions.

    Raises
    ------
    ValueError
        An argument is wrong: which, and what would be right.
    """
    recordings, seed = list(recordings), seed_of(seed, 2**64 - 1)
    if not recordings:
        raise ValueError("recordings: at least one shot is needed")
    recordings, notes, noise, remarks = _sound(recordings, table, radius, train, calibrate)
    free = [free] if isinstance(free, str) else list(free)
    values = _constants.complete({} if constants is None else constants, cushion_model)
    _priors([] if free[0] in ("none", "events") else free, priors or {}, values, cushion_model)
    spread: dict[str, float] = {}
    names: tuple[str, ...] = ()
    covariance: Doubles | None = None
    status = [_status(shot, radius) for shot in recordings]
    played = [k for k, text in enumerate(status) if text != "no ball moves"]
    fitted = [k for k in played if status[k] == "ok" and (train is None or k in set(train))]
    strikes, rmse = np.full((len(recordings), 6), np.nan), np.full(len(recordings), np.nan)
    if played:
        saved = _Saved(
            state, [recordings, table, radius, cushion_model, values, free, priors, fitted, seed]
        )
        job = _Job(
            recordings,
            table,
            radius,
            cushion_model,
            free,
            priors or {},
            seed,
            threads,
            progress,
            saved,
        )
        if free[0] in ("events", "default"):
            values, spread = _fit_to_events(job, fitted, values, remarks)
        if free[0] not in ("none", "events") and fitted:
            values, spread, names, covariance = _fit_to_shots(job, fitted, values, spread, remarks)
        plays = job.plays(played, values)
        strikes[played], _ = _search.find(plays, progress=progress, squares=True)
        rmse[played] = plays.rmse(strikes[played])
        for k in played:
            if not np.isfinite(rmse[k]):
                status[k], strikes[k], rmse[k] = "no strike could be played", np.nan, np.nan
            elif status[k] == "ok":
                status[k] = _remarks(strikes[k], float(rmse[k]), noise, radius, notes[k])
        strikes[played, 5] += plays.origins
        saved.done()
    part = None if train is None else [k in set(train) for k in range(len(recordings))]
    found = Fit(
        recordings,
        table,
        radius,
        cushion_model,
        values,
        spread,
        strikes,
        status,
        rmse,
        part,
        names,
        covariance,
        remarks,
    )
    if found.median_rmse > _MANY * noise:
        remarks.append(
            f"the median RMSE is {found.median_rmse / noise / math.sqrt(2.0):.0f} times that of the noise: the constants or the "
            f"models are off by more than the camera"
        )
    return found


def _remarks(
    strike: Doubles, rmse: float, noise: float, radius: float, mended: Sequence[str]
) -> str:
    """What there is to say of a strike that was found, or "ok"."""
    remarks = [_quality(strike, rmse, noise, radius)]
    if mended:
        remarks.append(f"mended: {'; '.join(mended)}")
    return "; ".join(filter(None, remarks)) or "ok"


def _quality(strike: Doubles, rmse: float, noise: float, radius: float) -> str:
    """Why the play of a shot is doubtful or rough, or nothing."""
    above = rmse / noise / math.sqrt(2.0)
    if rmse > max(2.0 * radius, _MANY * noise):
        return f"doubtful: RMSE {100.0 * rmse:.1f} cm, {above:.0f} times that of the noise"
    if bound := _strikes.at_bound(strike):
        return f"doubtful: {bound} of the strike is at its bound"
    return (
        f"rough: RMSE {1e3 * rmse:.1f} mm, {above:.2g} times that of the noise"
        if above > ROUGH
        else ""
    )


def _two_numbers(form: str) -> Callable[[str], tuple[float, float]]:
    """What reads an argument of two numbers, and says its form where it is wrong."""

    def read(text: str) -> tuple[float, float]:
        try:
            first, second = map(float, text.split(","))
        except ValueError:
            raise argparse.ArgumentTypeError(f"{text!r} must be {form}") from None
        return first, second

    return read


_extents = _two_numbers("W,L, the extents of x and y in m, such as 2.84,1.42")
_place = _two_numbers("X,Y, a place in the unit of the file, such as 4.5,3")


def _read_object(path: Path, such: str) -> dict[str, Any]:
    """An object of a JSON file: the constants of it, where it is what this command wrote."""
    try:
        content: Any = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise TrackError(f"{path}: no JSON ({error})") from None
    if isinstance(content, dict) and isinstance(content.get("constants"), dict):
        content = content["constants"]
    if not isinstance(content, dict):
        raise TrackError(f"{path}: an object of constants is needed, such as {such}")
    return cast(dict[str, Any], content)


def _show(what: str, part: float) -> None:
    print(
        f"\r{what}: {100.0 * part:3.0f} %  ",
        end="\n" if part >= 1.0 else "",
        file=sys.stderr,
        flush=True,
    )


def _forecasts(found: Fit, duration: float, seed: int) -> list[Forecast]:
    """Of the shots that the constants were not fitted to, or of all; without those of which nothing
    is known after the first seconds.
    """
    seen = []
    for k, shot in enumerate(found.recordings):
        if found.train is not None and found.train[k]:
            continue
        try:
            forecast = found.forecast(k, after=duration, seed=seed)
        except ValueError as error:
            if not 0.0 < duration < math.inf:
                raise
            print(f"carom.fit: shot {shot.id}: no forecast: {error}", file=sys.stderr)
            continue
        if len(forecast.later()[0]):
            seen.append(forecast)
    return seen


def main(arguments: Sequence[str] | None = None) -> int:
    """The command; its exit status is 0, 2 for bad usage or unreadable input, or 130 if it was
    interrupted; then nothing is written.
    """
    parser = argparse.ArgumentParser(
        prog="python -m carom.fit", description="Fits recorded shots: each strike, and constants."
    )
    parser.add_argument(
        "tracks",
        type=Path,
        help="recorded tracks: a CSV with shot,ball,t,x,y, or JSON Lines; .xz and .gz too",
    )
    parser.add_argument(
        "--table", type=_extents, required=True, metavar="W,L", help="extents of x and y, m"
    )
    parser.add_argument("--radius", type=float, required=True, metavar="R", help="of the balls, m")
    parser.add_argument(
        "--unit", type=float, default=1.0, metavar="M", help="unit of x and y, m: 0.0254 for inches"
    )
    parser.add_argument(
        "--origin",
        type=_place,
        default=(0.0, 0.0),
        metavar="X,Y",
        help="where the corner of the noses lies in the file, in its unit",
    )
    parser.add_argument(
        "--rate", type=float, default=1.0, metavar="HZ", help="frames a second, if t counts frames"
    )
    parser.add_argument("--cushion-model", default="smooth", choices=list(_constants.STARTS))
    parser.add_argument(
        "--game",
        default="billiard",
        choices=list(GAMES),
        help="whose usual constants the fit begins with, such as pool",
    )
    parser.add_argument(
        "--constants",
        type=Path,
        metavar="IN.json",
        help="known constants; those of --game otherwise",
    )
    parser.add_argument(
        "--free",
        default="default",
        type=lambda text: text.split(","),
        metavar="none|events|table|default|NAME,...",
        help="constants that are fitted besides the strikes",
    )
    parser.add_argument(
        "--priors", type=Path, metavar="PRIORS.json", help='{"mu_spin": [mean, deviation], ...}'
    )
    parser.add_argument(
        "--split",
        action="store_true",
        help="fit constants to every second shot, and tell how they predict the others",
    )
    parser.add_argument(
        "--calibrate",
        action="store_true",
        help="put right tracks on which the table lies crooked, has another size or is bent",
    )
    parser.add_argument(
        "--kicks", action="store_true", help="tell what the models get wrong at each contact"
    )
    parser.add_argument(
        "--forecast",
        type=float,
        metavar="T",
        help="forecast each shot from its first T seconds, of --split those that are not fitted, "
        "and tell how many of the later places lie in the regions; OUT.json has these",
    )
    parser.add_argument(
        "--summary", type=Path, metavar="OUT.html", help="write a page with pictures"
    )
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--threads", type=int, default=0, help="0: one; -1: all processors")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="OUT.json")
    options = parser.parse_args(arguments)
    try:
        constants = (
            _read_object(options.constants, '{"mu_slide": 0.2}') if options.constants else {}
        )
        _constants.complete(constants, options.cushion_model, str(options.constants))
        if options.game != "billiard":
            constants = {**_constants.of_game(options.game), **constants}
        recordings = read(
            options.tracks,
            table=options.table,
            radius=options.radius,
            unit=options.unit,
            origin=options.origin,
            rate=options.rate,
        )
        found = fit(
            recordings,
            options.table,
            options.radius,
            cushion_model=options.cushion_model,
            constants=constants,
            free=options.free,
            priors=_read_object(options.priors, '{"mu_spin": [0.004, 0.001]}')
            if options.priors
            else None,
            train=range(0, len(recordings), 2) if options.split else None,
            seed=options.seed,
            threads=options.threads,
            progress=_show if sys.stderr.isatty() else None,
            state=options.output.with_name(options.output.name + ".state"),
            calibrate=options.calibrate,
        )
        kicks = found.kicks() if options.kicks else None
        seen = _forecasts(found, options.forecast, options.seed) if options.forecast else []
        if options.summary:
            options.summary.write_text(
                _summary.page(found, options.tracks.name, kicks, seen), encoding="utf-8"
            )
        written = found.to_dict(kicks)
        if options.forecast:
            written["forecasts"] = [forecast.to_dict() for forecast in seen]
        options.output.write_text(json.dumps(written, indent=1) + "\n", encoding="utf-8")
    except (OSError, ValueError) as error:
        print(f"carom.fit: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("\ncarom.fit: interrupted; the same command goes on from here", file=sys.stderr)
        return 130
    parts = [("", None)] if found.train is None else [("fitted, ", True), ("predicted, ", False)]
    for what, part in parts:
        rmse = 100.0 * found.counted(part)
        if len(rmse):
            print(
                f"{what}{len(rmse)} of {len(recordings)} shots: RMSE median {np.median(rmse):.2f} cm, p90 {np.percentile(rmse, 90):.2f} cm"
            )
    if found.train is not None and len(rmse):
        within = 100.0 * found.covered(found.bands(True), False)
        print(
            f"of their samples, with strikes fitted to whole shots, {within[0]:.0f} and {within[1]:.0f} % "
            "are within the residuals of 68 and 95 % of the shots that were fitted"
        )
    if seen:
        print(_summary.told_forecasts(seen))
    print("\n".join(_summary.summary_lines(found)))
    if kicks is not None and np.isfinite(kicks.rmse).any():
        rmse = 100.0 * kicks.rmse[np.isfinite(kicks.rmse)]
        print(
            f"with kicks: RMSE median {np.median(rmse):.2f} cm, p90 {np.percentile(rmse, 90):.2f} cm\n\n{kicks.markdown()}"
        )
    return 0


if __name__ == "__main__":
    sys.exit(main())
