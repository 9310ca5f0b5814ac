"""Tracks of films that `draw` draws, against the shots that they show."""

import io

import numpy as np
import pytest

pytest.importorskip("cv2", reason="opencv-python-headless is not installed")
pytest.importorskip("scipy", reason="scipy is not installed")

import cv2
import draw
from conftest import run_python

import carom
import carom.fit
from carom import film
from carom.film import _balls, _camera, _cloth, _clock, _names, _paths
from carom.film._balls import blob

SNOOKER, POOL = carom.tables.snooker(), carom.tables.pool_9ft()
W, L = SNOOKER.width, SNOOKER.length
SPOTS = {
    "yellow": (W / 2 + 0.292, 0.737),
    "brown": (W / 2, 0.737),
    "green": (W / 2 - 0.292, 0.737),
    "blue": (W / 2, L / 2),
    "pink": (W / 2, 0.75 * L),
    "black": (W / 2, L - 0.324),
}


class Drawn:
    """A film that is drawn, what it shows, and its tracks."""

    def __init__(self, path, table, kind, scene, names, places, cue, rates, seconds, arm=None):
        self.path, self.scene, self.names, self.arm = path, scene, names, arm
        self.kind = kind
        self.balls = carom.balls(places, game="snooker" if kind == "snooker" else "pool")
        self.radius = float(self.balls["kind"]["radius"][0])
        self.shot = carom.simulate(table, self.balls, cue)
        self.rate, self.file_rate = rates
        self.times, self.places = draw.write(
            path, scene, names, self.shot, self.radius, *rates, seconds, arm
        )
        self.film = film.track(path, kind)

    def away(self, name, rows):
        """How far rows of the only shot are from the ball of a name, m."""
        (begin,) = self.film.begins
        times = np.clip(rows[:, 0] + begin - 0.6, 0.0, self.shot.time)
        true = self.shot.positions(times)[:, self.names.index(name), :2]
        return np.hypot(*(rows[:, 1:] - true).T)

    def found(self):
        """(true name, rows) of each ball: any red may have the name of another red."""
        (shot,) = self.film.recordings
        pairs = []
        for name, rows in zip(shot.balls, shot.tracks):
            reds = [other for other in self.names if other[:3] == "red" == name[:3]]
            pairs.append((min(reds or [name], key=lambda k: np.median(self.away(k, rows))), rows))
        return pairs


@pytest.fixture(scope="module")
def snooker(tmp_path_factory):
    """As broadcast: from behind the baulk end, 25 pictures a second in a file of 30; an arm with
    the cue before the stroke, and an arm over moving balls later.
    """
    scene = draw.Film(SNOOKER, (0.889, -3.6, 3.4), (0.889, 1.5, 0.0), 1900.0, k1=-0.05)

    def arm(t):
        if -0.5 < t < 0.1:
            back = 0.2 * max(-t, 0.0)
            return [(0.9, -0.3, 0.3), (0.84, 0.5 - back, 0.12), (0.765, 1.0 - back, 0.04)]
        return [(-0.3, 2.5, 0.4), (0.5, 2.35, 0.15), (0.55, 2.35, 0.1)] if 1.0 < t < 1.6 else None

    return Drawn(
        tmp_path_factory.mktemp("film") / "snooker.mp4",
        SNOOKER,
        "snooker",
        scene,
        ["cue", "red1", "red2", "red3", *SPOTS],
        [(0.75, 1.1), (0.6, 2.0), (0.35, 2.75), (1.45, 2.3), *SPOTS.values()],
        carom.cue(speed=2.8, phi=101.0),
        (25, 30),
        2.2,
        arm,
    )


@pytest.fixture(scope="module")
def pool(tmp_path_factory):
    """From a corner, by a lens that bends: an open break, 30 pictures a second in a file of 60."""
    scene = draw.Film(POOL, (1.9, -1.6, 1.9), (0.62, 1.2, 0.0), 1000.0, k1=-0.12)
    near = [(0.635, 1.9), (0.58, 2.05), (0.69, 2.06), (0.52, 2.2), (0.635, 2.2), (0.75, 2.2)]
    wide = [(0.2, 0.7), (0.95, 1.45), (0.2, 1.15), (0.9, 0.45), (0.5, 1.35)]
    return Drawn(
        tmp_path_factory.mktemp("film") / "pool.avi",
        POOL,
        "9ft",
        scene,
        ["cue", "1", "2", "3", "4", "5", "7", "8", "9", "10", "11", "12"],
        [(0.635, 0.55), *near, *wide],
        carom.cue(speed=4.0, phi=90.6),
        (30, 60),
        3.0,
    )


