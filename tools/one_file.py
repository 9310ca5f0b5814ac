"""Writes the library as one file, for projects that vendor it: tools/one_file.py FOLDER

FOLDER gets carom.c and the public headers. `cc -O2 app.c carom.c -lm` compiles them as C17,
`-pthread` where the C library wants it. All instruction sets of the processor are in: the kernels
that the build compiles several times are a part of carom.c that includes itself, with other
definitions each time. Derivatives are not in: they are C++, and their calls return
CAROM_ERROR_NO_TANGENTS. -DCAROM_WITHOUT_AVX512 (AVX2, SSE2, NEON) leaves sets out,
-DCAROM_WITHOUT_THREADS the threads.

In one translation unit the names that two sources have for themselves would meet. So a source's own
macros are undefined behind it, and names that another source has too are replaced by longer ones
meanwhile.
"""

import re
import sys
from collections import Counter
from itertools import groupby
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SRC, PLAN = ROOT / "core/src", ROOT / "games"
ROOMS = [PLAN / room for room in ("rules", "ratings", "search", "coach", "match")]
INCLUDES = (ROOT / "core/include", PLAN / "include", ROOT / "bindings/cpp")
HEADERS = {path.name: path for folder in INCLUDES for path in folder.glob("*.h*")}
PUBLIC = sorted(name for name in HEADERS if name.endswith(".h"))
WRAPPER = "carom.hpp"
# What CMakeLists.txt compiles once for every instruction set, with the definitions of each time,
# and the sets of `advance.c`.
PASSES = [
    ("rows.c", "", "f64"),
    ("rows.c", "F32", "f32"),
    ("rows.c", "MIXED", "mixed"),
    ("rows.c", "ONE", "one_f64"),
    ("rows.c", "ONE F32", "one_f32"),
    ("rows.c", "ONE MIXED", "one_mixed"),
    ("collocate.c", "", "steps_f64"),
    ("collocate.c", "F32", "steps_f32"),
    ("collocate.c", "ONE", "one_steps_f64"),
    ("collocate.c", "ONE F32", "one_steps_f32"),
    ("advance.c", "", "impact"),
]
KERNELS = {"rows.c": "ball_ball", "collocate.c": "ball_ball", "advance.c": "contact_law"}
ISAS = {"plain": "1", "sse2": "x86_64", "avx2": "x86_64", "avx512": "x86_64", "neon": "aarch64"}
TARGETS = {
    "sse2": "sse2",
    "avx2": "avx2,fma",
    "avx512": "avx512f,avx512dq,avx512vl,fma,prefer-vector-width=512",
}

COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.S)
LOCAL = re.compile(r'^[ \t]*#[ \t]*include[ \t]+"([^"]+)"[^\n]*\n', re.M)
SYSTEM = re.compile(r"^[ \t]*#[ \t]*include[ \t]+<[^>]+>[^\n]*\n", re.M)


def text_of(name):
    """A file of core/src/, or else of a room of games/."""
    places = (SRC / name, *(room / name for room in ROOMS))
    return next(path for path in places if path.exists()).read_text(encoding="utf-8")


def included(name, seen):
    """The headers of core/src/ that a file needs, each behind those that it needs."""
    for header in LOCAL.findall(text_of(name)):
        if header not in PUBLIC and header not in seen:
            seen[header] = None
            order = included(header, seen)
            seen.pop(header)
            seen[header] = None
            del order
    return seen


def macros(text):
    return set(re.findall(r"^[ \t]*#[ \t]*define[ \t]+(\w+)", text, re.M))


def own_names(text):
    """The names that a source declares at file scope for itself: functions, variables, types,
    enumerators.
    """
    # functions that a macro writes: KIND(name, ...)
    makers = [
        name
        for name, rest in re.findall(r"#define (\w+)\(name,((?:[^\n]*\\\n)*[^\n]*)", text)
        if re.search(r"static\b.* name\(", rest)
    ]
    defined_names = set(re.findall(rf"^(?:{'|'.join(makers) or '(?!)'})\((\w+),", text, re.M))
    text = re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*\n", "\n", COMMENT.sub(" ", text), flags=re.M)
    tokens = re.findall(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\'|\w+|\S', text)
    names, item, depth = defined_names, [], 0
    for token in tokens:
        depth += (token in "{([") - (token in "})]")
        item.append((token, depth))
        if (token == ";" and depth == 0) or (token == "}" and depth == 0 and is_function(item)):
            names |= declared(item)
            item = []
    return names


