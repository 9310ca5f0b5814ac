"""Files of tracks as people and trackers write them: what is read and what is said, case by case,
and that every way of writing gives the same recordings.
"""

import os
import re
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
import pytest

from carom import tracks
from carom.tracks import _spans

TABLE, RADIUS = (2.84, 1.42), 0.03075


class Case(NamedTuple):
    """A file of tracks, and what is read of it."""

    text: str
    balls: str = ""  # SHOT/BALL:ROWS of each
    notes: Sequence[str] = ()  # a pattern each
    error: str = ""  # the pattern of a TrackError instead
    file: str = "a.csv"
    options: Mapping[str, object] = {}


CASES = {
    "documented": Case(
        """\
shot,ball,t,x,y
1,cue,0,0.5,0.5
1,cue,0.04,0.6,0.5
1,red,0,1.5,0.7
""",
        balls="1/cue:2 1/red:1",
    ),
    "in_another_order": Case(
        """\
y,t,note,ball,x,shot
0.5,0,a,cue,0.5,1
""",
        balls="1/cue:1",
    ),
    "balls_that_are_not_seen": Case(
        """\
shot,ball,t,x,y
1,cue,0,0.5,0.5
1,cue,0.04,,
1,cue,0.08,nan,NaN
1,cue,0.12,0.6,0.5
""",
        balls="1/cue:2",
        notes=["line 3: the ball has no place there; left out, as are 1 more rows for this reason"],
    ),
    "outside_the_table": Case(
        """\
shot,ball,t,x,y
1,cue,0,0.5,0.5
1,cue,0.04,3.1,0.5
1,cue,0.08,0.7,0.5
""",
        balls="1/cue:2",
        notes=[
            "line 3: x = 3.1 m: centres of balls of radius 0.03 m must be 0.03 to 2.81 m; left out$"
        ],
        options={"table": (2.84, 1.42), "radius": 0.03},
    ),
    "out_of_the_order_of_time": Case(
        """\
shot,ball,t,x,y
1,cue,0,0.5,0.5
1,cue,9,0.5,0.5
1,cue,0.04,0.5,0.5
1,cue,0.08,0.5,0.5
1,cue,0.08,0.5,0.6
1,cue,0.12,0.6,0.5
1,cue,0.16,0.7,0.5
1,cue,0.2,0.8,0.5
1,cue,0.24,0.9,0.5
""",
        balls="1/cue:7",
        notes=[
            "line 3: shot 1, ball cue: t = 9 s comes after t = 0 s: the rows .* once; left out, as are 1 more"
        ],
    ),
    "newest_first": Case(
        """\
shot,ball,t,x,y
1,cue,0.12,0.8,0.5
1,cue,0.08,0.7,0.5
1,cue,0.04,0.6,0.5
1,cue,0,0.5,0.5
""",
        balls="1/cue:4",
        notes=["the rows of 1 balls are sorted by time"],
    ),
    "no_numbers": Case(
        """\
shot,ball,t,x,y
1,cue,0,0.5,0.5
1,cue,soon,0.5,0.5
1,cue,0.08,0.5,?!
1,cue,0.12,0,5,0,5
""",
        balls="1/cue:1",
        notes=[
            "line 3: t is 'soon': a finite number is needed, in s; left out",
            r"line 4: y is '\?!': a finite number is needed; left out",
            "line 5: 7 fields, but the titles name 5 columns; left out",
        ],
    ),
    "numbers_of_pictures": Case(
        """\
frame,track_id,cx,cy
0,1,0.5,0.5
25,1,0.6,0.5
""",
        balls="1/1:2",
        notes=[
            "columns: balls from column track_id; times from column frame; places from cx, cy; all rows as one film",
            "times are numbers of pictures .column frame.: rate says how many a second",
        ],
    ),
    "pictures_at_a_rate": Case(
        """\
shot,ball,frame,x,y
1,1,0,0.5,0.5
1,1,25,0.6,0.5
""",
        balls="1/1:2",
        notes=[
            "columns: shots from column shot; balls from column ball; times from column frame; places from x, y$"
        ],
        options={"rate": 25},
    ),
    "pairs_of_columns": Case(
        """\
t;x1;y1;x2;y2
0,00;0,5;0,5;1,5;0,7
0,04;0,6;0,5;;
""",
        balls="1/1:2 1/2:1",
        notes=[
            "columns: times from column t; balls 1, 2 from pairs of columns; all rows as one film",
            "line 3: the ball has no place there",
        ],
    ),
    "named_pairs_in_centimetres": Case(
        """\
clip,time (ms),cue_x (cm),cue_y (cm),red_x (cm),red_y (cm)
4,0,50,50,150,70
4,40,60,50,150,70
""",
        balls="4/cue:2 4/red:2",
        notes=[
            "columns: shots from column clip; times from column time .ms.; balls cue, red from pairs",
            "places are in cm, by the titles of columns",
        ],
    ),
    "exports_of_Tracker": Case(
        """\
#mass_A
t	x	y	v_{x}
0,000E0	5,000E-1	5,000E-1
4,000E-2	6,000E-1	5,000E-1	2,5E0
mass_B
t	x	y
0,000E0	1,500E0	7,000E-1
""",
        balls="1/mass_A:2 1/mass_B:1",
        notes=["columns: times from column t; places from x, y; all rows as one film"],
        file="a.txt",
    ),
    "states": Case(
        """\
shot,ball,t,x,y,state
1,cue,0,0.5,0.5,visible
1,cue,0.04,0.6,0.5,hidden
1,red,0,0.6,0.5,wobbling
1,red,0.04,0,0,pocketed
""",
        balls="1/cue:1 1/red:1",
        notes=[
            "states wobbling: their rows are taken",
            "line 3: the state says that the ball is not seen there; left out, as are 1 more",
        ],
    ),
    "millimetres_by_their_extents": Case(
        """\
shot,ball,t,x,y
1,cue,0,500,500
1,cue,0.04,2500,1300
""",
        balls="1/cue:2",
        notes=[
            "places are taken in mm from a corner of the table, by their extents; unit and origin say otherwise"
        ],
        options={"table": (2.84, 1.42), "radius": 0.03},
    ),
    "origin_in_the_middle": Case(
        """\
shot,ball,t,x,y
1,cue,0,-0.5,-0.5
1,cue,0.04,1.3,0.6
""",
        balls="1/cue:2",
        notes=["places are taken in m from the middle of the table"],
        options={"table": (2.84, 1.42), "radius": 0.03},
    ),
    "exchanged_extents": Case(
        """\
shot,ball,t,x,y
1,cue,0,0.5,2.5
1,cue,0.04,1.3,2.6
""",
        error="a.csv: the positions fit a table of 1.42 x 2.84 m; pass the table's extents in the order of x and y",
        options={"table": (2.84, 1.42), "radius": 0.03},
    ),
    "along_the_table_of_a_word": Case(
        """\
shot,ball,t,x,y
1,cue,0,60,25
1,cue,0.04,90,40
1,cue,0.08,101.5,-1
""",
        balls="1/cue:3",
        notes=[
            "places are taken in inches from a corner of the table",
            "places are turned by 90 degrees, as their x runs along the table",
        ],
        options={"table": "9ft"},
    ),
    "in_no_unit": Case(
        """\
shot,ball,t,x,y
1,cue,0,1e6,7e5
""",
        error=r"line 2: x = 1e\+06 m; centres .* 0.03 to 2.81 m, and most are not: .* all in metres. Pixels need corners",
        options={"table": (2.84, 1.42), "radius": 0.03},
    ),
    "pixels_without_corners": Case(
        """\
shot,ball,t,x_px,y_px
1,cue,0,900,700
""",
        error="positions are in pixels; pass corners, the positions of the table's corners",
        options={"table": (2.84, 1.42)},
    ),
    "no_titles": Case(
        """\
1,cue,0,0.5,0.5
""",
        error="line 1: '1,cue,0,0.5,0.5' names no columns of positions and times; a line must name .* shot,ball,t,x,y",
    ),
    "nothing": Case(
        "",
        error="line 1: '' names no columns",
    ),
    "no_rows": Case(
        """\
shot,ball,t,x,y
""",
        error="no samples are usable$",
    ),
    "no_usable_row": Case(
        """\
shot,ball,t,x,y
1,cue,0,,
""",
        error="no samples are usable; .*line 2: the ball has no place there",
    ),
    "not_compressed": Case(
        """\
shot,ball,t,x,y
""",
        error="compressed only if its name ends in",
        file="a.csv.xz",
    ),
    "lines_of_JSON": Case(
        """\
{"id": 7, "tracks": {"1": [[0, 1, 1], [0.04, null, null], [0.08, 1, true]], "2": [[0, 1]], "3": 4}}
{"id": 1}
{
""",
        balls="7/1:1",
        notes=[
            r"tracks.1\[1\]: the ball has no place there",
            r"tracks.1\[2\]: \[0.08, 1, True\]: finite numbers are needed",
            r"tracks.2\[0\]: \[0, 1\]: it must be \[t, x, y\]",
            "tracks.3: it must be a list",
            "line 2: each line must be",
            "line 3, column 2: no JSON",
        ],
        file="a.jsonl",
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_a_file_costs_rows_and_each_has_its_sentence(tmp_path, name):
    case = CASES[name]
    file = tmp_path / case.file
    file.write_text(case.text)
    if case.error:
        with pytest.raises(tracks.TrackError, match=case.error):
            tracks.read(file, **case.options)
        return
    found = tracks.read(file, **case.options)
    balls = [
        f"{shot.id}/{ball}:{len(track)}"
        for shot in found
        for ball, track in zip(shot.balls, shot.tracks)
    ]
    assert " ".join(balls) == case.balls
    assert len(found.notes) == len(case.notes), found.notes
    for note, pattern in zip(found.notes, case.notes):
        assert re.search(pattern, note), note


def long(titles, separator, number):
    """What writes rows of frames under these titles."""

    def write(recordings, places):
        lines = [separator.join(titles)]
        for shot, seen in zip(recordings, places):
            for ball, track, place in zip(shot.balls, shot.tracks, seen):
                for frame, (x, y) in zip(np.round(track[:, 0] * 50.0), place):
                    row = {"shot": shot.id, "ball": ball, "frame": int(frame)}
                    row |= {"x": number(float(x)), "y": number(float(y))}
                    lines.append(separator.join(str(value) for value in row.values()))
        return "\n".join(lines) + "\n"

    return write


def wide(recordings, places):
    """A line a picture, with empty cells where a ball is not seen."""
    lines = ["take,picture,x_white,y_white,x_yellow,y_yellow,x_red,y_red"]
    for shot, seen in zip(recordings, places):
        frames = sorted({int(t) for track in shot.tracks for t in np.round(track[:, 0] * 50.0)})
        cells = [
            {int(t): place for t, place in zip(np.round(track[:, 0] * 50.0), rows)}
            for track, rows in zip(shot.tracks, seen)
        ]
        for frame in frames:
            pairs = [",".join(map(repr, map(float, c.get(frame, ())))) or "," for c in cells]
            lines.append(f"{shot.id},{frame},{','.join(pairs)}")
    return "\n".join(lines) + "\n"


WRITERS = {
    "titles of trackers": long(["clip", "track_id", "frame_number", "cx", "cy"], ",", repr),
    "decimal commas": long(
        ["Shot", "Object", "Frame", "X", "Y"], ";", lambda value: repr(value).replace(".", ",")
    ),
    "spaces": long(["shot", "colour", "image", "x", "y"], "  ", repr),
    "columns of balls": wide,
}


@pytest.mark.parametrize("unit", ["m", "cm", "mm", "inches", "px"])
@pytest.mark.parametrize("writer", WRITERS)
def test_every_way_of_writing_gives_the_same_places(tmp_path, writer, unit):
    seed = int(os.environ.get("CAROM_TEST_SEED", "1"))
    print("seed", seed)
    random = np.random.default_rng(seed)
    recordings = tracks.synthetic(3, seed=seed).recordings
    options = {"table": TABLE, "radius": RADIUS, "rate": 50.0}
    if unit == "px":
        # a camera that looks askew: corners, and the homography from the table to the picture
        view = np.array([[300.0, 20.0, 100.0], [10.0, 280.0, 50.0], [0.02, 0.05, 1.0]])
        view[:2] += random.normal(0.0, 5.0, (2, 3))

        def seen(r):
            q = np.column_stack([r, np.ones(len(r))]) @ view.T
            return q[:, :2] / q[:, 2:]

        corners = np.array([[0.0, 0.0], [TABLE[0], 0.0], TABLE, [0.0, TABLE[1]]])
        options |= {"unit": "px", "corners": seen(corners).tolist()}
    else:
        origin = random.uniform(-2.0, 2.0, 2)
        size = {"m": 1.0, "cm": 0.01, "mm": 0.001, "inches": 0.0254}[unit]
        options |= {"unit": unit, "origin": tuple(origin / size)}

        def seen(r):
            return (r + origin) / size

    places = [[seen(track[:, 1:]) for track in shot.tracks] for shot in recordings]
    (tmp_path / "a.csv").write_text(WRITERS[writer](recordings, places))
    found = tracks.read(tmp_path / "a.csv", **options)
    assert any("columns:" in note for note in found.notes)
    assert [shot.id for shot in found] == [shot.id for shot in recordings]
    for one, other in zip(found, recordings):
        for a, b in zip(one.tracks, other.tracks, strict=True):
            assert np.allclose(a, b, rtol=0.0, atol=1e-9)


@pytest.mark.parametrize("gap", [1, 6])
def test_balls_that_are_put_up_anew_begin_another_shot(gap):
    """A film that is cut where the balls rest, with or without pictures between."""
    times = np.arange(400) / 50.0
    moved = np.clip(times - 1.0, 0.0, 1.0), np.clip(times - 5.0, 0.0, 1.0)
    places = np.column_stack([0.3 + 0.5 * moved[0] + 0.4 * moved[1], np.full(400, 0.5)])
    places[200:, 1] = 1.1  # another place from 4 s on
    numbers = [k for k in range(400) if not 200 - gap < k < 200]
    track = np.column_stack([times, places])[numbers]
    (first, second) = _spans.spans([track], times, [np.full(len(track), 1e-4)])
    assert first[0] < 1.0 and 2.0 < first[1] < 4.0 <= second[0] < 5.0
    # balls that are put up while others still count as moving end the shot as well
    early = track - [0.0, 0.2, 0.0]
    early[numbers.index(200) :, 1] += 0.3
    assert (
        max(end for _, end in _spans.spans([early], times, [np.full(len(early), 1e-4)])[:1]) < 4.0
    )


@pytest.mark.parametrize("rate", [30.0, None])
def test_a_film_without_a_column_of_shots_is_cut_into_shots(tmp_path, rate):
    """Three shots in sequence, with rests of 2 s in between; one shot remains a film."""
    made = tracks.synthetic(3, rate=30.0, thin=0.0, seed=2)
    rows, frame, begins = ["frame,ball,x,y"], 0, []
    for shot in made.recordings:
        count = len(shot.tracks[0])
        begins.append(frame + 30)
        for k in range(-30, count + 30):
            for ball, track in zip(shot.balls, shot.tracks):
                x, y = track[min(max(k, 0), count - 1), 1:]
                rows.append(f"{frame},{ball},{x},{y}")
            frame += 1
    file = tmp_path / "film.csv"
    file.write_text("\n".join(rows), encoding="utf-8")
    found = tracks.read(file, table=TABLE, radius=RADIUS, rate=rate)
    assert [shot.id for shot in found] == [1, 2, 3]
    assert re.search("the film is cut into 3 shots", " ".join(found.notes))
    assert ("30 pictures a second" in " ".join(found.notes)) == (rate is None)
    for shot, true, begin in zip(found, made.recordings, begins):
        assert shot.balls == (1, 2, 3)
        assert np.abs(shot.rest - true.rest).max() < 1e-3
        at = shot.moves.min() * (1.0 if rate is None else rate)
        assert begin <= at < begin + 15
    file.write_text("\n".join(rows[: 3 * begins[1] - 100]), encoding="utf-8")
    (alone,) = tracks.read(file, table=TABLE, radius=RADIUS, rate=rate)
    assert alone.balls == (1, 2, 3) and len(alone.tracks[0]) > begins[1] - 40