@pytest.mark.parametrize(
    ("name", "median"),
    [("snooker", 2e-3), pytest.param("pool", 2.5e-3, marks=pytest.mark.release)],
)
def test_places_names_and_times(name, median, request):
    drawn = request.getfixturevalue(name)
    found = drawn.found()
    assert {ball for ball, _ in found} == set(drawn.names)
    errors = {ball: drawn.away(ball, rows) for ball, rows in found}
    every = np.concatenate(list(errors.values()))
    print(name, {ball: f"{1e3 * np.median(away):.1f} mm" for ball, away in errors.items()})
    print(name, 1e3 * np.percentile(every, (50, 90, 99)))
    assert len(every) > 150
    assert np.median(every) < median and np.percentile(every, 90) < 5e-3

    # the clock is that of the pictures, not of the file
    (shot,), (begin,) = drawn.film.recordings, drawn.film.begins
    for rows in shot.tracks:
        numbers = (rows[:, 0] + begin) * drawn.rate
        assert np.abs(numbers - np.round(numbers)).max() < 2e-3
    assert f"{drawn.rate} new pictures a second" in drawn.film.notes[0]
    # whatever moves by 3 cm has rows, and what lies has one
    moved = np.hypot(*np.ptp(drawn.places[..., :2], axis=0).T)
    assert sum(len(rows) > 5 for rows in shot.tracks) == (moved > 0.03).sum()


EYE, MIDDLE = (0.8, -2.57, 2.43), (0.635, 1.07, 0.0)


def seen_in(cloth, shade, names, centres, spoil=None):
    """The balls that are found in a picture of balls on a table of pool, those that were drawn, the
    area of other things, and the bed. `spoil` draws on the picture, from the scene.
    """
    scene = draw.Film(POOL, EYE, MIDDLE, 1850.0, cloth=cloth, shade=shade)
    places = np.column_stack([centres, np.full(len(centres), 0.028575)])
    balls = [(name, r[None], 0.028575, np.eye(3)[0]) for name, r in zip(names, places)]
    picture, bed = scene.finished(scene.picture(balls)), film.bed_of("9ft")
    if spoil:
        spoil(picture, scene.pixels(places).round().astype(int).tolist())
    camera, depths, _ = _cloth.calibrated(picture, bed, None, None, None)
    cloth_seen = _cloth.Cloth(picture, camera, bed, depths)
    rows, _, foreign = _balls.Finder(cloth_seen).find(picture, cloth_seen.distance(picture))
    return rows["place"], np.hypot(*(rows["place"][:, None] - centres).transpose(2, 0, 1)), foreign


def test_balls_on_grey_cloth_and_with_numbers_of_its_colour():
    """A white one is told by its brightness alone, so that its shaded side may be missed."""
    centres = np.array([(0.66, 1.5), (0.3, 1.9), (0.9, 0.9), (0.635, 0.6)])

    def number(picture, pixels):
        x, y = pixels[1]
        cv2.circle(picture, (x, y), 3, picture[y, x + 30].tolist(), -1)

    for spoil in (None, number):
        places, away, foreign = seen_in("grey", 0.0, ["1", "8", "3", "cue"], centres, spoil)
        assert (away.min(axis=0) < [5e-3, 6e-3, 5e-3, 0.02]).all(), away.min(axis=0)
        assert len(places) == 4 and foreign == 0.0


def test_shadows_of_noses_are_no_balls():
    """But a ball in the shadow is one."""
    centres = np.array([(0.635, 0.6), (0.66, 1.5), (0.03, 0.9)])
    places, away, foreign = seen_in("blue", 0.7, "138", centres)
    assert (away.min(axis=0) < 5e-3).all() and foreign < 0.5
    others = places[away.min(axis=1) > 0.02]
    assert film.bed_of("9ft").near_pocket(others, 0.09).all()


