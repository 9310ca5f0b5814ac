"""Packages for other languages, made from the headers: write.py OUT.

OUT/api.json    the description of the interface
OUT/csharp      a package for Unity, whose Runtime/ any other program in C# compiles too
OUT/rust        the crates carom-sys, generated, with the library as one file, and carom, the safe
                layer
"""

import json
import re
import shutil
import subprocess
import sys
from os.path import commonprefix
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))  # tools/python leaves the script's folder out

from api import TYPES, describe  # noqa: E402
from getters import getters  # noqa: E402

NOTE = "// Written by bindings/write.py from the headers of carom {version}.\n"


def pascal(name):
    """ball_state as BallState."""
    return "".join(part[:1].upper() + part[1:].lower() for part in name.split("_"))


def type_name(name):
    """carom_ball_state as BallState."""
    return pascal(name.removeprefix("carom_"))


def ends(enum):
    """The names of an enumeration without what all of them begin with: POOL_9FT."""
    prefix = commonprefix([value["name"] for value in enum["values"]])
    return [value["name"][prefix.rindex("_") + 1 :] for value in enum["values"]]


def enumerators(enum):
    """Names and values of an enumeration: (Pool9ft, about)."""
    for value, end in zip(enum["values"], ends(enum)):
        name = pascal(end)
        yield ("_" if name[0].isdigit() else "") + name, value


def worded(api):
    """The enumerations whose values have words, each with its enumerator of carom_words."""
    words = next(entry for entry in api["enums"] if entry["name"] == "carom_words")
    known = {entry["name"] for entry in api["enums"]}
    for name, value in enumerators(words):
        enum = re.match(r"values of (\w+)", value["comment"])[1]
        if enum not in known:
            raise SystemExit(f"bindings/write.py: {value['name']}: no enumeration {enum}")
        yield enum, name


# Names of a number of elements, which stands right behind the pointer to the first of them.
COUNTS = {"count", "n", "size", "room"}
# Results that say where an error is: a layer that makes an exception of the status needs them.
FAULTS = {"fault", "field", "where", "in_the_way"}
# What an argument with a pointer is without one, by its direction and by whether a number follows.
ROLES = {
    ("in", True): "list",
    ("in", False): "object",
    ("inout", True): "changed list",
    ("inout", False): "changed",
    ("out", False): "result",
}


def has_pointer(name, structs):
    """Whether a struct has a pointer or a callback, so that code without pointers cannot make it."""
    if name not in structs:
        return name.startswith("carom_rules_")
    return any(
        field.get("pointer") or has_pointer(field["type"], structs)
        for field in structs[name]["fields"]
    )


def role_of(entry, following, last_role, function, structs):
    """The role of an argument, or None."""
    if not entry.get("pointer"):
        if entry["name"] in COUNTS:
            return {"list": "count", "changed list": "count", "words": "room"}.get(last_role)
        fields = structs[entry["type"]]["fields"] if entry["type"] in structs else []
        return "members" if {field["type"] for field in fields} == {"int32_t"} else "value"
    counted = following in COUNTS and not entry["type"].endswith("_options")
    if entry["type"] == "char" and entry["direction"] == "out" and counted:
        return "words"
    if (
        entry["type"] not in structs
        or entry["name"] in FAULTS
        or has_pointer(entry["type"], structs)
    ):
        return None
    role = ROLES.get((entry["direction"], counted))
    is_status = function["returns"]["type"] == "carom_status"
    return "changed" if role == "result" and not is_status else role


def roles_of(function, structs):
    """(argument, role) for each argument of a function without pointers; None where the rules have
    no role for one of them, so that a layer calls the function by hand.
    """
    if function["returns"].get("pointer") and function["returns"]["type"] != "char":
        return None
    found, last_role = [], None
    for entry, following in zip(function["arguments"], [*function["arguments"][1:], {"name": ""}]):
        last_role = role_of(entry, following["name"], last_role, function, structs)
        found.append((entry, last_role))
    roles = [role for _, role in found]
    return found if None not in roles and roles.count("result") < 2 else None


