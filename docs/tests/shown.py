"""shown.py SOURCE BUILD: runs the blocks of the kind `console` in README and docs, and compares
what they print with the page.

A line that begins with `$ ` is a command, `> ` continues it; the lines up to the next one are its
output, standard error included. A line `...` stands for any lines. Numbers may differ by 1e-6 of
themselves, since instruction sets differ in the last digits. All blocks of a page share a folder
that has `data`, and `carom` is on the path. `$?` is the exit code of the command before. UPDATE=1
writes the outputs into the pages; commands whose output has a `...` are left as they are.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

from blocks import blocks, difference, matches, pages

SOURCE, BUILD = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
ENVIRONMENT = {
    **os.environ,
    "PATH": f"{BUILD}:{os.environ['PATH']}",
    "CAROM_DATA": str(SOURCE / "data"),
}


def commands(text):
    """The commands of a block, each with the lines that it is shown to print."""
    lines, all_of_them = text.splitlines(), []
    assert lines[0].startswith("$ "), f"a console block begins with a command, not '{lines[0]}'"
    for line in lines:
        if line.startswith("$ "):
            all_of_them.append((line[2:], []))
        elif line.startswith("> ") and not all_of_them[-1][1]:
            all_of_them[-1] = (f"{all_of_them[-1][0]}\n{line[2:]}", [])
        else:
            all_of_them[-1][1].append(line)
    return all_of_them


count, wrong = 0, []
with tempfile.TemporaryDirectory() as work:
    for page in pages(SOURCE):
        folder, code, text = (
            Path(work, page.replace("/", "_")),
            0,
            Path(SOURCE, page).read_text(encoding="utf-8"),
        )
        folder.mkdir()
        (folder / "data").symlink_to(SOURCE / "data")
        for kind, block in blocks(SOURCE, page):
            if kind != "console":
                continue
            new = []
            for command, shown in commands(block):
                done = subprocess.run(
                    ["sh", "-c", f"(exit {code})\n{command}"],
                    cwd=folder,
                    env=ENVIRONMENT,
                    stdout=subprocess.PIPE,
                    stderr=subprocess.STDOUT,
                    text=True,
                    stdin=subprocess.DEVNULL,
                )
                printed, code, count = done.stdout.splitlines(), done.returncode, count + 1
                if code == 127:
                    sys.exit(f"{page}: $ {command}\n{done.stdout}")
                if not matches(shown, printed):
                    wrong.append(difference(f"{page}: $ {command}", shown, printed))
                new += [
                    "$ " + command.replace("\n", "\n> "),
                    *(shown if "..." in shown or matches(shown, printed) else printed),
                ]
            text = text.replace(block, "".join(f"{line}\n" for line in new))
        if os.environ.get("UPDATE") == "1":
            Path(SOURCE, page).write_text(text, encoding="utf-8")
if wrong and os.environ.get("UPDATE") != "1":
    sys.exit("\n\n".join(wrong) + "\n\nUPDATE=1 writes the outputs into the pages: read the diff")
assert count >= 20, count
print(f"{count} commands run")