def test_hidden_balls_have_no_rows(snooker):
    """Under the arm and its hand, which a disc and a thick line of pixels cover."""
    (begin,), hidden = snooker.film.begins, 0
    for name, rows in snooker.found():
        ball = snooker.names.index(name)
        for t, places in zip(snooker.times, snooker.places):
            arm = snooker.arm(t)
            if arm is None or len(rows) == 1:
                continue
            a, b, _ = snooker.scene.pixels(arm)
            pixel = snooker.scene.pixels(places[ball : ball + 1])[0]
            share = np.clip((pixel - a) @ (b - a) / ((b - a) @ (b - a)), 0.0, 1.0)
            if np.hypot(*(pixel - a - share * (b - a))) < 20.0:
                hidden += 1
                assert np.abs(rows[:, 0] + begin - 0.6 - t).min() > 0.01, (name, t)
    assert hidden > 3
    assert any("over the table" in note for note in snooker.film.notes)


def test_a_film_gives_a_fit_and_a_plan(snooker, tmp_path):
    """As a new user would: film, tracks, strike, and a plan of the layout."""
    snooker.film.write(tmp_path / "tracks.csv")
    shots = carom.tracks.read(tmp_path / "tracks.csv", table=(W, L), radius=snooker.radius)
    kind = snooker.balls["kind"][0]
    found = carom.fit.fit(shots, (W, L), snooker.radius, constants=kind, free="none")
    print("rmse", found.rmse)
    assert found.rmse[0] < 0.025
    (shot,) = shots
    order = sorted(range(len(shot.balls)), key=lambda k: shot.balls[k] != "cue")
    layout = carom.balls(shot.rest[order], game="snooker")
    assert len(carom.plan(SNOOKER, layout, rules="potting", shots=100)) > 0


def test_the_command_writes_tracks_and_a_picture_to_check(snooker, tmp_path):
    out, check = tmp_path / "tracks.csv", tmp_path / "check.png"
    done = run_python(
        *("-m", "carom.film", snooker.path, "--table", "snooker", "-o", out, "--check", check)
    )
    text = io.StringIO()
    snooker.film.write(text)
    assert out.read_text() == text.getvalue()
    assert done.stdout == "" and "s1: from" in done.stderr and "python -m carom.fit" in done.stderr
    drawn = cv2.imread(str(check)).astype(int)
    changed = np.abs(drawn - snooker.film.picture).max(axis=2) > 60
    # the outline lies on the noses as the scene has them
    ends = np.array([[0.3, 0.0, snooker.scene.nose], [1.4, 0.0, snooker.scene.nose]])
    for share in np.linspace(0.0, 1.0, 20):
        x, y = snooker.scene.pixels(ends[:1] + share * np.diff(ends, axis=0))[0].round().astype(int)
        assert changed[y - 2 : y + 3, x].any()


def test_corners_by_hand(snooker):
    corners = np.array([[0, 0], [W, 0], [W, L], [0, L]])
    pixels = snooker.scene.pixels(np.column_stack([corners, np.full(4, snooker.scene.nose)]))
    careless = pixels + [[1.0, -1.0], [-1.0, 0.5], [0.5, 1.0], [-1.0, 1.0]]
    found = film.track(snooker.path, "snooker", corners=careless, end=0.8)
    eye = np.linalg.norm(found.camera.eye - snooker.scene.eye)
    assert eye < 0.06, eye
    with pytest.raises(ValueError, match="corners: not counterclockwise in the frame"):
        film.track(snooker.path, "snooker", corners=pixels[::-1])
    with pytest.raises(ValueError, match="corners: the shape is .*four finite pixels x,y"):
        film.track(snooker.path, "snooker", corners=pixels[:3])
    with pytest.raises(film.FilmError, match="given corners"):
        film.track(snooker.path, "snooker", corners=pixels * 0.25 + [900, 0], end=0.3)


