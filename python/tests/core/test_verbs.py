"""Files of shots, tables of states, first events, potted balls, racks in arrays, and moving pictures."""

import importlib.util
import sys
import types
from pathlib import Path

import numpy as np
import pytest
from conftest import run_python, same_bits

import carom

TABLE = carom.tables.pool_9ft()
RACK = carom.racks.nineball(TABLE)
MATHAVAN = carom.racks.nineball(TABLE, cushion_model="mathavan")
BREAK = carom.cue(speed=8.0)


@pytest.fixture(scope="module")
def shot():
    return carom.simulate(TABLE, RACK, BREAK)


@pytest.fixture(scope="module")
def shots():
    cues = carom.cue(speed=8.0, phi=np.linspace(85.0, 95.0, 6).reshape(2, 3))
    return carom.simulate_batch(TABLE, RACK, cues, room=400)


# ---- Files


def of_pooltool():
    balls = carom.balls([[0.3, 0.5], [0.6, 1.5]], game="pooltool_pool")
    cue = carom.cue(speed=3.0, phi=75, game="pooltool_pool")
    return carom.simulate(carom.tables.pooltool(), balls, cue, world="pooltool")


def without_a_strike():
    balls = carom.balls([[0.3, 0.5], [0.6, 1.5]], v=[[1.0, 0.5, 0.0], [0.0, 0.0, 0.0]])
    return carom.simulate(TABLE, balls)


def resumed():
    part = carom.simulate(TABLE, RACK, BREAK, stop_at="contact")
    later = carom.resume(part, stop_at="rail")
    return carom.resume(later, t_final=later.time + 0.5)


def continued():
    return carom.resume(carom.simulate(TABLE, RACK, BREAK, stop_at="contact"), stop_at="contact")


@pytest.mark.parametrize(
    "play",
    [
        lambda: carom.simulate(TABLE, RACK, BREAK),
        lambda: carom.simulate(TABLE, MATHAVAN, BREAK, cushion_model="mathavan", space="flat"),
        lambda: carom.simulate(TABLE, RACK, BREAK, t_final=0.3),
        of_pooltool,
        without_a_strike,
        resumed,
        continued,
    ],
)
def test_a_shot_is_read_as_it_was_written(play, tmp_path):
    shot, path = play(), tmp_path / "shot.carom"
    shot.save(path)
    again = carom.load(path)
    assert type(again) is carom.Shot and again.status == shot.status
    for name in ("events", "final", "balls"):
        assert same_bits(getattr(again, name), getattr(shot, name)), name
    assert again.cue == shot.cue and again.time == shot.time
    assert again.table == shot.table
    assert all(replayed.same for replayed in carom.record.replay(path))
    if shot.status > 0:  # stopped: it can be resumed
        assert same_bits(carom.resume(again).final, carom.resume(shot).final)


def test_a_batch_is_read_as_it_was_written(shots, tmp_path):
    path = tmp_path / "shots.carom"
    shots.save(path)
    flat = carom.load(path)
    assert type(flat) is carom.Shots and flat.shape == (6,) and flat.events.shape == (6, 0)
    again = carom.load(path, shape=(2, 3), room=400, features=True)
    assert same_bits(again.events, shots.events) and same_bits(again.final, shots.final)
    assert again.features.contact.shape == (2, 3, 2)
    assert carom.load(path, shape=6).shape == (6,)
    shots[0, 0].save(path)
    assert carom.load(path).count == shots[0, 0].count
    assert carom.load(path, shape=1).shape == (1,)


def test_a_shot_that_ended_in_an_error(tmp_path):
    cues = carom.cue(speed=12.0, phi=90.0, theta=[0.0, 40.0])
    balls = carom.balls([[0.6, 2.3]])
    shots = carom.simulate_batch(TABLE, balls, cues)
    shots.save(tmp_path / "a.carom")
    again = carom.load(tmp_path / "a.carom")
    assert (again.status == shots.status).all() and same_bits(again.final, shots.final)


def test_what_cannot_be_saved(shots, tmp_path):
    path = tmp_path / "a.carom"
    layouts = np.stack([RACK, RACK])
    layouts["state"]["r"][1, 1] = layouts["state"]["r"][1, 0]
    some = carom.simulate_batch(TABLE, layouts, BREAK)
    with pytest.raises(ValueError, match=r"shots\[1\]: it was not played.*overlap.*~shots.refused"):
        some.save(path)
    assert not path.exists()
    some[~some.refused].save(path)
    assert carom.load(path, shape=(1,)).shape == (1,)
    changed = carom.simulate(TABLE, RACK, BREAK)
    changed.final["r"][0, 0] += 1e-9
    with pytest.raises(ValueError, match="shot: playing it again results in other bits"):
        changed.save(path)
    with pytest.raises(ValueError, match="the batch is empty"):
        shots[:0].save(path)


