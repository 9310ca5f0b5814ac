"""The recipes of docs/using/scale.md: Dask and xarray over collide, and a batch of shots over
clusters of two worker processes.
"""

import importlib.util
import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from conftest import run_python
from numpy.testing import assert_array_equal

import carom

TABLE = carom.tables.pool_9ft()
EXAMPLE = Path(__file__).parents[2] / "examples" / "on_a_cluster.py"


@pytest.mark.release  # which installs Dask
def test_dask(impacts):
    array = pytest.importorskip("dask.array", reason="Dask is not installed")
    expected, chunked = carom.collide(impacts), array.from_array(impacts, chunks=(50, 26))
    motion, status = array.apply_gufunc(
        carom.collide,
        "(i)->(j),()",
        chunked,
        output_sizes={"j": 12},
        output_dtypes=[float, np.int8],
    )
    assert_array_equal(motion.compute(), expected.motion)
    assert_array_equal(status.compute(), expected.status)


def test_xarray(impacts):
    xarray = pytest.importorskip("xarray", reason="xarray is not installed")
    expected = carom.collide(impacts)
    labelled = xarray.DataArray(impacts.reshape(4, 51, 26), dims=("speed", "angle", "field"))
    motion, status = xarray.apply_ufunc(
        carom.collide, labelled, input_core_dims=[["field"]], output_core_dims=[["motion"], []]
    )
    assert motion.dims == ("speed", "angle", "motion") and status.dims == ("speed", "angle")
    assert_array_equal(motion.values.reshape(204, 12), expected.motion)


def test_tables_of_arrow_in_bounded_memory():
    """A batch in parts has the rows of one; ten times the shots need no more memory."""
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    pandas, layout, cues = (
        pytest.importorskip("pandas"),
        carom.balls([[0.6, 0.8]]),
        carom.cue(speed=[[1.0], [9e9]], phi=[70.0, 80.0, 90.0]),
    )
    rows = carom.simulate_arrow(TABLE, layout, cues, at_once=4, features=True).read_pandas()
    assert rows.pop("shot").tolist() == [*range(6)] and rows["status"][4] == "error_cue_speed"
    pandas.testing.assert_frame_equal(
        rows,
        carom.simulate_batch(TABLE, layout, cues, features=True)
        .to_dataframe()
        .reset_index(drop=True),
    )

    def peak(parts):
        drawn = (carom.cue(speed=np.linspace(0.5, 2.0, 2000)) for _ in range(parts))
        tracemalloc.start()
        assert (
            sum(batch.num_rows for batch in carom.simulate_arrow(TABLE, layout, drawn, at_once=500))
            == 2000 * parts
        )
        most = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        return most

    assert peak(20) < 1.2 * peak(2)


def digest_of(*arguments):
    """What examples/on_a_cluster.py prints as the digest of the same small batch."""
    done = run_python(EXAMPLE, "--shots", 300, "--parts", 6, *arguments)
    name, digest = done.stdout.splitlines()[-1].split()
    assert name == "digest:" and len(digest) == 64
    return digest


def test_parts_of_a_batch_follow_its_seed():
    """The parts of the example, in one process."""
    digest = digest_of("--by", "local")
    assert digest_of("--by", "local", "--parts", "3", "--threads", "2") != digest
    assert digest_of("--by", "local", "--threads", "2") == digest
    assert digest_of("--by", "local", "--seed", "2") != digest


@pytest.mark.release  # which installs Dask and Ray
@pytest.mark.parametrize("way", ["dask", "ray"])
def test_two_worker_processes(way):
    """A batch over a cluster of two worker processes has the bits that it has in one process."""
    package = {"dask": "distributed", "ray": "ray"}[way]
    if importlib.util.find_spec(package) is None:
        pytest.skip(f"{package} is not installed")
    assert digest_of("--by", way, "--workers", "2") == digest_of("--by", "local")
