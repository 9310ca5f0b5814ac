"""Makes the outputs in the docs anew: tools/python tools/outputs.py [PAGE...], in a tree that ./run
has built, on a quiet machine.

Where a page has a line <!-- output of: COMMAND -->, the block `measured on MACHINE, DATE` below it
becomes what the command prints now, without its notes. The commands take some minutes together. The figures of
docs/figures are made by `cmake --build build --target figures`.
"""

import platform
import re
import subprocess
import sys
from datetime import date
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MARK = re.compile(
    r"(<!-- output of: (?P<command>.*) -->\n\n?)```measured on .*?\n.*?^```\n", re.M | re.S
)


def processor() -> str:
    """The name of the processor, as the kernel reports it."""
    names = re.findall(r"^model name\s*: (.*)$", Path("/proc/cpuinfo").read_text(), flags=re.M)
    return names[0] if names else platform.machine()


def measured_block(match: re.Match[str]) -> str:
    command = match["command"]
    print(command, flush=True)
    run = subprocess.run(["sh", "-c", command], cwd=ROOT, stdout=subprocess.PIPE, text=True)
    if run.returncode != 0:
        sys.exit(f"{command}: exit code {run.returncode}")
    shown = run.stdout.split("\nlargest errors:")[0].rstrip(
        "\n"
    )  # those are rows for `carom resolve`
    lines = (line.rstrip() for line in shown.split("\n") if not line.startswith("#"))
    head = f"measured on {processor()}, {date.today()}"
    return f"{match[1]}```{head}\n" + "\n".join(lines) + "\n```\n"


for page in map(Path, sys.argv[1:]) if sys.argv[1:] else sorted(ROOT.glob("docs/*/*.md")):
    text = page.read_text(encoding="utf-8")
    if MARK.search(text):
        page.write_text(MARK.sub(measured_block, text), encoding="utf-8")