def test_what_cannot_be_loaded(shot, shots, tmp_path):
    path = tmp_path / "a.carom"
    shot.save(path)
    text = path.read_text()
    path.write_text(text.replace('"speed":8', '"speed":9'))
    with pytest.raises(carom.CaromError, match="shot 1 has other bits"):
        carom.load(path)
    path.write_text("".join(text.splitlines(keepends=True)[:-1]))
    with pytest.raises(carom.CaromError, match="cut off"):
        carom.load(path)
    shots.save(path)
    with pytest.raises(ValueError, match=r"shape: \(4,\) is not the shape of the 6 shots"):
        carom.load(path, shape=4)
    continued().save(path)
    with pytest.raises(ValueError, match="its shot is continued"):
        carom.load(path, shape=1)
    with pytest.raises(FileNotFoundError):
        carom.load(tmp_path / "none.carom")


# ---- Tables of states


def test_states_as_a_table(shot, shots):
    pytest.importorskip("pandas", reason="pandas is not installed")
    frame = shot.to_dataframe(dt=0.5)
    times = np.append(np.arange(0.0, shot.time, 0.5), shot.time)
    assert len(frame) == 10 * len(times) and list(frame.columns[:3]) == ["time", "ball", "r_x"]
    np.testing.assert_array_equal(frame["time"], np.repeat(times, 10))
    last = frame[frame["time"] == shot.time]
    np.testing.assert_array_equal(last["r_y"], shot.final["r"][:, 1])
    assert set(last["label"]) <= {"stationary", "pocketed", "off"}
    many = shots.to_dataframe(["row", "column"], dt=1.0)
    assert list(many.columns[:4]) == ["row", "column", "time", "ball"]
    one = many[(many["row"] == 1) & (many["column"] == 2) & (many["time"] == 1.0)]
    np.testing.assert_array_equal(one[["r_x", "r_y", "r_z"]], shots[1, 2].positions(1.0))
    for dt in (0.0, -1.0, np.nan, np.inf):
        with pytest.raises(ValueError, match="dt: it must be positive"):
            shot.to_dataframe(dt=dt)
    with pytest.raises(ValueError, match="dt: .* rows"):
        shot.to_dataframe(dt=1e-9)


# ---- First events, and potted balls


def test_first_events(shots):
    hits = shots.first("ball_ball", ball=0)
    for index in np.ndindex(2, 3):
        events = shots[index].events
        mine = (events["a"] == 0) | (events["b"] == 0)
        found = np.flatnonzero((events["type"] == carom.EventType.BALL_BALL) & mine)
        if len(found) == 0:
            assert hits.index[index] == -1 and np.isnan(hits.time[index])
            assert np.isnan(hits.before["v"][index]).all() and hits.other[index] == -1
            continue
        event = events[found[0]]
        side = 0 if event["a"] == 0 else 1
        assert hits.index[index] == found[0] and hits.time[index] == event["time"]
        assert same_bits(hits.before[index], event["before"][side])
        assert same_bits(hits.after[index], event["after"][side])
        assert hits.other[index] == event["b" if side == 0 else "a"]
    rolls = shots.first("sliding_rolling", ball=0, after=hits.time)
    assert (rolls.time > hits.time)[rolls.index >= 0].all()
    one = shots[0, 1].first("rail")
    assert one.time.shape == () and one.time == shots.first("rail").time[0, 1]


def test_first_events_need_events(shots):
    with pytest.raises(ValueError, match="kind: unknown value 'collision'.*'ball_ball'"):
        shots.first("collision")
    with pytest.raises(ValueError, match="ball: 10 is not .* 0 to 9"):
        shots.first("rail", ball=10)
    few = carom.simulate_batch(TABLE, RACK, BREAK, room=3)
    assert few.first("strike").time == 0.0
    with pytest.raises(ValueError, match=r"3 were kept.*room=\d+"):
        few.first("pocket")
    brief = carom.simulate_batch(TABLE, RACK, BREAK, room=3, records="brief")
    with pytest.raises(ValueError, match='records="full"'):
        brief.first("strike")


def test_potted(shots):
    down = shots.final["label"] == carom.Label.POCKETED
    assert (shots.potted() == down).all() and down.any()
    assert (shots.potted(3) == down[..., 3]).all()
    assert (shots.potted([1, 2]) == down[..., 1:3]).all()
    assert (shots[0, 1].potted() == down[0, 1]).all()
    layout = RACK.copy()
    layout["state"]["label"][4] = carom.Label.POCKETED
    layout["state"]["r"][4, 2] = -0.1
    assert not carom.simulate(TABLE, layout, BREAK).potted(4)
    for wrong in (10, -1, 0.5, "x"):
        with pytest.raises(ValueError, match="ball: indices from 0 to 9"):
            shots.potted(wrong)


# ---- Racks


