"""The ten tasks of pooltool's documentation and sandbox, as programs of examples/ten_tasks: each runs,
and has at most as many lines of code as pooltool's program for it.
"""

import io
import os
import re
import runpy
import tokenize
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parents[1] / "examples/ten_tasks"
PAGE = EXAMPLES.parents[2] / "docs/using/pooltool.md"
# Lines of code of pooltool's programs at its commit 9a8abfe0, counted as below.
TASKS = {
    "hello_world": (8, r"10 balls, \d+ events"),
    "thirty_degrees": (197, r"at most \d\.\de-\d+ degrees"),
    "straight_shot": (122, r"0.4 degrees: 1.00 .* 1.00\n$"),
    "custom_table": (62, r"16 balls, \d+ events"),
    "newtons_cradle": (50, r"5 balls, \d+ events"),
    "many_breaks": (32, r"\d.\d\d balls a break, [3-9] in the best one"),
    "collection": (24, r"Shots: \(20,\), 0 in error"),
    "side_by_side": (12, r"Shots: \(20,\), 0 in error"),
    "save_and_load": (21, r"10 balls, \d+ events"),
    "film": (77, r"break.gif: \d+ kB"),
}
NEEDED = {
    "thirty_degrees": "matplotlib",
    "straight_shot": "matplotlib",
    "save_and_load": "pandas",
    "film": "PIL",
}
_LAYOUT = {
    tokenize.COMMENT,
    tokenize.NL,
    tokenize.NEWLINE,
    tokenize.INDENT,
    tokenize.DEDENT,
    tokenize.ENDMARKER,
}


def lines_of_code(text: str) -> int:
    """Lines without blank ones, comments and docstrings."""
    lines: set[int] = set()
    begins = True
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type in _LAYOUT:
            begins |= token.type == tokenize.NEWLINE
            continue
        if not (begins and token.type == tokenize.STRING):
            lines |= set(range(token.start[0], token.end[0] + 1))
            begins = False
    return len(lines)


def test_all_tasks_are_here():
    assert {path.stem for path in EXAMPLES.glob("*.py")} == set(TASKS)


@pytest.mark.parametrize("name", TASKS)
def test_task(name, tmp_path, monkeypatch, capsys):
    most, printed = TASKS[name]
    text = (EXAMPLES / f"{name}.py").read_text(encoding="utf-8")
    assert lines_of_code(text) <= most
    row = re.search(rf"\| \[{name}\.py\]\S* \| `\S+` \| (\d+) \| (\d+) \|", PAGE.read_text("utf-8"))
    assert row and (int(row[1]), int(row[2])) == (lines_of_code(text), most)
    if name in NEEDED:
        pytest.importorskip(NEEDED[name], reason=f"{NEEDED[name]} is not installed")
    if NEEDED.get(name) == "matplotlib":
        from matplotlib import pyplot

        pyplot.switch_backend("agg")
        pyplot.close("all")
    opened = []
    monkeypatch.setattr("webbrowser.open", lambda address: opened.append(address) or True)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    runpy.run_path(str(EXAMPLES / f"{name}.py"), run_name="__main__")
    assert re.search(printed, capsys.readouterr().out)
    assert bool(opened) == (".show()" in text)
    assert os.listdir(tmp_path)