def called_by(folder, pattern):
    """The functions of C that the sources of a layer call."""
    text = "\n".join(
        path.read_text(encoding="utf-8")
        for path in sorted(HERE.parent.glob(folder))
        if path.name != "_described.py"  # which is made
    )
    return set(re.findall(pattern, re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.S)))


class Layer:
    """A language: its declarations of C, and its layer without pointers. The functions that the
    layer does not call by hand are made here, by the roles of their arguments. Those of a match are
    methods of its class, in which the seat at the table acts.
    """

    def __init__(self, api):
        self.api = api
        self.callbacks = {entry["name"] for entry in api["callbacks"]}
        self.enums = {entry["name"] for entry in api["enums"]}
        self.structs = {entry["name"]: entry for entry in api["structs"]}
        self.by_hand = called_by(self.HAND, self.CALL)

    def listed(self, several, indent, form):
        """Entries of the description, each with its comment above it."""
        lines = []
        for entry in several:
            lines += [*self.about(entry["comment"], indent), *f"{indent}{form(entry)}".split("\n")]
        return lines

    def wrapped_functions(self, of_match):
        """The functions that are made, with the roles of their arguments: those of a match, or all
        others.
        """
        for entry in self.api["functions"]:
            is_of_match = entry["name"].startswith("carom_match_")
            is_beginning = entry["name"].startswith("carom_match_begin")
            if is_of_match != of_match or is_beginning or entry["name"] in self.by_hand:
                continue
            arguments = entry["arguments"][is_of_match:]
            roles = roles_of({**entry, "arguments": arguments}, self.structs)
            if roles is not None:
                yield entry, roles

    def lines(self, of_match):
        """The lines of these functions."""
        found = []
        for entry, roles in self.wrapped_functions(of_match):
            found += ["", *self.about(entry["comment"], self.INDENT)]
            found += self.function(entry, roles, of_match)
        return found[1:]

    def getter_lines(self):
        """The getters of a match for whose forms the language has a template."""
        lines = []
        for getter in getters(self.api):
            if getter.form in self.GETTERS:
                type_, value, *remark = self.GETTERS[getter.form]
                about = " ".join([getter.comment[:1].upper() + getter.comment[1:], *remark])
                lines += ["", *self.getter(getter, self.about(about, "    "), type_, value)]
        return lines

    def match_lines(self):
        """What the class of a match gets."""
        return self.lines(of_match=True) + self.getter_lines()

    def calls(self):
        """The functions as a file."""
        names = [self.KIND.format(self.type_name(of), name) for of, name in worded(self.api)]
        made = (self.lines(of_match=False), self.match_lines(), names)
        parts = ("\n".join(lines) for lines in made)
        return NOTE.format(version=self.api["version"]) + self.CALLS.format(*parts)

    def called(self):
        """The functions of C that the layer without pointers calls."""
        return self.by_hand | {
            entry["name"] for kind in (0, 1) for entry, _ in self.wrapped_functions(kind)
        }

    def arguments_of(self, roles):
        """What the caller gives, and what C gets."""
        parameters, passed, last = [], [], ""
        for entry, role in roles:
            name, type_ = self.name(entry["name"]), self.value_type(entry)
            fields = self.structs[entry["type"]]["fields"] if role == "members" else []
            if role == "members":
                parameters += [
                    self.GIVEN["value"][0].format(name=field["name"], type=self.value_type(field))
                    for field in fields
                ]
            elif self.GIVEN[role][0]:
                parameters.append(self.GIVEN[role][0].format(name=name, type=type_))
            is_word = entry["type"] in self.enums and role == "value"
            passed.append(
                self.GIVEN["word" if is_word else role][1].format(
                    name=name,
                    type=type_,
                    last=last,
                    count=self.type(entry).replace("c_int", "i32"),
                    members=", ".join(self.MEMBER.format(field["name"]) for field in fields),
                )
            )
            last = name
        return parameters, passed


