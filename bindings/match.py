"""What npm and Python say of a match as the headers do: its acts, and how it stands.

match.py typescript    web/npm/src/generated/match.ts, which a build of the package writes
match.py python        python/src/carom/games/_described.py, also with enumerations of the games

An act is a function of carom_match.h that changes a match and takes numbers and words. One that the
layer calls by hand is not made: an argument or a result has another form there. getters.py has the
getters. write.py makes the same of C# and Rust.
"""

import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))  # tools/python leaves the script's folder out

from api import describe  # noqa: E402
from write import Layer, ends, pascal, type_name, wrapped  # noqa: E402

# A sentence of a comment that is about C alone.
OF_C = re.compile(r"CAROM_(?:OK|ERROR)|match->text|\bNULL\b")
# An argument that both packages have always had by another name.
RENAMED = {"choice": "what"}


class MatchLayer(Layer):
    """A layer in which the seat that acts is the last argument, by default the one at the table."""

    def __init__(self, api):
        super().__init__(api)
        self.words = {enum["name"]: [end.lower() for end in ends(enum)] for enum in api["enums"]}
        self.word_of = {
            value["name"]: word
            for enum in api["enums"]
            for value, word in zip(enum["values"], self.words[enum["name"]])
        }

    def said(self, comment):
        """A comment of the headers with the names of the language, without what only C has."""
        sentences = re.split(r"(?<=\.) (?=[A-Z]|match->)", comment)
        text = " ".join(one for one in sentences if not OF_C.search(one))
        text = re.sub(r", as a set(?:: a sum of \w+)?", "", text)
        text = re.sub(
            r"\b(?:carom_match_(\w+)\(\)|match->(\w+))",
            lambda found: f"`{self.name(found[1] or found[2])}`",
            text,
        )
        text = re.sub(r"\bCAROM_\w+", lambda found: f'"{self.word_of[found[0]]}"', text)
        return re.sub(
            r"\ba (carom_\w+)",
            lambda found: ", ".join(f'"{word}"' for word in self.words[found[1]]),
            text,
        )

    def acts(self):
        """The functions that are acts, with their arguments."""
        for function, roles in self.wrapped_functions(of_match=True):
            if all(role == "value" for _, role in roles):
                yield function, [entry for entry, _ in roles]

    def called(self):
        """The functions of C that the layer calls."""
        return self.by_hand | {function["name"] for function, _ in self.acts()}

    def act_lines(self):
        """The acts."""
        lines = []
        for function, arguments in self.acts():
            parameters, passed = [], []
            for entry in arguments:
                name = RENAMED.get(entry["name"], entry["name"])
                if name == "seat":
                    passed.append(self.SEAT[1])
                    continue
                if entry["type"] not in self.ARGUMENTS:
                    raise SystemExit(
                        f"bindings/match.py: {function['name']}: {name} is a {entry['type']}: "
                        f"give {type(self).__name__} a form of it, or call the function by hand"
                    )
                type_, value = self.ARGUMENTS[entry["type"]]
                parameters.append(f"{name}: {type_}")
                passed.append(value.format(name))
            if self.SEAT[1] in passed:
                parameters += [*self.BEFORE_SEAT[: len(parameters)], self.SEAT[0]]
            about = self.about(function["comment"], "    ")
            lines += ["", *self.act(function["name"], about, parameters, passed)]
        return lines

    def text(self):
        return "\n".join([self.head().rstrip(), *self.getter_lines(), *self.act_lines(), self.END])

    def head(self):
        """What is above the getters and acts."""
        return self.HEAD


