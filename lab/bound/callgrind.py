"""Execution counts per instruction, from the file that `valgrind --tool=callgrind --dump-instr=yes` writes.

Asked for with --collect-jumps=yes --compress-pos=no --compress-strings=no the format is plain: `fn=NAME` opens a function, then
`ADDRESS LINE COUNT` says how often the instruction at ADDRESS was executed. The line after `calls=` is the cost of what was
called, and not counted here. `jcnd=TAKEN/EXECUTED TARGET ...` is followed by the position of the conditional jump.
"""

from collections import Counter


def parse_callgrind(text):
    """(counts, taken): executions by address, and how often the conditional jump at an address was taken."""
    counts, taken = Counter(), Counter()
    skip, jump = False, None
    if "positions: instr" not in text:
        raise ValueError("no instruction addresses in the callgrind file: run it with --dump-instr=yes")
    for line in text.splitlines():
        if line.startswith("calls="):
            skip = True
        elif line.startswith("jcnd="):
            jump = int(line[5:].split("/")[0])
        elif line.startswith("jump="):
            jump = 0
        elif line.startswith("0x"):
            words = line.split()
            address = int(words[0], 16)
            if jump is not None:
                taken[address] += jump
                jump = None
            elif skip:
                skip = False
            elif len(words) > 2:
                counts[address] += int(words[2])
    return counts, taken


def join(code, counts, classifier):
    """Operations and instructions by kind: {kind: executed operations} with '<kind>_instructions' beside each."""
    total = Counter()
    for address, instruction in code.items():
        executed = counts.get(address, 0)
        if not executed:
            continue
        kind = classifier.kind(instruction)
        for name, operations in classifier.operations(instruction).items():
            total[name] += executed * operations
        total[kind + "_instructions"] += executed
        total["instructions"] += executed
    return total


def flops(total, fma=1):
    """Add, mul, div, sqrt and fma, as the seed paper counts; AMD's counter counts a fused multiply-add as fma=2."""
    return sum(total[kind] for kind in ("add", "mul", "div", "sqrt")) + fma * total["fma"]
