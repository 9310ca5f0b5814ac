"""lint_c.py FILE...: functions of C with more than 20 branches, and conditions within conditions.

The first is the cyclomatic complexity, which lizard counts; the second a `?:` in an operand of
another. tools/lint_exceptions lists what stays as it is: FILE, what (a function, or nested), reason.
An exception that nothing needs any more is reported too, so that the list only shrinks.
"""

import sys
from pathlib import Path

import lizard
from lizard_languages import get_reader_for

MOST_BRANCHES = 20
CHECKED = (".c", ".cpp", ".h", ".hpp")


def exceptions():
    """{(file, what)} of the list, whose lines are FILE WHAT REASON."""
    listed = set()
    for line in Path("tools/lint_exceptions").read_text().splitlines():
        words = line.partition("#")[0].split(maxsplit=2)
        if words and len(words) < 3:
            sys.exit(f"tools/lint_exceptions: {line!r} has no reason")
        if words:
            listed.add((words[0], words[1]))
    return listed


def nested_conditionals(path):
    """The lines of each `?:` that is an operand of another."""
    line, depth = 1, 0
    open_at = []  # the depth of brackets at each conditional that has not ended
    for token in get_reader_for(path).generate_tokens(Path(path).read_text()):
        start = line
        line += token.count("\n")
        if token.isspace() or token.startswith(("//", "/*", "#")):
            continue
        if token in "([":
            depth += 1
        elif token in ")]":
            depth -= 1
            open_at = [d for d in open_at if d <= depth]
        elif token == ",":
            open_at = [d for d in open_at if d < depth]
        elif token in (";", "{", "}"):
            open_at, depth = [], 0
        elif token == "?":
            if open_at:
                yield start
            open_at.append(depth)


def main():
    listed, used, wrong = exceptions(), set(), []
    files = [name for name in sys.argv[1:] if name.endswith(CHECKED)]
    for path in files:
        for function in lizard.analyze_file(path).function_list:
            branches = function.cyclomatic_complexity
            if branches <= MOST_BRANCHES:
                continue
            if (path, function.name) in listed:
                used.add((path, function.name))
            else:
                place = f"{path}:{function.start_line}"
                wrong.append(f"{place}: {function.name}() has {branches} branches, above 20")
        for number in nested_conditionals(path):
            if (path, "nested") in listed:
                used.add((path, "nested"))
            else:
                wrong.append(f"{path}:{number}: a condition within a condition (?: in ?:)")
    for path, what in sorted(listed - used):
        if what.startswith("hidden:"):
            continue  # of hidden_calls.py
        if path in files or not Path(path).exists():
            wrong.append(f"tools/lint_exceptions: {path} {what} is not needed any more")
    if wrong:
        sys.exit("\n".join(wrong))


if __name__ == "__main__":
    main()