def is_function(item):
    """Whether a block that has just been closed is the body of a function."""
    top = [token for token, depth in item if depth == 0 or (depth == 1 and token in "{(")]
    return (
        "(" in top
        and "=" not in top[: top.index("(")]
        and top[0] not in ("typedef", "struct", "enum", "union")
    )


def declared(item):
    tokens = [token for token, _ in item]
    depths = [depth for _, depth in item]
    names = set()
    # enumerators, and tags
    for k, token in enumerate(tokens):
        if (
            token in ("struct", "enum", "union")
            and depths[k] == 0
            and k + 1 < len(tokens)
            and re.match(r"\w", tokens[k + 1])
        ):
            if (
                k + 2 < len(tokens)
                and tokens[k + 2] == "{"
                and not tokens[k + 1].startswith("carom_")
            ):
                names.add(tokens[k + 1])
        if token == "enum" and depths[k] == 0 and "{" in tokens[k : k + 3]:
            opening = tokens.index("{", k)
            end = next(
                n
                for n in range(opening, len(tokens))
                if tokens[n] == "}" and depths[n] == depths[opening] - 1
            )
            names |= {
                tokens[n + 1]
                for n in range(opening, end)
                if tokens[n] in "{," and depths[n] == depths[opening] and n + 1 < end
            }
    # declarators: the names before ( = , ; [ at the top; what is not static begins with carom_
    static = tokens[0] in ("static", "typedef", "always")
    in_value = False  # behind =, where names belong to others, such as UINT32_C(1)
    for k in range(1, len(tokens)):
        was_in_value = in_value
        if depths[k] == 0 and tokens[k] in ("=", ",", ";"):
            in_value = tokens[k] == "="
        if was_in_value:
            continue
        outside = depths[k] == 0 or (depths[k] == 1 and tokens[k] in "([")
        if (
            outside
            and tokens[k] in ("(", "=", ",", ";", "[", "__attribute__")
            and re.match(r"[A-Za-z_]\w*$", tokens[k - 1])
            and depths[k - 1] == 0
        ):
            if tokens[k - 1] not in (
                "__attribute__",
                "_Alignas",
                "_Static_assert",
                "inline",
                "const",
                "static",
            ) and (static or not tokens[k - 1].startswith("carom_")):
                names.add(tokens[k - 1])
            if tokens[k] == "(" and tokens[k - 1] != "__attribute__":
                break
    return names


def bare(text):
    """Without includes; the system's are at the top."""
    return SYSTEM.sub("", LOCAL.sub("", text))


def expanded(name, remaining):
    """A source with the headers that are wanted in place, each once."""

    def header(found):
        if found[1] not in remaining:
            return ""
        remaining.remove(found[1])
        return expanded(found[1], remaining)

    return f"\n/* ==== core/src/{name} ==== */\n" + SYSTEM.sub("", LOCAL.sub(header, text_of(name)))


def guarded(name, text, others):
    """A source whose own names do not reach the next one. Members of structs keep theirs."""
    renamed = own_names(text) & others
    tag = re.sub(r"\W", "_", name.removesuffix(".c"))
    skipped = COMMENT.pattern + r'|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'|(?:\.|->)\w+'
    pattern = re.compile(f"({skipped})|\\b({'|'.join(sorted(renamed)) or '(?!)'})\\b", re.S)
    text = pattern.sub(lambda found: found[1] or f"{found[2]}_of_{tag}", bare(text))
    endings = "".join(f"#undef {private}\n" for private in sorted(macros(text) - {"_GNU_SOURCE"}))
    return f"\n/* ==== core/src/{name} ==== */\n{text}{endings}"


def listed(folder, target):
    """The sources of a target."""
    return (
        re.search(
            rf"add_library\(\s*{target} OBJECT(.*?)\)",
            (folder / "CMakeLists.txt").read_text(encoding="utf-8"),
            re.S,
        )
        .group(1)
        .split()
    )


