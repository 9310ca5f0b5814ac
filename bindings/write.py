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

from api import describe  # noqa: E402

NOTE = "// Written by bindings/write.py from the headers of carom {version}.\n"


def pascal(name):
    """ball_state as BallState."""
    return "".join(part[:1].upper() + part[1:].lower() for part in name.split("_"))


def type_name(name):
    """carom_ball_state as BallState."""
    return pascal(name.removeprefix("carom_"))


def enumerators(enum):
    """Names and values of an enumeration, without what all names begin with: (Pool9ft, about)."""
    prefix = commonprefix([value["name"] for value in enum["values"]])
    prefix = prefix[: prefix.rindex("_") + 1]
    for value in enum["values"]:
        name = pascal(value["name"].removeprefix(prefix))
        yield ("_" if name[0].isdigit() else "") + name, value


def wrapped(words, before, width=100):
    """Lines of a comment."""
    lines = [""]
    for word in words.split():
        if len(before) + len(lines[-1]) + len(word) + 1 > width and lines[-1]:
            lines.append("")
        lines[-1] += f" {word}" if lines[-1] else word
    return [before + line for line in lines if line]


class CSharp:
    """Runtime/Native.cs: structs by sequential layout, enumerations, and the functions of C by
    P/Invoke.
    """

    BASE = {
        "double": "double",
        "float": "float",
        "char": "byte",
        "int": "int",
        "int8_t": "sbyte",
        "int32_t": "int",
        "uint32_t": "uint",
        "int64_t": "long",
        "uint64_t": "ulong",
        "size_t": "UIntPtr",
        "void": "void",
    }
    SAFE_MOST = 32  # numbers of an array that code without pointers reads and sets
    # System and UnityEngine, which games import beside Carom, have types of these names.
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
        self.api, self.arrays = api, {}
        self.callbacks = {one["name"] for one in api["callbacks"]}

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
    def summary(words, indent):
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

    def text(self):
        lines = [
            NOTE.format(version=self.api["version"]) + "using System;",
            "using System.Runtime.InteropServices;",
            "",
            "namespace Carom {",
        ]
        for one in self.api["enums"]:
            lines += [
                *self.summary(one["comment"], "  "),
                f"  public enum {self.type_name(one['name'])} {{",
            ]
            for name, value in enumerators(one):
                lines += self.summary(value["comment"], "    ")
                lines.append(f"    {name} = {value['value']},")
            lines += ["  }", ""]
        for one in self.api["structs"]:
            lines += [
                *self.summary(one["comment"], "  "),
                "  [StructLayout(LayoutKind.Sequential)]",
            ]
            lines.append(f"  public unsafe struct {self.type_name(one['name'])} {{")
            for field in one["fields"]:
                lines += [*self.summary(field["comment"], "    "), f"    {self.field(field)}"]
            lines += ["  }", ""]
        for (struct, count), size in self.arrays.items():
            lines += [
                f"  /// <summary>{count} of {struct}, one behind the other.</summary>",
                f"  [StructLayout(LayoutKind.Sequential, Size = {size})]",
                f"  public unsafe struct {pascal(struct)}Array{count} {{",
                f"    {struct} first;",
                f"    public {struct} this[int k] {{",
                f"      get {{ Check(k); fixed ({struct}* at = &first) return at[k]; }}",
                f"      set {{ Check(k); fixed ({struct}* at = &first) at[k] = value; }}",
                "    }",
                f'    static void Check(int k) {{ if (k < 0 || k >= {count}) throw new IndexOutOfRangeException($"must be 0 to {count - 1}, not {{k}}"); }}',
                "  }",
                "",
            ]
        lines += [
            "  /// <summary>Constants and functions of the library, by their names in C.</summary>",
            "  public static unsafe class Native {",
        ]
        # IL2CPP links a plugin into the program itself on these systems.
        lines += [
            "#if (UNITY_IOS || UNITY_WEBGL) && !UNITY_EDITOR",
            '    const string Library = "__Internal";',
            "#else",
            '    const string Library = "carom";',
            "#endif",
        ]
        for one in self.api["constants"]:
            kind = "double" if isinstance(one["value"], float) else "int"
            lines += [
                *self.summary(one["comment"], "    "),
                f"    public const {kind} {one['name']} = {one['value']};",
            ]
        for one in self.api["callbacks"]:
            lines += [
                *self.summary(one["comment"], "    "),
                "    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]",
            ]
            lines.append(
                f"    public delegate {self.type(one['returns'])} {one['name']}({self.arguments(one)});"
            )
        for one in self.api["functions"]:
            lines += [
                *self.summary(one["comment"], "    "),
                "    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]",
            ]
            lines.append(
                f"    public static extern {self.type(one['returns'])} {one['name']}({self.arguments(one)});"
            )
        return "\n".join([*lines, "  }", "}", ""])

    def arguments(self, function):
        return ", ".join(
            f"{self.type(one)} {self.name(one['name'])}" for one in function["arguments"]
        )

    def layout_test(self):
        """A program that compares sizes and offsets with those of C."""
        lines = [
            "using System;",
            "using System.Runtime.InteropServices;",
            "using Carom;",
            "static class Layout {",
        ]
        lines += [
            "  static int wrong;",
            "  static void Same(string what, long seen, long expected) {",
            '    if (seen != expected) { Console.WriteLine($"{what}: {seen}, in C {expected}"); wrong++; }',
            "  }",
            "  static unsafe int Main() {",
        ]
        for one in self.api["structs"]:
            struct = self.type_name(one["name"])
            lines.append(f'    Same("{struct}", sizeof({struct}), {one["size"]});')
            lines += [
                f'    Same("{struct}.{name}", (long)Marshal.OffsetOf(typeof({struct}), "{name.lstrip("@")}"), {field["offset"]});'
                for field in one["fields"]
                for name in [self.name(field["name"])]
            ]
        count = len(self.api["structs"])
        lines += [
            f'    if (wrong == 0) Console.WriteLine("{count} structs have the layout of C");',
            "    return wrong == 0 ? 0 : 1;",
            "  }",
            "}",
            "",
        ]
        return "\n".join(lines)


