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
pytest.importorskip("tqdm", reason="tqdm is not installed")
EXAMPLES = Path(__file__).parents[1] / "examples"
sys.path.insert(0, str(EXAMPLES))

import best_of_many  # noqa: E402
import error_bars  # noqa: E402
import fit_cloth  # noqa: E402
import fit_shots  # noqa: E402
import learn_potting  # noqa: E402
import refine_aim  # noqa: E402
import smoothness  # noqa: E402
import ten_million  # noqa: E402
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


def test_smoothness(tmp_path):
    exact, euler = smoothness.largest_jumps(4001, (100, 1000, 10000))
    # docs/understanding/accuracy.md promises pair errors below 1e-6, about as much in radians of the throw; a fifth of that is met with room.
    assert exact < np.degrees(2e-7)
    # Euler's are thousands of times larger, and fall as 1/N.
    assert euler[1000] > 1e-3 and euler[1000] > 1000 * exact
    assert 3 < euler[100] / euler[1000] < 30 and 3 < euler[1000] / euler[10000] < 30
    # What a jump is: none in a curve or at a corner, all of a step's height.
    x = np.linspace(0, 1, 101)
    assert smoothness.jumps(np.sin(x)).max() < 1e-15 and smoothness.jumps(np.abs(x - 0.505)).max() < 1e-15
    assert smoothness.jumps(np.where(x > 0.5, x + 0.125, x)).max() == pytest.approx(0.125)
    smoothness.main(["--draws", "1001", "--out", str(tmp_path / "smoothness.png")])
    assert picture(tmp_path / "smoothness.png")


def test_margins():
    # By brute force: the nearest place that is not good, the layer around the grid counted in.
    grid = best_of_many.Grid(np.linspace(-0.5, 0.5, 7), np.geomspace(1, 2, 5), np.linspace(-0.2, 0.2, 4))
    good = np.random.default_rng(SEED).random(grid.shape) < 0.9
    errors = best_of_many.ERRORS
    axes = [grid.aim / errors["aim"], np.log(grid.speed) / errors["speed"], grid.height / errors["height"]]
    axes = [np.concatenate([[2 * at[0] - at[1]], at, [2 * at[-1] - at[-2]]]) for at in axes]
    padded = np.pad(good, 1)
    bad = np.array([[axes[k][n] for k, n in enumerate(index)] for index in np.argwhere(~padded)])
    margin = best_of_many.margins(good, grid)
    for index in itertools.product(*(range(n) for n in grid.shape)):
        here = np.array([axes[k][n + 1] for k, n in enumerate(index)])
        expected = np.linalg.norm(bad - here, axis=-1).min() if good[index] else 0.0
        assert margin[index] == pytest.approx(expected, abs=1e-12)


def test_best_of_many(tmp_path):
    grid = best_of_many.grid_of(8000)
    outcomes = best_of_many.play(best_of_many.cue(*np.meshgrid(*grid, indexing="ij")))
    assert outcomes.shape == grid.shape and 0.05 < (outcomes == best_of_many.POTTED).mean() < 0.5
    i, j, k = best_of_many.widest(best_of_many.margins(outcomes == best_of_many.POTTED, grid))
    best = (float(grid.aim[i]), float(grid.speed[j]), float(grid.height[k]))
    # Alone, event by event: ball 1 into that pocket, and no other ball into any.
    shot = carom.simulate(best_of_many.table, best_of_many.layout, best_of_many.cue(*best), cushion_model=best_of_many.CUSHION)
    potted = shot.events[shot.events["type"] == carom.EventType.POCKET]
    assert [(event["a"], event["b"]) for event in potted] == [(1, best_of_many.POCKET)]
    # The neighbours are within the margin; and a player pots it more often than by geometry, and than others that went in.
    around = best_of_many.cue(best[0] + np.array([-0.04, 0.04]), best[1] * np.array([[0.97], [1.03]]), best[2])
    assert (best_of_many.play(around) == best_of_many.POTTED).all()

    def share(aim, speed, height):
        played = best_of_many.executions((aim, speed, height), 400, SEED)
        return (best_of_many.play(played) == best_of_many.POTTED).mean()

    others = np.random.default_rng(SEED).permutation(np.argwhere(outcomes == best_of_many.POTTED))[:15]
    shares = [share(grid.aim[a], grid.speed[s], grid.height[h]) for a, s, h in others]
    assert share(*best) > max(0.5, share(0.0, *best[1:]) + 0.2, np.median(shares) + 0.1)
    best_of_many.main(["--draws", "2000", "--out", str(tmp_path / "best.png")])
    assert picture(tmp_path / "best.png")


