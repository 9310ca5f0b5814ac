"""What bound finds on the machine: processor, compilers, valgrind, llvm-mca; and how it speaks to the user.

What is not installed costs the columns that need it: `find_tools` says so on stderr, and they are NA.
"""

import platform
import re
import shutil
import subprocess
import sys
from pathlib import Path

from . import mca

CLANGS = [f"clang-{version}" for version in range(30, 13, -1)] + ["clang"]


def say(message):
    print(f"bound: {message}", file=sys.stderr, flush=True)


def fail(message):
    say(message)
    sys.exit(2)


def output_of(command, **more):
    done = subprocess.run(command, capture_output=True, text=True, **more)
    if done.returncode:
        lines = [line for line in (done.stderr + done.stdout).splitlines() if re.search("error|nrecogni[sz]ed|unhandled", line)]
        raise RuntimeError(f"'{Path(command[0]).name}' failed: {(lines or [done.stderr.strip()])[0]}")
    return done.stdout


def first_line(command):
    try:
        return output_of(command).strip().splitlines()[0]
    except (OSError, RuntimeError, IndexError):
        return "unknown"


def processor_name():
    try:
        text = Path("/proc/cpuinfo").read_text()
        name = re.search(r"^model name\s*:\s*(.+)$", text, re.M)[1]
        family, model = (re.search(rf"^{key}\s*:\s*(\d+)$", text, re.M)[1] for key in ("cpu family", "model"))
        return f"{name}, family {family}, model {model}"
    except (OSError, TypeError):
        return platform.processor() or "unknown"


def runs_here(isa):
    """Whether this processor executes what was compiled for Zen 2, and AVX-512 where a rung needs it."""
    try:
        flags = set(re.search(r"^flags\s*:(.*)$", Path("/proc/cpuinfo").read_text(), re.M)[1].split())
    except (OSError, TypeError):
        return False
    return {"avx2", "fma", "bmi2", "f16c", "movbe"} <= flags and (isa != "AVX512" or "avx512f" in flags)


def native_latencies():
    """The column of latencies.txt for the processor at hand, or None: AMD family 26 is Zen 5, family 23 has Zen 2."""
    name = processor_name()
    if "AMD" in name and "family 26" in name:
        return "zen5"
    if "AMD" in name and "family 23" in name:
        return "zen2"
    return None


def native_name(program):
    """llvm-mca's own name for the processor at hand; None for one that is newer than it, "(unknown)" in its words."""
    match = re.search(r"Host CPU: ([^\s(]+)", output_of([program, "--version"]))
    return match[1] if match else None


def find_tools():
    tools = {"valgrind": shutil.which("valgrind"), "mca": mca.find(), "native": None}
    if not shutil.which("objdump"):
        fail("objdump is not installed (package binutils), and without a disassembly nothing can be counted")
    if not tools["valgrind"]:
        say("valgrind is not installed (package valgrind): no counts, and no loops to bound; the models are still there")
    if not tools["mca"]:
        say("llvm-mca is not installed (package llvm): its columns are NA")
    else:
        tools["native"] = native_name(tools["mca"])
        if not tools["native"]:
            say(f"{tools['mca']} does not know this processor: no native column of it")
    return tools


def compilers_found(wanted):
    if wanted:
        missing = [name for name in wanted if not shutil.which(name)]
        if missing:
            fail(f"compiler '{missing[0]}' is not installed")
        return wanted
    found = [next((name for name in CLANGS if shutil.which(name)), None), "gcc" if shutil.which("gcc") else None]
    if not any(found):
        fail("neither clang nor gcc is installed")
    return [name for name in found if name]