def main():
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    sources = listed(SRC, "carom_objects")
    sources += sorted(path.name for room in ROOMS for path in room.glob("*.c"))
    sources += ["platform/processors.c", "platform/processors_windows.c"]
    kernels = {name: f"{room}/{name}" for name, room in KERNELS.items()}

    # Only headers of the kernels are read in every pass; the others once.
    common, inner = {}, {}
    for name in sources:
        included(name, common)
    for name in kernels.values():
        included(name, inner)
    inner = [name for name in inner if name not in common]
    texts = {name: text_of(name) for name in [*common, *inner, *sources, *kernels.values()]}

    counted = Counter(
        name for source in sources for name in own_names(texts[source]) | macros(texts[source])
    )
    counted.update(
        name for header in common for name in own_names(texts[header]) | macros(texts[header])
    )
    macro = set().union(*(macros(texts[name]) for name in [*common, *sources]))
    others = {name for name, times in counted.items() if times > 1 and name not in macro} | {
        "open",
        "close",
        "read",
        "write",
    }  # and those of POSIX

    system = sorted(
        {line.strip() for text in texts.values() for line in SYSTEM.findall(COMMENT.sub("", text))}
    )
    everywhere, posix, x86, android = sorted_out(system)

    out = [
        f"/* carom {version()} in one file, written by tools/one_file.py. It includes itself; its name must stay. */\n"
    ]
    out.append(
        '#ifndef CAROM_PASS\n#pragma GCC diagnostic ignored "-Wpsabi" /* wide vectors stay inside functions */\n'
        "#if defined(__linux__) && !defined(_GNU_SOURCE)\n#define _GNU_SOURCE\n#endif\n#define CAROM_BUILD\n"
    )
    out.append(
        "#if defined(__MINGW32__) && !defined(__clang__) /* gcc for Windows cannot align the stack for their vectors */\n"
    )
    out.append(
        "#undef CAROM_WITHOUT_AVX2\n#define CAROM_WITHOUT_AVX2\n#undef CAROM_WITHOUT_AVX512\n#define CAROM_WITHOUT_AVX512\n#endif\n"
    )
    out.append("#include <float.h>\n" + bare(texts["platform/arithmetic.h"]) + "\n")
    out.append("\n".join(everywhere) + "\n#ifndef _WIN32\n" + "\n".join(posix) + "\n#endif\n")
    out.append(
        "#if defined(__x86_64__) || defined(__i386__)\n"
        + "\n".join(x86)
        + "\n#elif defined(__aarch64__)\n#include <arm_neon.h>\n#endif\n"
    )
    out.append("#ifdef __ANDROID__\n" + "\n".join(android) + "\n#endif\n")
    out.append("#ifdef __wasm_simd128__\n#include <wasm_simd128.h>\n#endif\n")
    out.append("".join(f'#include "{name}"\n' for name in PUBLIC))
    for name in common:
        if name != "platform/arithmetic.h":
            out.append(f"\n/* ==== core/src/{name} ==== */\n{bare(texts[name])}")
    for name in sources:
        windows_alone = {
            "platform/processors.c": "#ifndef _WIN32\n",
            "platform/processors_windows.c": "#ifdef _WIN32\n",
        }.get(name)
        out.append(
            (windows_alone or "")
            + guarded(name, texts[name], others)
            + ("#endif\n" if windows_alone else "")
        )

    # The passes, and at the end their text.
    blocks = [
        (isa, condition, list(passes))
        for isa in ISAS
        for condition, passes in groupby(passes_of(isa), lambda one: condition_of(isa, *one[1:3]))
    ]
    for isa, condition, passes in blocks:
        out.append(f"\n#if {condition}\n")
        if isa in TARGETS:
            each = "".join(
                f"{part}," for part in TARGETS[isa].split(",") if not part.startswith("prefer")
            )[:-1]
            out.append("#ifdef __clang__\n")
            out.append(
                f'#pragma clang attribute push(__attribute__((target("{each}"))), apply_to = function)\n'
            )
            out.append(
                f'#else\n#pragma GCC push_options\n#pragma GCC target("{TARGETS[isa]}")\n#endif\n'
            )
        for number, _, definitions, tag in passes:
            defined = [
                f"CAROM_LANES_{isa.upper()}",
                f"CAROM_LANES_SUFFIX {isa}",
                *(f"CAROM_LANES_{d}" for d in definitions.split()),
            ]
            out.append(
                f"#define CAROM_PASS {number}\n#define CAROM_PASS_NAME(x) x##_of_{isa}_{tag}\n"
            )
            out.append("".join(f"#define {d}\n" for d in defined) + '#include "carom.c"\n')
            out.append(
                "".join(f"#undef {d.split()[0]}\n" for d in defined)
                + "#undef CAROM_PASS\n#undef CAROM_PASS_NAME\n"
            )
        if isa in TARGETS:
            out.append(
                "#ifdef __clang__\n#pragma clang attribute pop\n#else\n#pragma GCC pop_options\n#endif\n"
            )
        out.append("#endif\n")
    out.append("\n#else /* a pass */\n")
    for name, path in kernels.items():
        mine = {}
        included(path, mine)
        parts = [header for header in mine if header in inner] + [path]
        numbers = " || ".join(f"CAROM_PASS == {k}" for k, p in enumerate(PASSES, 1) if p[0] == name)
        names = set().union(*(own_names(texts[part]) for part in parts))
        defined = set().union(*(macros(texts[part]) for part in parts))
        out.append(
            f"#if {numbers}\n"
            + "".join(
                f"#define {private} CAROM_PASS_NAME({private})\n"
                for private in sorted(names - defined - macro - KERNEL_MACROS)
            )
        )
        out.append(names_of_pass(name))
        out.append(expanded(path, set(inner)))
        out.append(
            "".join(f"#undef {private}\n" for private in sorted(names | defined | KERNEL_MACROS))
            + "#endif\n"
        )
    out.append("#endif\n")
    (folder / "carom.c").write_text("".join(out), encoding="utf-8")
    for name in [*PUBLIC, WRAPPER]:
        (folder / name).write_bytes(HEADERS[name].read_bytes())


