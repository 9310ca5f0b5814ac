"""The worked examples of python/examples/, with small numbers of draws: what they find is checked, and that the pictures come out.

Randomness comes from CAROM_TEST_SEED; bounds hold for any.
"""

import ast
import itertools
import json
import os
import re
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

import carom

pytest.importorskip("matplotlib", reason="matplotlib is not installed")
EXAMPLES = Path(__file__).parents[1] / "examples"
sys.path.insert(0, str(EXAMPLES))

import learn_potting  # noqa: E402
import refine_aim  # noqa: E402
import throw  # noqa: E402

SEED = int(os.environ.get("CAROM_TEST_SEED", "1"))


@pytest.fixture(autouse=True)
def seed():
    print(f"CAROM_TEST_SEED={SEED}")


def picture(path):
    """Whether the file is a picture of its kind, of a size that suits a page."""
    head = path.read_bytes()[:200]
    kind = head.startswith(b"\x89PNG") if path.suffix == ".png" else b"<?xml" in head
    return kind and 10_000 < path.stat().st_size < 1_000_000


def test_throw(tmp_path, capsys):
    # Alciatore's closed form, TP A-14: friction by the slip, and at most what ends it. The normal impulse is (1 + e) M v_n / 2.
    cut = np.linspace(1.0, 88.0, 60)
    for speed in (0.1, 0.5, 1.0, 3.0, 10.0):
        slip, approach = speed * np.sin(np.radians(cut)), speed * np.cos(np.radians(cut))
        friction = 0.009951 + 0.108 * np.exp(-1.088 * slip)
        ends = 2 / 7 / 1.95 * slip / approach
        expected = np.degrees(np.arctan(np.minimum(friction, ends)))
        np.testing.assert_allclose(throw.throw(cut, speed, "stun"), expected, atol=2e-4)
    # Marlow's three points: of the law that was fitted to them, and of the throw.
    for (speed, mu), at in zip(throw.MEASURED, throw.measured_throw(), strict=True):
        assert carom.mu_ball(throw.cuts(throw.MEASURED_CUT, speed, "stun")) == pytest.approx(mu, abs=1e-4)
        assert throw.throw(throw.MEASURED_CUT, speed, "stun") == pytest.approx(at, abs=0.01)
    # Spin takes friction away from the throw; thin cuts slip across alone, whatever the spin.
    by_spin = {spin: throw.throw(np.array([15.0, 30.0, 60.0, 89.9]), 1.0, spin) for spin in throw.SPINS}
    for spin in ("follow", "draw"):
        assert (by_spin["stun"][:3] - by_spin[spin][:3] > 0.5).all()
        assert by_spin[spin][3] == pytest.approx(by_spin["stun"][3], abs=1e-3)
    assert throw.throw(0.0, 1.0, "stun") == pytest.approx(0.0, abs=1e-9)
    throw.main(["--draws", "50", "--out", str(tmp_path / "throw.svg")])
    assert picture(tmp_path / "throw.svg") and "stun   at 1 m/s: at most 4.3" in capsys.readouterr().out


def test_learning(tmp_path, capsys):
    """The policy learns: from every seed it pots at least twice as much, less fouls, on layouts that it has not learnt from."""
    policy, curve = learn_potting.main(["--generations", "20", "--seed", str(SEED), "--out", str(tmp_path / "learning.svg")])
    assert curve[0] < 0.25 and curve[-1] > 0.42 and curve[-5:].min() > 2 * curve[0]
    assert (policy[:2] > 0).all() and policy[3] > 0  # cuts, ways and balls in the way cost something
    assert picture(tmp_path / "learning.svg") and "at the end" in capsys.readouterr().out


def test_the_notebook(capsys):
    """Every cell runs, prints the stored text (numbers within 2 %, as instruction sets differ by rounding) and gives its pictures.

    Pictures are not stored: they are long, and no reader of the file can read them.
    """
    from matplotlib import pyplot

    pyplot.switch_backend("agg")
    pyplot.close("all")
    book = json.loads((EXAMPLES / "first_look.ipynb").read_text(encoding="utf-8"))
    cells = [cell for cell in book["cells"] if cell["cell_type"] == "code"]
    assert [cell["execution_count"] for cell in cells] == list(range(1, len(cells) + 1)) and len(cells) >= 8
    number = re.compile(r"\d+(?:\.\d+)?")
    names: dict = {}
    svgs = figures = 0
    for cell in cells:
        tree = ast.parse("".join(cell["source"]))
        last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, "first_look.ipynb", "exec"), names)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # that nothing is shown
            shown = None if last is None else eval(compile(ast.Expression(last.value), "first_look.ipynb", "eval"), names)
        svgs += hasattr(shown, "_repr_svg_") and shown._repr_svg_().startswith("<svg")
        figures += len(pyplot.get_fignums())
        pyplot.close("all")
        expected = "".join(text for output in cell["outputs"] if output["output_type"] == "stream" for text in output["text"])
        printed = capsys.readouterr().out
        assert number.sub("#", printed) == number.sub("#", expected)
        np.testing.assert_allclose([*map(float, number.findall(printed))], [*map(float, number.findall(expected))], rtol=0.02)
    assert (svgs, figures) == (3, 3)


def test_refine_aim(tmp_path, monkeypatch):
    runs = [refine_aim.refine(start, balls, goal)[1] for balls, _, goal, start in refine_aim.tasks(20, SEED)]
    # each step helps, and where the reach lets it the search ends at the goal
    assert all(later < sooner for misses in runs for sooner, later in itertools.pairwise(misses))
    assert sum(misses[-1] < 1e-3 for misses in runs) >= 3
    out = tmp_path / "refine_aim.svg"
    monkeypatch.setattr("sys.argv", ["refine_aim.py", "--draws", "4", "--out", str(out)])
    refine_aim.main()
    assert picture(out)
