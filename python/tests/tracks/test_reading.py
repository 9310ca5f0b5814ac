"""Files of tracks as people and trackers write them: what is read and what is said, case by case in
the text beside this module; and that every way of writing gives the same recordings.
"""

import os
import re
from pathlib import Path

import numpy as np
import pytest

from carom import tracks

TABLE, RADIUS = (2.84, 1.42), 0.03075
CASES = re.findall(
    r"^=== (\w+) ([\w.]+)(?:, (.*))?\n((?:(?![>=]).*\n)*)((?:> .*\n)+)",
    Path(__file__).with_suffix(".txt").read_text(encoding="utf-8"),
    re.M,
)


@pytest.mark.parametrize("case", CASES, ids=[case[0] for case in CASES])
def test_a_file_costs_rows_and_each_has_its_sentence(tmp_path, case):
    _, name, arguments, text, expected = case
    (tmp_path / name).write_text(text.rstrip("\n") + "\n" if text.strip() else "")
    options = eval(f"dict({arguments})")
    first, *patterns = re.findall(r"^> (.*)$", expected, re.M)
    if first.endswith("Error"):
        with pytest.raises(tracks.TrackError, match=patterns[0]):
            tracks.read(tmp_path / name, **options)
        return
    found = tracks.read(tmp_path / name, **options)
    balls = [
        f"{shot.id}/{ball}:{len(track)}"
        for shot in found
        for ball, track in zip(shot.balls, shot.tracks)
    ]
    assert " ".join(balls) == first
    assert len(found.notes) == len(patterns), found.notes
    for note, pattern in zip(found.notes, patterns):
        assert re.search(pattern, note), note


def test_all_cases_are_read():
    assert len(CASES) == Path(__file__).with_suffix(".txt").read_text().count("\n=== ") >= 20


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
    "titles of trackers": long("clip track_id frame_number cx cy".split(), ",", repr),
    "decimal commas": long(
        "Shot Object Frame X Y".split(), ";", lambda value: repr(value).replace(".", ",")
    ),
    "spaces": long("shot colour image x y".split(), "  ", repr),
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