def wrapped(words, prefix, width=100):
    """Lines of a comment."""
    lines = [""]
    for word in words.split():
        if len(prefix) + len(lines[-1]) + len(word) + 1 > width and lines[-1]:
            lines.append("")
        lines[-1] += f" {word}" if lines[-1] else word
    return [prefix + line for line in lines if line]


class CSharp(Layer):
    """Runtime/Native.cs: structs by sequential layout, enumerations, and the functions of C by
    P/Invoke. Runtime/Calls.cs: functions without pointers.
    """

    HAND, CALL = "bindings/csharp/Runtime/*.cs", r"\bNative\.(carom_\w+)\("
    # How a caller gives an argument, and how C gets it, by its role.
    GIVEN = {
        "value": ("{type} {name}", "{name}"),
        "word": ("{type} {name}", "{name}"),
        "members": ("", "new {type} {{ {members} }}"),
        "object": ("{type} {name}", "&{name}"),
        "changed": ("ref {type} {name}", "{name}At"),
        "list": ("{type}[] {name}", "{name}At"),
        "changed list": ("{type}[] {name}", "{name}At"),
        "count": ("", "({count}){last}.Length"),
        "result": ("", "&made"),
        "words": ("", "to"),
        "room": ("", "room"),
    }
    MEMBER, INDENT = "{0} = {0}", "    "
    # The type of a getter of a match, its value, of which {at} is the member, and what else is to be
    # said, by its form.
    GETTERS = {
        "index": ("int", "(int)Open->{at}"),
        "seat": ("int", "(int)Open->{at}", "-1: none has yet."),
        "count": ("long", "Open->{at}"),
        "word": ("{type}", "({type})Open->{at}"),
        "side": ("int", "Drawn ? -1 : Open->{at} - 1", "-1: none has."),
        "drawn": ("bool", "Open->{at} == Native.CAROM_DRAWN"),
        "struct": ("{type}", "Open->{at}"),
    }
    PASSED_MOST = 8000  # bytes of a struct
    FIXED = {"changed": "&{name}", "list": "{name}", "changed list": "{name}"}

    BASE = {c: csharp for c, _, csharp, _ in TYPES}
    SAFE_MOST = 32  # numbers of an array that code without pointers reads and sets
    # System and UnityEngine, which games import next to Carom, have types of these names.
    RENAMED = {
        "Bounds": "HandBounds",
        "Event": "ShotEvent",
        "EventType": "ShotEventType",
        "Motion": "BallMotion",
        "Space": "ShotSpace",
        "Type": "NumberType",
    }
    KEYWORDS = {
        "is",
        "in",
        "out",
        "event",
        "fixed",
        "params",
        "ref",
        "base",
        "lock",
        "object",
        "operator",
    }

    def __init__(self, api):
        super().__init__(api)
        self.arrays = {}

    def name(self, words):
        found = pascal(words)
        found = found[:1].lower() + found[1:]
        return f"@{found}" if found in self.KEYWORDS else found

    def type_name(self, name):
        found = type_name(name)
        return self.RENAMED.get(found, found)

    def type(self, about):
        if about["type"] in self.callbacks:
            return "IntPtr"
        found = self.BASE.get(about["type"]) or self.type_name(about["type"])
        return found + "*" * about.get("pointer", 0)

    @staticmethod
    def about(words, indent):
        words = words.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
        return wrapped(f"<summary>{words}</summary>", f"{indent}/// ") if words else []

    def field(self, about):
        count, name = 1, self.name(about["name"])
        for length in about.get("array", ()):
            count *= length
        if "array" not in about:
            return f"public {self.type(about)} {name};"
        if about["type"] == "char" or count > self.SAFE_MOST:
            return f"public fixed {self.type(about)} {name}[{count}];"
        self.arrays[self.type(about), count] = about["size"]
        return f"public {pascal(self.type(about))}Array{count} {name};"

    HEAD = """using System;
using System.Runtime.InteropServices;

namespace Carom {"""
    ARRAY = """  /// <summary>{count} of {struct}, one behind the other.</summary>
  [StructLayout(LayoutKind.Sequential, Size = {size})]
  public unsafe struct {name}Array{count} {{
    {struct} first;
    public {struct} this[int k] {{
      get {{ Check(k); fixed ({struct}* at = &first) return at[k]; }}
      set {{ Check(k); fixed ({struct}* at = &first) at[k] = value; }}
    }}
    static void Check(int k) {{ if (k < 0 || k >= {count}) throw new IndexOutOfRangeException($"must be 0 to {last}, not {{k}}"); }}
  }}
"""
    # IL2CPP links a plugin into the program itself on these systems.
    NATIVE = """  /// <summary>Constants and functions of the library, by their names in C.</summary>
  public static unsafe class Native {
#if (UNITY_IOS || UNITY_WEBGL) && !UNITY_EDITOR
    const string Library = "__Internal";
#else
    const string Library = "carom";
#endif

    static Native() {
      if (carom_serves(10000 * CAROM_VERSION_MAJOR + 100 * CAROM_VERSION_MINOR) == 0)
        throw new DllNotFoundException(
            $"the library {Library} has another version; this package needs version " +
            $"{CAROM_VERSION_MAJOR}.{CAROM_VERSION_MINOR}");
    }"""
    CALLBACK = "[UnmanagedFunctionPointer(CallingConvention.Cdecl)]\n    public delegate {};"
    FUNCTION = "[DllImport(Library, CallingConvention = CallingConvention.Cdecl)]\n    public static extern {};"

    def text(self):
        lines = [NOTE.format(version=self.api["version"]) + self.HEAD]
        for entry in self.api["enums"]:
            lines += self.listed(
                [entry], "  ", lambda entry: f"public enum {self.type_name(entry['name'])} {{"
            )
            for name, value in enumerators(entry):
                lines += self.listed(
                    [value], "    ", lambda value, name=name: f"{name} = {value['value']},"
                )
            lines += ["  }", ""]
        for entry in self.api["structs"]:
            lines += self.listed([entry], "  ", self.struct_head)
            lines += [*self.listed(entry["fields"], "    ", self.field), "  }", ""]
        for (struct, count), size in self.arrays.items():
            lines.append(
                self.ARRAY.format(
                    struct=struct, count=count, size=size, name=pascal(struct), last=count - 1
                )
            )
        lines.append(self.NATIVE)
        lines += self.listed(self.api["constants"], "    ", self.constant)
        for kind, form in (("callbacks", self.CALLBACK), ("functions", self.FUNCTION)):
            lines += self.listed(
                self.api[kind], "    ", lambda entry, form=form: form.format(self.signature(entry))
            )
        return "\n".join([*lines, "  }", "}", ""])

    def struct_head(self, entry):
        name = self.type_name(entry["name"])
        return f"[StructLayout(LayoutKind.Sequential)]\n  public unsafe struct {name} {{"

    @staticmethod
    def constant(entry):
        kind = "double" if isinstance(entry["value"], float) else "int"
        return f"public const {kind} {entry['name']} = {entry['value']};"

    def signature(self, function):
        arguments = (
            f"{self.type(entry)} {self.name(entry['name'])}" for entry in function["arguments"]
        )
        return f"{self.type(function['returns'])} {function['name']}({', '.join(arguments)})"

    def value_type(self, about):
        return self.type({**about, "pointer": 0})

    def is_large(self, about):
        """Whether Mono cannot pass it by value."""
        return self.structs[about["type"]]["size"] > self.PASSED_MOST

    def function(self, function, roles, of_match):
        """A function without pointers."""
        roles = [
            (entry, "changed" if role == "object" and self.is_large(entry) else role)
            for entry, role in roles
        ]
        parameters, passed = self.arguments_of(roles)
        name = pascal(function["name"].removeprefix("carom_match_" if of_match else "carom_"))
        asks = {"result", "words"} & {role for _, role in roles}
        if of_match:
            passed = ["Open", *("Seat" if entry == "seat" else entry for entry in passed)]
        if of_match and not asks:
            parameters = [entry for entry in parameters if entry != "int seat"]
            call = f"Native.{function['name']}({', '.join(passed)})"
            return [
                f"    public void {name}({', '.join(parameters)}) {{",
                f"      Told({call});",
                "    }",
            ]

        pinned = "".join(
            f"fixed ({self.type(entry)} {self.name(entry['name'])}At = {place}) "
            for entry, role in roles
            if role in self.FIXED
            for place in [self.FIXED[role].format(name=self.name(entry["name"]))]
        )
        call = f"Native.{function['name']}({', '.join(passed)})"
        result = next((self.value_type(entry) for entry, role in roles if role == "result"), None)
        returned = function["returns"]
        if result:
            lines = [f"{result} made;", f"{pinned}Billiards.Check({call});", "return made;"]
        elif "to" in passed:
            result = "string"
            size, write = (
                call.replace("to, room", words)
                for words in ("null, UIntPtr.Zero", "to, (UIntPtr)text.Length")
            )
            lines = [
                "byte[] text;",
                f"{pinned}text = new byte[(int){size} + 1];",
                f"{pinned}fixed (byte* to = text) {write};",
                "fixed (byte* to = text) return Billiards.Text(to);",
            ]
        elif returned.get("pointer"):
            result, lines = "string", [f"{pinned}return Billiards.Text({call});"]
        elif returned["type"] == "carom_status":
            result, lines = "Status", [f"{pinned}return Billiards.Check({call});"]
        else:
            result = self.type(returned)
            lines = [f"{pinned}{'' if result == 'void' else 'return '}{call};"]
        static = "" if of_match else "static "
        head = f"    public {static}{result} {name}({', '.join(parameters)}) {{"
        return [head, *(f"      {line}" for line in lines), "    }"]

    def getter(self, getter, about, type_, value):
        given = {
            "type": self.type_name(getter.type),
            "at": ".".join(map(self.name, getter.path)),
        }
        return [
            *about,
            f"    public {type_.format(**given)} {pascal(getter.name)} {{",
            f"      get {{ return {value.format(**given)}; }}",
            "    }",
        ]

    KIND = "      {{ typeof({0}), Words.{1} }},"
    CALLS = """using System;
using System.Collections.Generic;

namespace Carom {{
  /// <summary>Functions of C without pointers, by their names in C.</summary>
  public static unsafe class Calls {{
{}
  }}

  public sealed unsafe partial class LiveMatch {{
{}
  }}

  public static unsafe partial class Names {{
    static readonly Dictionary<Type, Words> Kinds = new Dictionary<Type, Words> {{
{}
    }};
  }}
}}
"""
    LAYOUT = """using System;
using System.Runtime.InteropServices;
using Carom;
static class Layout {{
  static int wrong;
  static void Same(string what, long seen, long expected) {{
    if (seen != expected) {{ Console.WriteLine($"{{what}}: {{seen}}, in C {{expected}}"); wrong++; }}
  }}
  static unsafe int Main() {{
{tests}
    if (wrong == 0) Console.WriteLine("{count} structs have the layout of C");
    return wrong == 0 ? 0 : 1;
  }}
}}
"""

    def layout_test(self):
        """A program that compares sizes and offsets with those of C."""
        lines = []
        for entry in self.api["structs"]:
            struct = self.type_name(entry["name"])
            lines.append(f'    Same("{struct}", sizeof({struct}), {entry["size"]});')
            lines += [
                f'    Same("{struct}.{name}", (long)Marshal.OffsetOf(typeof({struct}), "{name.lstrip("@")}"), {field["offset"]});'
                for field in entry["fields"]
                for name in [self.name(field["name"])]
            ]
        return self.LAYOUT.format(tests="\n".join(lines), count=len(self.api["structs"]))


