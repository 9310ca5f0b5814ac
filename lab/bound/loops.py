"""The hot loops of a rung as straight lines: the instructions of one iteration on the path that is taken most.

A loop of the ladder has branches (does it slip, which ball is pressed), but one collision goes the same way almost every step.
Beginning with the instruction executed most often, the path follows every jump in the direction taken more often until it comes
back; then the same for the most often executed instruction not yet seen, while it runs for at least a tenth of the steps.
"""


def successor(instruction, following, counts, taken):
    if instruction.mnemonic == "jmp":
        return instruction.target
    if instruction.target is not None and 2 * taken[instruction.address] > counts[instruction.address]:
        return instruction.target
    return following.get(instruction.address)


def hot_loops(code, counts, taken, threshold):
    """[(executions, [Instruction, ...])], most executed first; `threshold` is the least number of executions of a loop."""
    addresses = sorted(code)
    following = dict(zip(addresses, addresses[1:]))
    loops, seen = [], set()
    for start in sorted((a for a in addresses if counts[a] >= threshold), key=lambda a: (-counts[a], a)):
        if start in seen:
            continue
        path, place = [], {}
        here = start
        while here is not None and here in code and here not in place and counts[here] > 0:
            place[here] = len(path)
            path.append(code[here])
            here = successor(code[here], following, counts, taken)
        seen.update(place)
        if here == start:
            first = min(range(len(path)), key=lambda k: path[k].address)
            path = path[first:] + path[:first]
            loops.append((counts[start], path))
    return loops