def test_fit_cloth(tmp_path):
    fits = fit_cloth.fit(fit_cloth.record(SEED, 120))
    errors = fit_cloth.errors(fits)
    # The truth within the stated uncertainty, which is small; the scatter of all is what is stated: 120 draws of each.
    deviation = np.sqrt(np.diagonal(fits.covariance, axis1=1, axis2=2))
    assert (deviation[:, 0] < 0.002 * 0.212).all() and (deviation[:, 1] < 0.004 * 0.012).all()
    assert np.abs(errors[:, :2]).max() < 5
    assert np.abs(errors.mean(axis=0)).max() < 5 / np.sqrt(120)
    assert np.abs(errors.std(axis=0) - 1).max() < 5 / np.sqrt(2 * 120)
    assert abs(fit_cloth.inside(fits, 2) - 0.865) < 5 * np.sqrt(0.865 * 0.135 / 120)
    # Without noise, the truth itself.
    silent = fit_cloth.fit(fit_cloth.paths(fit_cloth.TRUTH)[None])
    np.testing.assert_allclose(silent.found[0], fit_cloth.TRUTH, rtol=1e-7)
    fit_cloth.main(["--draws", "20", "--seed", str(SEED), "--out", str(tmp_path / "fit.svg")])
    assert picture(tmp_path / "fit.svg")


def test_ten_million(tmp_path, capsys):
    total = ten_million.collide_many(250_000, SEED, threads=1)
    assert total.counts.sum() == total.collisions == 250_000
    assert total.momentum < 1e-14 and total.gain < 1e-12
    # No bit depends on the threads.
    other = ten_million.collide_many(250_000, SEED, threads=3)
    np.testing.assert_array_equal(other.counts, total.counts)
    assert (other.momentum, other.gain) == (total.momentum, total.gain)

    # The balance notices a change by a millionth, and the cloth does take momentum from the two balls: without their spin it fails.
    pairs = ten_million.random_impacts(np.random.default_rng(SEED), 1000, None)
    before, after = carom.dtypes.plain(pairs), carom.collide(carom.dtypes.plain(pairs)).motion
    r, a, b = before[:, 12:14], before[:, 3:9], before[:, 15:21]
    begun = ten_million.kept(r, a, b)
    spinless = [np.concatenate([motion[:, :3], 0 * motion[:, 3:]], axis=-1) for motion in (a, b, after[:, :6], after[:, 6:])]
    lost = ten_million.kept(r, *spinless[2:]) - ten_million.kept(r, *spinless[:2])
    assert np.abs(lost).max() > 1e-4 * ten_million.MASS
    changed = ten_million.kept(r, after[:, :6] * (1 + 1e-6), after[:, 6:]) - begun
    assert np.abs(changed / (ten_million.MASS * before[:, 3])).max() > 1e-8

    # The deflection is that of the ball on a table, when it begins to roll there; slow balls do so before a cushion.
    slow = after[before[:, 3] < 1.0][:50, :6]
    balls = carom.balls(np.full((len(slow), 1, 2), 0.9), v=slow[:, None, :3], w=slow[:, None, 3:])
    shots = carom.simulate_batch(carom.tables.snooker(), balls, room=1)
    assert (shots.events["type"] == carom.EventType.SLIDING_ROLLING).all()
    rolls = shots.events["after"]["v"][:, 0, 0]
    turned = np.degrees(np.abs(np.arctan2(rolls[:, 1], rolls[:, 0])))
    np.testing.assert_allclose(ten_million.deflection(slow), turned, atol=1e-9)

    # A ball that rolls is deflected least: nothing is below the rule of 30 degrees, but for what friction takes; much is just above.
    density = total.counts.reshape(90, 4, 180, -1).sum(axis=(1, 3))
    for cut in range(10, 80, 10):
        rule = int(ten_million.rolling_rule(np.array([cut + 0.5]))[0])
        assert density[cut, : rule - 4].sum() == 0 and density[cut, rule - 4 : rule + 4].sum() > 0.03 * density[cut].sum()
    # The ridge at stun is there by friction.
    smooth = ten_million.collide_many(250_000, SEED, threads=1, friction=0.0).counts.reshape(90, 4, 180, -1).sum(axis=(1, 3))
    assert density[18:22, 63:67].sum() > 1.3 * smooth[18:22, 63:67].sum()
    ten_million.main(["--draws", "120000", "--seed", str(SEED), "--threads", "2", "--out", str(tmp_path / "density.png")])
    assert picture(tmp_path / "density.png") and "120,000 collisions" in capsys.readouterr().out


