"""How fast a loop could be if the processor had no limits but the latencies: the bound by the longest dependency chain.

A loop is a list of operations, each with what it reads, what it writes and how long that takes. Every operation starts when all
that it reads is there; branches are taken as predicted and never wait. Values carried from one iteration to the next then set
the pace: after some iterations the loop advances by the length of its longest cycle of dependences, which is the bound.

Registers and memory are renamed by the processor, so only true dependences count. A value stored and loaded again inside the
loop is followed, in granules of 4 bytes, and costs the latency `load`; other loads are from values that were there long before.
"""

import re
from dataclasses import dataclass
from pathlib import Path

from .machine_code import access_bytes

LATENCIES = Path(__file__).with_name("latencies.txt")


@dataclass(frozen=True)
class Operation:
    label: str
    reads: tuple
    writes: tuple
    latency: float
    loads: tuple = ()  # memory read, with its own latency before the operation's
    load_latency: float = 0


def read_latencies(path=LATENCIES):
    """Zen 2's: {row: cycles}"""
    lines = [line.split("#")[0].split() for line in Path(path).read_text().splitlines()]
    return {line[0]: float(line[1]) for line in lines if line}


def chain(operations, iterations=64):
    """(cycles per iteration, [(label, latency), ...]): the pace, and the operations of one round of the cycle that sets it."""
    ready, maker = {}, {}  # by value: when, and by which executed operation
    finish, because = [], []

    def wait(values):
        latest = max(values, key=lambda value: ready.get(value, 0.0), default=None)
        return (ready.get(latest, 0.0), maker.get(latest)) if latest is not None else (0.0, None)

    middle = 0.0
    for iteration in range(2 * iterations):
        for operation in operations:
            start, source = wait(operation.reads)
            loaded, stored_by = wait(operation.loads)
            if stored_by is not None and loaded + operation.load_latency > start:
                start, source = loaded + operation.load_latency, stored_by
            for value in operation.writes:
                ready[value], maker[value] = start + operation.latency, len(finish)
            finish.append(start + operation.latency)
            because.append(source)
        if iteration == iterations - 1:
            middle = max(finish)
    pace = (max(finish) - middle) / iterations

    # Walk back from the latest result until an operation of the loop comes round again.
    here, walked, place = finish.index(max(finish)), [], {}
    while here is not None:
        index = here % len(operations)
        if index in place:
            walked = walked[place[index] :]
            break
        place[index] = len(walked)
        walked.append(here)
        here = because[here]
    else:
        return pace, []
    steps = []
    for executed in reversed(walked):
        source = because[executed]
        steps.append((operations[executed % len(operations)].label, finish[executed] - (finish[source] if source is not None else 0)))
    return pace, steps


WIDE = {"a": "ax", "b": "bx", "c": "cx", "d": "dx"}


def register(operand):
    """One name for all widths of a register: %xmm3 and %ymm3 are v3, %eax and %al are ax."""
    name = operand.lstrip("*%").split("{")[0]
    match = re.fullmatch(r"[xyz]mm(\d+)", name)
    if match:
        return "v" + match[1]
    match = re.fullmatch(r"[re]?([abcd])[xlh]", name)
    if match:
        return WIDE[match[1]]
    return re.sub(r"^(r\d+)[dwb]$", r"\1", re.sub(r"^[re](si|di|bp|sp)$|^(si|di|bp|sp)l$", r"\1\2", name))


def is_memory(operand):
    return "(" in operand


def granules(operand, size):
    """The memory an operand means, in pieces of 4 bytes, named by base register and displacement."""
    displacement, base = operand.split("(", 1)
    try:
        offset = int(displacement, 16) if displacement else 0
    except ValueError:
        offset = 0
    return tuple(f"({base}+{offset + 4 * k}" for k in range(max(1, size // 4)))


def operation(instruction, classifier, latencies):
    """The reads, writes and latency of one instruction; None for a jump or a nop."""
    name, operands = instruction.mnemonic, instruction.operands
    kind, row = classifier.kind(instruction), classifier.latency_row(instruction)
    if kind == "control" or not operands:
        return None
    bare = name[1:] if name.startswith("v") else name
    sources, target = list(operands[:-1]), operands[-1]
    flags_only = re.match(r"u?comis|test|cmp[lqbw]?$|ptest", bare) is not None
    if flags_only:
        sources.append(target)
    elif kind == "fma" or (not name.startswith("v") and not re.match(r"mov|lea|set|cvt|sqrt|rsqrt|pshuf", bare)):
        sources.append(target)  # read and written; two-operand forms of SSE and of integers
    elif re.match(r"mov[lh]p", bare) or (re.match(r"movs[sd]$", bare) and not name.startswith("v") and "(" not in instruction.text):
        sources.append(target)
    if re.match(r"(p?xor|psub|pandn|pcmpgt)", bare) and len({s for s in sources if not s.startswith("$")}) == 1:
        sources = []  # a zero, whatever was in the register
    reads, loads = [], []
    for source in sources:
        if source.startswith("$"):
            continue
        if not is_memory(source):
            reads.append(register(source))
        elif bare.startswith("lea"):
            reads += [register(r) for r in re.findall(r"%\w+", source)]
        else:
            loads += granules(source, access_bytes(instruction))
    if re.match(r"set|cmov", bare):
        reads.append("flags")
    latency = latencies[row]
    if flags_only:
        writes = ("flags",)
    elif is_memory(target):
        writes, latency = granules(target, access_bytes(instruction)), latencies["move"] if kind == "move" else latency
    else:
        writes = (register(target),)
    return Operation(instruction.text, tuple(reads), tuple(writes), latency, tuple(loads), latencies["load"])


def operations_of(path, classifier, latencies):
    return [o for o in (operation(i, classifier, latencies) for i in path) if o]
