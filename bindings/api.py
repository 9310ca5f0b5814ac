"""The interface of the library as data, read from the headers: constants, enumerations, structs,
callbacks and functions.

api.py json INCLUDE         the description as JSON, which README.md explains
api.py functions INCLUDE    the names of the functions
api.py abi INCLUDE          sizes, offsets and values, a line each; abi-wasm32: on WebAssembly
api.py c INCLUDE            a C program that prints the same as its compiler sees it

The declarations are parsed by pycparser. A comment next to or above a declaration is its
description. Sizes and offsets are those of 64-bit systems; "wasm32" has those with pointers of 32
bits. The tests packaging/abi and bindings/api compare them with compilers.
"""

import json
import re
import sys
from pathlib import Path

from pycparser import c_ast, c_parser

HEADERS = [
    "carom.h",
    "carom_shot.h",
    "carom_tangent.h",
    "carom_record.h",
    "carom_plan.h",
    "carom_match.h",
    "carom_coach.h",
]
# Each type of C, its bytes ("-": none of its own), and what C# and Rust call it.
TYPES = [
    row.split()
    for row in """double 8 double f64
float 4 float f32
char 1 byte c_char
int 4 int c_int
int8_t 1 sbyte i8
int32_t 4 int i32
uint32_t 4 uint u32
int64_t 8 long i64
uint64_t 8 ulong u64
size_t - UIntPtr usize
void - void c_void""".splitlines()
]
SIZES = {name: int(size) for name, size, _, _ in TYPES if size != "-"}
BUILT_IN = "".join(f"typedef int {name};" for name in ("size_t", *SIZES) if name.endswith("_t"))
# Arguments that a function reads and writes. Of the other pointers those to const are read, and the
# rest written.
READ_AND_WRITTEN = set(
    """carom_shoot shot
carom_shot_continue shot
carom_place_ball balls
carom_shot_tangent tangent
carom_player_strike cue
carom_aim cue
carom_aim pot
carom_rules_judge state
carom_match_stroke shot
carom_match_continue shot
carom_match_plan job
carom_ball_kind_for kind
carom_ball_kind_resolve options
carom_ball_kind_resolve kind
carom_condition_give kind
carom_record_play shot
carom_spot_ball balls
carom_spot_ball_of balls
carom_turn_settle balls
carom_turn_settle state
carom_turn_settle turn
carom_plan_replay choices
carom_way_chance way
carom_break_play counts""".splitlines()
)
# Objects that functions change, as carom_match_place() changes a match.
OBJECTS = ("match", "record")
# Macros without their own value: guards, marks, and expressions of other constants.
NO_VALUE = {"CAROM_API", "CAROM_VERSION_NUMBER", "CAROM_STOP_AT", "CAROM_KIND_NUMBERS"}
A_UNIT = r"m/s\^2|m/s|rad/s|1/m|s/m|N s|kg|m|s|J|Pa|degrees"
# A unit is first, after the lengths of an array, or after a comma; but "u, m/s" is about
# another number.
UNIT = re.compile(rf"(?:^(?:\[\w+\])*|(?<! u), |\()({A_UNIT})(?=[,.;:)]|$| from)")
UNITS = re.compile(rf"(?:(?:{A_UNIT}|-)(?:, |$))+")


