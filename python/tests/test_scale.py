"""The recipes of docs/python.md: Dask and xarray over collide, and a batch of shots over a cluster of two worker processes."""

import numpy as np
import pytest

import carom


def shots_of(cues):
    """What a worker does: its own table and layout, the cues of its part."""
    table = carom.tables.pool_9ft()
    shots = carom.simulate_batch(table, carom.racks.nineball(table), cues, cushion_model="han")
    return shots.final, shots.status


def test_dask_array(impacts):
    array = pytest.importorskip("dask.array", reason="Dask is not installed")
    chunked = array.from_array(np.tile(impacts, (20, 1)), chunks=(1000, 26))
    motion, status = array.apply_gufunc(carom.collide, "(i)->(j),()", chunked, output_sizes={"j": 12}, output_dtypes=[float, np.int8])
    expected = carom.collide(np.tile(impacts, (20, 1)))
    np.testing.assert_array_equal(motion.compute(), expected.motion)
    np.testing.assert_array_equal(status.compute(), expected.status)


def test_xarray(impacts):
    xarray = pytest.importorskip("xarray", reason="xarray is not installed")
    given = xarray.DataArray(impacts.reshape(4, 51, 26), dims=("speed", "angle", "field"))
    motion, status = xarray.apply_ufunc(carom.collide, given, input_core_dims=[["field"]], output_core_dims=[["motion"], []])
    assert motion.dims == ("speed", "angle", "motion") and status.dims == ("speed", "angle")
    np.testing.assert_array_equal(motion.values.reshape(204, 12), carom.collide(impacts).motion)


def test_two_worker_processes(tmp_path):
    distributed = pytest.importorskip("distributed", reason="Dask's distributed is not installed")
    cues = carom.cue(speed=8.0, phi=np.linspace(85.0, 95.0, 60))
    expected, status = shots_of(cues)
    cluster = distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, local_directory=str(tmp_path)
    )
    with cluster, distributed.Client(cluster) as client:
        parts = client.gather(client.map(shots_of, np.array_split(cues, 6)))
    assert np.concatenate([final for final, _ in parts]).tobytes() == expected.tobytes()
    assert np.concatenate([part for _, part in parts]).tobytes() == status.tobytes()
