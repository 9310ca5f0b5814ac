"""The worked examples of python/examples/, with small numbers of draws: what they find is checked,
and that the pictures come out.

Randomness comes from CAROM_TEST_SEED; bounds hold for any.
"""

import ast
import io
import itertools
import json
import os
import re
import runpy
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest


pytest.importorskip("matplotlib", reason="matplotlib is not installed")
EXAMPLES = Path(__file__).parents[1] / "examples"
FIGURES = EXAMPLES.parents[1] / "docs/figures"
sys.path[:0] = [str(EXAMPLES), str(EXAMPLES.parents[1] / "docs/tests")]

import figures  # noqa: E402
import refine_aim  # noqa: E402


@pytest.mark.parametrize(
    ("name", "pictures"), [("first_look", 5), ("rack_gap", 3), ("thirty_trust", 1)]
)
def test_notebooks(capsys, name, pictures):
    """Every cell runs, prints the stored text (numbers within 2 %, as instruction sets differ by
    rounding) and gives its pictures.

    Pictures are not stored in the file, of which no reader can read them, but for the site, in
    docs/figures: UPDATE=1 writes them and the texts.
    """
    from matplotlib import pyplot

    pyplot.switch_backend("agg")
    pyplot.close("all")
    book = json.loads((EXAMPLES / f"{name}.ipynb").read_text(encoding="utf-8"))
    cells = [(k, cell) for k, cell in enumerate(book["cells"]) if cell["cell_type"] == "code"]
    assert [cell["execution_count"] for _, cell in cells] == list(range(1, len(cells) + 1)) and len(
        cells
    ) >= 6
    number = re.compile(r"\d+(?:\.\d+)?")
    names: dict = {}
    drawn: dict[Path, bytes] = {}
    for k, cell in cells:
        tree = ast.parse("".join(cell["source"]))
        last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, name, "exec"), names)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # that nothing is shown
            shown = (
                None
                if last is None
                else eval(compile(ast.Expression(last.value), name, "eval"), names)
            )
        if hasattr(shown, "_repr_svg_") and shown._repr_svg_().startswith("<svg"):
            drawn[FIGURES / f"notebook-{name}-{k}.svg"] = shown._repr_svg_().encode()
        for figure in map(pyplot.figure, pyplot.get_fignums()):
            figure.savefig(file := io.BytesIO())
            drawn[FIGURES / f"notebook-{name}-{k}-{figure.number}.png"] = file.getvalue()
        pyplot.close("all")
        expected = "".join(
            text
            for output in cell["outputs"]
            if output["output_type"] == "stream"
            for text in output["text"]
        )
        printed = capsys.readouterr().out
        if os.environ.get("UPDATE") and printed != "":
            streams = [o for o in cell["outputs"] if o["output_type"] == "stream"]
            streams[0]["text"] = printed
            continue
        assert number.sub("#", printed) == number.sub("#", expected)
        np.testing.assert_allclose(
            [*map(float, number.findall(printed))],
            [*map(float, number.findall(expected))],
            rtol=0.02,
        )
    if os.environ.get("UPDATE"):
        text = json.dumps(book, indent=1, ensure_ascii=False) + "\n"
        (EXAMPLES / f"{name}.ipynb").write_text(text, encoding="utf-8")
    for path in drawn if os.environ.get("UPDATE") else ():
        path.write_bytes(drawn[path])
    assert len(drawn) == pictures and sorted(drawn) == sorted(FIGURES.glob(f"notebook-{name}-*"))


def test_bank_with_position(capsys, monkeypatch):
    monkeypatch.setattr("sys.argv", ["bank_with_position.py"])
    runpy.run_path(str(EXAMPLES / "bank_with_position.py"), run_name="__main__")
    misses = [float(number) for number in re.findall(r"rests ([\d.]+) mm", capsys.readouterr().out)]
    assert (
        len(misses) == 4
        and misses[0] > 70.0
        and misses[1] < 10.0
        and misses[2] < 0.2
        and misses[3] <= misses[2]
    )


def test_refine_aim(tmp_path, monkeypatch):
    seed = int(os.environ.get("CAROM_TEST_SEED", "1"))
    print(f"CAROM_TEST_SEED={seed}")
    runs = [
        refine_aim.refine(start, balls, goal)[1]
        for balls, _, goal, start in refine_aim.tasks(20, seed)
    ]
    # each step helps, and where the reach lets it the search ends at the goal
    assert all(later < sooner for misses in runs for sooner, later in itertools.pairwise(misses))
    assert sum(misses[-1] < 1e-3 for misses in runs) >= 3
    out = tmp_path / "refine_aim.svg"
    monkeypatch.setattr("sys.argv", ["refine_aim.py", "--draws", "4", "--out", str(out)])
    refine_aim.main()
    assert out.read_text(encoding="utf-8").startswith("<?xml") and out.stat().st_size > 10_000


def test_what_ppo_is_given():
    """Without stable_baselines3: to aim at the ghost ball of the easiest pot does better than
    corrections at random, and those than strokes at random.
    """
    pytest.importorskip("gymnasium", reason="gymnasium is not installed")
    train_games = pytest.importorskip("train_games")
    generator = np.random.default_rng(1)
    policies = [lambda sight: np.zeros((1, 6)), lambda sight: generator.uniform(-1.0, 1.0, (1, 6))]
    agents = [*map(train_games.agent, policies), train_games.game_agents.random_agent(1)]
    for game in ("carom/PotOne-v1", "carom/RunOutSix-v1"):
        straight, corrected, random = (
            train_games.game_agents.play(agent, game, 400, 1)[0].mean() for agent in agents
        )
        assert straight > corrected + 0.1 and corrected > random + 0.1
    with pytest.raises(SystemExit):
        train_games.main(["games.svg", "--minutes", "many"])


SHORT = [
    (name, Path(command.split()[0]).stem)
    for name, program, command in figures.made(EXAMPLES.parents[1])
    if program == "python"
]
# Figures that the command draws, so that the docs have each once: these programs draw them too.
SHORT += [("", "throw_by_speed"), ("", "thirty_degrees")]
ASIDE = 0.5  # points of a plot by matplotlib, whose versions lay plots out differently


@pytest.mark.parametrize(("figure", "name"), SHORT)
def test_short(figure, name, tmp_path, monkeypatch, capsys):
    """Each program checks its own claims; it prints something and draws a picture: that of the
    docs, if they have one, which UPDATE=1 writes anew.

    Its head says how to run it.
    """
    from matplotlib import pyplot

    pyplot.close("all")
    shown = figure and os.environ.get("UPDATE")
    out = FIGURES / figure if shown else tmp_path / (figure or "picture.svg")
    monkeypatch.setattr("sys.argv", [f"{name}.py", str(out)])
    text = (EXAMPLES / f"{name}.py").read_text(encoding="utf-8")
    assert 20 <= text.count("\n") <= 80 and f"    python {name}.py " in ast.get_docstring(
        ast.parse(text)
    )
    runpy.run_path(str(EXAMPLES / f"{name}.py"), run_name="__main__")
    assert capsys.readouterr().out.strip()
    assert "</svg>" in out.read_text(encoding="utf-8")[-20:]
    assert not figure or not figures.difference(out, FIGURES / figure, ASIDE)
