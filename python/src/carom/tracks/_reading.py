"""Reads tracks in the formats of people and trackers, and reports the interpretation.

Only a file without any usable row is an error. Invalid rows are skipped: for example rows out of
order of time, or positions off the table. Skipped rows are counted by reason, with the first row of
each. Missing information, such as the unit, is inferred from the extents of the positions relative
to the table.
"""

from __future__ import annotations

import bisect
import csv
import gzip
import io
import json
import lzma
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from carom._rows import unknown_value
from carom.dtypes import Doubles
from carom.tracks import _constants
from carom.tracks._recordings import ON_TABLE, Recording, TrackError, View, exchanged, is_inside
from carom.tracks._spans import spans

UNITS = {"m": 1.0, "cm": 0.01, "mm": 0.001, "inches": 0.0254}
_UNIT_NAMES = {"in": "inches", "inch": "inches", "metres": "m", "meters": "m", "pixels": "px"}
# The names that trackers give their columns, in the order in which they are looked for.
_SYNONYMS = {
    "shot": ["shot", "clip", "take", "trial", "stroke", "sequence"],
    "ball": [
        "ball",
        "track_id",
        "trackid",
        "id",
        "track",
        "object",
        "object_id",
        "particle",
        "colour",
        "color",
        "class",
        "label",
    ],
    "t": ["t", "time", "seconds", "sec", "timestamp", "elapsed", "position_t"],
    "picture": ["frame", "picture", "image", "frame_id", "frame_number", "frame_no", "image_id"],
    "x": [
        "x",
        "cx",
        "xc",
        "px",
        "center_x",
        "centre_x",
        "x_center",
        "x_centre",
        "centroid_x",
        "position_x",
        "pos_x",
    ],
    "y": [
        "y",
        "cy",
        "yc",
        "py",
        "center_y",
        "centre_y",
        "y_center",
        "y_centre",
        "centroid_y",
        "position_y",
        "pos_y",
    ],
    "state": [
        "state",
        "status",
        "visible",
        "visibility",
        "hidden",
        "occluded",
        "pocketed",
        "potted",
    ],
}
_UNSEEN = {"", "nan", "na", "n/a", "null", "none", "-", "?"}
_ABSENT = {
    "hidden",
    "occluded",
    "lost",
    "missing",
    "invisible",
    "pocketed",
    "potted",
    "out",
    "false",
    "no",
    "0",
}
_PRESENT = {
    "visible",
    "seen",
    "moving",
    "rolling",
    "sliding",
    "still",
    "rest",
    "stationary",
    "true",
    "yes",
    "1",
    "ok",
}
_WIDE = 0.3  # share of an extent that places of a right unit reach, at least
_RADIUS = 0.028  # m: of a ball where none is given
_USUAL_RATE = 30.0  # frames per second, to cut a film whose rate is not known
_ORDERED = 0.8  # share of a ball's rows in order, below which all are sorted


class Reading(list[Recording]):
    """The recordings of a file, and `notes`: sentences on inferred information and skipped rows.

    A file in the documented format without skipped rows has no notes.
    """

    def __init__(self, recordings: Iterable[Recording] = (), notes: Iterable[str] = ()) -> None:
        super().__init__(recordings)
        self.notes = list(notes)


@dataclass
class _Notes:
    """The notes on a file: sentences, and for each reason the number of skipped rows and the first."""

    unit: str = ""  # of the positions, from the titles
    picture: str = ""  # the column of frame numbers, if they are the times
    is_film: bool = False  # whether no column says which shot a row belongs to
    sentences: list[str] = field(default_factory=list)
    rows: dict[str, list[str]] = field(default_factory=dict)

    def leave_out(self, reason: str, row: str) -> None:
        self.rows.setdefault(reason, []).append(row)

    def lines(self) -> list[str]:
        return self.sentences + [
            f"{rows[0]}: {reason}; left out"
            + (f", as are {len(rows) - 1} more rows for this reason" if len(rows) > 1 else "")
            for reason, rows in self.rows.items()
        ]


@dataclass(frozen=True)
class _Row:
    """A sample as it is in a file."""

    place: str  # the line, for messages
    shot: str
    ball: str
    t: float
    x: float
    y: float


