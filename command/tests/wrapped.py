"""wrapped PROGRAM COMMAND...: whether each help is 80 columns wide, its lines end no earlier than
they must, and its options have word for word the text of the manual, which no width breaks. Prints
what is not so.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

WIDTH, INDENT = 80, 23


def of_manual(page):
    """{option: its words} of a page of the manual."""
    plain = page.replace("\\-", "-").replace("\\:", "")
    return {
        m[1]: m[2].split()
        for m in re.finditer(r"^\.TP\n\\fB(?:-\w, )?(--[\w-]+)\\fR.*\n(.*)$", plain, re.M)
    }


def of_help(text):
    """{option: the lines of its text}, which stands beside the option or below it."""
    rows = re.findall(rf"^(  (?:-\w, )?(--[\w-]+).*)((?:\n {{{INDENT}}}.*)*)", text, re.M)
    return {
        name: [
            line[INDENT:]
            for line in ([head] if head[INDENT - 2 : INDENT] == "  " else []) + rest.split("\n")[1:]
        ]
        for head, name, rest in rows
    }


program, *commands = sys.argv[1:]
for command in commands:
    name = f"{Path(program).name} {command}"
    text = subprocess.run(
        [program, command, "--help"], capture_output=True, text=True, check=True
    ).stdout
    usage, examples, rest = re.split(r"\nexample:\n((?:  .*\n)+)", text)
    if not all(line.startswith("  carom") for line in examples.splitlines()):
        print(f"{name}: the example is no command: {examples}")
    for line in (usage + rest).split("\n"):
        if len(line) > WIDTH and " " in line.strip():
            print(f"{name}: a line of {len(line)} columns: {line}")
    options = of_help(text)
    for option, lines in options.items():
        for line, following in zip(lines, lines[1:]):
            if INDENT + len(line) + 1 + len(following.split(" ")[0]) <= WIDTH:
                print(f"{name} {option}: a line ends early: {line}")
    page = Path(os.environ["CAROM"]).parent / "man" / f"{name.replace(' ', '-')}.1"
    said = {option: " ".join(lines).split() for option, lines in options.items()}
    if page.is_file() and said != (shown := of_manual(page.read_text(encoding="utf-8"))):
        print(
            f"{name}: the manual has other options:",
            sorted(o for o in said.keys() | shown.keys() if said.get(o) != shown.get(o)),
        )
    if not options:
        print(f"{name}: no options")
