"""Operations and hot loops of one kernel, by running the module that was timed under callgrind.

`valgrind --tool=callgrind --dump-instr=yes` says how often the instruction at each address was executed, and its `jcnd=` lines how
often a conditional jump was taken. Joined with the module's disassembly these are operations by kind, and the path through the loop
that one collision takes in almost every step.
"""

import re
import subprocess
import tempfile
from collections import Counter
from pathlib import Path

from . import dataflow, machine_code

COUNTED = ["add", "mul", "div", "sqrt", "fma"]
OTHERS = {"rsqrt": "rsqrt", "rcp": "rcp", "convert": "conversions", "compare": "compares", "minmax": "minmax"}


def output_of(command, **more):
    done = subprocess.run(command, capture_output=True, text=True, **more)
    if done.returncode:
        lines = [line for line in (done.stderr + done.stdout).splitlines() if re.search("error|nrecogni[sz]ed|unhandled", line)]
        raise RuntimeError(f"'{Path(command[0]).name}' failed: {(lines or [done.stderr.strip()])[0]}")
    return done.stdout


def code_of(module, kernel):
    """The instructions of a kernel: {address: Instruction}."""
    text = output_of(["objdump", "-d", "--no-show-raw-insn", module])
    blocks = re.split(r"^[0-9a-f]+ <([^>]+)>:$", text, flags=re.M)
    return machine_code.parse_disassembly(dict(zip(blocks[1::2], blocks[2::2])).get(f"carom_rung_{kernel}", ""))


def parse_callgrind(text):
    """(counts, taken): executions by address, and how often the conditional jump at an address was taken. The line after `calls=`
    is the cost of what was called, and not counted here."""
    counts, taken = Counter(), Counter()
    skip, jump = False, None
    if "positions: instr" not in text:
        raise ValueError("no instruction addresses in the callgrind file: run it with --dump-instr=yes")
    for line in text.splitlines():
        if line.startswith("calls="):
            skip = True
        elif line.startswith(("jcnd=", "jump=")):
            jump = int(line[5:].split("/")[0]) if line.startswith("jcnd=") else 0
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


def execute(driver, module, kernel, steps, cases):
    """(counts, taken) of a run under callgrind."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "callgrind.out"
        words = ["--tool=callgrind", "--dump-instr=yes", "--collect-jumps=yes", "--compress-pos=no", "--compress-strings=no"]
        output_of(["valgrind", *words, f"--callgrind-out-file={out}", driver, module, kernel, str(steps)], input=cases)
        return parse_callgrind(out.read_text())


def join(code, counts, classifier):
    """Operations and instructions by kind: {kind: executed operations} with '<kind>_instructions' beside each."""
    total = Counter()
    for address, instruction in code.items():
        executed = counts.get(address, 0)
        if not executed:
            continue
        for name, operations in classifier.operations(instruction).items():
            total[name] += executed * operations
        total[classifier.kind(instruction) + "_instructions"] += executed
        total["instructions"] += executed
    return total


def flops(total, fma=1):
    """Add, mul, div, sqrt and fma, as the seed paper counts; AMD's counter counts a fused multiply-add as fma=2."""
    return sum(total[kind] for kind in ("add", "mul", "div", "sqrt")) + fma * total["fma"]


def hot_loops(code, counts, taken, threshold):
    """[(executions, [Instruction, ...])], most executed first: the instructions of one iteration on the path that is taken most.

    Beginning with the instruction executed most often, the path follows every jump in the direction taken more often until it comes
    back; then the same for the next instruction not yet seen, while it runs `threshold` times at least."""
    addresses = sorted(code)
    following = dict(zip(addresses, addresses[1:]))
    loops, seen = [], set()
    for start in sorted((a for a in addresses if counts[a] >= threshold), key=lambda a: (-counts[a], a)):
        path, here = {}, start
        while start not in seen and here in code and here not in path and counts[here] > 0:
            path[here] = instruction = code[here]
            jumps = instruction.mnemonic == "jmp" or instruction.target is not None and 2 * taken[here] > counts[here]
            here = instruction.target if jumps else following.get(here)
        seen.update(path)
        if path and here == start:
            first = list(path).index(min(path))
            loops.append((counts[start], list(path.values())[first:] + list(path.values())[:first]))
    return loops


def counts_row(few, many, steps):
    """Columns of the counts: of a collision in N steps, and of a step, from N and the fewer steps of the other run."""
    step = Counter({kind: (many[kind] - few[kind]) / (steps - steps // 4) for kind in many})
    row = {f"flops_{kind}": many[kind] for kind in COUNTED} | {name: many[kind] for kind, name in OTHERS.items()}
    row |= {"flops_total": flops(many), "flops_amd": flops(many, fma=2)}
    row |= {"shuffles": many["shuffle_instructions"], "instructions": many["instructions"]}
    row |= {f"per_step_{kind}": step[kind] for kind in COUNTED} | {f"per_step_{name}": step[kind] for kind, name in OTHERS.items()}
    row |= {"per_step_flops": flops(step), "per_step_flops_amd": flops(step, fma=2), "per_step_instructions": step["instructions"]}
    return row


def bounds_row(loops, classifier, latencies, describe):
    """Columns of the bounds, per collision: the sum over the hot loops of executions times cycles per iteration."""
    row = Counter(steps_total=sum(executions for executions, _ in loops))
    for executions, path in loops:
        for machine, cycles_of in latencies.items():
            pace, chain = dataflow.chain(dataflow.operations_of(path, classifier, cycles_of))
            row[f"chain_cycles_{machine}"] += executions * pace
            describe(f"loop of {executions} iterations, {len(path)} instructions; {machine}: {pace:g} cycles each")
            for label, cycles in chain:
                describe(f"    {cycles:4g}  {label}")
    return dict(row)


def measure(driver, module, kernel, steps, cases, case, latencies, describe):
    """{column: value}: operations as the mean over `cases`, texts of a line each, and bounds of the one `case`."""
    classifier, code = machine_code.Classifier(), code_of(module, kernel)
    totals = []
    for n in (steps // 4, steps):
        counts, _ = execute(driver, module, kernel, n, "".join(cases))
        totals.append(Counter({kind: count / len(cases) for kind, count in join(code, counts, classifier).items()}))
    counts, taken = execute(driver, module, kernel, steps, case)
    return counts_row(*totals, steps) | bounds_row(hot_loops(code, counts, taken, steps / 10), classifier, latencies, describe)