def _name(text: str) -> int | str:
    """A shot's or a ball's name: a number, if it is one."""
    try:
        return int(text)
    except ValueError:
        return text


def _text(path: Path) -> str:
    """The text of a file, compressed or not by its name."""
    opener: Any = {".xz": lzma.open, ".gz": gzip.open}.get(path.suffix, open)
    try:
        with cast(io.TextIOBase, opener(path, "rt", encoding="utf-8-sig", newline="")) as file:
            return file.read()
    except (UnicodeDecodeError, lzma.LZMAError, EOFError, gzip.BadGzipFile) as error:
        raise TrackError(
            f"{path}: {error}; use a text file, compressed only if its name ends in .xz or .gz"
        ) from None


# ---- Columns


@dataclass(frozen=True)
class _Columns:
    """The columns of the fields of a row, and the units in the titles."""

    titles: list[str]
    places: dict[str, int]  # of shot, ball, t, frame and state, if they exist
    balls: list[tuple[str, int, int]]  # a label, "" for the ball column's, and x and y
    unit: str
    time_unit: str


def _title(cell: str) -> tuple[str, str]:
    """A title in small letters without its unit, and the unit: "x (mm)", "x_in", "t [ms]"."""
    text = re.sub(r"[{}]", "", cell.strip().lower())
    found = re.fullmatch(
        r"(.*?)[ _]*[(\[ _]\s*(mm|cm|m|in|inch|inches|metres|meters|px|pixels|s|ms)\s*[)\]]?", text
    )
    name, unit = found.groups() if found and found[1] else (text, "")
    return re.sub(r"[ .\-]+", "_", name), _UNIT_NAMES.get(unit, unit)


def _pair(name: str) -> tuple[str, str] | None:
    """The label and the axis of a column of one ball: x1, x_red, cue_x."""
    found = re.fullmatch(r"([xy])_?(\d+)|([xy])_(.+)|(.+)_([xy])", name)
    if not found:
        return None
    axis, label = (
        found[1] or found[3] or found[6],
        found[2] or found[4] or found[5],
    )
    return None if label in ("v", "a", "vel", "velocity", "acc", "p", "d") else (label, axis)


def _columns(row: Sequence[str]) -> _Columns | None:
    """The columns of a line of titles; None without x and y."""
    named = [_title(cell) for cell in row]
    names = [name for name, _ in named]
    places: dict[str, int] = {}
    for role, synonyms in _SYNONYMS.items():
        for synonym in synonyms:
            if synonym in names:
                places.setdefault(role, names.index(synonym))
    balls: list[tuple[str, int, int]] = []
    if "x" in places and "y" in places:
        balls.append(("", places["x"], places["y"]))
    else:
        pairs: dict[str, dict[str, int]] = {}
        for column, name in enumerate(names):
            pair = _pair(name)
            if pair:
                pairs.setdefault(pair[0], {})[pair[1]] = column
        balls += [(label, axes["x"], axes["y"]) for label, axes in pairs.items() if len(axes) == 2]
    if not balls or not {"t", "picture"} & places.keys():
        return None
    time = places.get("t", places.get("picture", 0))
    return _Columns(list(row), places, balls, named[balls[0][1]][1], named[time][1])


def _number(cell: str) -> float:
    """The number of a cell, with a point or a comma; NaN without one."""
    try:
        return float(cell.replace(",", "."))
    except ValueError:
        return math.nan


def _split(path: Path, text: str) -> tuple[Any, str]:
    """The separator of the cells of a table, from the line of titles."""
    first = text.splitlines()[:40]
    for delimiter in (",", ";", "\t", " "):
        how: Any = {"delimiter": delimiter, "skipinitialspace": delimiter == " "}
        if any(_columns([cell.strip() for cell in row]) for row in csv.reader(first, **how)):
            return csv.reader(io.StringIO(text, newline=""), **how), delimiter
    titles = first[0].strip()[:60] if first else ""
    raise TrackError(
        f"{path}, line 1: {titles!r} names no columns of positions and times; a line must name the "
        f"columns shot,ball,t,x,y, in any order, or frame instead of t, or t,x1,y1,x2,y2"
    )


