"""Fit carom to recorded shots: the strike of each shot, and the constants of a table.

    python -m carom.fit TRACKS.csv --table snooker -o fit.json

or, in Python, `carom.fit.fit(carom.tracks.read("TRACKS.csv"), "snooker")`. docs/using/fit.md
explains the method and the results.
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
from typing import Any, NamedTuple, cast, get_args

import numpy as np

from carom._described import BallFriction, Game
from carom._rows import Seed, listing, seed_of, unknown_name
from carom._shot_options import ShotCushion
from carom.dtypes import Doubles, Records
from carom.layouts import GAMES
from carom.tracks import _constants, _covariance, _from_events, _joint
from carom.tracks import _search, _strikes, _summary
from carom.tracks import Recording, TrackError, events, examine, read
from carom.tracks._forecast import ROUGH, Forecast, first_seconds
from carom.tracks._kicks import Kicks, contact
from carom.tracks._profile import light, profiles
from carom.tracks._summary import Fit

__all__ = ["Fit", "Kicks", "contact", "fit", "main"]
__dir__ = listing(__name__)

Progress = Callable[[str, float], None]
_FASTEST = 8.0  # m/s: no ball is faster
_BREAK = 1.0  # s from the first motion: later rows of a break tell nothing of its strike
_MANY = 5.0  # standard deviations of a coordinate: an RMSE above is not that of the noise
_STARTS, _NAMED = 3, 8  # searches from better points of profiles; shots that are named
_WORSE = 1.02  # times the median RMSE of the start, from which it is kept
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
) -> dict[str, tuple[float, float]]:
    """Mean and deviation of the prior of each constant to fit to complete shots."""
    # a change with the speed is not sought where the cushion begins without one, nor a height where
    # it has no friction
    some = ("mu_cushion", "roll_loss", "restitution_log", "mu_log")
    left_out = {name for name in some if not values[name]} | (
        {"nose_height"} if not values["mu_cushion"] else set()
    )
    wider = _joint.TABLE if list(free) == ["table"] else {}
    usually = [name for name in wider or _joint.PRIORS if name not in left_out]
    names = usually if list(free) in (["default"], ["table"]) else list(free)
    values = {**dict.fromkeys(_constants.SLOPE, 0.0), **values}
    known = [name for name in _constants.NAMES if name in values]
    unknown = [name for name in [*names, *priors] if name not in known]
    if unknown:
        raise ValueError(
            unknown_name("free, priors", "constant", unknown[0], known, "help(carom.fit.fit)")
        )
    for name, (mean, deviation) in priors.items():
        if not (math.isfinite(mean) and math.isfinite(deviation) and deviation > 0.0):
            raise ValueError(
                f"priors: {name}: {mean!r}, {deviation!r} are not a finite mean and a positive deviation"
            )
    found = {}
    for name in names:
        width, low, high = _joint.prior(name, values[name])
        width = wider.get(name, width)
        if name not in _joint.PRIORS and not low <= values[name] <= high:
            raise ValueError(
                f"free: {name} starts at its default {values[name]:g}, which is not {low:g} to {high:g}; pass a start in constants"
            )
        if name not in priors and width is None:
            raise ValueError(
                f"free: {name} has a wide range and starts at 0; pass its mean and deviation in priors"
            )
        found[name] = priors.get(name, (values[name], width or 0.0))
    return found


class _Saved:
    """The finished parts of a fit, as JSON, kept in a file while the fit runs."""

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
        """A part, which is computed if it is missing."""
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


def _told_by_events(
    values: dict[str, float],
    remarks: list[str],
    measured: Mapping[str, float],
    errors: Mapping[str, float],
) -> tuple[dict[str, float], dict[str, float]]:
    """The constants from single events, and their errors.

    Constants that events determine no better than the prior are kept as given.
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
    """The arguments of a fit, and its finished parts."""

    recordings: list[Recording]
    table: str | tuple[float, float]
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


def _median(job: _Job, shots: Sequence[int], values: dict[str, float]) -> float:
    """The median RMSE of shots with constants, by the strikes of a quick search, m."""
    plays = job.plays(shots, values)
    return float(np.median(plays.rmse(_search.find(plays)[0])))


def _fit_to_events(
    job: _Job, fitted: Sequence[int], values: dict[str, float], remarks: list[str]
) -> tuple[dict[str, float], dict[str, float]]:
    """The constants from single events of these shots, and their errors."""
    job.report("events", 0.0)
    shots = [job.recordings[k] for k in fitted]

    def measured() -> Any:
        ground = _constants.ground(job.table, job.radius)
        found = events(shots, ground.size, job.radius)
        # near a pocket a ball may have met a jaw, a facing or the hole
        gaps = found.impacts["r"][:, None] - ground.table.pockets["centre"]
        near = np.hypot(gaps[..., 0], gaps[..., 1]) < (
            ground.table.pockets["radius"] + 3.0 * job.radius
        )
        found = replace(found, impacts=found.impacts[~near.any(axis=1)])
        return _from_events.measured(found, job.radius, job.cushion_model, job.seed, values)

    return _told_by_events(values, remarks, *job.saved.get("events", measured))


