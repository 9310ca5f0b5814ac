"""Machine code as text, as objdump prints it: what each instruction counts as, and how fast a loop of them could be at best.

Nothing here executes or guesses: a mnemonic that instructions.csv does not know raises UnknownInstruction.

A loop is bounded as if the processor had no limits but the latencies. Every operation starts when all that it reads is there; branches
are taken as predicted and never wait. Values carried from one iteration to the next then set the pace: after some iterations the loop
advances by the length of its longest cycle of dependences. Registers and memory are renamed by the processor, so only true dependences
count. A value stored and loaded again inside the loop is followed, in granules of 4 bytes, and costs the latency `load`; other loads are
of values that were there long before.
"""

import csv
import re
from collections import namedtuple
from functools import cache
from pathlib import Path

FLOATING_POINT = [
    "add",
    "mul",
    "div",
    "sqrt",
    "fma",
    "rsqrt",
    "rcp",
    "convert",
    "compare",
    "minmax",
]
PREFIXES = {
    "data16",
    "cs",
    "ds",
    "notrack",
    "bnd",
    "lock",
    "rep",
    "repz",
    "repnz",
    "{vex}",
    "{evex}",
}


class UnknownInstruction(Exception):
    """A mnemonic that instructions.csv does not list."""


# Operands in AT&T order: sources first, destination last; target: of a jump, or None.
Instruction = namedtuple("Instruction", "address mnemonic operands target text")
# What an instruction reads, writes and how long that takes; memory that it loads first, and how long that takes.
Step = namedtuple("Step", "reads writes latency loads load_latency")


def read_table(name):
    with open(Path(__file__).with_name(name), newline="") as file:
        return list(
            csv.DictReader((line for line in file if not line.startswith("#")), delimiter=";")
        )


def read_latencies():
    """Zen 2's: {row: cycles}"""
    return {row["row"]: float(row["cycles"]) for row in read_table("latencies.csv")}


INSTRUCTIONS = [
    (row["kind"], row["latency"], re.compile(row["pattern"]))
    for row in read_table("instructions.csv")
]


def split_operands(text):
    """At the commas that stand outside brackets: '0x8(%rax,%rbx,8),%xmm0' has two operands."""
    return tuple(part.strip() for part in re.split(r",(?![^(]*\))", text) if part.strip())


def parse_disassembly(text):
    """{address: Instruction} of the output of `objdump -d --no-show-raw-insn` (GNU's or LLVM's)."""
    code = {}
    for line in text.splitlines():
        match = re.match(r"^\s*([0-9a-f]+):\s+(.*?)\s*$", line)
        if not match or match[2].endswith(">:"):
            continue
        words = match[2].split("#")[0].split("<")[0].split()
        while len(words) > 1 and words[0] in PREFIXES:
            words.pop(0)
        if not words:
            continue
        mnemonic, operands = words[0], split_operands(" ".join(words[1:]))
        jumps = mnemonic.startswith("j") and operands and not operands[0].startswith("*")
        address = int(match[1], 16)
        code[address] = Instruction(
            address, mnemonic, operands, int(operands[0], 16) if jumps else None, " ".join(words)
        )
    return code


# ---- What an instruction counts as


@cache
def row_of(mnemonic):
    """(kind, latency row). The v of the AVX form is AT&T's; no mnemonic of the table begins with v itself."""
    for kind_of_row, latency, pattern in INSTRUCTIONS:
        if pattern.fullmatch(mnemonic.removeprefix("v")):
            return kind_of_row, latency
    raise UnknownInstruction(
        f"instruction '{mnemonic}' is not in instructions.csv: add a row that says what it counts as"
    )


def kind(instruction):
    return row_of(instruction.mnemonic)[0]


def latency_row(instruction):
    row = row_of(instruction.mnemonic)[1]
    if row in ("div", "sqrt"):
        row += ".s" if re.search(r"[sp]s$", instruction.mnemonic) else ".d"
    registers = " ".join(operand for operand in instruction.operands if "(" not in operand)
    if (
        row == "move"
        and re.search(r"mm\d", instruction.text)
        and re.search(r"%[re][a-ds1-9]", registers)
    ):
        row = "transfer"
    return row


def widest(instruction):
    """Bytes of its widest vector register; 0 for none."""
    sizes = {"x": 16, "y": 32, "z": 64}
    return max(
        [
            sizes[match]
            for operand in instruction.operands
            for match in re.findall(r"^%([xyz])mm\d+", operand)
        ]
        + [0]
    )