class TypeScript(MatchLayer):
    """web/npm/src/generated/match.ts: what the class Match of the package extends."""

    HAND, CALL = "web/npm/src/*.ts", r"\.(carom_\w+)\("
    HEAD = """// Written by bindings/match.py from the headers of the C library.
import { Owner } from "../batches.js";
import type { Exports, Memory, Pointer } from "../memory.js";
import { members, readStruct, value } from "../structs.js";
import { layout, names, values } from "./layout.js";
import type * as C from "./structs.js";

const MATCH = layout.carom_match.offset;
const RECORD = layout.carom_record.offset;

/** The acts of a match, and how it stands, as carom_match.h has them. */
export abstract class MatchActs<L extends { memory: Memory }> extends Owner<L> {
    /** Does what C does. Returns whether a shot has ended. */
    protected abstract act(act: (pointer: Pointer, call: Exports) => number): boolean;
    /** The seat that acts: by default the one at the table. */
    protected abstract seatOf(seat: number | undefined): number;
    #int(offset: number): number {
        return this.library.memory.i32[(this.pointer(0) + offset) / 4]!;
    }
    #long(offset: number): number {
        return Number(this.library.memory.i64[(this.pointer(0) + offset) / 8]);
    }
"""
    END = "}\n"
    # The type of an argument of an act, and what C gets of it, by its type in C. A choice is a bit.
    ARGUMENTS = {
        "double": ("number", "{0}"),
        "carom_choice": ("C.Choice", '1 << value("carom_choice", {0}, "{0}")'),
    }
    SEAT, BEFORE_SEAT = ("seat?: number", "this.seatOf(seat)"), []
    GETTERS = {
        "index": ("number", "{at}"),
        "seat": ("number | undefined", "{at} < 0 ? undefined : {at}"),
        "count": ("number", "{at}"),
        "word": ("C.{type}", "names.{enum}[{at}] as C.{type}"),
        "words": ("C.{type}[]", "names.{enum}.filter((_, k) => ({at} >> k) & 1) as C.{type}[]"),
        "balls": ("number[]", "members({at})"),
        "side": ("number | undefined", "{at} === 0 || this.drawn ? undefined : {at} - 1"),
        "drawn": ("boolean", "{at} === values.CAROM_DRAWN"),
        "struct": ("C.{type}", 'readStruct(this.library.memory, {place}, "{enum}")'),
    }

    def name(self, words):
        return words[0] + pascal(words)[1:]

    def about(self, words, indent):
        return [f"{indent}/**", *wrapped(self.said(words), f"{indent} * "), f"{indent} */"]

    def getter(self, getter, about, type_, value):
        holders = ["MATCH", "RECORD"]
        members = map(self.name, getter.path)
        offset = " + ".join(f"{holder}.{member}" for holder, member in zip(holders, members))
        at = f"this.#{'long' if getter.field['type'] == 'int64_t' else 'int'}({offset})"
        place = f"this.pointer(0) + {offset}"
        given = {"type": type_name(getter.type), "enum": getter.type, "at": at, "place": place}
        return [
            *about,
            f"    get {self.name(getter.name)}(): {type_.format(**given)} {{",
            f"        return {value.format(**given)};",
            "    }",
        ]

    def act(self, function, about, parameters, passed):
        return [
            *about,
            f"    {self.name(function.removeprefix('carom_match_'))}({', '.join(parameters)}): void {{",
            "        this.act((pointer, call) =>",
            f"            call.{function}({', '.join(['pointer', *passed])}),",
            "        );",
            "    }",
        ]


