"""hidden_calls.py FILE...: predicates that change something, behind `&&`, `||` or in `?:`.

Such a call is skipped where the operand before it decides, and its name does not show that this
matters: a shot that had stopped once did not take note of a contact, as `stops_at()` took it. A
step, as in `ready && play(shot)`, says by its name that it is to be skipped.

A predicate is a function of type bool or int with a verb of the third person first, or behind its
subject: `is_open`, `stops_at`, `tip_acts`. It changes something if its first parameter is a pointer
to a structure that is not const; behind that, such a pointer receives an answer, which is read only
if the call was made. The functions are those that FILEs define or declare.
tools/lint_exceptions lists what stays as it is: FILE hidden:FUNCTION REASON.
"""

import re
import sys
from pathlib import Path

from lizard_languages import get_reader_for
from lint_c import exceptions

# A declaration or a definition at the begin of a line: type, NAME, parameters.
FUNCTION = re.compile(r"^(?:[a-z_]+ )*(?:bool|int) (\w+)\(([^()]*)\)", re.MULTILINE)
# A pointer to a structure: carom_sim *sim. Not to a number or to text, and not const.
NUMBERS = r"(?:char|int|double|float|bool|void|size_t|u?int\d+_t|FILE)"
CHANGED = re.compile(rf"^(?!.*\bconst\b)(?!{NUMBERS}\b)\w+ \*\w+$")
AUXILIARY = {"is", "has", "may", "can"}
# Words that end in s and are no verbs of the third person, and verbs of steps before a plural.
NOUNS = {"strokes", "numbers", "status", "process", "less", "cross", "pass", "press", "guess"}
STEPS = {
    "find",
    "list",
    "read",
    "take",
    "put",
    "add",
    "make",
    "write",
    "check",
    "keep",
    "name",
    "note",
    "play",
    "open",
    "close",
    "set",
    "get",
    "begin",
    "count",
    "match",
    "show",
    "print",
    "draw",
    "give",
    "tell",
}


def is_third(word):
    return word in AUXILIARY or (word.endswith("s") and word not in NOUNS)


def is_predicate(name):
    words = name.removeprefix("carom_").split("_")
    subject = len(words) == 2 and words[0] not in STEPS and is_third(words[1])
    return is_third(words[0]) or subject


def changing_predicates(paths):
    """The names of all predicates that may change a structure."""
    names = set()
    for path in paths:
        for name, parameters in FUNCTION.findall(Path(path).read_text()):
            first = " ".join(parameters.partition(",")[0].split())
            if CHANGED.match(first) and is_predicate(name):
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
    names = changing_predicates(paths)
    listed = {row for row in exceptions() if row[1].startswith("hidden:")}
    used, wrong = set(), []
    for path in paths:
        for line, name in hidden_calls(path, names):
            row = (path, f"hidden:{name}")
            used.add(row)
            if row not in listed:
                wrong.append(
                    f"{path}:{line}: {name}() changes an argument, and the operator before "
                    "it may skip it: call it in its own statement"
                )
    for path, what in sorted(listed - used):
        wrong.append(f"tools/lint_exceptions: {path} {what} is not needed any more")
    if wrong:
        sys.exit("\n".join(wrong))


if __name__ == "__main__":
    main()
