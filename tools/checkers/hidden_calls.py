"""hidden_calls.py FILE...: calls that change something, behind `&&`, `||` or in a branch of `?:`.

Such a call is skipped where the operand before it decides, which is easy to overlook: a shot that
had stopped once did not take note of a contact. A call is taken to change something if the first
parameter of its function is a pointer to a structure that is not const, as in `note_event(sim, e)`.
An answer through a later pointer, as in `read_number(text, &x)`, is none: it is read only if the
call was made.

The functions are those that FILEs define or declare. tools/lint_exceptions lists what stays as it
is: FILE hidden:FUNCTION REASON, FUNCTION being the one that is called.
"""

import re
import sys
from pathlib import Path

from lizard_languages import get_reader_for
from lint_c import exceptions

# A declaration or a definition: NAME(FIRST parameter, at the begin of a line.
FUNCTION = re.compile(r"^(?:[A-Za-z_][\w ]*[ *]+)(\w+)\(([^,()]*)[,)]", re.MULTILINE)
# A pointer to a structure: carom_sim *sim. Not to a number or to text, and not const.
NUMBERS = r"(?:char|int|double|float|bool|void|size_t|u?int\d+_t|FILE|long|real|number)"
CHANGED = re.compile(rf"^(?!.*\bconst\b)(?!{NUMBERS}\b)(?:struct )?\w+ \*\w+$")


def changing_functions(paths):
    """The names of all functions whose first parameter is a structure that they may change."""
    names = set()
    for path in paths:
        for name, first in FUNCTION.findall(Path(path).read_text()):
            if CHANGED.match(first.strip()):
                names.add(name)
    return names


def tokens_of(path):
    """Each token with its line, without comments, spaces and preprocessor lines."""
    line = 1
    for token in get_reader_for(path).generate_tokens(Path(path).read_text()):
        start = line
        line += token.count("\n")
        if not token.isspace() and not token.startswith(("//", "/*", "#")):
            yield start, token


def hidden_calls(path, names):
    """Line and function of each call that is behind an operator that may skip it."""
    depth, skipping = 0, []  # the depths of brackets at which an operator may skip what follows
    tokens = list(tokens_of(path))
    for (line, token), (_, after) in zip(tokens, tokens[1:]):
        if token in "([":
            depth += 1
        elif token in ")]":
            depth -= 1
            skipping = [d for d in skipping if d <= depth]
        elif token in (",", "="):
            skipping = [d for d in skipping if d < depth]
        elif token in (";", "{", "}"):
            depth, skipping = 0, []
        elif token in ("&&", "||", "?"):
            skipping.append(depth)
        elif token in names and after == "(" and skipping:
            yield line, token


def main():
    paths = [path for path in sys.argv[1:] if path.endswith((".c", ".h"))]
    names = changing_functions(paths)
    listed = {row for row in exceptions() if row[1].startswith("hidden:")}
    used, wrong = set(), []
    for path in paths:
        for line, name in hidden_calls(path, names):
            row = (path, f"hidden:{name}")
            used.add(row)
            if row not in listed:
                wrong.append(f"{path}:{line}: {name}() changes its first argument, and may be "
                             "skipped by the operator before it: call it in a statement")
    for path, what in sorted(listed - used):
        wrong.append(f"tools/lint_exceptions: {path} {what} is not needed any more")
    if wrong:
        sys.exit("\n".join(wrong))


if __name__ == "__main__":
    main()
