"""Batches are indexed as NumPy indexes their array `status`, in every form and every dimension."""

import pickle

import numpy as np
import pytest
from conftest import same_bits

import carom

TABLE = carom.tables.pool_9ft()
BALLS = carom.balls([[0.6, 0.8], [0.75, 1.6]])
SHAPES = [(), (5,), (1,), (4, 6), (2, 3, 2), (0,), (2, 0)]


def batch(shape, **options):
    speeds = np.linspace(1.0, 3.0, max(int(np.prod(shape)), 1))[: int(np.prod(shape))]
    cues = carom.cue(speed=speeds.reshape(shape), phi=80.8)
    return carom.simulate_batch(TABLE, BALLS, cues, features=True, **options)


@pytest.fixture(scope="module", params=[0, 64], ids=["room=0", "room=64"])
def batches(request):
    return {shape: batch(shape, room=request.param) for shape in SHAPES}


def indices(shape):
    """Every form of an index that NumPy has, right and wrong ones, for an array of a shape."""
    n = len(shape)
    mask = np.random.default_rng(1).random(shape) < 0.5
    yield from [
        (),
        ...,
        None,
        (None,),
        (..., None),
        (None, ...),
        True,
        False,
        np.True_,
        0,
        -1,
        1,
        np.int8(-1),
        np.array(0),
        99,
        -99,
        1.0,
        "a",
        "time",
        b"r",
        object(),
        slice(None),
        slice(1, None),
        slice(None, None, -1),
        slice(2, 1),
        slice(-2, 99),
        [0],
        [0, -1],
        [],
        [99],
        np.array([0, 0]),
        np.zeros((0,), int),
        np.array([0.5]),
        [True],
        [False],
        np.ones(1, bool),
        np.ones(99, bool),
        mask,
        ~mask,
        mask.tolist(),
        (..., 0),
        (..., -1),
        (..., [0]),
        (0, ...),
        (..., slice(None, 1)),
        (..., ..., 0),
        (0,) * n,
        (-1,) * n,
        (0,) * (n + 1),
        (slice(None),) * n,
        (slice(None),) * (n + 1),
        (np.array(0),) * n,
        ([0, -1],) * n,
        (None, 0),
        (0, None),
        (0, None, ...),
        (mask, None),
        (None, mask),
        (mask, ...),
        (..., mask),
        (mask, 0),
        ([[0], [0]],),
    ]
    if n < 2:
        return
    yield from [
        (slice(None), 1),
        (slice(None), -1, None),
        ([0, 1], slice(None)),
        (1, ..., 0),
        (slice(None), [1, 0]),
        (..., [1, 0]),
        ([0], ..., [0]),
        mask.any(axis=-1),
        np.ix_(*([0, -1] for _ in shape)),
        np.ix_(mask.any(axis=(1, 2)[: n - 1]), *([0] for _ in shape[1:])),
        (np.newaxis, slice(None), None, [0, 1]),
        (0, [1, 0]),
        ([1, 0], 0),
        (1, True),
    ]
    if n < 3:
        return
    yield from [
        (0, slice(None), [0, 1]),
        ([0, 1], slice(None), [0, 1]),
        (..., 0, None),
        (slice(None), mask[0]),
        (mask[..., 0], 1),
        (1, ..., [0]),
    ]


def numpy_s(array, index):
    """What NumPy gives, or the class of its error."""
    try:
        return array[index]
    except Exception as error:
        return type(error)


@pytest.mark.parametrize("shape", SHAPES, ids=str)
def test_every_index_is_numpy_s(batches, shape):
    shots = batches[shape]
    places = np.arange(shots.size).reshape(shape)
    forms = 0
    for index in indices(shape):
        expected, found = numpy_s(places, index), numpy_s(shots, index)
        context = (shape, index)
        forms += 1
        if isinstance(expected, type):
            assert found is expected, context
        elif not isinstance(expected, np.ndarray):
            assert isinstance(found, carom.Shot), context
            assert found.time == shots.time.flat[expected], context
            assert same_bits(found.final, shots.final.reshape(-1, 2)[expected]), context
            assert found.cue["speed"] == shots.cues["speed"].flat[expected], context
            assert same_bits(found.balls, BALLS) and found.positions(0.3).shape == (2, 3)
        else:
            assert isinstance(found, carom.Shots) and found.shape == expected.shape, context
            compared(shots, found, expected, context)
    assert forms > 50