def _is_present(columns: _Columns, row: Sequence[str], states: set[str]) -> bool:
    """Whether a row without a state, or with a state that means visible, is used."""
    if "state" not in columns.places:
        return True
    column = columns.places["state"]
    word = row[column].lower()
    if _title(columns.titles[column])[0] in ("hidden", "occluded", "pocketed", "potted"):
        return word in ("", "0", "false", "no")
    if word not in _ABSENT | _PRESENT | {""}:
        states.add(row[column])
    return word not in _ABSENT


def _say_columns(columns: _Columns, notes: _Notes) -> None:
    """Note the columns in use if they differ from the documented ones."""
    titles, places = columns.titles, columns.places
    if {"shot", "ball", "t", "x", "y"} <= {title.strip() for title in titles}:
        return
    time = "t" if "t" in places else "picture"
    parts = [
        f"{what} from column {titles[places[role]]}"
        for role, what in (("shot", "shots"), ("ball", "balls"), (time, "times"))
        if role in places
    ]
    if not columns.balls[0][0]:
        parts.append(f"places from {titles[columns.balls[0][1]]}, {titles[columns.balls[0][2]]}")
    else:
        labels = ", ".join(label for label, _, _ in columns.balls)
        parts.append(f"balls {labels} from pairs of columns")
    if "shot" not in places:
        parts.append("all rows as one film")
        notes.is_film = True
    notes.sentences.append(f"columns: {'; '.join(parts)}")


def _table_rows(path: Path, text: str, notes: _Notes) -> Iterator[_Row]:
    """The samples of a table of text. A line of one cell before the titles names the ball."""
    lines, delimiter = _split(path, text)
    columns: _Columns | None = None
    title, states, is_said = "1", set[str](), False
    for cells in lines:
        row = [cell.strip() for cell in cells]
        place = f"{path}, line {lines.line_num}"
        filled = [cell for cell in row if cell]
        if not filled:
            continue
        # titles, and the name of a track above them
        if all(math.isnan(_number(cell)) for cell in filled):
            found = _columns(row)
            if found:
                columns, notes.unit = found, found.unit
                if not is_said:
                    _say_columns(columns, notes)
                is_said = True
                continue
            if len(filled) == 1 and (columns is None or delimiter != " "):
                title = filled[0].lstrip("#").strip()
                continue
        if columns is None:
            continue
        if len(filled) > len(columns.titles) or len(row) < 1 + max(columns.places.values()):
            notes.leave_out(
                f"{len(row)} fields, but the titles name {len(columns.titles)} columns", place
            )
            continue
        if not _is_present(columns, row, states):
            notes.leave_out("the state says that the ball is not seen there", place)
            continue
        yield from _samples(columns, row, title, place, notes)
    if states:
        notes.sentences.append(f"states {', '.join(sorted(states))}: their rows are taken")
    if columns and "t" not in columns.places:
        notes.picture = columns.titles[columns.places["picture"]]


def _samples(
    columns: _Columns, row: list[str], title: str, place: str, notes: _Notes
) -> Iterator[_Row]:
    """The samples of one line: of one ball, or of all."""
    places = columns.places
    shot = row[places["shot"]] if "shot" in places else "1"
    cell = row[places.get("t", places.get("picture", 0))]
    t = _number(cell) * (0.001 if columns.time_unit == "ms" else 1.0)
    if not math.isfinite(t):
        notes.leave_out("a finite number is needed, in s", f"{place}: t is {cell!r}")
        return
    for label, x_column, y_column in columns.balls:
        x, y = (row[k] if k < len(row) else "" for k in (x_column, y_column))
        ball = label or (row[places["ball"]] if "ball" in places else title)
        if {x.lower(), y.lower()} & _UNSEEN:
            notes.leave_out("the ball has no place there", place)
            continue
        values = _number(x), _number(y)
        if not all(map(math.isfinite, values)):
            name, wrong = ("x", x) if not math.isfinite(values[0]) else ("y", y)
            notes.leave_out("a finite number is needed", f"{place}: {name} is {wrong!r}")
            continue
        yield _Row(place, shot, ball, t, *values)