# The headers of systems and processors, by the condition under which carom.c includes them. Those
# of `elsewhere` are in carom.c next to what is made of them.
SYSTEM_HEADERS = {
    "everywhere": "math stdbool stddef stdint string float limits stdlib stdio stdatomic",
    "posix": "pthread sched signal unistd fcntl time",
    "x86": "cpuid immintrin emmintrin",
    "android": "sys/auxv",
    "elsewhere": "arm_neon wasm_simd128",
}


def sorted_out(includes):
    """The lines of includes by their conditions. A header on no list would be missing on some
    system only, so it is an error here.
    """
    found = {condition: [] for condition in SYSTEM_HEADERS}
    for line in includes:
        name = re.search(r"<(.+)\.h>", line)[1]
        conditions = [key for key, names in SYSTEM_HEADERS.items() if name in names.split()]
        if not conditions:
            raise SystemExit(
                f"tools/one_file.py: {line} is on no list: SYSTEM_HEADERS must say where it is included"
            )
        found[conditions[0]].append(line)
    return [found[key] for key in ("everywhere", "posix", "x86", "android")]


KERNEL_MACROS = {
    "KERNEL_SUFFIX",
    "KERNEL_PRECISION",
    "COLLOCATED_SUFFIX",
    "LANE_NUMBERS",
    "KERNEL_PASTE",
    "KERNEL_PASTE_EXPANDED",
    "KERNEL_OF_SET",
    "KERNEL",
    "COLLOCATION_KERNEL",
}


def passes_of(isa):
    """What CMakeLists.txt compiles for an instruction set: rows of PASSES, each behind its number."""
    return [(number, *one) for number, one in enumerate(PASSES, 1) if has_pass(isa, one[0], one[1])]


def has_pass(isa, name, definitions):
    """Whether CMakeLists.txt compiles a source for an instruction set with these definitions."""
    if name == "advance.c":
        return isa in ("plain", "avx2")
    if isa == "plain":
        return definitions != ""
    if isa == "sse2":
        return definitions not in ("", "ONE")
    if isa == "avx512":
        return definitions != "ONE"
    return True


def condition_of(isa, name, definitions):
    """When a pass for an instruction set is compiled, for #if."""
    if isa == "plain":
        return "1"
    left_out = f"defined(CAROM_WITHOUT_{isa.upper()})"
    if isa == "avx2" and (name == "advance.c" or definitions == "ONE"):  # AVX-512 uses it too
        left_out = f"({left_out} && defined(CAROM_WITHOUT_AVX512))"
    return f"defined(__{ISAS[isa]}__) && !{left_out}"


def names_of_pass(name):
    """The section of a common header that names the functions of a source, which depends on the
    pass."""
    if name == "advance.c":
        part = r"#ifdef CAROM_LANES_AVX2\n#define CAROM_IMPACT_ADVANCE .*?\n#endif\n"
        return "#undef CAROM_IMPACT_ADVANCE\n" + re.search(
            part, text_of("contact_law/impact.h"), re.S
        ).group(0)
    return re.search(
        r"#ifdef CAROM_LANES_SUFFIX\n.*?COLLOCATION_KERNEL.*?\n#endif\n",
        text_of("ball_ball/kernels.h"),
        re.S,
    ).group(0)


def version():
    numbers = re.findall(
        r"#define CAROM_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)",
        (ROOT / "core/include/carom.h").read_text(encoding="utf-8"),
    )
    return ".".join(numbers)


main()