class Rust(Layer):
    """carom-sys/src/lib.rs: the declarations of C. carom/src/calls.rs: functions without pointers."""

    HAND, CALL = "bindings/rust/carom/src/*.rs", r"\bsys::(carom_\w+)\("
    # How a caller gives an argument, and how C gets it, by its role.
    GIVEN = {
        "value": ("{name}: {type}", "{name}"),
        "word": ("{name}: {type}", "{name}.into()"),
        "members": ("", "{type} {{ {members} }}"),
        "object": ("{name}: &{type}", "{name}"),
        "changed": ("{name}: &mut {type}", "{name}"),
        "list": ("{name}: &[{type}]", "{name}.as_ptr()"),
        "changed list": ("{name}: &mut [{type}]", "{name}.as_mut_ptr()"),
        "count": ("", "{last}.len() as {count}"),
        "result": ("", "&mut made"),
        "words": ("", "to"),
        "room": ("", "room"),
    }
    MEMBER, INDENT = "{0}", ""
    # The type of a getter of a match and its value, by its form; {at} is the member.
    GETTERS = {
        "index": ("usize", "self.of.{at} as usize"),
        "seat": ("Option<usize>", "usize::try_from(self.of.{at}).ok()"),
        "count": ("u64", "self.of.{at} as u64"),
        "word": ("{type}", '{type}::try_from(self.of.{at}).expect("a value of carom_match.h")'),
        "side": (
            "Option<usize>",
            "(!self.is_drawn()).then(|| usize::try_from(self.of.{at} - 1).ok()).flatten()",
        ),
        "drawn": ("bool", "self.of.{at} == sys::CAROM_DRAWN"),
        "struct": ("sys::{type}", "self.of.{at}"),
    }

    BASE = {c: rust for c, _, _, rust in TYPES}
    KEYWORDS = {"final", "type", "in", "where", "box", "match", "move", "ref", "loop", "use"}

    def name(self, words):
        return f"r#{words}" if words in self.KEYWORDS else words

    def type(self, about):
        name = about["type"]
        if name in self.callbacks:
            return f"Option<{name}>"
        found = self.BASE.get(name, name)
        for length in reversed(about.get("to_array", ())):
            found = f"[{found}; {length}]"
        for _ in range(about.get("pointer", 0)):
            found = f"*{'const' if about.get('const') else 'mut'} {found}"
        for length in reversed(about.get("array", ())):
            found = f"[{found}; {length}]"
        return found

    def signature(self, function):
        arguments = ", ".join(
            f"{self.name(entry['name'])}: {self.type(entry)}" for entry in function["arguments"]
        )
        returns = self.type(function["returns"])
        return f"({arguments})" + ("" if returns == "c_void" else f" -> {returns}")

    @staticmethod
    def about(words, indent=""):
        # brackets would be links, and angles HTML
        return wrapped(re.sub(r"([\[\]<>])", r"\\\1", words), f"{indent}/// ")

    HEAD = """//! The declarations of the C library carom, by their names in C.
#![allow(non_camel_case_types)]
pub mod words;
use std::os::raw::{c_char, c_int, c_void};
"""
    # All fields are numbers, pointers, or functions that may be missing: zeros are valid in each.
    DEFAULT = """}}

impl Default for {0} {{
    /// All zero.
    fn default() -> Self {{
        unsafe {{ core::mem::zeroed() }}
    }}
}}"""

    def text(self):
        lines = [NOTE.format(version=self.api["version"]) + self.HEAD]
        lines += self.listed(self.api["constants"], "", self.constant)
        for entry in self.api["enums"]:
            lines += self.listed([entry], "", lambda entry: f"pub type {entry['name']} = c_int;")
            lines += self.listed(
                entry["values"],
                "",
                lambda value,
                enumeration=entry[
                    "name"
                ]: f"pub const {value['name']}: {enumeration} = {value['value']};",
            )
        for entry in self.api["structs"]:
            lines += ["", *self.listed([entry], "", self.struct_head)]
            lines += self.listed(entry["fields"], "    ", self.field)
            lines.append(self.DEFAULT.format(entry["name"]))
        for entry in self.api["callbacks"]:
            lines += ["", *self.listed([entry], "", self.callback)]
        lines += ["", 'extern "C" {']
        lines += self.listed(
            self.api["functions"],
            "    ",
            lambda entry: f"pub fn {entry['name']}{self.signature(entry)};",
        )
        return "\n".join([*lines, "}", ""])

    @staticmethod
    def constant(entry):
        kind = "f64" if isinstance(entry["value"], float) else "c_int"
        return f"pub const {entry['name']}: {kind} = {entry['value']};"

    @staticmethod
    def struct_head(entry):
        return f"#[repr(C)]\n#[derive(Clone, Copy, Debug)]\npub struct {entry['name']} {{"

    def field(self, entry):
        return f"pub {self.name(entry['name'])}: {self.type(entry)},"

    def callback(self, entry):
        return f'pub type {entry["name"]} = unsafe extern "C" fn{self.signature(entry)};'

    def value_type(self, about):
        """A type of the safe layer: enumerations are those of words.rs."""
        name = about["type"]
        if name in self.structs:
            return f"sys::{name}"
        return type_name(name) if name in self.enums else self.BASE[name].replace("c_int", "i32")

    def function(self, function, roles, of_match):
        """A function without pointers."""
        parameters, passed = self.arguments_of(roles)
        name = self.name(function["name"].removeprefix("carom_match_" if of_match else "carom_"))
        asks = {"result", "words"} & {role for _, role in roles}
        own = "&*self.of" if asks else "&mut *self.of"
        call = f"sys::{function['name']}({', '.join([own] * of_match + passed)})"
        if of_match and not asks:
            seat = ["let seat = self.at_table();"] if "seat" in passed else []
            parameters = [
                "&mut self",
                *(entry for entry in parameters if not entry.startswith("seat:")),
            ]
            result = "Result<(), Error>"
            lines = [*seat, f"let status = unsafe {{ {call} }};", "self.told(status)"]
        else:
            result, lines = self.result(function["returns"], roles, f"unsafe {{ {call} }}")
            parameters = ["&self"] * of_match + parameters
        arrow = f" -> {result}" if result else ""
        lines = [
            f"pub fn {name}({', '.join(parameters)}){arrow} {{",
            *(f"    {entry}" for entry in lines),
            "}",
        ]
        return [f"    {line}" for line in lines] if of_match else lines

    def result(self, returned, roles, call):
        """What a function returns, and its lines."""
        outputs = [self.value_type(entry) for entry, role in roles if role == "result"]
        if outputs:
            lines = ["let mut made = Default::default();", f"check({call})?;", "Ok(made)"]
            return f"Result<{outputs[0]}, Error>", lines
        if "words" in (role for _, role in roles):
            return "String", [f"written(|to, room| {call})"]
        if returned.get("pointer"):
            return "Option<String>", [f"optional_text({call})"]
        if returned["type"] == "carom_status":
            return "Result<Status, Error>", [f"check({call})"]
        if returned["type"] in self.enums:
            known = '.expect("the library is of the version of carom-sys")'
            return self.value_type(returned), [f"{call}.try_into(){known}"]
        return (
            ("", [f"{call};"])
            if returned["type"] == "void"
            else (self.value_type(returned), [call])
        )

    def getter(self, getter, about, type_, value):
        enum = getter.type in self.enums
        given = {
            "type": type_name(getter.type) if enum else getter.type,
            "at": ".".join(map(self.name, getter.path)),
        }
        name = f"is_{getter.name}" if type_ == "bool" else self.name(getter.name)
        return [
            *about,
            f"    pub fn {name}(&self) -> {type_.format(**given)} {{",
            f"        {value.format(**given)}",
            "    }",
        ]

    @staticmethod
    def type_name(name):
        return type_name(name)

    KIND = "impl Named for {0} {{\n    const WORDS: Words = Words::{1};\n}}"
    CALLS = """//! Functions of C without pointers, by their names in C.
use crate::sys::words::*;
use crate::{{check, optional_text, sys, written, Error, Match, Named}};

{}

impl Match {{
{}
}}

{}
"""

    WORDS = """
macro_rules! words {
    ($($(#[$about:meta])* $of:ident { $($(#[$text:meta])* $word:ident = $value:literal,)* })*) => {$(
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[non_exhaustive]
        #[repr(i32)]
        pub enum $of {
            $($(#[$text])* $word = $value,)*
        }

        impl From<$of> for i32 {
            fn from(word: $of) -> i32 {
                word as i32
            }
        }

        /// The error is a value that is not listed.
        impl TryFrom<i32> for $of {
            type Error = i32;
            fn try_from(value: i32) -> Result<Self, i32> {
                match value {
                    $($value => Ok($of::$word),)*
                    other => Err(other),
                }
            }
        }
    )*};
}

words! {
"""

    def words(self):
        """carom-sys/src/words.rs: the enumerations as those of Rust."""
        about = "//! The enumerations as types of Rust. Structs and functions have their values as i32.\n"
        lines = [NOTE.format(version=self.api["version"]) + about + self.WORDS.rstrip()]
        for entry in self.api["enums"]:
            lines += [*self.about(entry["comment"], "    "), f"    {type_name(entry['name'])} {{"]
            for name, value in enumerators(entry):
                lines += self.about(value["comment"], "        ")
                lines.append(f"        {name} = {value['value']},")
            lines.append("    }")
        return "\n".join([*lines, "}", ""])

    def layout_test(self):
        """A test that compares sizes and offsets with those of C."""
        lines = [
            "use carom_sys::*;",
            "use core::mem::{size_of, MaybeUninit};",
            "use core::ptr::addr_of;",
            "",
        ]
        for entry in self.api["structs"]:
            lines += [
                "#[test]",
                f"fn {entry['name']}() {{",
                f"    assert_eq!(size_of::<carom_sys::{entry['name']}>(), {entry['size']});",
            ]
            lines.append(f"    let one = MaybeUninit::<carom_sys::{entry['name']}>::uninit();")
            for field in entry["fields"]:
                place = f"unsafe {{ addr_of!((*one.as_ptr()).{self.name(field['name'])}) }} as usize - one.as_ptr() as usize"
                lines.append(f'    assert_eq!({place}, {field["offset"]}, "{field["name"]}");')
            lines += ["}", ""]
        return "\n".join(line for line in lines if line != "use carom_sys::*;")