def _json_rows(path: Path, text: str, notes: _Notes) -> Iterator[_Row]:
    """The samples of JSON Lines: {"id": ..., "tracks": {ball: [[t, x, y], ...], ...}}."""
    for number, line in enumerate(text.splitlines(), 1):
        place = f"{path}, line {number}"
        if not line.strip():
            continue
        try:
            shot = json.loads(line)
        except json.JSONDecodeError as error:
            notes.leave_out(
                "no JSON; each line must be one object", f"{place}, column {error.colno}"
            )
            continue
        if (
            not isinstance(shot, dict)
            or not isinstance(shot.get("tracks"), dict)
            or "id" not in shot
        ):
            notes.leave_out(
                'each line must be {"id": ..., "tracks": {"ball": [[t, x, y], ...], ...}}', place
            )
            continue
        for ball, rows in shot["tracks"].items():
            if not isinstance(rows, list):
                notes.leave_out("it must be a list of [t, x, y]", f"{place}, tracks.{ball}")
                continue
            for k, row in enumerate(rows):
                where = f"{place}, tracks.{ball}[{k}]"
                if not isinstance(row, list) or len(row) != 3:
                    notes.leave_out("it must be [t, x, y]", f"{where}: {row!r}")
                elif None in row[1:] or any(value != value for value in row[1:]):
                    notes.leave_out("the ball has no place there", where)
                elif not all(type(v) in (int, float) and math.isfinite(v) for v in row):
                    notes.leave_out("finite numbers are needed", f"{where}: {row!r}")
                else:
                    yield _Row(where, str(shot["id"]), ball, *map(float, row))


# ---- Places


def _homography(corners: Sequence[tuple[float, float]], table: tuple[float, float]) -> Doubles:
    """The matrix, (3, 3), that maps four corners in an image to the table's."""
    targets = [(0.0, 0.0), (table[0], 0.0), table, (0.0, table[1])]
    A, b = [], []
    for (u, v), (x, y) in zip(corners, targets):
        A += [[u, v, 1, 0, 0, 0, -u * x, -v * x], [0, 0, 0, u, v, 1, -u * y, -v * y]]
        b += [x, y]
    try:
        numbers = np.linalg.solve(np.array(A), np.array(b))
    except np.linalg.LinAlgError:
        raise ValueError(
            "corners: three of the four are on one line; pass the corners of the noses"
        ) from None
    return np.append(numbers, 1.0).reshape(3, 3)


def _closest(rows: Sequence[_Row], places: Doubles) -> float:
    """The smallest distance between two balls at the same time."""
    least, seen = math.inf, dict[tuple[str, float], list[tuple[str, Doubles]]]()
    for row, place in zip(rows, places):
        others = seen.setdefault((row.shot, row.t), [])
        for ball, other in others:
            if ball != row.ball:
                least = min(least, float(np.hypot(*(place - other))))
        others.append((row.ball, place))
    return least


@dataclass(frozen=True)
class _Area:
    """The area of a table, for checking positions."""

    size: tuple[float, float]  # extents of x and y, m
    radius: float  # of the balls, m
    pockets: Doubles  # their centres
    is_named: bool  # whether the word of the table gives its extents

    def share(self, places: Doubles) -> float:
        """The fraction of positions on the table, which may be along x or y."""
        return max(
            float(np.mean(is_inside(turned, self.size, self.radius, self.pockets)))
            for turned in (places, places[:, ::-1])
        )


def _area(table: str | tuple[float, float] | None, radius: float | None) -> _Area | None:
    if table is None:
        return None
    ground = _constants.ground(table, radius or (None if isinstance(table, str) else _RADIUS))
    return _Area(ground.size, ground.radius, ground.table.pockets["centre"], isinstance(table, str))