class Python(MatchLayer):
    """python/src/carom/games/_described.py: what the class Match of the package extends."""

    HAND, CALL = "python/src/carom/**/*.py", r"\blib\.(carom_\w+)\("
    HEAD = '''"""Enumerations of games, acts of a match, and its state. Written by bindings/match.py:
UPDATE=1 ctest -R bindings/rows.
"""

from __future__ import annotations

import enum
from collections.abc import Callable
from typing import Any, Literal, get_args

import numpy as np

from carom import dtypes
from carom._carom import ffi, lib
from carom._described import Choice, Phase
from carom._rows import choice, number, text_of
from carom.dtypes import Records
'''
    # Enumerations whose words the package takes, and those that it has as such, with the sets of
    # words that have the texts of their values.
    WORDS = {"Group": "carom_group", "Race": "carom_race", "BreakOrder": "carom_break_order"}
    ENUMS = {
        "Foul": (
            "carom_foul",
            "FOUL",
            'The description of a foul, such as "the cue ball met no ball".',
        ),
        "Kind": ("carom_plan_kind", "PLAN_KIND", 'The name of a kind, such as "bank".'),
    }
    ACTS = '''

_PHASES: tuple[Phase, ...] = get_args(Phase)
_CHOICES: tuple[Choice, ...] = get_args(Choice)
_BITS: dict[str, int] = {word: 1 << k for k, word in enumerate(_CHOICES)}


class MatchActs:
    """The acts and the state of a match, as in carom_match.h.

    The seat that acts defaults to the one at the table.
    """

    _c: Any

    def _act(self, call: Callable[[], int], field: str) -> bool:
        raise NotImplementedError

    def _seat(self, seat: int | None) -> int:
        raise NotImplementedError
'''
    END = ""
    ARGUMENTS = {
        "double": ("float", 'number({0}, "{0}")'),
        "carom_choice": ("str", 'choice(_BITS, {0}, "{0}")'),
    }
    # Behind other arguments the seat is given by its name.
    SEAT, BEFORE_SEAT = ("seat: int | None = None", "self._seat(seat)"), ["*"]
    GETTERS = {
        "index": ("int", "int({at})"),
        "seat": ("int | None", "int({at}) if {at} >= 0 else None"),
        "count": ("int", "int({at})"),
        "word": ("{type}", "{words}[int({at})]"),
        "words": (
            "tuple[{type}, ...]",
            "tuple(word for k, word in enumerate({words}) if {at} >> k & 1)",
        ),
        "balls": ("frozenset[int]", "frozenset(k for k in range(32) if {at} >> k & 1)"),
        "side": ("int | None", "int({at}) - 1 if 0 < {at} < lib.CAROM_DRAWN else None"),
        "drawn": ("bool", "bool({at} == lib.CAROM_DRAWN)"),
        "struct": (
            "Records",
            "np.frombuffer(ffi.buffer(ffi.addressof({at})), dtypes.{dtype}).copy().reshape(())",
        ),
    }

    def name(self, words):
        return words

    def enum_lines(self):
        """The types of words, and the enumerations."""
        lines = []
        for name, of in self.WORDS.items():
            words = ", ".join(f'"{word}"' for word in self.words[of])
            lines.append(f"{name} = Literal[{words}]")
        for name, (of, words, about) in self.ENUMS.items():
            enum = next(entry for entry in self.api["enums"] if entry["name"] == of)
            lines += ["", "", f"class {name}(enum.IntEnum):", *self.about(enum["comment"], ""), ""]
            for end, value in zip(ends(enum), enum["values"]):
                lines.append(f"    {end} = {value['value']}")
            lines += ["", "    @property", "    def text(self) -> str:"]
            lines += self.about(about, "    ")
            lines.append(
                f"        return text_of(lib.carom_word_text(lib.CAROM_WORDS_{words}, self))"
            )
        return lines

    def head(self):
        return "\n".join([self.HEAD, *self.enum_lines(), self.ACTS])

    def about(self, words, indent):
        # A docstring begins with what a call is to do: "Takes" becomes "Take".
        text = re.sub(r"^([A-Z][a-z]+)s ", r"\1 ", self.said(words))
        one_line = f'{indent}    """{text}"""'
        if len(one_line) <= 100:
            return [one_line]
        return [*wrapped(f'"""{text}', f"{indent}    "), f'{indent}    """']

    def getter(self, getter, about, type_, value):
        word = pascal(getter.type.removeprefix("carom_").removeprefix("match_"))
        given = {
            "type": word,
            "words": f"_{word.upper()}S",
            "dtype": getter.type.removeprefix("carom_"),
            "at": ".".join(["self._c", *getter.path]),
        }
        return [
            "    @property",
            f"    def {getter.name}(self) -> {type_.format(**given)}:",
            *about,
            f"        return {value.format(**given)}",
        ]

    def act(self, function, about, parameters, passed):
        name = function.removeprefix("carom_match_")
        return [
            f"    def {name}({', '.join(['self', *parameters])}) -> None:",
            *about,
            "        self._act(",
            f"            lambda: lib.{function}({', '.join(['self._c', *passed])}),",
            f'            "{name}",',
            "        )",
        ]


def main():
    layers = {"typescript": TypeScript, "python": Python}
    if sys.argv[1:] not in [[name] for name in layers]:
        raise SystemExit(f"{' '.join(sys.argv[1:])}: must be one of {', '.join(layers)}")
    sys.stdout.write(layers[sys.argv[1]](describe(HERE.parent / "core/include")).text())


if __name__ == "__main__":
    main()
