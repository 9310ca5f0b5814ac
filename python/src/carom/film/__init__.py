"""Tracks of balls from the film of a fixed camera.

Use `python -m carom.film CLIP --table snooker -o tracks.csv`, or in Python
`carom.film.track("clip.mp4", "snooker")`. Each step is a module: `_cloth` finds the table,
`_camera` the camera's position, `_clock` the new frames and their times, `_balls` the balls in a
frame, `_paths` their identities over time, and `_names` their names. Needs OpenCV and SciPy: `pip
install opencv-python-headless scipy`.

Not supported are moving cameras, tables with fewer than three visible sides, white balls on light
grey cloth and rolling shutters. Balls of the same colour are distinguished only by the continuity of their paths.
Numbers of pool balls are inferred from colours, so poor light can exchange them.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path as FilePath
from typing import TextIO

try:
    import cv2  # noqa: F401
    import scipy.optimize  # noqa: F401
except ImportError as missing:
    raise ImportError(
        "carom.film needs OpenCV and SciPy: pip install opencv-python-headless scipy"
    ) from missing
import numpy as np
from numpy.typing import NDArray

from carom import racks, tables
from carom._rows import as_array, listing
from carom.dtypes import Doubles
from carom.film._balls import Finder, blob
from carom.film._camera import Camera, Evidence, fit
from carom.film._clock import Clock, change, clock_of, pictures
from carom.film._cloth import NORMALS, Bed, Cloth, FilmError, Picture, area, calibrated
from carom.film._names import kinds_of, names_of
from carom.film._paths import Path, linked, turns
from carom.tracks import Recording
from carom.tracks._constants import ground
from carom.tracks._spans import spans

__all__ = ["Camera", "Film", "FilmError", "track"]
__dir__ = listing(__name__)

_FIRST = 3.0  # s at the beginning, from which the table is found
_AWAY = 0.5  # s: longest time without a visible table
_PART = 0.8  # fraction of the usual area below which a ball is partly hidden
_ABOUT = 8  # rows to each side whose median area is the usual one
_SPOT = 0.09  # m: largest distance of a snooker ball on its spot
_ODD = 0.015  # m: largest deviation of a cushion's depth from the kind of table
_PLACED = 0.004  # m: standard deviation of a ball from its spot
_TURNED = 0.003  # m: standard deviation of a turning point at a cushion
_JAWS = 0.09  # m around a pocket within which a ball may hit a jaw
_FALLEN = 0.15  # m around a pocket within which a ball that disappears has fallen
_TOGETHER = 0.07  # s: balls that begin to move within this may be the struck one
_RESIZED = 0.7  # of the logarithm of an extent over the usual one, at most
_FAR = 0.02  # m: a ball that turns farther from a cushion was hit by another

Progress = Callable[[str, float], None]


@dataclass(frozen=True, eq=False)
class Film:
    """The result of tracking a film."""

    recordings: list[Recording]
    """One recording per shot, "s1", "s2", ..., for `carom.fit.fit`."""
    camera: Camera
    bed: Bed
    notes: list[str]
    """Sentences on what was found and what was not."""
    picture: Picture
    """The frame before the first shot, or the first frame."""
    begins: list[float]
    """Start of each shot's clock in the film, s."""

    def write(self, file: str | FilePath | TextIO) -> None:
        """Write the tracks as CSV for `carom.tracks.read`."""
        if isinstance(file, (str, FilePath)):
            with open(file, "w", newline="", encoding="utf-8") as opened:
                self.write(opened)
            return
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(("shot", "ball", "t", "x", "y"))
        for shot in self.recordings:
            for ball, places in zip(shot.balls, shot.tracks):
                rows.writerows(
                    (shot.id, ball, f"{t:.5f}", f"{x:.5f}", f"{y:.5f}") for t, x, y in places
                )