def _found_scale(
    places: Doubles, rows: Sequence[_Row], area: _Area, notes: _Notes
) -> tuple[float, Doubles]:
    """The unit of positions, m, and their origin in this unit, from the table's extents.

    Of several possible units, the one is chosen in which the closest balls are two radii apart;
    otherwise the largest, which leaves the smallest part of the table empty.
    """
    if area.share(places) >= ON_TABLE:
        return 1.0, np.zeros(2)
    candidates = []
    closest = _closest(rows, places) / (2.0 * area.radius)
    middles = (np.array(area.size), np.array(area.size[::-1]))
    for origin, text in ((np.zeros(2), "a corner"), *((-0.5 * m, "the middle") for m in middles)):
        for name, unit in UNITS.items():
            tried = places * unit - origin
            reach = np.ptp(np.percentile(tried, (2, 98), axis=0), axis=0).max()
            if area.share(tried) >= ON_TABLE and reach > _WIDE * max(area.size):
                candidates.append((not 0.85 < closest * unit < 1.3, -unit, text, name, origin))
    if not candidates:
        return 1.0, np.zeros(2)
    _, _, text, name, origin = min(candidates, key=lambda candidate: candidate[:2])
    notes.sentences.append(
        f"places are taken in {name} from {text} of the table, by their extents; unit and origin "
        f"say otherwise"
    )
    return UNITS[name], origin / UNITS[name]