class Header:
    """The text of a header: what declares, and the comments by the lines where they begin and end."""

    def __init__(self, path):
        self.comments, self.code = [], []  # (first line, last line, text); lines without comments
        text = path.read_text(encoding="utf-8")

        def blank(match):
            first = text.count("\n", 0, match.start()) + 1
            words = " ".join(match[0][2:-2].replace("\n *", "\n").split())
            self.comments.append((first, first + match[0].count("\n"), words))
            return re.sub(r"[^\n]", " ", match[0])

        code = re.sub(r"/\*.*?\*/", blank, text, flags=re.DOTALL)
        self.macros = [
            (m[1], m[2], code.count("\n", 0, m.start()) + 1)
            for m in re.finditer(r"^#define (\w+)(.*)$", code, flags=re.M)
        ]
        code = re.sub(
            r"#ifdef __cplusplus\n.*?#endif",
            lambda m: "\n" * m[0].count("\n"),
            code,
            flags=re.DOTALL,
        )
        code = re.sub(
            r"^#(?:.*\\\n)*.*$", lambda m: "\n" * m[0].count("\n"), code, flags=re.MULTILINE
        )
        self.code = code.replace("CAROM_API", "").split("\n")

    def above(self, line, over=0):
        """The comment that ends right above a line, or above up to `over` lines of code right above
        it.
        """
        for number in range(line - 1, max(line - 2 - over, 0), -1):
            for first, last, words in self.comments:
                if last == number and not self.code[first - 1].strip():
                    return words if not words.startswith(("----", "====")) else ""
            if not self.code[number - 1].strip():
                break
        return ""

    def trailing_comment(self, line):
        """The comment that begins on a line, after code."""
        return next((words for first, _, words in self.comments if first == line), "")


def type_of(node):
    """A type as {"type": name}, with "pointer", "const" and "array" where they apply."""
    if isinstance(node, c_ast.ArrayDecl):
        inner = type_of(node.type)
        return {**inner, "array": [node.dim, *inner.get("array", [])]}
    if isinstance(node, c_ast.PtrDecl):
        inner = type_of(node.type)
        return {
            **inner,
            "pointer": inner.get("pointer", 0) + 1,
            **({"to_array": inner.pop("array")} if "array" in inner else {}),
        }
    found = {"type": " ".join(node.type.names)}
    return {**found, "const": True} if "const" in node.quals else found


def header_of(include, name):
    """The planner's header is in its own folder."""
    return next(
        path
        for path in (include / name, include.parents[1] / "games" / "include" / name)
        if path.exists()
    )


