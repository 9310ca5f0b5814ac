"""palette.py [ROOT]: writes data/palette.csv, the colours and measures of pictures of a table, into
the sources of each language that draws one. With --check it writes nothing, and fails where a source
is not as it would be written.

The rows of a kind `ball` are in the order of the numbers of pool: the cue ball, 1 to 8, and then those
that only snooker has. Each has the colour of the ball, of its path, and of the number on the ball.
"""

import csv
import json
import re
import sys
from pathlib import Path

NOTE = "Written by tools/palette.py from data/palette.csv: colours and sizes of a table from above."
DISCIPLINES = "pool", "snooker", "carom"


def read(root):
    """The rows of each kind: {"cloth": {"pool": "#0a5568", ...}, ..., "ball": {"white": (colour,
    path, ink), ...}, "size": {"margin": 0.05, ...}}.
    """
    kinds = {}
    with (root / "data/palette.csv").open(encoding="utf-8") as rows:
        for row in csv.DictReader(rows):
            value = row["value"]
            if row["kind"] == "ball":
                value = (row["value"], row["path"], row["ink"])
            elif row["kind"] == "size":
                value = float(row["value"])
            kinds.setdefault(row["kind"], {})[row["name"]] = value
    return kinds


def in_c(kinds):
    lines = [f"/* {NOTE} */", "#ifndef CAROM_CLI_PALETTE_H", "#define CAROM_CLI_PALETTE_H", ""]
    lines += [
        f'#define PALETTE_{name.upper()} "{colour}"' for name, colour in kinds["part"].items()
    ]
    lines.append("/* Sizes are in metres, but the margin and the letters are shares. */")
    lines += [
        f"#define PALETTE_SIZE_{name.upper()} {size:g}" for name, size in kinds["size"].items()
    ]
    lines += [
        "",
        "/* TABLE(discipline, cloth, cushion, wood) */",
        "#define PALETTE_TABLES(TABLE) \\",
    ]
    tables = [
        f'  TABLE({name}, "{kinds["cloth"][name]}", "{kinds["cushion"][name]}", "{kinds["wood"][name]}")'
        for name in DISCIPLINES
    ]
    lines += [" \\\n".join(tables)]
    lines += [
        "",
        "/* BALL(name, colour, path, ink): the cue ball, 1 to 8, and others of snooker */",
    ]
    lines += ["#define PALETTE_BALLS(BALL) \\"]
    balls = [
        f'  BALL("{name}", "{colour}", "{path}", "{ink}")'
        for name, (colour, path, ink) in kinds["ball"].items()
    ]
    lines += [" \\\n".join(balls), "", "#endif", ""]
    return "/* clang-format off */\n" + "\n".join(lines)


def in_python(kinds):
    lines = [f'"""{NOTE}"""', "", "from __future__ import annotations", ""]
    for kind in ("cloth", "cushion", "wood", "part", "size"):
        lines.append(f"{kind.upper()} = {{")
        lines += [
            f"    {json.dumps(name)}: {json.dumps(value)}," for name, value in kinds[kind].items()
        ]
        lines.append("}")
    lines.append(
        "# the cue ball, 1 to 8, and others of snooker: of the ball, of its path, of its number"
    )
    lines.append("BALLS = {")
    lines += [
        f'    "{name}": ("{colour}", "{path}", "{ink}"),'
        for name, (colour, path, ink) in kinds["ball"].items()
    ]
    return "\n".join([*lines, "}", ""])


def camel(name):
    return re.sub(r"_(.)", lambda found: found[1].upper(), name)


def in_javascript(kinds, name, comment, end):
    """The same object for the player and for the npm package."""
    lines = [f"// {NOTE}", "", comment, f"export const {name} = {{"]
    for kind in ("cloth", "cushion", "wood", "part", "size"):
        lines.append(f"  {kind}: {{")
        lines += [f"    {camel(key)}: {json.dumps(value)}," for key, value in kinds[kind].items()]
        lines.append("  },")
    lines.append("  /** The cue ball, 1 to 8, and others of snooker. */")
    lines.append("  balls: [")
    lines += [
        f'    {{ name: "{ball}", colour: "{colour}", path: "{path}", ink: "{ink}" }},'
        for ball, (colour, path, ink) in kinds["ball"].items()
    ]
    return "\n".join([*lines, "  ],", f"}}{end};", ""])


def texts(root):
    """The sources, by their paths."""
    kinds = read(root)
    of_player = "/** Colours and sizes (m; margin and letters are shares) of a table from above. */"
    of_package = of_player.replace("above. */", "above, as carom's command draws it. */")
    return {
        "command/pictures/palette.h": in_c(kinds),
        "python/src/carom/_palette.py": in_python(kinds),
        "web/player/palette.js": in_javascript(kinds, "PALETTE", of_player, ""),
        "web/npm/src/palette.ts": in_javascript(kinds, "palette", of_package, " as const"),
    }


def main(words):
    check = "--check" in words
    root = Path(next((word for word in words if word != "--check"), "."))
    stale = []
    for name, text in texts(root).items():
        path = root / name
        if path.is_file() and path.read_text(encoding="utf-8") == text:
            continue
        stale.append(name)
        if not check:
            path.write_text(text, encoding="utf-8")
    if check and stale:
        sys.exit(f"{', '.join(stale)}: not as data/palette.csv says; run python3 tools/palette.py")


if __name__ == "__main__":
    main(sys.argv[1:])
