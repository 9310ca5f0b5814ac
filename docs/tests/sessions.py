"""sessions.py SOURCE: runs the Python blocks of README and docs; each page is one session, as for a
reader who pastes block by block, and shows what the page shows.

What a block prints stands behind it in a block `output`. A comment behind an expression that begins
with a value (a number, a string, a list, `<`, True, False or None) shows that of the expression, up
to a colon: the same words, and numbers rounded to the digits shown. Of a larger array it shows the
shape, in which a word stands for any number. UPDATE=1 writes printed outputs into the pages.

Runs in an environment that has the package. Blocks that need other packages are counted and left
out where these are not installed, as their tests are.
"""

import ast
import contextlib
import importlib.util
import io
import os
import re
import sys
import tempfile
from pathlib import Path

import numpy as np
from blocks import NUMBER, blocks, difference, matches, outputs, pages

NEEDS = {
    "python": [],
    "python pooltool": ["pooltool"],
    "python jax": ["jax"],
    "python torch": ["torch"],
    "python gymnasium": ["gymnasium"],
    "python pettingzoo": ["pettingzoo"],
    "python scale": ["dask", "xarray", "pyarrow"],
    "python sb3": ["stable_baselines3"],
}
VALUE = re.compile(r"#\s+(?=[-\d('\"\[<]|array\(|(?:True|False|None)\b)(<.*>|.+?)(?:: .*)?$")
WRAPPED = re.compile(r"\b(?:np\.)?(?:array|str_|bool|u?int\d+|float\d+)\(([^()]*?)\)")
LARGE = 10  # elements of an array


def shape_fits(shown, shape):
    """Whether a tuple such as (201, balls, 4) is a shape."""
    sides = shown.strip("()").rstrip(",").split(",")
    return len(sides) == len(shape) and all(
        not side.strip().isdigit() or int(side) == length for side, length in zip(sides, shape)
    )


def value_fits(shown, value):
    """Whether a comment shows the value of an expression."""
    if isinstance(value, np.ndarray) and value.size > LARGE:
        return shape_fits(shown, value.shape)
    bare = [WRAPPED.sub(r"\1", text) for text in (shown, repr(value))]
    words = [re.sub(r"\s", "", NUMBER.sub("#", text)) for text in bare]
    numbers = [NUMBER.findall(text) for text in bare]
    return words[0] == words[1] and all(
        abs(float(a) - float(b)) <= (0.5 + 1e-6) * 10.0 ** -len(a.partition(".")[2])
        for a, b in zip(*numbers)
    )


class Session:
    """A page as one session."""

    def __init__(self):
        self.names = {"__name__": "__main__"}
        self.wrong, self.shown, self.compared = [], 0, 0

    def run(self, where, text):
        """What the block prints. Statement by statement, as one who types them: an expression's
        value is shown, so it must show.
        """
        lines, printed = text.splitlines(), io.StringIO()
        with contextlib.redirect_stdout(printed):
            for statement in ast.parse(text).body:
                if not isinstance(statement, ast.Expr):
                    exec(compile(ast.Module([statement], []), where, "exec"), self.names)
                    continue
                value = eval(compile(ast.Expression(statement.value), where, "eval"), self.names)
                self.shown += len(repr(value)) > 0
                comment = VALUE.search(lines[statement.end_lineno - 1], statement.end_col_offset)
                if comment:
                    self.compared += 1
                    if not value_fits(comment[1], value):
                        line = lines[statement.end_lineno - 1]
                        self.wrong.append(difference(where, [line], [repr(value)]))
        return printed.getvalue()


# That the comparison can fail.
assert value_fits("81.04", np.float64(81.0438)) and not value_fits("81.05", np.float64(81.0438))
assert value_fits("(201, balls)", np.zeros((201, 2))) and not value_fits("(20,)", np.zeros(21))
assert value_fits("'POCKETED'", "POCKETED") and not value_fits("'POCKETED'", "ROLLING")

source, update = Path(sys.argv[1]).resolve(), os.environ.get("UPDATE") == "1"
run = left_out = shown = compared = 0
wrong = []
with tempfile.TemporaryDirectory() as work:
    os.chdir(work)
    for page in pages(source):
        session, found, printed = Session(), blocks(source, page), {}
        text = new = Path(source, page).read_text(encoding="utf-8")
        for number, (kind, block) in enumerate(found):
            if kind not in NEEDS:
                continue
            if not all(importlib.util.find_spec(module) for module in NEEDS[kind]):
                left_out += 1
                continue
            printed[number] = session.run(f"{page}, block {number + 1}", block)
            run += 1
        expected = {number: (lines, share) for number, lines, share in outputs(found)}
        for number, came in printed.items():
            lines, share = expected.get(number, ([], 0))
            if not matches(lines, came.splitlines(), share):
                session.wrong.append(
                    difference(f"{page}, block {number + 1}", lines, came.splitlines())
                )
                new = new.replace("".join(f"{line}\n" for line in lines), came) if lines else new
        if update and new != text:
            Path(source, page).write_text(new, encoding="utf-8")
        wrong += session.wrong
        shown, compared = shown + session.shown, compared + session.compared
    os.chdir("/")
if wrong:
    sys.exit("\n\n".join(wrong))
assert run >= 4 and compared >= 6, (run, compared)
print(f"{run} blocks run, {left_out} left out, {shown} values shown, {compared} compared")