@pytest.mark.parametrize(
    ("name", "what"),
    [
        ("snooker", "cut"),
        *(pytest.param("pool", what, marks=pytest.mark.release) for what in ("cut", "moved")),
    ],
)
def test_another_view_ends_the_tracks(name, what, request, tmp_path):
    """Another picture, or the same six pixels aside."""
    drawn = request.getfixturevalue(name)
    cut, end = (seconds * drawn.file_rate for seconds in (5 / 3, 5 / 2))
    source = cv2.VideoCapture(str(drawn.path))
    path = tmp_path / "two.avi"
    code = cv2.VideoWriter_fourcc(*"MJPG")
    writer = cv2.VideoWriter(str(path), code, drawn.file_rate, drawn.scene.size)
    for k in range(round(end)):
        picture = source.read()[1]
        if k >= round(cut):
            picture = np.roll(picture, 6, axis=1) if what == "moved" else picture[::-1, ::-1] // 2
        writer.write(picture)
    writer.release()
    found = film.track(path, drawn.kind)
    (note,) = [note for note in found.notes if "the camera changes or moves" in note]
    assert note.startswith(f"at {5 / 3:.2f} s"), note
    assert max(shot.end + t for shot, t in zip(found.recordings, found.begins)) < 5 / 3


def test_refusals(snooker, tmp_path):
    def error(*arguments):
        return run_python("-m", "carom.film", *arguments, "--table", "snooker", status=2).stderr

    missing = tmp_path / "missing.mp4"
    assert str(missing) in error(missing)
    text = tmp_path / "text.mp4"
    text.write_text("no film\n")
    assert f"{text}: no frame can be read; use a film" in error(text)
    assert "is not a pixel; use x,y" in error(snooker.path, "--corners", "1,2", "3,4", "5,6", "7")
    assert "no frame between 90" in error(snooker.path, "--start", "90")
    grey = tmp_path / "grey.avi"
    writer = cv2.VideoWriter(str(grey), cv2.VideoWriter_fourcc(*"MJPG"), 30, (320, 240))
    for _ in range(10):
        writer.write(np.full((240, 320, 3), 90, np.uint8))
    writer.release()
    assert "the cloth reaches the border of the frame" in error(grey)
    near = tmp_path / "near.avi"
    writer = cv2.VideoWriter(str(near), cv2.VideoWriter_fourcc(*"MJPG"), 30, (640, 400))
    for _ in range(10):
        writer.write(np.ascontiguousarray(snooker.film.picture[200:600, 300:940]))
    writer.release()
    assert "the cloth reaches the border of the frame" in error(near)


def test_clocks():
    """Every usual rate in every usual file, at any phase; then a camera that drops pictures."""
    seed = int(np.random.SeedSequence().entropy % 2**32)
    print("seed", seed)
    random = np.random.default_rng(seed)
    for rate, file_rate in [(25, 30), (24, 30), (25, 60), (24, 60), (30, 60), (25, 50), (15, 30)]:
        n = 240
        times = np.arange(n) / file_rate
        count = np.floor(times * rate + random.uniform(0.0, 1.0) + 1e-9)
        new = np.diff(count, prepend=count[0] - 1) > 0
        moving = (np.arange(n) > 30) & (np.arange(n) < 200)
        changes = np.where(new & moving, random.uniform(60, 90, n), random.uniform(2, 5, n))
        clock = _clock.clock_of(times, changes)
        # where nothing moves, pictures may be told apart by the rate alone
        assert (clock.new == new)[moving].all(), (rate, file_rate)
        assert np.allclose(np.diff(clock.times), 1.0 / rate)
    # no rate explains repeats that come at random
    times, changes = np.arange(200) / 30.0, random.uniform(60, 90, 200)
    dropped = np.sort(random.choice(np.arange(20, 180, 4), 12, replace=False))
    changes[dropped] = 3.0
    clock = _clock.clock_of(times, changes)
    assert (np.flatnonzero(~clock.new) == dropped).all() and "no regular pace" in clock.notes[0]
    assert np.allclose(clock.times, np.delete(times, dropped))
    # and a file that left them out has times of its own
    clock = _clock.clock_of(np.delete(times, dropped), np.full(188, 70.0))
    assert clock.new.all() and "left out 12 pictures, at 12 places" in clock.notes[0]