class Api:
    """What the headers declare; `values` has all constants by their names."""

    def __init__(self, include):
        self.values, self.places, self.layouts = {}, {}, {}
        self.about = {
            kind: [] for kind in ("constants", "enums", "structs", "callbacks", "functions")
        }
        parser, earlier = c_parser.CParser(), BUILT_IN
        for name in HEADERS:
            header, self.header = Header(header_of(Path(include), name)), name
            # Earlier headers are on one line before it, so that lines keep their numbers.
            tree = parser.parse(
                earlier + '\n# 1 "' + name + '"\n' + "\n".join(header.code), "before"
            )
            for node in tree.ext:
                if node.coord.file == name:
                    self.declaration(header, node)
            self.macros(header)
            earlier += " ".join(" ".join(header.code).split())

    def declaration(self, header, node):
        inner = node.type
        made_of = getattr(
            inner, "type", None
        )  # the coordinates of a typedef are those of its name, at the end
        comment = header.above(
            (made_of if isinstance(made_of, (c_ast.Struct, c_ast.Enum)) else node).coord.line,
            over=1,
        )
        if isinstance(inner, c_ast.FuncDecl):
            name = (
                inner.type.type.declname
                if isinstance(inner.type, c_ast.PtrDecl)
                else inner.type.declname
            )
            kind = "callbacks" if isinstance(node, c_ast.Typedef) else "functions"
            self.add(
                kind,
                name,
                comment,
                returns=type_of(inner.type),
                arguments=[self.argument(name, entry) for entry in self.arguments(inner)],
            )
        elif isinstance(inner, c_ast.Enum):
            self.constants(header, inner.values)
        elif isinstance(inner.type, c_ast.Enum):
            self.add(
                "enums", node.name, comment, values=self.enumerators(header, inner.type.values)
            )
            SIZES[node.name] = 4
        elif isinstance(inner.type, c_ast.Struct):
            self.struct(header, node.name, comment, inner.type)
        else:
            raise SystemExit(
                f"{node.coord}: this kind of declaration is not known: {type(inner).__name__}"
            )

    def add(self, kind, name, comment, **more):
        if name in self.places:
            raise SystemExit(f"{name}: it is declared twice")
        self.places[name] = len(self.places)
        self.about[kind].append(
            {
                "name": name,
                "comment": comment,
                "header": self.header,
                "place": self.places[name],
                **more,
            }
        )

    @staticmethod
    def arguments(function):
        found = function.args.params if function.args else []
        return [
            entry
            for entry in found
            if not (isinstance(entry.type, c_ast.TypeDecl) and entry.type.type.names == ["void"])
        ]

    def argument(self, function, node):
        found = {"name": node.name, **type_of(node.type)}
        if "array" in found:  # an array as an argument is a pointer
            found["length"] = self.value(found.pop("array")[0])
            found["pointer"] = 1
        if "to_array" in found:
            found["to_array"] = [self.value(entry) for entry in found["to_array"]]
        written = found.get("pointer") and not found.get("const")
        both = f"{function} {node.name}" in READ_AND_WRITTEN or (
            node.name in OBJECTS and function.startswith(f"carom_{node.name}_")
        )
        return {**found, "direction": "inout" if both else "out" if written else "in"}

    def value(self, node):
        """The value of a constant expression: a number, a name, or minus one of them."""
        if isinstance(node, c_ast.UnaryOp) and node.op == "-":
            return -self.value(node.expr)
        return int(node.value, 0) if isinstance(node, c_ast.Constant) else self.values[node.name]

    def enumerators(self, header, values):
        found, following = [], 0
        for entry in values.enumerators:
            self.values[entry.name] = value = self.value(entry.value) if entry.value else following
            following = value + 1
            found.append(
                {
                    "name": entry.name,
                    "value": value,
                    "comment": header.trailing_comment(entry.coord.line),
                }
            )
        return found

    def constants(self, header, values):
        for entry in self.enumerators(header, values):
            self.add(
                "constants",
                entry["name"],
                entry["comment"] or header.above(values.enumerators[0].coord.line, over=1),
                value=entry["value"],
            )

    def macros(self, header):
        for name, text, line in header.macros:
            if name.startswith("CAROM_") and not name.endswith("_H") and name not in NO_VALUE:
                literal = re.sub(r"^UINT64_C\((\d+)\)$", r"\1", text.strip())
                if not re.fullmatch(r"[\d.]+", literal):
                    raise SystemExit(
                        f"{name}: a macro whose value is not a number: {text.strip()}; it belongs in NO_VALUE of bindings/api.py"
                    )
                self.values[name] = float(literal) if "." in literal else int(literal)
                self.add("constants", name, header.above(line), value=self.values[name])

    def struct(self, header, name, comment, node):
        fields = []
        for entry in node.decls:
            words = header.trailing_comment(entry.coord.line) or header.above(entry.coord.line)
            found = {"name": entry.name, **type_of(entry.type)}
            if "array" in found:
                found["array"] = [self.value(length) for length in found["array"]]
            if UNITS.fullmatch(words) and "," in words:
                words = words.split(", ")[
                    sum(field["comment"] in words.split(", ") for field in fields)
                ]
            if unit := UNIT.search(words):
                found["unit"] = unit[1]
            fields.append({**found, "comment": words})
        self.add("structs", name, comment, fields=fields)
        about = self.about["structs"][-1]
        for bits, key in ((64, None), (32, "wasm32")):
            size, align, places = self.layout(fields, bits // 8)
            self.layouts[name, bits // 8] = size, align
            if key is None:
                about |= {"size": size, "align": align}
                for field, (offset, bytes_) in zip(fields, places):
                    field |= {"offset": offset, "size": bytes_}
            else:
                about[key] = {
                    "size": size,
                    "align": align,
                    "offsets": [offset for offset, _ in places],
                    "sizes": [bytes_ for _, bytes_ in places],
                }

    def layout(self, fields, pointer):
        """Size and alignment of a struct, and offset and size of each field: each is at the
        next multiple of its alignment.
        """
        end, widest, places = 0, 1, []
        for field in fields:
            name = field["type"]
            if field.get("pointer") or name == "size_t":
                size = align = pointer
            elif (name, pointer) in self.layouts:
                size, align = self.layouts[name, pointer]
            else:
                size = align = SIZES[name]
            for length in field.get("array", ()):
                size *= length
            end = -(-end // align) * align
            places.append((end, size))
            end, widest = end + size, max(widest, align)
        return -(-end // widest) * widest, widest, places

    def described(self):
        version = ".".join(
            str(self.values[f"CAROM_VERSION_{part}"]) for part in ("MAJOR", "MINOR", "PATCH")
        )
        return {"name": "carom", "version": version, "headers": list(HEADERS), **self.about}


def describe(include):
    """The description as a dictionary."""
    return Api(include).described()


def abi(api, bits=None):
    """Sizes, offsets and values as lines, as packaging/tests/abi compares them; `bits`: "wasm32" for
    those of that system.
    """
    lines = []
    for entry in types(api):
        if "values" in entry:
            lines.append(f"{entry['name']}: 4 bytes, aligned to 4")
            continue
        layout = entry[bits] if bits else entry
        lines.append(f"{entry['name']}: {layout['size']} bytes, aligned to {layout['align']}")
        offsets = layout["offsets"] if bits else [field["offset"] for field in entry["fields"]]
        sizes = layout["sizes"] if bits else [field["size"] for field in entry["fields"]]
        lines += [
            f"  {offset:3} {field['name']}: {size}"
            for field, offset, size in zip(entry["fields"], offsets, sizes)
        ]
    return "\n".join([*lines, *(f"{name} = {value}" for name, value in values(api)), ""])


def types(api):
    """Structs and enumerations in the order of the headers."""
    return sorted(api["structs"] + api["enums"], key=lambda entry: entry["place"])


def values(api):
    """Names and values of enumerators and whole constants but for the version, in the order of
    their names.
    """
    found = [entry for enum in api["enums"] for entry in enum["values"]] + api["constants"]
    return sorted(
        (entry["name"], entry["value"])
        for entry in found
        if isinstance(entry["value"], int) and "_VERSION_" not in entry["name"]
    )


def c_program(api):
    """A program that prints the same as its compiler sees it."""
    lines = [f"#include <{name}>" for name in api["headers"]]
    lines += ["#include <stdio.h>", "int main(void) {"]
    for entry in types(api):
        name = entry["name"]
        lines.append(
            f'  printf("{name}: %zu bytes, aligned to %zu\\n", sizeof({name}), _Alignof({name}));'
        )
        for field in entry.get("fields", ()):
            member = field["name"]
            lines.append(
                f'  printf("  %3zu {member}: %zu\\n", offsetof({name}, {member}), sizeof((({name} *)0)->{member}));'
            )
    lines += [f'  printf("{name} = %lld\\n", (long long){name});' for name, _ in values(api)]
    return "\n".join([*lines, "  return 0;", "}", ""])


def main():
    outputs = {
        "json": lambda api: json.dumps(api, indent=1, ensure_ascii=False) + "\n",
        "functions": lambda api: "".join(
            sorted(f"{entry['name']}\n" for entry in api["functions"])
        ),
        "abi": abi,
        "abi-wasm32": lambda api: abi(api, "wasm32"),
        "c": c_program,
    }
    what, include = sys.argv[1:]
    if what not in outputs:
        raise SystemExit(f"{what}: must be one of {', '.join(outputs)}")
    sys.stdout.write(outputs[what](describe(include)))


if __name__ == "__main__":
    main()