def compared(shots, part, places, context):
    """Every array of a part is that of the whole at these places."""
    shape = places.shape
    for name in ("status", "time", "count", "refused"):
        assert np.array_equal(getattr(part, name), getattr(shots, name).reshape(-1)[places]), (
            context
        )
    assert part.final.shape == (*shape, 2) and part.events.shape[:-1] == shape, context
    assert same_bits(part.final, shots.final.reshape(-1, 2)[places]), context
    cues = np.broadcast_to(shots.cues, shots.shape).reshape(-1)[places]
    assert np.array_equal(np.broadcast_to(part.cues, shape), cues), context
    assert np.broadcast_to(part.layouts, part.final.shape).shape == (*shape, 2), context
    events = shots.events.reshape(shots.size, shots.events.shape[-1])[places]
    assert same_bits(part.events["time"], events["time"]), context
    where = shots.features.contact_time.reshape(shots.size, 2)[places]
    assert same_bits(part.features.contact_time, where), context
    seen = shots.positions([0.2, 0.5]).reshape(-1, 2, 2, 3)[places]
    assert np.array_equal(part.positions([0.2, 0.5]), seen), context


@pytest.mark.parametrize("shape", SHAPES, ids=str)
def test_features_are_indexed_as_their_shots(batches, shape):
    shots = batches[shape]
    for index in indices(shape):
        if not isinstance(numpy_s(shots.status, index), type):
            found, expected = shots.features[index], shots[index]
            if isinstance(expected, carom.Shots):
                assert found.pocket.shape == expected.features.pocket.shape, index
                assert same_bits(found.contact, expected.features.contact), index


@pytest.mark.parametrize("shape", [(5,), (4, 6), (2, 3, 2)], ids=str)
def test_tables_of_a_part(batches, shape):
    pandas, arrow = pytest.importorskip("pandas"), pytest.importorskip("pyarrow")
    xarray = pytest.importorskip("xarray")
    shots = batches[shape]
    places = np.arange(shots.size).reshape(shape)
    whole = shots.to_dataframe().reset_index(drop=True)
    for index in [..., (..., 1), (..., slice(None, 1)), (..., None), [0, -1], places % 3 == 1, 1]:
        rows, part = places[index], shots[index]
        if not isinstance(part, carom.Shots):
            continue
        frame = part.to_dataframe().reset_index(drop=True)
        pandas.testing.assert_frame_equal(
            frame, whole.iloc[rows.ravel()].reset_index(drop=True), check_index_type=False
        )
        table = part.to_arrow()
        assert isinstance(table, arrow.Table) and table.num_rows == rows.size
        assert arrow.table(part).equals(table, check_metadata=True)
        assert table["ball_1_r_y"].to_pylist() == whole["ball_1_r_y"][rows.ravel()].tolist()
        data = part.to_xarray()
        assert isinstance(data, xarray.Dataset) and data["r"].shape == (*rows.shape, 2, 3)
        assert (
            data["cue_speed"].values.ravel().tolist() == whole["cue_speed"][rows.ravel()].tolist()
        )


def test_tables_have_units():
    pytest.importorskip("pyarrow")
    pytest.importorskip("xarray")
    shots = batch((4,))
    schema = shots.to_arrow().schema
    units = {field.name: (field.metadata or {}).get(b"units", b"").decode() for field in schema}
    expected_units = {"time": "s", "cue_speed": "m/s", "cue_phi": "degree", "ball_1_r_x": "m"}
    expected_units |= {
        "ball_0_w_z": "rad/s",
        "pocket_time_1": "s",
        "contact_time_0": "s",
        "cue_mass": "kg",
    }
    expected_units |= {"count": "", "shot": "", "cue_a": "", "ball_0_label": "", "contact_0": ""}
    assert {name: units[name] for name in expected_units} == expected_units
    reader = carom.simulate_arrow(TABLE, BALLS, carom.cue(speed=[1.0, 2.0]))
    assert reader.schema.field("ball_0_v_y").metadata == {b"units": b"m/s"}
    data = shots.to_xarray(["speed"])
    assert data["speed"].attrs == {"units": "m/s"} and data["r"].attrs == {"units": "m"}
    assert data["time"].attrs == {"units": "s"} and "units" not in data["ball"].attrs


