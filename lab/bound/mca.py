"""What llvm-mca says of a loop: cycles per iteration with the processor's limits modelled, and the bound by throughput alone.

llvm-mca knows dependences through registers only: a value stored in one iteration and loaded in the next counts as there at
once (dataflow.py follows it). Branches count as predicted.
"""

import re
import shutil
import subprocess

NAMES = ["llvm-mca"] + [f"llvm-mca-{version}" for version in range(30, 13, -1)]
ITERATIONS = 400


class McaFailed(Exception):
    """llvm-mca does not take the code or does not know the processor."""


def find():
    """The newest llvm-mca installed, or None."""
    return next((name for name in NAMES[1:] + NAMES[:1] if shutil.which(name)), None)


def assembly(path):
    """A loop as the assembler takes it: jumps lead to the end, where the next iteration begins."""
    lines = [f"{i.mnemonic} .Lnext" if i.target is not None else i.text for i in path]
    return "\n".join(lines) + "\n.Lnext:\n"


def run(program, path, processor, iterations):
    command = [program, "-mtriple=x86_64", f"-mcpu={processor}", f"-iterations={iterations}"]
    done = subprocess.run(command, input=assembly(path), capture_output=True, text=True)
    cycles = re.search(r"^Total Cycles:\s+(\d+)", done.stdout, re.M)
    throughput = re.search(r"^Block RThroughput:\s+([\d.]+)", done.stdout, re.M)
    if done.returncode or not cycles:
        raise McaFailed((done.stderr.strip().splitlines() or ["no output"])[0])
    return int(cycles[1]), float(throughput[1])


def cycles_per_iteration(program, path, processor):
    """(cycles, cycles by throughput alone): the difference of two runs, so that filling and draining do not count."""
    short, _ = run(program, path, processor, ITERATIONS)
    long, throughput = run(program, path, processor, 2 * ITERATIONS)
    return (long - short) / ITERATIONS, throughput