def _search_constants(job: _Job, first: _joint.Search) -> _joint.Search:
    """Search for the constants, at first also without a dependence of friction on slip; return the
    finished search.
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


class _Told(NamedTuple):
    """The constants that shots determine."""

    values: dict[str, float]
    spread: dict[str, float]  # their errors
    names: tuple[str, ...] = ()  # of those that whole shots told
    covariance: Doubles | None = None  # of these
    intervals: Mapping[str, tuple[float, float] | None] = {}  # of 95 %, of these


def _profiled(job: _Job, search: _joint.Search) -> dict[str, tuple[float, float] | None]:
    """The intervals of the constants from their profiles; the search continues from a better point
    of a profile, if there is one.
    """
    for number in range(_STARTS):
        found = profiles(search)
        if found.best is None:
            break
        search.values, search.strikes = found.best
        search.weigh()
        for stage in (_joint.STAGES - 2, _joint.STAGES - 1):
            job.report("constants", stage / (_joint.STAGES + 2))
            work = functools.partial(search.stage, stage, job.seed + number + 1)
            search.resume(job.saved.get(f"start {number}, constants {stage}", work))
        finish = functools.partial(search.finish, job.seed, _joint.ROUNDS)
        search.resume(job.saved.get(f"start {number}, end", finish))
    return found.intervals


def _fit_to_shots(
    job: _Job,
    fitted: Sequence[int],
    values: dict[str, float],
    spread: dict[str, float],
    remarks: list[str],
) -> _Told:
    """The constants from complete shots."""
    plays = job.plays(fitted, values)
    found = job.saved.get(
        "strikes", lambda: _search.find(plays, job.seed, job.progress)[0].tolist()
    )
    expected = _priors(job.free, job.priors, values)
    search = _search_constants(
        job, _joint.Search(plays, np.array(found), range(len(fitted)), expected)
    )
    job.report("spread", _joint.STAGES / (_joint.STAGES + 2))
    if search.middle >= _joint.MOST:
        remarks.append(
            "half of the shots are off by centimetres: whole shots tell no constants, which stay as they were before"
        )
        return _Told(values, spread)

    intervals = _profiled(job, search)
    shots = [(job.recordings[fitted[row]].id, weight) for row, weight in light(search)]
    if shots:
        remarks.append(
            f"{len(shots)} of {len(fitted)} shots misfit and count less for the constants: "
            + ", ".join(f"shot {shot} {100.0 * weight:.0f} %" for shot, weight in shots[:_NAMED])
            + (" and others" if len(shots) > _NAMED else "")
        )
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
    if unknown := [name for name, interval in intervals.items() if interval is None]:
        remarks.append(
            f"not told by these shots: {', '.join(unknown)}, which could be anywhere that they are on "
            f"other tables; more shots would tell them, such as those of --next"
        )
    return _Told(values, spread, names, covariance, intervals)


def fit(
    recordings: Sequence[Recording],
    table: str | tuple[float, float],
    radius: float | None = None,
    *,
    game: Game | None = None,
    cushion_model: ShotCushion = "default",
    friction: BallFriction = "alciatore",
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
    """Fit the strikes of recorded shots, and the constants of their table.

    Parameters
    ----------
    recordings : sequence of Recording
        From `carom.tracks.read`. Shots may have different numbers of balls, and tracks may end
        before the shot; rows after a ball fell into a pocket are ignored.
    table : str or (float, float)
        A built-in table, such as "9ft" or "snooker", with x along its width and y along its length;
        or the extents of x and y, m, of a table without pockets.
    radius : float, optional
        Radius of the balls, m. Default: the game's.
    game : str, optional
        The game that supplies constants that are not given. Default: the table's, or "billiard" for
        extents.
    cushion_model, friction : str
        As for `carom.simulate`.
    constants : mapping or `carom.dtypes.ball_kind`, optional
        Known constants.
    free : "none", "events", "table", "default", or names of constants
        The constants to fit in addition to the strikes. "none": no constants. "events": the
        constants that single events determine: mu_slide, mu_roll, drag, restitution, and the
        cushion's; those with too few events are kept as given. "default": these first, and then all
        of them with mu_spin, law_a and law_b, to complete shots. "table": restitution_cushion,
        mu_cushion, nose_height, mu_slide, mu_roll and drag to complete shots; this suits few shots,
        because the other constants are laws that tables have in common. Names: only these
        constants, to complete shots; any field of `carom.dtypes.ball_kind` except radius and
        mu_ball.
    priors : mapping, optional
        Mean and standard deviation of constants that are fitted to complete shots. Default: around
        the initial value, as wide as the variation between tables.
    train : sequence of int, optional
        The shots, from 0, to which constants are fitted. Default: all. The others test the
        predictions of the constants.
    seed : int or numpy.random.Generator
        Seed of the search for constants; strikes for known constants do not depend on it. In the
        same environment the bits depend only on the seed.
    threads : int
        Largest number of threads: 0 uses only the calling thread, -1 all processors.
    progress : callable(what, part), optional
        Called with the name of the step and its completed fraction, 0 to 1.
    state : path, optional
        A file for intermediate results. An interrupted fit continues from it when called again with
        the same arguments, and returns the same bits. The file is removed at the end.
    calibrate : bool
        Whether to correct positions first if the table is rotated, wrongly scaled or distorted in
        the tracks, from impacts on cushions.

    Returns
    -------
    Fit

    Raises
    ------
    ValueError
        An argument is invalid; the message names it.
    """
    seed = seed_of(seed, 2**64 - 1)
    if not len(recordings):
        raise ValueError("recordings: there are none; pass at least one shot")
    ground = _constants.ground(table, radius, game)
    radius = ground.radius
    examination = examine(recordings, table, radius, train=train, calibrate=calibrate)
    recordings, notes = examination.recordings, examination.mended
    noise, remarks = examination.noise.value, examination.sentences
    if train is not None:
        train = [k for k, index in enumerate(examination.indices) if index in {*train}]
    for k, shot in enumerate(recordings):
        if _strikes.is_break(shot):
            recordings[k] = first_seconds(shot, _BREAK)
            notes[k].append(f"a break, of which the first {_BREAK:g} s count")
    free = [free] if isinstance(free, str) else list(free)
    values, cushion_model = _constants.complete(
        {} if constants is None else constants,
        cushion_model,
        game=ground.game,
        friction=friction,
        table=ground.table,
    )
    sought = _priors([] if free[0] in ("none", "events") else free, priors or {}, values)
    values |= {name: values.get(name, 0.0) for name in _constants.SLOPE if name in sought}
    outcome = _Told(values, {})
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
            outcome = _Told(*_fit_to_events(job, fitted, values, remarks))
        if free[0] not in ("none", "events") and fitted:
            outcome = _fit_to_shots(job, fitted, outcome.values, outcome.spread, remarks)
        if outcome.values != values and fitted:
            # constants that play the shots worse than those that were given are not taken
            given, told = (_median(job, fitted, each) for each in (values, outcome.values))
            if told > _WORSE * given:
                outcome = _Told(values, {})
                remarks.append(
                    f"the constants that were found play the shots worse, to a median RMSE of "
                    f"{1e3 * told:.2f} mm, than those that were given, {1e3 * given:.2f} mm: "
                    f"these are kept"
                )
        plays = job.plays(played, outcome.values)
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
        outcome.values,
        outcome.spread,
        strikes,
        status,
        rmse,
        part,
        outcome.names,
        outcome.covariance,
        remarks,
        ground.game,
        dict(outcome.intervals),
    )
    if found.median_rmse > _MANY * noise:
        causes = " and ".join(examination.causes)
        remarks.append(
            f"the median RMSE is {found.median_rmse / noise / math.sqrt(2.0):.0f} times that of the noise: "
            + (
                f"what is said of the {causes} comes first"
                if causes
                else "the constants or the models are off by more than the camera"
            )
        )
    return found


def _remarks(
    strike: Doubles, rmse: float, noise: float, radius: float, mended: Sequence[str]
) -> str:
    """Remarks on a strike that was found, or "ok"."""
    remarks = [_quality(strike, rmse, noise, radius)]
    if mended:
        remarks.append(f"mended: {'; '.join(mended)}")
    return "; ".join(filter(None, remarks)) or "ok"


def _quality(strike: Doubles, rmse: float, noise: float, radius: float) -> str:
    """Why the play of a shot is doubtful or rough, or an empty text."""
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


def _numbers(count: int, form: str) -> Callable[[str], tuple[float, ...]]:
    """A reader of an argument with several numbers, whose error shows the form."""

    def read(text: str) -> tuple[float, ...]:
        try:
            numbers = tuple(map(float, text.split(",")))
        except ValueError:
            numbers = ()
        if len(numbers) != count:
            raise argparse.ArgumentTypeError(f"{text!r} must be {form}")
        return numbers

    return read


_extents = _numbers(
    2,
    f"one of {', '.join(_constants.TABLES)}, or W,L, the extents of x and y in m, such as 2.84,1.42",
)
_place = _numbers(2, "X,Y, a place in the unit of the file, such as 4.5,3")


_corners = _numbers(8, "X,Y of each of four corners")


def _unit(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text


def _read_object(path: Path, such: str) -> dict[str, Any]:
    """An object from a JSON file, or its constants if this command wrote the file."""
    try:
        content: Any = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise TrackError(f"{path}: not valid JSON ({error})") from None
    if isinstance(content, dict) and isinstance(content.get("constants"), dict):
        content = content["constants"]
    if not isinstance(content, dict):
        raise TrackError(f"{path}: not a JSON object of constants, such as {such}")
    return cast(dict[str, Any], content)


def _show(what: str, part: float) -> None:
    print(
        f"\r{what}: {100.0 * part:3.0f} %  ",
        end="\n" if part >= 1.0 else "",
        file=sys.stderr,
        flush=True,
    )


def _asked(option: str, work: Callable[[], Any], is_asked: object) -> Any:
    """The result of an option of the command.

    None, after a message, if the shots do not determine it; the fit is written in any case.
    """
    try:
        return work() if is_asked else None
    except ValueError as error:
        print(f"carom.fit: --{option}: {error}", file=sys.stderr)
        return None


def _forecasts(found: Fit, duration: float, seed: int) -> list[Forecast]:
    """Forecasts of the shots to which the constants were not fitted, or of all, except shots
    without rows after the first seconds.
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
    """Run the command.

    The exit status is 0; 2 for wrong usage or unreadable input; or 130 if interrupted, without
    output.
    """
    parser = argparse.ArgumentParser(
        prog="python -m carom.fit", description="Fits recorded shots: each strike, and constants."
    )
    parser.add_argument(
        "tracks",
        type=Path,
        help="recorded tracks: a table with shot,ball,t,x,y or as trackers write it, or JSON Lines",
    )
    parser.add_argument(
        "--table",
        type=lambda text: text if text in _constants.TABLES else _extents(text),
        required=True,
        metavar="TABLE|W,L",
        help=f"{', '.join(_constants.TABLES)}, x along the width; or the extents of x and y, m, of "
        "a table without pockets",
    )
    parser.add_argument(
        "--radius", type=float, metavar="R", help="of the balls, m; without: of those of the game"
    )
    parser.add_argument(
        "--unit",
        type=_unit,
        metavar="m|cm|mm|inches|px|M",
        help="unit of x and y, or its length, m; without, by the titles of columns or the extents",
    )
    parser.add_argument(
        "--origin",
        type=_place,
        metavar="X,Y",
        help="where the corner of the noses lies in the file, in its unit",
    )
    parser.add_argument(
        "--rate", type=float, metavar="HZ", help="pictures a second, if t counts pictures"
    )
    parser.add_argument(
        "--corners",
        type=_corners,
        metavar="X,Y,X,Y,X,Y,X,Y",
        help="where the corners (0, 0), (W, 0), (W, L), (0, L) of the noses lie in pictures",
    )
    parser.add_argument(
        "--cushion-model", default="default", choices=_constants.CUSHIONS, help="as of carom shoot"
    )
    parser.add_argument(
        "--friction", default="alciatore", choices=get_args(BallFriction), help="as of carom shoot"
    )
    parser.add_argument(
        "--game",
        choices=list(GAMES),
        help="whose constants the fit begins with; without: that of the table, or billiard",
    )
    parser.add_argument(
        "--constants",
        type=Path,
        metavar="IN.json",
        help="known constants; those of the game otherwise",
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
        "--next",
        type=int,
        default=0,
        metavar="N",
        help="the N shots that would tell the constants best, to play and to film next",
    )
    parser.add_argument(
        "--player",
        action="store_true",
        help="the player's errors and rating, by strokes that were meant alike",
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
        ground = _constants.ground(options.table, options.radius, options.game)
        recordings = read(
            options.tracks,
            table=options.table,
            radius=ground.radius,
            unit=options.unit,
            origin=options.origin,
            rate=options.rate,
            corners=options.corners and np.reshape(options.corners, (4, 2)).tolist(),
        )
        found = fit(
            recordings,
            options.table,
            options.radius,
            game=options.game,
            cushion_model=options.cushion_model,
            friction=options.friction,
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
        further = _asked(
            "next", lambda: found.design(options.next, seed=options.seed), options.next
        )
        player = _asked("player", found.player, options.player)
        if player is not None:
            written["player"] = player.to_dict()
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
    for name, interval in found.intervals.items():
        if interval is not None:
            print(f"{name} {found.constants[name]:.4g} ({interval[0]:.4g} to {interval[1]:.4g})")
    for number, shot in enumerate(further or [], 1):
        print(f"next {number}: {shot}")
    if player is not None:
        print(player)
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
