"""Machine code as text: what objdump prints, and what each instruction counts as (instructions.txt).

Nothing here executes or guesses: a mnemonic that the table does not know raises UnknownInstruction.
"""

import re
from dataclasses import dataclass
from pathlib import Path

TABLE = Path(__file__).with_name("instructions.txt")
FLOATING_POINT = ("add", "mul", "div", "sqrt", "fma", "rsqrt", "rcp", "convert", "compare", "minmax")


class UnknownInstruction(Exception):
    """A mnemonic that instructions.txt does not list."""


@dataclass(frozen=True)
class Instruction:
    address: int
    mnemonic: str
    operands: tuple  # AT&T order: sources first, destination last
    target: int | None  # of a jump
    text: str


LINE = re.compile(r"^\s*([0-9a-f]+):\s+(.*?)\s*$")
PREFIXES = {"data16", "cs", "ds", "notrack", "bnd", "lock", "rep", "repz", "repnz", "{vex}", "{evex}"}


def split_operands(text):
    """Splits at the commas that stand outside brackets: '0x8(%rax,%rbx,8),%xmm0' has two operands."""
    parts, depth, current = [], 0, ""
    for character in text:
        depth += (character == "(") - (character == ")")
        if character == "," and depth == 0:
            parts.append(current.strip())
            current = ""
        else:
            current += character
    return tuple(parts + [current.strip()]) if current.strip() else tuple(parts)


def parse_disassembly(text):
    """{address: Instruction} of the output of `objdump -d --no-show-raw-insn` (GNU's or LLVM's)."""
    code = {}
    for line in text.splitlines():
        match = LINE.match(line)
        if not match or match[2].endswith(">:"):
            continue
        words = match[2].split("#")[0].split("<")[0].split()
        while len(words) > 1 and words[0] in PREFIXES:
            words.pop(0)
        if not words:
            continue
        mnemonic, operands = words[0], split_operands(" ".join(words[1:]))
        target = None
        if mnemonic.startswith("j") and operands and not operands[0].startswith("*"):
            target = int(operands[0], 16)
        address = int(match[1], 16)
        code[address] = Instruction(address, mnemonic, operands, target, " ".join(words))
    return code


class Classifier:
    """Kind, latency row and number of operations of an instruction, by the table instructions.txt."""

    def __init__(self, table=TABLE):
        self.rows = []
        for line in Path(table).read_text().splitlines():
            line = line.split("#")[0]
            if line.strip():
                kind, latency, pattern = line.split()
                self.rows.append((kind, latency, re.compile(pattern)))
        self.known = {}

    def row(self, mnemonic):
        if mnemonic not in self.known:
            # AT&T's v of the AVX form; no mnemonic of the table begins with v itself.
            bare = mnemonic[1:] if mnemonic.startswith("v") else mnemonic
            for kind, latency, pattern in self.rows:
                if pattern.fullmatch(bare):
                    self.known[mnemonic] = kind, latency
                    break
            else:
                raise UnknownInstruction(
                    f"instruction '{mnemonic}' is not in {TABLE.name}: add a line that says what it counts as"
                )
        return self.known[mnemonic]

    def kind(self, instruction):
        return self.row(instruction.mnemonic)[0]

    def operations(self, instruction):
        """{kind: floating point operations of one execution}; empty for what is not arithmetic."""
        kind = self.kind(instruction)
        if kind == "dot":
            count = lanes(instruction)
            return {"mul": count, "add": count - count // 4 if count >= 4 else count - 1}
        return {kind: lanes(instruction)} if kind in FLOATING_POINT else {}

    def latency_row(self, instruction):
        row = self.row(instruction.mnemonic)[1]
        if row in ("div", "sqrt"):
            row += ".s" if re.search(r"[sp]s$", instruction.mnemonic) else ".d"
        if row == "move" and re.search(r"mm\d", instruction.text) and re.search(r"%[re][a-ds1-9]", without_memory(instruction)):
            row = "transfer"
        return row


def without_memory(instruction):
    return " ".join(operand for operand in instruction.operands if "(" not in operand)


def register_bytes(operand):
    match = re.match(r"%([xyz])mm\d+", operand)
    return {"x": 16, "y": 32, "z": 64}[match[1]] if match else 0


def lanes(instruction):
    """1 for a scalar instruction, else the number of elements: of the wider side, for a conversion."""
    name = instruction.mnemonic
    packed = re.search(r"p([sd])(2p[sd]|2dq)?[xyz]?$|dq2p([sd])$", name)
    if not packed:
        return 1
    width = max([register_bytes(operand) for operand in instruction.operands] + [0])
    if name.endswith("y"):  # vcvtpd2psy (mem),%xmm: the width of the source in memory is in the name alone
        width = 32
    return width // (8 if "pd" in name else 4)


def access_bytes(instruction):
    """Size of the memory operand of a floating point or integer instruction, as far as the dependences need it."""
    name = instruction.mnemonic
    if name.endswith("ss") or name.startswith("vcvtss") or name.endswith("ss2sd"):
        return 4
    if re.search(r"s[d]$", name) or name in ("vmovddup", "movddup") and "%ymm" not in instruction.text:
        return 8
    width = max([register_bytes(operand) for operand in instruction.operands] + [0])
    if width:
        return width
    return 4 if re.search(r"%e[a-ds]|%r\d+d", instruction.text) else 8