def lanes(instruction):
    """1 for a scalar instruction, else the number of elements: of the wider side, for a conversion."""
    name = instruction.mnemonic
    if not re.search(r"p([sd])(2p[sd]|2dq)?[xyz]?$|dq2p([sd])$", name):
        return 1
    width = (
        32 if name.endswith("y") else widest(instruction)
    )  # vcvtpd2psy (mem),%xmm: the source's width is in the name alone
    return width // (8 if "pd" in name else 4)


def operations(instruction):
    """{kind: floating point operations of one execution}; empty for what is not arithmetic."""
    what = kind(instruction)
    if what == "dot":
        count = lanes(instruction)
        return {"mul": count, "add": count - count // 4 if count >= 4 else count - 1}
    return {what: lanes(instruction)} if what in FLOATING_POINT else {}


# ---- The longest chain


def chain(steps, iterations=64):
    """Cycles per iteration, once the loop is under way."""
    ready, made = {}, set()  # by value: when; which are stored in the loop
    finish = middle = 0.0
    for iteration in range(2 * iterations):
        for step in steps:
            start = max((ready.get(value, 0.0) for value in step.reads), default=0.0)
            loaded = max((ready[value] for value in step.loads if value in made), default=None)
            start = start if loaded is None else max(start, loaded + step.load_latency)
            for value in step.writes:
                ready[value] = start + step.latency
                made.add(value)
            finish = max(finish, start + step.latency)
        middle = finish if iteration == iterations - 1 else middle
    return (finish - middle) / iterations


def register(operand):
    """One name for all widths of a register: %xmm3 and %ymm3 are v3, %eax and %al are ax."""
    name = operand.lstrip("*%").split("{")[0]
    if match := re.fullmatch(r"[xyz]mm(\d+)", name):
        return "v" + match[1]
    if match := re.fullmatch(r"[re]?([abcd])[xlh]", name):
        return match[1] + "x"
    return re.sub(
        r"^(r\d+)[dwb]$", r"\1", re.sub(r"^[re](si|di|bp|sp)$|^(si|di|bp|sp)l$", r"\1\2", name)
    )


def access_bytes(instruction):
    """Size of the memory operand, as far as the dependences need it."""
    name = instruction.mnemonic
    if name.endswith("ss") or name.startswith("vcvtss") or name.endswith("ss2sd"):
        return 4
    if (
        re.search(r"s[d]$", name)
        or name in ("vmovddup", "movddup")
        and "%ymm" not in instruction.text
    ):
        return 8
    return widest(instruction) or (4 if re.search(r"%e[a-ds]|%r\d+d", instruction.text) else 8)


def granules(operand, size):
    """The memory an operand means, in pieces of 4 bytes, named by base register and displacement."""
    displacement, base = operand.split("(", 1)
    offset = int(displacement, 16) if re.fullmatch(r"-?(0x)?[0-9a-f]+", displacement) else 0
    return tuple(f"({base}+{offset + 4 * k}" for k in range(max(1, size // 4)))


def step_of(instruction, latencies):
    """What one instruction reads and writes; None for a jump or a nop."""
    name, operands, what = instruction.mnemonic, instruction.operands, kind(instruction)
    if what == "control" or not operands:
        return None
    bare = name.removeprefix("v")
    sources, target = list(operands[:-1]), operands[-1]
    flags_only = re.match(r"u?comis|test|cmp[lqbw]?$|ptest", bare) is not None
    # read and written: fma, and the two-operand forms of SSE and of integers
    both = what == "fma" or (
        not name.startswith("v") and not re.match(r"mov|lea|set|cvt|sqrt|rsqrt|pshuf", bare)
    )
    half = re.match(r"mov[lh]p", bare) or (
        re.match(r"movs[sd]$", bare) and not name.startswith("v") and "(" not in instruction.text
    )
    if flags_only or both or half:
        sources.append(target)
    if (
        re.match(r"(p?xor|psub|pandn|pcmpgt)", bare)
        and len({s for s in sources if not s.startswith("$")}) == 1
    ):
        sources = []  # a zero, whatever was in the register
    reads = ["flags"] if re.match(r"set|cmov", bare) else []
    loads = []
    for source in sources:
        if "(" not in source:
            reads += [] if source.startswith("$") else [register(source)]
        elif bare.startswith("lea"):
            reads += [register(r) for r in re.findall(r"%\w+", source)]
        else:
            loads += granules(source, access_bytes(instruction))
    latency = latencies[
        "move" if "(" in target and what == "move" and not flags_only else latency_row(instruction)
    ]
    stores = granules(target, access_bytes(instruction)) if "(" in target else (register(target),)
    return Step(reads, ("flags",) if flags_only else stores, latency, loads, latencies["load"])


def steps_of(path, latencies):
    return [step for step in (step_of(instruction, latencies) for instruction in path) if step]