def _on_table(
    path: Path, rows: Sequence[_Row], places: Doubles, area: _Area, notes: _Notes
) -> tuple[list[_Row], Doubles, Doubles]:
    """The rows with positions on the table, rotated if the table is along the other axis; and the
    rotation, (3, 3), of homogeneous positions.
    """
    turn = np.eye(3)
    size, radius = area.size, area.radius
    if exchanged(places, size, radius, area.pockets):
        if not area.is_named:
            raise TrackError(
                f"{path}: the positions fit a table of {size[1]:g} x {size[0]:g} m; pass the table's "
                f"extents in the order of x and y"
            )
        turn = np.array([[0.0, -1.0, size[0]], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
        places = places @ turn[:2, :2].T + turn[:2, 2]
        notes.sentences.append("places are turned by 90 degrees, as their x runs along the table")
    on_table = is_inside(places, size, radius, area.pockets)
    for k in np.flatnonzero(~on_table).tolist():
        axis = int(is_inside(places[k, :1], size[:1], radius))
        name, value, extent = "xy"[axis], places[k, axis], size[axis]
        text = (
            f"centres of balls of radius {radius:g} m must be {radius:g} to {extent - radius:g} m"
        )
        if on_table.mean() < 0.5:
            raise TrackError(
                f"{rows[k].place}: {name} = {value:g} m; {text}, and most are not: are the table's "
                f"extents in the order of x and y, all in metres? Pixels need corners"
            )
        notes.leave_out(text, f"{rows[k].place}: {name} = {value:g} m")
    return [row for row, inside in zip(rows, on_table) if inside], places[on_table], turn


def _ordered(times: Doubles) -> NDArray[np.intp]:
    """The rows of the longest increasing subsequence of times; the first of equal times."""
    tails: list[float] = []
    indices: list[int] = []
    before: list[int] = []
    for k, t in enumerate(times.tolist()):
        place = bisect.bisect_left(tails, t)
        before.append(indices[place - 1] if place else -1)
        if place == len(tails):
            tails.append(t)
            indices.append(k)
        elif t < tails[place]:
            tails[place], indices[place] = t, k
    rows, k = [], indices[-1]
    while k >= 0:
        rows.append(k)
        k = before[k]
    return np.array(rows[::-1], np.intp)


def _recordings_of(
    rows: Sequence[_Row], places: Doubles, rate: float, view: View | None, notes: _Notes
) -> list[Recording]:
    """The recordings of samples, in the order of the file, by a camera with this view.

    Rows out of order of time are skipped, or sorted if there are many.
    """
    shots: dict[str, dict[str, list[int]]] = {}
    for k, row in enumerate(rows):
        shots.setdefault(row.shot, {}).setdefault(row.ball, []).append(k)
    found, is_sorted = [], 0
    for shot, balls in shots.items():
        tracks = []
        for ball, indices in balls.items():
            order = np.array(indices)
            times = np.array([rows[k].t for k in indices]) / rate
            ordered = _ordered(times)
            if len(ordered) < _ORDERED * len(np.unique(times)):
                order = order[np.argsort(times, kind="stable")]
                times = np.sort(times)
                ordered, is_sorted = _ordered(times), is_sorted + 1
            for k in np.setdiff1d(np.arange(len(order)), ordered).tolist():
                row, first = rows[order[k]], times[max(k - 1, 0)]
                notes.leave_out(
                    "the rows of a ball come in the order of time, each time once",
                    f"{row.place}: shot {shot}, ball {ball}: t = {times[k]:g} s comes after "
                    f"t = {first:g} s",
                )
            tracks.append(np.column_stack([times[ordered], places[order[ordered]]]))
        found.append(Recording(_name(shot), tuple(map(_name, balls)), tuple(tracks), view=view))
    if is_sorted:
        notes.sentences.append(f"the rows of {is_sorted} balls are sorted by time")
    return found


def _shots_of(film: Recording, second: float, notes: _Notes) -> list[Recording]:
    """The shots of a film, 1, 2, ..., where all balls rest in between or are put elsewhere; the film
    itself if there is one shot. `second` is the length of a second on its clock.
    """
    scale = np.array([second, 1.0, 1.0])
    tracks = [track / scale for track in film.tracks if len(track) > 1]
    times = np.unique(np.concatenate([track[:, 0] for track in film.tracks])) / second
    if not tracks:
        return [film]
    steps = [film.evened(track[1:, 1:], np.diff(track[:, 1:], axis=0)) for track in tracks]
    noise = float(np.median(np.abs(np.concatenate(steps))))
    noisy_film = replace(film, noise=noise)
    found = spans(tracks, times, [noisy_film.noises(track[:, 1:]) for track in tracks])
    if len(found) < 2:
        return [film]
    shots = []
    for number, (begin, end) in enumerate(found, 1):
        rows = [
            track[(track[:, 0] >= second * begin) & (track[:, 0] <= second * end)]
            for track in film.tracks
        ]
        seen = [k for k, part in enumerate(rows) if len(part)]
        balls = tuple(film.balls[k] for k in seen)
        shots.append(replace(film, id=number, balls=balls, tracks=tuple(rows[k] for k in seen)))
    notes.sentences.append(
        f"the film is cut into {len(shots)} shots, where all balls rest or are put elsewhere"
        + ("" if second == 1.0 else f"; times are taken as {second:g} pictures a second for this")
    )
    return shots


def _unit_of(unit: float | str | None) -> float | None:
    """The length of a unit, m; None if it is inferred from the file."""
    if unit is None or unit == "px":
        return None
    given = unit
    if isinstance(unit, str):
        unit = UNITS.get(_UNIT_NAMES.get(unit, unit), math.nan)
    if isinstance(unit, bool) or not isinstance(unit, (int, float)) or not 0.0 < unit < math.inf:
        raise ValueError(
            unknown_value("unit", given, [*UNITS, "px"]) + ", or a positive length in m"
        )
    return float(unit)


def _check(rate: float | None, origin: Any, corners: Any, table: Any, unit: Any) -> None:
    """Raise an error for invalid arguments of `read`."""
    if rate is not None and not 0.0 < rate < math.inf:
        raise ValueError(f"rate: {rate!r} is not a positive number of frames per second")
    if origin is not None and not np.isfinite(np.asarray(origin, np.float64)).all():
        raise ValueError(f"origin: {origin!r} are not two finite numbers")
    if corners is not None and (np.shape(corners) != (4, 2) or table is None):
        raise ValueError(
            "corners: not four positions, or table is missing; pass the positions of the corners (0, 0), "
            "(W, 0), (W, L), (0, L), and the table"
        )
    if unit == "px" and corners is None:
        raise ValueError("unit: 'px' needs corners, the positions of the four corners of the noses")


def read(
    path: str | Path,
    *,
    table: str | tuple[float, float] | None = None,
    radius: float | None = None,
    unit: float | str | None = None,
    origin: tuple[float, float] | None = None,
    rate: float | None = None,
    corners: Sequence[tuple[float, float]] | None = None,
) -> Reading:
    """Read recorded shots, in the order of the file.

    Parameters
    ----------
    path : path
        A text table with the columns shot, ball, t, x, y (s and m), one row per sample; or, if the
        name contains .jsonl or .ndjson, JSON Lines with one shot per line: {"id": 1, "tracks":
        {"1": [[t, x, y], ...], ...}}. Both may be compressed (.xz, .gz). Tables of trackers are
        accepted too: separated by commas, semicolons, tabs or spaces; with decimal commas; with
        other column names, such as frame, track_id, cx, x_in or "x (mm)"; with a pair of columns
        for each ball (x1, y1, ... or cue_x, cue_y, ...); with a state (visible, hidden, pocketed);
        and exports of Tracker, whose first line names the track. Without a column of shots, the
        rows are those of a film, which is cut into shots where all balls rest or are put elsewhere.
    table, radius : optional
        A built-in table, such as "9ft", or the extents (W, L) of x and y, and the radius of the
        balls, m. With a table, centres more than 60 mm outside its bounds are skipped, and the
        file's unit and origin are inferred if they are not given. Positions with x along a built-in
        table are rotated by 90 degrees.
    unit : float or str, optional
        Length of the unit of x and y, m, or "m", "cm", "mm", "inches" or "px".
    origin : (float, float), optional
        Position of the corner of the noses in the file, in the file's unit.
    rate : float, optional
        Frames per second, if t counts frames: 30 or 120.
    corners : four (x, y), optional
        The corners (0, 0), (W, 0), (W, L), (0, L) of the noses in pixels or any other unit.
        Positions are then mapped to the table by a perspective transformation, which also
        determines how the noise of x and y varies over the table.

    Returns
    -------
    Reading
        A list of recordings, with `notes` on inferred information and skipped rows.

    Raises
    ------
    TrackError
        No row is usable, or the table's extents are exchanged. The message contains the line and a
        remedy.
    ValueError
        An argument is invalid.
    OSError
        The file cannot be read.
    """
    _check(rate, origin, corners, table, unit)
    area = _area(table, radius)
    length, path, notes = _unit_of(unit), Path(path), _Notes()
    is_json = any(suffix in (".jsonl", ".ndjson") for suffix in path.suffixes)
    text = _text(path)
    try:
        rows = list((_json_rows if is_json else _table_rows)(path, text, notes))
    except csv.Error as error:
        raise TrackError(f"{path}: {error}; use a table of text") from None
    if not rows:
        raise TrackError("; ".join([f"{path}: no samples are usable", *notes.lines()]))
    places = np.array([(row.x, row.y) for row in rows])
    matrix = None if corners is None or area is None else _homography(corners, area.size)
    if matrix is not None:
        q = np.column_stack([places, np.ones(len(places))]) @ matrix.T
        places = q[:, :2] / q[:, 2:]
        notes.sentences.append(
            "places are mapped by the corners onto the plane of the noses; a centre lies lower by "
            "about a quarter of the radius, and is seen that much farther from the camera"
        )
    else:
        if length is None and notes.unit == "px":
            raise TrackError(
                f"{path}: positions are in pixels; pass corners, the positions of the table's corners"
            )
        if length is None and notes.unit in UNITS:
            length = UNITS[notes.unit]
            if length != 1.0:
                notes.sentences.append(f"places are in {notes.unit}, by the titles of columns")
        shift: Any = np.zeros(2) if origin is None else np.array(origin)
        if length is None and origin is None and area is not None:
            length, shift = _found_scale(places, rows, area, notes)
        places = (places - shift) * (length or 1.0)
    if area is not None:
        rows, places, turn = _on_table(path, rows, places, area, notes)
        matrix = None if matrix is None else turn @ matrix
    if rate is None and notes.picture:
        notes.sentences.append(
            f"times are numbers of pictures (column {notes.picture}): rate says how many a second"
        )
    view = None if matrix is None else View.over(matrix, places)
    recordings = _recordings_of(rows, places, rate or 1.0, view, notes)
    if notes.is_film:
        second = _USUAL_RATE if rate is None and notes.picture else 1.0
        recordings = _shots_of(recordings[0], second, notes)
    return Reading(recordings, notes.lines())