def test_a_shot_on_axes_of_matplotlib():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    pyplot = pytest.importorskip("matplotlib.pyplot")
    shot = carom.simulate(TABLE, BALLS, carom.cue(speed=2.0, phi=80.8))
    figure, axes = pyplot.subplots(1, 2)
    assert shot.plot(ax=axes[1]) is axes[1] and TABLE.plot(axes[0]) is axes[0]
    assert axes[1].get_xlabel() == "x, m"
    paths = axes[1].lines[len(TABLE.rails) :]
    assert len(paths) == len(BALLS)
    for ball, line in enumerate(paths):
        assert np.allclose(
            line.get_xydata()[[0, -1]], shot.positions([0.0, shot.time])[:, ball, :2]
        )
    pyplot.close(figure)


@pytest.mark.parametrize("shape", [(5,), (4, 6), (2, 3, 2), (0,)], ids=str)
def test_a_batch_is_a_sequence_as_arrays_are(batches, shape):
    shots = batches[shape]
    assert len(shots) == len(shots.status) and len(list(shots)) == len(shots)
    assert (shots.ndim, shots.size, shots.shape) == (len(shape), shots.status.size, shape)
    for k, part in enumerate(shots):
        assert type(part) is type(shots[k]) and np.array_equal(part.time, shots[k].time)
    assert [shot.time for shot in shots.flat] == shots.time.ravel().tolist()


def test_a_batch_of_no_dimensions_is_no_sequence(batches):
    shots = batches[()]
    for use in (len, iter, list):
        with pytest.raises(TypeError):
            use(shots)
    assert [shot.time for shot in shots.flat] == [float(shots.time)] == [shots[()].time]


def test_slices_are_views():
    shots = batch((4, 6), room=8)
    part = shots[1:, ..., ::2]
    assert np.shares_memory(part.final, shots.final) and np.shares_memory(part.status, shots.status)
    assert not np.shares_memory(shots[[0, 1]].final, shots.final)


def test_one_layout_stays_one():
    """A part of many shots from one layout takes no memory for its layouts."""
    shots = batch((4, 6))
    for part in (shots[1:], shots[[0, 2]], shots[shots.status == 0], shots[..., None]):
        assert part.layouts.size == 2


def test_what_later_calls_read_cannot_be_written_to():
    shots = batch((3,), room=64)
    single = carom.simulate(TABLE, BALLS, carom.cue(speed=2.0, phi=80.8))
    for shot in (single, shots[1]):
        for array in (shot.events, shot.balls, shot.cue, shot.table.record):
            assert not array.flags.writeable
    with pytest.raises(ValueError, match="read-only"):
        single.events["time"] = 0.0
    for array in (shots.time, shots.count, TABLE.rails, TABLE.jaws, TABLE.pockets, TABLE.record):
        assert not array.flags.writeable
    assert single.events.copy().flags.writeable


def test_tables_and_options_hash_and_compare():
    same = carom.tables.pool_9ft()
    assert same == TABLE and hash(same) == hash(TABLE) and len({same, TABLE}) == 1
    assert hash(pickle.loads(pickle.dumps(TABLE))) == hash(TABLE)
    assert not pickle.loads(pickle.dumps(TABLE)).record.flags.writeable
    rails = TABLE.rails.copy()
    rails["restitution"] = 0.7
    table = TABLE.changed(rails=rails)
    assert table != TABLE and (table.rails["restitution"] == 0.7).all()
    assert len({table, TABLE, carom.tables.snooker()}) == 3
    with pytest.raises(
        TypeError,
        match=r"table: unknown parameter 'rail'; did you mean 'rails'\? Use width, length, ball_radius, rail_width, pocket_back, slope_x, slope_y,",
    ):
        TABLE.changed(rail=rails)
    # -0.0 equals 0.0
    minus = TABLE.changed(jaws=TABLE.jaws, pockets=TABLE.pockets, rail_width=-0.0)
    assert minus == TABLE.changed(rail_width=0.0) and hash(minus) == hash(TABLE)
    options = carom.Options(cushion_model="han", first_of=[1, 2], stop_at=["rail"])
    assert options == carom.Options(cushion_model="han", first_of=(1, 2), stop_at=("rail",))
    assert (
        len({options, carom.Options(cushion_model="han", first_of=(1, 2), stop_at=("rail",))}) == 1
    )