def test_cameras():
    """A place that is projected comes back; evidence without noise gives the camera back."""
    seed = int(np.random.SeedSequence().entropy % 2**32)
    print("seed", seed)
    random = np.random.default_rng(seed)
    bed = film.bed_of("snooker")
    for _ in range(8):
        turn = random.uniform(0.0, 2.0 * np.pi)
        eye = [0.9 + 3.5 * np.cos(turn), 1.8 + 4.5 * np.sin(turn), random.uniform(2.5, 4.0)]
        scene = draw.Film.__new__(draw.Film)
        scene.place(eye, (0.9, 1.8, 0.0), random.uniform(900, 1600), random.uniform(-0.1, 0.05))
        corners = np.column_stack([bed.corners, np.full(4, bed.nose)])
        start = _camera.begin(scene.pixels(corners), bed.corners, bed.nose, scene.size)
        points = random.uniform([0, 0], [W, L], (60, 2))
        evidence = []
        for height in (0.0262, bed.nose):
            seen = scene.pixels(np.column_stack([points, np.full(60, height)]))
            for axis in np.eye(2):
                normals = np.tile(axis, (60, 1))
                evidence.append(
                    _camera.Evidence.uniform(seen, height, normals, points @ axis, (0.01, 0.0))
                )
        joined = _camera.Evidence.join(evidence)
        camera, _, _ = _camera.fit(start, joined, bed.depth, None, None)
        assert np.abs(camera.eye - eye).max() < 2e-3
        assert abs(camera.numbers[7] - scene.k1) < 2e-3
        back = camera.places(camera.project(np.column_stack([points, np.full(60, 0.03)])), 0.03)
        assert np.abs(back - points).max() < 1e-6


def rolled(colour, white, begin, end, places):
    """A path of a ball with these colours over frames, which moves between two positions from 1 s
    to 2 s after its begin.
    """
    path = _paths.Path(list(range(begin, end)))
    part = np.clip(np.arange(end - begin) / 25.0 - 1.0, 0.0, 1.0)[:, np.newaxis]
    rows = np.zeros(end - begin, blob)
    rows["place"] = (1.0 - part) * places[0] + part * np.array(places[1])
    rows["share"], rows["colour"], rows["white"], rows["whole"] = 1.0, colour, white, True
    path.blobs = list(rows)
    return path


def test_names_belong_to_a_shot_and_a_shot_has_a_cue_ball():
    """The balls of a second layout have the colours of the first, in less light."""
    white, yellow = (225.0, 235.0, 240.0), (10.0, 190.0, 235.0)
    lies = [(0.9, 1.9), (0.9, 1.9)]
    paths = [
        rolled(white, 0.95, 0, 100, [(0.3, 0.5), (0.6, 1.2)]),
        rolled(yellow, 0.1, 0, 100, lies),
        rolled(np.multiply(white, 0.8), 0.95, 150, 250, [(0.7, 0.5), (0.4, 0.9)]),
        rolled(np.multiply(yellow, 0.8), 0.1, 150, 250, lies),
        # a ball is pushed, and no cue ball is there
        rolled(yellow, 0.1, 300, 400, [(0.5, 0.5), (0.5, 0.9)]),
    ]
    clock, notes = _clock.Clock(np.ones(400, bool), np.arange(400) / 25.0, []), []
    shots, begins = film._shots("9ft", paths, clock, film.bed_of("9ft"), notes)
    assert [(shot.id, sorted(shot.balls)) for shot in shots] == [
        ("s1", ["1", "cue"]),
        ("s2", ["1", "cue"]),
    ]
    assert len(begins) == 2 and notes == ["s3: no cue ball was found; the shot is left out"]


def test_a_ball_that_a_cue_seems_to_touch_lay_there():
    """A ball is first seen alone while it moves; before, a cue's blob had a round part."""
    times, radius = np.arange(60) / 30.0, 0.0286
    moved = rolled((225.0, 235.0, 240.0), 0.95, 20, 60, [(0.5, 0.5), (0.5, 0.5)])
    for k, row in enumerate(moved.blobs):
        row["place"] = 0.55 + 0.05 * k, 0.5
    found = [np.array([moved.blobs[k - 20]]) if k >= 20 else np.zeros(0, blob) for k in range(60)]
    lies = np.zeros(1, blob)
    lies["place"], lies["colour"] = (0.5, 0.5), (225.0, 235.0, 240.0)
    lies["white"], lies["share"], lies["whole"] = 0.95, 1.0, True
    hand = lies.copy()
    hand["place"], hand["colour"], hand["white"] = (0.45, 0.5), (120.0, 150.0, 205.0), 0.0
    parts = [np.concatenate([hand, lies]) if k < 20 else hand for k in range(60)]
    (path,) = _paths.linked(found, parts, times, radius)
    assert path.numbers == list(range(60)) and np.allclose(path.places[:20], [0.5, 0.5])
    # a part elsewhere, or of another colour, is another thing
    (path,) = _paths.linked(found, [hand] * 60, times, radius)
    assert path.numbers == list(range(20, 60))