def track(
    clip: str | FilePath,
    table: str,
    *,
    size: tuple[float, float] | None = None,
    corners: Sequence[Sequence[float]] | None = None,
    focal: float | None = None,
    lens: float | None = None,
    turned: bool | None = None,
    start: float = 0.0,
    end: float = math.inf,
    progress: Progress | None = None,
) -> Film:
    """Track the balls of a film of a fixed camera.

    Parameters
    ----------
    clip : path
        A film in a format that OpenCV reads.
    table : str
        The kind of table, such as "9ft" or "snooker", as for the command's `--table`. It determines
        the size, the noses and the balls.
    size : (W, L), optional
        The extents between the noses, m, of a table of this kind with another size.
    corners : four (x, y), optional
        Pixels of the corners of the noses at (0, 0), (W, 0), (W, L), (0, L) on the table,
        counterclockwise in the frame. Default: found from the cloth's colour.
    focal, lens : float, optional
        Focal length, pixels, and k1 of the lens (negative: barrel). Default: fitted.
    turned : bool, optional
        Whether y begins at the upper or right end instead of the lower or left one. Default:
        detected from snooker's colours on their spots, otherwise False.
    start, end : float
        The interval of the film to track, s.
    progress : callable, optional
        Called with the name of the step and its completed fraction, 0 to 1.

    Returns
    -------
    Film

    Raises
    ------
    FilmError
        The film cannot be tracked; the message states the reason and a remedy.
    OSError
        The file cannot be read.
    """
    clip, bed = FilePath(clip), bed_of(table, size)
    known = None if corners is None else _corners(corners)
    first = _first(clip, start, end)
    camera, depths, evidence = calibrated(first, bed, known, focal, lens)
    if known is None and turned is None and table == "snooker" and size is None:
        turned = _spots_turned(first, camera, bed, depths)
    if known is None and _turns_round(camera, bed) != bool(turned):
        camera, depths, evidence = calibrated(first, bed, None, focal, lens, half_turn=True)
    seen = _Seen(Cloth(first, camera, bed, depths))
    seen.read(clip, start, end, progress)
    clock = clock_of(np.array(seen.times), np.array(seen.changes))
    new = np.flatnonzero(clock.new)
    blobs, parts = ([rows[k] for k in new] for rows in (seen.blobs, seen.parts))
    paths = linked(blobs, parts, clock.times, bed.radius)
    paths = [path for path in paths if np.mean(bed.near_pocket(path.places)) < 0.8]
    if not paths:
        where = "" if known is None else " whose noses meet at the given corners"
        raise FilmError(
            f"{clip}: no ball was found{where}; the film must show a {table} table with balls"
        )

    _name(table, paths)
    # turns at cushions and balls on spots measure the camera better than edges of the cloth
    marks = _marks(table if size is None else "", paths, clock.times, camera, bed)
    camera, depths, _ = fit(camera, Evidence.join([*evidence, *marks]), bed.depth, focal, lens)
    for path in paths:
        pixels = np.array([row["pixel"] for row in path.blobs])
        for row, place in zip(path.blobs, camera.places(pixels, bed.radius)):
            row["place"] = place
    notes = [*clock.notes, *seen.notes, *_told(camera, depths, evidence, marks, bed)]
    recordings, begins = _shots(table, paths, clock, bed, notes)
    begin = begins[0] if begins else start
    picture = next((image for t, _, image in pictures(clip, begin, end)), first)
    return Film(recordings, camera, bed, notes, picture, begins)


def bed_of(table: str, size: tuple[float, float] | None = None) -> Bed:
    """The table of a kind, as a camera sees it, with its extents or others (m).

    The pockets keep their distances from the nearest corners, or from the middle of a side.
    """
    table = f"pool_{table}" if table[:1].isdigit() else table
    measures = tables.measures(table)
    made = getattr(tables, table)()
    usual = np.array([measures["width"], measures["length"]])
    extents = usual if size is None else as_array(size, "size", np.float64)
    if extents.shape != (2,) or not (np.abs(np.log(extents / usual)) < _RESIZED).all():
        raise ValueError(
            f"size: {size!r} are not the extents of such a table, m; use two numbers from "
            f"{math.exp(-_RESIZED):.1f} to {math.exp(_RESIZED):.1f} times {usual[0]:g} and {usual[1]:g}"
        )
    pockets = []
    for pocket in made.pockets:
        sides = np.round(2.0 * pocket["centre"] / usual) / 2.0
        pockets.append((*(pocket["centre"] + sides * (extents - usual)), pocket["radius"]))
    return Bed(
        float(extents[0]),
        float(extents[1]),
        measures["nose_height"],
        measures["cushion_depth"],
        ground(table).radius,
        np.array(pockets, np.float64).reshape(-1, 3),
    )


def _corners(corners: Sequence[Sequence[float]]) -> Doubles:
    found = as_array(corners, "corners", np.float64)
    if found.shape != (4, 2) or not np.isfinite(found).all():
        raise ValueError(
            f"corners: the shape is {found.shape}, but must be (4, 2): four finite pixels x,y"
        )
    if area(found) < 1000.0:
        raise ValueError(
            "corners: not counterclockwise in the frame, or too close together; pass the pixels of (0, 0), (W, 0), (W, L), (0, L)"
        )
    return np.asarray(found, np.float64)