def test_learning(tmp_path, capsys):
    """The policy learns: from every seed it pots at least twice as much, less fouls, on layouts that it has not learnt from."""
    policy, curve = learn_potting.main(["--generations", "20", "--seed", str(SEED), "--out", str(tmp_path / "learning.svg")])
    assert curve[0] < 0.25 and curve[-1] > 0.42 and curve[-5:].min() > 2 * curve[0]
    assert (policy[:2] > 0).all() and policy[3] > 0  # cuts, ways and balls in the way cost something
    assert picture(tmp_path / "learning.svg") and "at the end" in capsys.readouterr().out


def test_the_notebook(capsys):
    """Every cell runs, prints what is stored with it (numbers within 2 %, as instruction sets differ by rounding) and gives its pictures.

    Those of Matplotlib are not stored: images in letters are long, and no reader of the file can read them.
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
        stored = {name for output in cell["outputs"] if "data" in output for name in output["data"]} - {"text/plain"}
        found = {"image/svg+xml"} if hasattr(shown, "_repr_svg_") else set()
        assert stored == found
        svgs += len(found)
        figures += len(pyplot.get_fignums())
        pyplot.close("all")
        if found:
            assert shown._repr_svg_().startswith("<svg")
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


def test_error_bars(tmp_path, capsys):
    rows = error_bars.compare(40, 2000, SEED)
    small = rows[rows[:, 0] < 0.1]
    ratio = small[:, 1] / small[:, 0]
    assert len(rows) > 40 and len(small) > 25
    assert 0.95 < np.median(ratio) < 1.05 and np.mean((ratio > 0.8) & (ratio < 1.25)) > 0.8
    # beyond what is shown, a first order says too much: no ball goes farther than the table is long
    assert rows[:, 1].max() < 2.0
    # a covariance by hand, of a straight roll without contacts: along the way by speed and height, across it by direction and side
    balls, cue = carom.balls([[0.6, 0.4]]), {"speed": 0.45, "phi": 90.0, "a": 0.0, "b": 0.0}
    shot, bars = error_bars.predict(balls, carom.cue(**cue))
    assert shot.count < 5 and not np.isin(shot.events["type"], (carom.EventType.RAIL, carom.EventType.JAW)).any()

    def moved(**by):
        return carom.simulate(error_bars.table, balls, carom.cue(**{**cue, **by})).final["r"][0, :2] - shot.final["r"][0, :2]

    across = np.hypot(moved(phi=90.05)[0], moved(a=0.01)[0])
    along = np.hypot(moved(speed=0.4545)[1], moved(b=0.01)[1])
    np.testing.assert_allclose(np.sqrt(bars.ends[0].diagonal()), [across, along], rtol=0.02)
    error_bars.main(["--draws", "4", "--strokes", "200", "--seed", str(SEED), "--out", str(tmp_path / "bars.svg")])
    assert picture(tmp_path / "bars.svg") and "played / predicted" in capsys.readouterr().out


def test_fit_shots(tmp_path, capsys):
    plays = fit_shots.Plays(SEED)
    recorded, starts = fit_shots.recordings(plays, 40, SEED)
    fits, _ = fit_shots.fit_all(plays, recorded, starts)
    good = fit_shots.solved(fits)
    assert good.mean() > 0.7
    # 200 standard normal numbers: 68 % within one deviation, 95 % within two
    z = np.abs(fit_shots.errors([one for one, yes in zip(fits, good) if yes]))
    assert 0.56 < (z < 1).mean() < 0.82 and 0.89 < (z < 2).mean() < 0.99
    assert (np.abs([one.found / fit_shots.TRUTH - 1 for one, yes in zip(fits, good) if yes]) < 0.02).mean() > 0.95
    # differences of shots end at the same constants, and play several times as many shots
    by_differences, _ = fit_shots.fit_all(plays, recorded[:5], starts[:5], differences=True)
    for one, other in zip(fits, by_differences):
        if np.abs(other.found / fit_shots.TRUTH - 1).max() < 0.02 and np.abs(one.found / fit_shots.TRUTH - 1).max() < 0.02:
            assert (np.abs(one.found - other.found) < 0.1 * np.sqrt(one.covariance.diagonal())).all()
    assert np.median([one.played for one in fits]) < 0.5 * np.median([one.played for one in by_differences])
    fit_shots.main(["--draws", "12", "--seed", str(SEED), "--out", str(tmp_path / "shots.svg")])
    assert picture(tmp_path / "shots.svg") and "tangents" in capsys.readouterr().out