def test_the_struck_ball_is_the_cue_ball():
    """A striped ball that shows its white looks as white as the cue ball in blue light."""
    colours = np.array([[67.0, 102.0, 72.0], [134.0, 134.0, 69.0], [61.0, 52.0, 23.0]])
    whites, lengths = np.array([0.86, 0.81, 0.24]), np.array([152.0, 148.0, 152.0])
    assert _names.names_of("9ft", colours, whites, lengths, 1)[1] == "cue"
    assert "cue" not in _names.names_of("9ft", colours, whites, lengths, 2)[2:]
    # in a shot, the ball that moves first
    paths = [
        rolled(colours[0], 0.86, 0, 100, [(0.9, 1.9), (0.9, 1.9)]),
        rolled(colours[1], 0.81, 0, 100, [(0.3, 0.5), (0.6, 1.2)]),
    ]
    clock, notes = _clock.Clock(np.ones(100, bool), np.arange(100) / 25.0, []), []
    (shot,), _ = film._shots("9ft", paths, clock, film.bed_of("9ft"), notes)
    assert len(shot.tracks[shot.balls.index("cue")]) > 20


def test_a_cue_ball_that_is_first_seen_moving_loses_its_shot():
    """Also in a film that begins with the strike, 0.2 s before the cue ball is seen."""
    white, yellow = (225.0, 235.0, 240.0), (10.0, 190.0, 235.0)
    paths = [
        rolled(white, 0.95, 0, 100, [(0.3, 0.5), (0.6, 1.2)]),
        rolled(yellow, 0.1, 0, 100, [(0.9, 1.9), (0.9, 1.5)]),
    ]
    for path, first in zip(paths, (30, 25)):
        path.numbers, path.blobs = list(range(first - 25, 75)), path.blobs[first:]
    clock, notes = _clock.Clock(np.ones(75, bool), np.arange(75) / 25.0, []), []
    assert film._shots("9ft", paths, clock, film.bed_of("9ft"), notes)[0] == []
    assert notes[-2:] == [
        "s1: cue was first seen moving, and is left out",
        "s1: no cue ball was found; the shot is left out",
    ]


def test_tables_of_another_size():
    """Pockets stay at their corners and in the middles of the sides."""
    usual, bed = film.bed_of("9ft"), film.bed_of("9ft", (1.17, 2.34))
    assert (bed.width, bed.length, bed.nose) == (1.17, 2.34, usual.nose)
    for (x, y, radius), (p, q, reach) in zip(bed.pockets, usual.pockets, strict=True):
        ends = np.round([p / usual.width, 2.0 * q / usual.length])
        assert np.allclose(
            [x, y], [p + ends[0] * (1.17 - usual.width), q + ends[1] * 0.5 * (2.34 - usual.length)]
        )
        assert radius == reach
    with pytest.raises(
        ValueError, match=r"size: \(50, 100\) are not the extents of such a table, m"
    ):
        film.bed_of("9ft", (50, 100))
    clip = ("-m", "carom.film", "missing.mp4", "--table", "9ft")
    assert "'2' is not a size; use W,L in m" in run_python(*clip, "--size", "2", status=2).stderr
    assert "of such a table" in run_python(*clip, "--size", "9,9", status=2).stderr


def test_a_shot_whose_cue_ball_lies_still_is_left_out():
    """The ball that was named so by its colour is another."""
    white, yellow = (225.0, 235.0, 240.0), (10.0, 190.0, 235.0)
    paths = [
        rolled(white, 0.95, 0, 100, [(0.3, 0.5), (0.3, 0.5)]),
        rolled(yellow, 0.1, 0, 100, [(0.9, 1.9), (0.9, 1.5)]),
    ]
    clock, notes = _clock.Clock(np.ones(100, bool), np.arange(100) / 25.0, []), []
    assert film._shots("9ft", paths, clock, film.bed_of("9ft"), notes)[0] == []
    assert notes == ["s1: what is named cue does not move; the shot is left out"]