def _first(clip: FilePath, start: float, end: float) -> Picture:
    """The table without moving objects: the median of frames of the first seconds."""
    chosen: list[Picture] = []
    begin = math.nan
    for t, _, picture in pictures(clip, start, min(end, start + _FIRST)):
        begin = t if math.isnan(begin) else begin
        if t >= begin + 0.2 * len(chosen):
            chosen.append(picture)
    if not chosen:
        raise FilmError(
            f"{clip}: no frame between {start:g} and {end:g} s; check --start and --end"
        )
    return np.asarray(np.median(np.array(chosen), axis=0), np.uint8)


class _Seen:
    """The frames of a film: their times, their differences from the frame before, and their balls."""

    def __init__(self, cloth: Cloth) -> None:
        self.cloth, self.finder = cloth, Finder(cloth)
        self.times: list[float] = []
        self.changes: list[float] = []
        self.blobs: list[NDArray[np.void]] = []
        self.parts: list[NDArray[np.void]] = []
        self.notes: list[str] = []
        self.foreign: list[float] = []

    def read(self, clip: FilePath, start: float, end: float, progress: Progress | None) -> None:
        """Read until the film ends or the table disappears."""
        previous, hidden, seen, away = None, list[float](), math.nan, 0
        for t, share, picture in pictures(clip, start, end):
            part = picture[self.cloth.part]
            distance = self.cloth.distance(picture)
            rows, parts, foreign = np.zeros(0, blob), np.zeros(0, blob), 0.0
            if self.cloth.is_seen(picture, distance):
                rows, parts, foreign = self.finder.find(picture, distance)
                hidden, seen = [], t
            else:
                hidden.append(t)
                away += 1
            self.times.append(t)
            self.changes.append(0.0 if previous is None else change(previous, part))
            self.blobs.append(rows)
            self.parts.append(parts)
            self.foreign.append(foreign)
            previous = part
            if hidden and t - hidden[0] > _AWAY:
                self._end(hidden[0], len(hidden))
                away -= len(hidden)
                break
            if progress:
                progress("tracking", min(share, 0.999))
        if math.isnan(seen):
            raise FilmError(
                f"{clip}: the table is not where it was in the first {_FIRST:g} s; "
                "use --start to begin after a cut to another camera"
            )
        if progress:
            progress("tracking", 1.0)
        step = float(np.median(np.diff(self.times))) if len(self.times) > 1 else 0.0
        if away:
            self.notes.append(
                f"for {away * step:.2f} s something hid the edges of the table: no rows"
            )
        usual = float(np.median(self.foreign))
        hands = int((np.array(self.foreign) > usual + 1.0).sum())
        if hands:
            self.notes.append(
                f"a hand, a cue or something else was over the table for {hands * step:.1f} s: "
                "balls that it touched in the picture have no rows then"
            )

    def _end(self, t: float, count: int) -> None:
        """Drop the last frames after the table disappeared."""
        for rows in (self.times, self.changes, self.blobs, self.parts, self.foreign):
            del rows[-count:]
        self.notes.append(
            f"at {t:.2f} s the camera changes or moves, or the table is hidden: the tracks end there; "
            f"--start {t + 1:.1f} begins after it"
        )


def _turns_round(camera: Camera, bed: Bed) -> bool:
    """Whether y = 0 is not the lower end, or for a table seen lengthwise not the left end."""
    ends = np.array([[0.5 * bed.width, 0.0, 0.0], [0.5 * bed.width, bed.length, 0.0]])
    way = np.diff(camera.project(ends), axis=0)[0]
    return bool(way[1] > 0.0 if abs(way[1]) > abs(way[0]) else way[0] < 0.0)


def _spots() -> dict[str, Doubles]:
    """The spots of snooker's colours."""
    rack = racks.snooker(tables.snooker())
    names = ("yellow", "green", "brown", "blue", "pink", "black")
    return {name: np.array(ball["state"]["r"][:2]) for name, ball in zip(names, rack[-6:])}


