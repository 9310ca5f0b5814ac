"""sessions.py SOURCE: runs the Python blocks of README and docs; each page is one session, as for a
reader who pastes block by block.

Runs in an environment that has the package. Blocks that need other packages are counted and left
out where these are not installed, as their tests are.
"""

import ast
import importlib.util
import os
import sys
import tempfile

from blocks import blocks, pages

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
source = os.path.abspath(sys.argv[1])
run, left_out, shown = 0, 0, 0

with tempfile.TemporaryDirectory() as work:
    os.chdir(work)
    for page in pages(source):
        session = {"__name__": "__main__"}
        for number, (kind, text) in enumerate(blocks(source, page), 1):
            if kind not in NEEDS:
                continue
            if not all(importlib.util.find_spec(module) for module in NEEDS[kind]):
                left_out += 1
                continue
            where = f"{page}, block {number}"
            # Statement by statement, as one who types them: an expression's value is shown, so it
            # must show.
            for statement in ast.parse(text).body:
                if isinstance(statement, ast.Expr):
                    shown += (
                        len(
                            repr(
                                eval(
                                    compile(ast.Expression(statement.value), where, "eval"), session
                                )
                            )
                        )
                        > 0
                    )
                else:
                    exec(compile(ast.Module([statement], []), where, "exec"), session)
            run += 1
    os.chdir("/")
assert run >= 4, run
print(f"{run} blocks run, {left_out} left out, {shown} values shown")
