"""The recorded references of the repository's data/, as arrays, a count of calls, and values of the
wrong kind.
"""

import csv
import os
import re
import subprocess
import sys
import warnings
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

import carom

pytest.register_assert_rewrite("gradient_cases")

DATA = Path(__file__).parents[2] / "data"


# Whether the tests with the mark `release` run too, as they do before a release.
RELEASE = bool(os.environ.get("CAROM_RELEASE"))


def pytest_configure(config):
    config.addinivalue_line("markers", "release: takes long, and needs CAROM_RELEASE=1 to run")


def pytest_collection_modifyitems(config, items):
    later = [item for item in items if item.get_closest_marker("release") and not RELEASE]
    if later:
        config.hook.pytest_deselected(items=later)
        items[:] = [item for item in items if item not in later]


def columns(name: str, names: Sequence[str]) -> np.ndarray:
    """Columns of a file of data/, in the order wanted, as an array of rows."""
    with open(DATA / name, newline="", encoding="utf-8") as file:
        return np.array([[float(row[key]) for key in names] for row in csv.DictReader(file)])


def same_bits(a: np.ndarray, b: np.ndarray) -> bool:
    """Also of numbers that are none."""
    return a.tobytes() == b.tobytes()


def of_ball(ball: int) -> list[str]:
    """The columns of a ball before a collision."""
    motion = [f"{vector}{ball}{axis}" for vector in "rvw" for axis in "xyz"]
    return [*motion, "R", "M", f"u_s{ball}"]


MOTION = [f"{vector}{ball}{axis}" for ball in (1, 2) for vector in "vw" for axis in "xyz"]


@pytest.fixture(scope="session")
def impacts() -> np.ndarray:
    """The 204 recorded collisions, (204, 26)."""
    return columns("collisions-204.csv", [*of_ball(1), *of_ball(2), "u_b", "e_b"])


@pytest.fixture(scope="session")
def reference():
    """reference(name): the motion after the 204 collisions, (204, 12), by a file of data/."""
    return lambda name: columns(name, MOTION)


@pytest.fixture
def calls():
    """calls(function): how many functions Python calls while it runs, those written in C included."""

    def count(function) -> int:
        kinds = []
        sys.setprofile(lambda frame, kind, argument: kinds.append(kind))
        try:
            function()
        finally:
            sys.setprofile(None)
        return kinds.count("call") + kinds.count("c_call")

    return count


def run_python(*arguments, status=0, **environment) -> subprocess.CompletedProcess:
    """This Python with arguments, in an environment that is changed; it ends with the status."""
    variables = os.environ | environment
    done = subprocess.run(
        [sys.executable, *map(str, arguments)],
        capture_output=True,
        text=True,
        env={name: text for name, text in variables.items() if text is not None},
    )
    assert done.returncode == status, done.stdout + done.stderr
    return done


WRONG = [
    "1",
    "x",
    b"1",
    {},
    {"world": "pooltool"},
    [],
    [None, 1.0],
    [[1, 2], [3]],
    (1, 2, 3),
    np.array(["a"]),
    np.zeros((0, 3)),
    object(),
    1j,
    np.nan,
    np.inf,
    -1,
    None,
    True,
    np.datetime64(0, "s"),
    len,
]
# Arguments that take a name, so that "x" may be one.
NAMES = {
    "game",
    "world",
    "ball_model",
    "cushion_model",
    "friction",
    "space",
    "simultaneous",
    "stop_at",
    "records",
    "rules",
    "group",
    "ball_set",
    "solver",
    "slip",
    "model",
    "convention",
    "law",
}


def by_line(rows):
    """Rows that begin with a function written in place, for pytest: each is named by its line."""
    return [pytest.param(*row, id=f"line {row[0].__code__.co_firstlineno}") for row in rows]


def name_of(value):
    """The name of a function, for a row that pytest names; of other values none."""
    return getattr(value, "__qualname__", "")


def refused(call, error, message):
    """The call raises the error, with a short text of public names and without a warning; a
    CaromError has the field that its text names.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(error, match=f"^{message}") as caught:
            call()
    raised = caught.value
    assert type(raised) is error and len(str(raised)) < 410
    assert not re.search(r"offsets|options\.", str(raised))
    if error is carom.CaromError:
        assert raised.field == re.split(" = |: ", str(raised))[0] and raised.status < 0


def refused_by_name(function, good, names):
    """A value of another kind in place of each argument in turn is refused, by the name of the
    argument.
    """
    for name in names:
        for wrong in WRONG:
            try:
                function(**{**good, name: wrong})
            except carom.CaromError as error:
                assert error.field, (name, wrong)  # whose numbers C refused
            except (TypeError, ValueError) as error:
                assert re.search(rf"\b{name}\b", str(error)), (name, wrong, error)
            else:
                # of text and bytes none is read as a number
                assert not isinstance(wrong, (str, bytes)) or (name in NAMES and wrong == "x"), (
                    name,
                    wrong,
                )