def _spots_turned(first: Picture, camera: Camera, bed: Bed, depths: Doubles) -> bool:
    """Whether more colours are on the spots of the table turned by 180 degrees."""
    cloth = Cloth(first, camera, bed, depths)
    rows, _, _ = Finder(cloth).find(first, cloth.distance(first))
    names = names_of("snooker", rows["colour"], rows["white"], np.zeros(len(rows)))
    votes = 0
    for name, spot in _spots().items():
        if name in names:
            place = rows["place"][names.index(name)]
            here = np.hypot(*(place - spot)) < 2.0 * _SPOT
            there = np.hypot(*(np.array([bed.width, bed.length]) - place - spot)) < 2.0 * _SPOT
            votes += int(there) - int(here)
    # relative to the lower or left end, as for `turned`
    return _turns_round(camera, bed) != (votes > 0)


def _marks(
    table: str, paths: list[Path], times: Doubles, camera: Camera, bed: Bed
) -> list[Evidence]:
    """Evidence from turns at cushions and from balls on their spots."""
    marks = []
    size = (bed.width, bed.length)
    for side, place in turns(paths, times, size):
        normal = NORMALS[side]
        nose = bed.nose_of(side)
        jaws = bool(bed.near_pocket(place[None], _JAWS)[0])
        if jaws or abs(place @ normal - nose + bed.radius) > _FAR:
            continue
        # a cushion on the camera's side partly hides the ball
        deviation = _TURNED * (2.0 if camera.eye[:2] @ normal > nose else 1.0)
        pixel = camera.project(np.array([[*place, bed.radius]]))
        target = np.array([nose - bed.radius])
        marks.append(Evidence.uniform(pixel, bed.radius, normal[None], target, (0.5, deviation)))
    if table == "snooker":
        named = {path.name: path.blobs[:8] for path in paths}
        for name, spot in _spots().items():
            rows = named.get(name, [])
            away = [np.hypot(*(row["place"] - spot)) for row in rows]
            if not away or max(away) > _SPOT:
                continue
            pixel = np.mean([row["pixel"] for row in rows], axis=0)[None]
            for axis in np.eye(2):
                target = np.array([spot @ axis])
                marks.append(
                    Evidence.uniform(pixel, bed.radius, axis[None], target, (0.3, _PLACED))
                )
    return marks


def _name(table: str, paths: list[Path], struck: int | None = None) -> None:
    """Name the paths by their appearance over all their rows; one may be known to be struck."""
    colours = np.array([np.median([b["colour"] for b in path.blobs], axis=0) for path in paths])
    whites = np.array([np.median([b["white"] for b in path.blobs]) for path in paths])
    lengths = np.array([float(len(path.numbers)) for path in paths])
    for path, name in zip(paths, names_of(table, colours, whites, lengths, struck)):
        path.name = name


def _told(
    camera: Camera, depths: Doubles, evidence: list[Evidence], marks: list[Evidence], bed: Bed
) -> list[str]:
    """Sentences on the calibration."""
    edges = [rows for rows in evidence if rows.sides[0] >= 0.0]
    sentences = []
    misfits = [np.abs(rows.residuals(camera, depths)) for rows in edges]
    if misfits:
        sentences.append(
            f"the edges of the cloth fit to {1e3 * np.median(np.concatenate(misfits)):.1f} mm"
        )
    if marks:
        misfit = np.abs([rows.residuals(camera, depths)[0] for rows in marks])
        sentences.append(
            f"{len(marks)} turns at cushions and coordinates of spots fit to "
            f"{1e3 * np.median(misfit):.1f} mm (median)"
        )
    if len(edges) < 3:
        sentences.append(
            "fewer than three edges of the cloth are found: a moved camera goes unnoticed"
        )
    if not marks:
        sentences.append(
            f"no ball turned at a cushion: the cushions are taken as {1e3 * depths.mean():.0f} mm deep, "
            "and places may be too far out or in by some mm"
        )
    if np.abs(depths - bed.depth).max() > _ODD:
        sentences.append(
            f"the cushions come out {1e3 * depths.min():.0f} to {1e3 * depths.max():.0f} mm deep, not "
            f"{1e3 * bed.depth:.0f}: does the outline of --check lie on the noses?"
        )
    x, y, z = camera.eye
    sentences.append(
        f"the camera is at x = {x:.2f}, y = {y:.2f} m, {z:.2f} m above the slate; focal length "
        f"{camera.focal:.0f} pixels, k1 = {camera.numbers[7]:.3f}"
    )
    return sentences


def _is_whole(path: Path, bed: Bed) -> NDArray[np.bool_]:
    """In which rows a ball is completely visible and not about to fall."""
    shares = np.array([row["share"] for row in path.blobs])
    # the visible area changes along a path, with the light, the shadow and the blur of the ball
    wide = np.pad(shares, _ABOUT, mode="reflect" if len(shares) > _ABOUT else "edge")
    usual = np.median(np.lib.stride_tricks.sliding_window_view(wide, 2 * _ABOUT + 1), axis=1)
    whole = np.array([row["whole"] for row in path.blobs]) & (shares > _PART * usual)
    return np.asarray(whole & ~bed.near_pocket(path.places))