def main():
    out = Path(sys.argv[1])
    api = describe(HERE.parent / "core/include")
    texts = {
        "api.json": json.dumps(api, indent=1, ensure_ascii=False) + "\n",
        "csharp/Runtime/Native.cs": CSharp(api).text(),
        "csharp/Runtime/Calls.cs": CSharp(api).calls(),
        "csharp/Tests/Layout.cs": CSharp(api).layout_test(),
        "rust/carom/src/calls.rs": Rust(api).calls(),
        "rust/carom-sys/src/lib.rs": Rust(api).text(),
        "rust/carom-sys/src/words.rs": Rust(api).words(),
        "rust/carom-sys/tests/layout.rs": Rust(api).layout_test(),
    }
    for language in ("csharp", "rust"):
        shutil.copytree(HERE / language, out / language, dirs_exist_ok=True)
        for package in [
            *(out / language).glob("*/Cargo.toml"),
            *(out / language).glob("package.json"),
        ]:
            for licence in ("LICENSE", "NOTICE"):
                shutil.copy(HERE.parent / licence, package.parent)
        for part in (out / language).rglob("*"):
            if part.suffix in (".json", ".toml"):
                part.write_text(
                    part.read_text(encoding="utf-8").replace("VERSION", api["version"]),
                    encoding="utf-8",
                )
    for name, text in texts.items():
        (out / name).parent.mkdir(parents=True, exist_ok=True)
        (out / name).write_text(text, encoding="utf-8")
    subprocess.run(
        [sys.executable, HERE.parent / "tools/one_file.py", out / "rust/carom-sys/c"], check=True
    )


if __name__ == "__main__":
    main()
