"""selections.py SOURCE BUILD: every selection of tests that pages, scripts and comments show selects a
test. ctest itself runs nothing, without a word, where a pattern matches no test.

A selection is what follows -R, -L or -E in a line with `ctest`, `./test` or `run_preset`.
"""

import json
import re
import subprocess
import sys
from pathlib import Path

SOURCE, BUILD = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
listed = subprocess.run(
    ["ctest", "--show-only=json-v1"], cwd=BUILD, capture_output=True, text=True, check=True
)
tests = json.loads(listed.stdout)["tests"]
names = [test["name"] for test in tests]
labels = sorted(
    {
        label
        for test in tests
        for row in test.get("properties", [])
        if row["name"] == "LABELS"
        for label in row["value"]
    }
)
# Stand-ins of instructions, variables of scripts, and what is not in this build.
NOT_A_NAME = re.compile(r"NAME|\$|\.\.\.")
# The test docs/release selects nothing on purpose.
files = subprocess.run(
    ["git", "ls-files", "-z"], cwd=SOURCE, capture_output=True, text=True, check=True
).stdout.split("\0")[:-1]
faults, count = [], 0
for name in files:
    if name in ("CHANGELOG.md", "docs/tests/release") or Path(name).suffix in (
        ".svg",
        ".png",
        ".ipynb",
        ".xz",
    ):
        continue
    try:
        text = (SOURCE / name).read_text(encoding="utf-8")
    except (UnicodeDecodeError, FileNotFoundError, IsADirectoryError):
        continue
    for number, line in enumerate(text.split("\n"), 1):
        if not re.search(r"\bctest\b|\./test\b|\brun_preset\b", line):
            continue
        for option, _, pattern in re.findall(r" -([RLE]) (['\"]?)([^'\"`\s,)]+)\2", line):
            pattern = pattern.replace("\\|", "|").rstrip(".")
            if NOT_A_NAME.search(pattern.rstrip("$")):
                continue
            count += 1
            known = labels if option == "L" else names
            # each alternative at the top, or of one group around all, must match by itself
            alternatives = re.fullmatch(r"\^?\(([^()]*)\)\$?", pattern)
            for part in (alternatives[1] if alternatives else pattern).split("|"):
                if "(" in part or ")" in part:
                    part = pattern
                if not any(re.search(part, one) for one in known):
                    faults.append(f"{name}:{number}: -{option} {pattern}: no test has '{part}'")
assert count >= 8, f"only {count} selections found"
print("\n".join(faults))
sys.exit(bool(faults))