def _struck(
    paths: list[Path], times: Doubles, begin: float, end: float, least: float
) -> int | None:
    """The ball of a shot that moves first by `least`, m: the whitest of those within _TOGETHER."""
    moves = np.full(len(paths), np.inf)
    for k, path in enumerate(paths):
        t, places = times[path.numbers], path.places
        rows = (t >= begin) & (t <= end)
        away = np.hypot(*(places[rows] - places[rows][0]).T) > least
        if away.any():
            moves[k] = t[rows][int(np.argmax(away))]
    if not np.isfinite(moves).any():
        return None
    whites = [np.median([b["white"] for b in path.blobs]) for path in paths]
    return int(np.argmax(np.where(moves <= moves.min() + _TOGETHER, whites, -1.0)))


def _shots(
    table: str, paths: list[Path], clock: Clock, bed: Bed, notes: list[str]
) -> tuple[list[Recording], list[float]]:
    """The shots of the paths; defects are added to the notes.

    Names belong to a shot: the balls of another rack or layout may have the same colours. A shot
    without its cue ball is left out.
    """
    times = clock.times
    rest = [np.diff(path.places, axis=0) for path in paths]
    noise = float(np.median(np.concatenate([np.abs(step).ravel() for step in rest])))
    recordings, begins, merged = [], [], 0
    tracks_of = [np.column_stack([times[path.numbers], path.places]) for path in paths]
    spans_of = spans(tracks_of, times, [np.full(len(rows), noise) for rows in tracks_of])
    for number, (begin, end) in enumerate(spans_of, 1):
        present = [
            path
            for path, rows in zip(paths, tracks_of)
            if ((rows[:, 0] >= begin) & (rows[:, 0] <= end)).any()
        ]
        least = 0.012 + 6.0 * noise
        _name(table, present, _struck(present, times, begin, end, least))
        names, tracks, late = [], [], []
        for path in sorted(present, key=lambda path: path.numbers[0]):
            name, whole = path.name, _is_whole(path, bed)
            rows = np.column_stack([times[path.numbers], path.places])
            merged += int((~whole & (rows[:, 0] >= begin) & (rows[:, 0] <= end)).sum())
            rows = rows[whole]
            earlier = rows[rows[:, 0] < begin][-8:]
            rows = rows[(rows[:, 0] >= begin) & (rows[:, 0] <= end)]
            if not len(rows):
                continue
            if np.hypot(*np.ptp(rows[:, 1:], axis=0)) < least:
                # a ball at rest has one row, its mean position
                rows = np.concatenate([[rows[0, 0]], rows[:, 1:].mean(axis=0)])[None]
            elif rows[0, 0] > begin + 0.1 and len(earlier):
                # a ball that is hidden when it is hit was at its last visible position
                rows = np.vstack([[begin, *earlier[:, 1:].mean(axis=0)], rows])
            elif rows[0, 0] > begin + 0.1 and path.first_velocity(times).any():
                late.append(name)
                continue
            if len(rows) > 1 and rows[-1, 0] < min(end, times[-1]) - _AWAY:
                where = (
                    "is in a pocket" if bed.near_pocket(rows[-1:, 1:], _FALLEN)[0] else "is lost"
                )
                notes.append(f"s{number}: {name} {where} from {rows[-1, 0] - begin:.2f} s on")
            names.append(name)
            tracks.append(np.column_stack([rows[:, 0] - begin, rows[:, 1:]]))
        if late:
            notes.append(f"s{number}: {', '.join(late)} was first seen moving, and is left out")
        cue = [rows for name, rows in zip(names, tracks) if name == "cue"]
        if "cue" in kinds_of(table) and not cue:
            notes.append(f"s{number}: no cue ball was found; the shot is left out")
        elif cue and len(cue[0]) == 1:
            notes.append(f"s{number}: what is named cue does not move; the shot is left out")
        elif tracks:
            recordings.append(Recording(f"s{number}", tuple(names), tuple(tracks)))
            begins.append(begin)
    if merged:
        notes.append(
            f"{merged} places of balls that were hidden in part, merged or about to fall have no rows"
        )
    if not spans_of:
        notes.append("no ball moves by 3 cm: there is no shot")
    return recordings, begins