class Rust:
    """carom-sys/src/lib.rs: the declarations of C."""

    BASE = {
        "double": "f64",
        "float": "f32",
        "char": "c_char",
        "int": "c_int",
        "int8_t": "i8",
        "int32_t": "i32",
        "uint32_t": "u32",
        "int64_t": "i64",
        "uint64_t": "u64",
        "size_t": "usize",
        "void": "c_void",
    }
    KEYWORDS = {"final", "type", "in", "where", "box", "match", "move", "ref", "loop", "use"}

    def __init__(self, api):
        self.api = api
        self.callbacks = {one["name"] for one in api["callbacks"]}

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
            f"{self.name(one['name'])}: {self.type(one)}" for one in function["arguments"]
        )
        returns = self.type(function["returns"])
        return f"({arguments})" + ("" if returns == "c_void" else f" -> {returns}")

    @staticmethod
    def about(words, indent=""):
        # brackets would be links, and angles HTML
        return wrapped(re.sub(r"([\[\]<>])", r"\\\1", words), f"{indent}/// ")

    def text(self):
        lines = [
            NOTE.format(version=self.api["version"])
            + "//! The declarations of the C library carom, by their names in C."
        ]
        lines += [
            "#![allow(non_camel_case_types)]",
            "pub mod words;",
            "use std::os::raw::{c_char, c_int, c_void};",
            "",
        ]
        for one in self.api["constants"]:
            kind = "f64" if isinstance(one["value"], float) else "c_int"
            lines += [
                *self.about(one["comment"]),
                f"pub const {one['name']}: {kind} = {one['value']};",
            ]
        for one in self.api["enums"]:
            lines += [*self.about(one["comment"]), f"pub type {one['name']} = c_int;"]
            for value in one["values"]:
                lines += [
                    *self.about(value["comment"]),
                    f"pub const {value['name']}: {one['name']} = {value['value']};",
                ]
        for one in self.api["structs"]:
            lines += [
                "",
                *self.about(one["comment"]),
                "#[repr(C)]",
                "#[derive(Clone, Copy, Debug)]",
                f"pub struct {one['name']} {{",
            ]
            for field in one["fields"]:
                lines += [
                    *self.about(field["comment"], "    "),
                    f"    pub {self.name(field['name'])}: {self.type(field)},",
                ]
            lines += ["}", "", f"impl Default for {one['name']} {{", "    /// All zero."]
            # All fields are numbers, pointers, or functions that may be missing: zeros are valid in
            # each.
            lines += [
                "    fn default() -> Self {",
                "        unsafe { core::mem::zeroed() }",
                "    }",
                "}",
            ]
        for one in self.api["callbacks"]:
            lines += [
                "",
                *self.about(one["comment"]),
                f'pub type {one["name"]} = unsafe extern "C" fn{self.signature(one)};',
            ]
        lines += ["", 'extern "C" {']
        for one in self.api["functions"]:
            lines += [
                *self.about(one["comment"], "    "),
                f"    pub fn {one['name']}{self.signature(one)};",
            ]
        return "\n".join([*lines, "}", ""])

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
        for one in self.api["enums"]:
            lines += [*self.about(one["comment"], "    "), f"    {type_name(one['name'])} {{"]
            for name, value in enumerators(one):
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
        for one in self.api["structs"]:
            lines += [
                "#[test]",
                f"fn {one['name']}() {{",
                f"    assert_eq!(size_of::<carom_sys::{one['name']}>(), {one['size']});",
            ]
            lines.append(f"    let one = MaybeUninit::<carom_sys::{one['name']}>::uninit();")
            for field in one["fields"]:
                place = f"unsafe {{ addr_of!((*one.as_ptr()).{self.name(field['name'])}) }} as usize - one.as_ptr() as usize"
                lines.append(f'    assert_eq!({place}, {field["offset"]}, "{field["name"]}");')
            lines += ["}", ""]
        return "\n".join(line for line in lines if line != "use carom_sys::*;")


def main():
    out = Path(sys.argv[1])
    api = describe(HERE.parent / "include")
    made = {
        "api.json": json.dumps(api, indent=1, ensure_ascii=False) + "\n",
        "csharp/Runtime/Native.cs": CSharp(api).text(),
        "csharp/Tests/Layout.cs": CSharp(api).layout_test(),
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
    for name, text in made.items():
        (out / name).parent.mkdir(parents=True, exist_ok=True)
        (out / name).write_text(text, encoding="utf-8")
    subprocess.run(
        [sys.executable, HERE.parent / "tools/one_file.py", out / "rust/carom-sys/c"], check=True
    )


if __name__ == "__main__":
    main()