def test_racks_in_arrays():
    gaps, seeds = [[1e-5], [1e-4]], np.arange(3)
    places = np.array([[0.4, 0.5], [0.6, 0.5], [0.8, 0.5]])
    many = carom.racks.nineball(TABLE, gap=gaps, seed=seeds, cue_ball=places)
    assert many.shape == (2, 3, 10)
    for i, j in np.ndindex(2, 3):
        alone = carom.racks.nineball(TABLE, gap=gaps[i][0], seed=int(seeds[j]))
        assert same_bits(many[i, j, 1:], alone[1:])
        assert (many[i, j, 0]["state"]["r"][:2] == places[j]).all()
    moved = carom.racks.snooker(carom.tables.snooker(), cue_ball=(0.8, 0.5))
    assert moved.shape == (22,) and moved["state"]["r"][0, 0] == 0.8
    assert same_bits(carom.racks.nineball(TABLE, seed=np.uint64(1)), RACK)
    for changes, message in [
        ({"cue_ball": (0.635, 1.9)}, "in the way of ball 0"),
        ({"cue_ball": [0.1, 0.2, 0.3]}, r"cue_ball: the shape must be \(..., 2\)"),
        ({"cue_ball": 1}, "cue_ball: the shape"),
        ({"seed": [1, -1]}, "seed: "),
        ({"seed": 0.5}, "seed: "),
        ({"gap": [1e-4, 1.0]}, "gap"),
        ({"gap": [1e-4, 1e-3], "seed": [1, 2, 3]}, "broadcast"),
    ]:
        with pytest.raises(ValueError, match=message):
            carom.racks.nineball(TABLE, **changes)


# ---- Moving pictures


def test_frames(shot):
    short = carom.simulate(TABLE, RACK, BREAK, t_final=0.4)
    frames = list(short.animate(speed=0.5).frames(fps=5))
    assert len(frames) == 5 and all(frame.dtype == np.uint8 for frame in frames)
    assert (frames[0] != frames[1]).any() and frames[0].shape[2] == 3
    with pytest.raises(ValueError, match="fps: it must be positive"):
        next(short.animate().frames(fps=0))
    with pytest.raises(ValueError, match="fps: .* frames"):
        next(shot.animate().frames(fps=1e9))


def test_moving_files(tmp_path):
    short = carom.simulate(TABLE, RACK, BREAK, t_final=0.4)
    moving = short.animate()
    moving.save(tmp_path / "a.svg")
    assert (tmp_path / "a.svg").read_text(encoding="utf-8") == moving.svg
    with pytest.raises(ValueError, match=r"path: unknown ending '.avi'; use .svg, .gif or .mp4"):
        moving.save(tmp_path / "a.avi")
    image = pytest.importorskip("PIL.Image", reason="Pillow is not installed")
    moving.save(tmp_path / "a.gif", fps=30)
    with image.open(tmp_path / "a.gif") as gif:
        durations = []
        for k in range(gif.n_frames):
            gif.seek(k)
            durations.append(gif.info["duration"])
    assert gif.n_frames == 13 and sum(durations) == 430 and set(durations) <= {30, 40}
    with pytest.raises(ValueError, match="fps: a GIF has at most 50"):
        moving.save(tmp_path / "b.gif", fps=60)


@pytest.mark.skipif(
    importlib.util.find_spec("imageio_ffmpeg") is None, reason="imageio-ffmpeg is not installed"
)
def test_mp4(tmp_path):
    carom.simulate(TABLE, RACK, BREAK, t_final=0.2).animate().save(tmp_path / "a.mp4", fps=10)
    assert b"ftyp" in (tmp_path / "a.mp4").read_bytes()[:16]


@pytest.mark.parametrize(
    ("ending", "module", "package"),
    [("gif", "PIL", "pillow"), ("mp4", "imageio_ffmpeg", "imageio-ffmpeg")],
)
def test_a_package_that_is_missing_is_named(ending, module, package, monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, module, None)
    monkeypatch.setitem(sys.modules, f"{module}.Image", None)
    with pytest.raises(ImportError, match=f"a .{ending} needs {package}.*pip install {package}"):
        carom.simulate(TABLE, RACK, BREAK, t_final=0.1).animate().save(tmp_path / f"a.{ending}")


def test_show_opens_a_page(shot, shots, monkeypatch, tmp_path):
    opened = []
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.setattr("webbrowser.open", lambda address: opened.append(address) or True)
    shot.show(speed=2.0)
    shots.show()
    first, second = (Path(address.removeprefix("file://")).read_text() for address in opened)
    assert first.count("<svg") == 1 and "<animateTransform" in first and "ArrowLeft" not in first
    assert second.count("<svg") == 6 and "shots[1, 2]" in second and "ArrowLeft" in second
    with pytest.raises(ValueError, match="1 to 100 can be shown, not 0"):
        shots[:0].show()
    monkeypatch.setattr("webbrowser.open", lambda address: False)
    with pytest.warns(RuntimeWarning, match="no browser could be opened; the page is"):
        shot.show()


def test_show_displays_in_a_notebook(shot, monkeypatch):
    displayed = []
    shell = types.SimpleNamespace(kernel=1)
    python = types.SimpleNamespace(get_ipython=lambda: shell)
    display = types.SimpleNamespace(HTML=str, display=displayed.append)
    monkeypatch.setitem(sys.modules, "IPython", python)
    monkeypatch.setitem(sys.modules, "IPython.display", display)
    shot.show()
    assert len(displayed) == 1 and displayed[0].startswith("<figure><svg")


def test_parts_load_when_they_are_asked_for():
    run_python("-c", "import carom; carom.record.replay; assert not hasattr(carom, 'tables_of')")
