"""The pages of the site that list every call: of C from the description of the headers
(bindings/api.py), of npm, C# and Rust from their sources and from what bindings/ makes of a match, of
Python by mkdocstrings. pages(SOURCE) gives names and texts; options_of_command(PROGRAM) the options of `carom`, as its help has them.
"""

import ast
import re
import subprocess
import sys
from pathlib import Path


def plain(words):
    """A comment as Markdown: only what is between backquotes is code."""
    parts = re.split(r"(`[^`]*`)", " ".join(words.split()))
    return "".join(
        part if part.startswith("`") else re.sub(r"([\[\]<>*_|`#])", r"\\\1", part)
        for part in parts
    )


MOST_COLUMNS = 88  # of a line of code on the site's pages


def wrapped(declaration):
    """A declaration with one argument a line, if it is too long for one line of a page."""
    if len(declaration) <= MOST_COLUMNS or "(" not in declaration:
        return declaration
    begin = declaration.index("(") + 1
    arguments, depth, start, end = [], 0, begin, len(declaration)
    for place in range(begin, len(declaration)):
        sign = declaration[place]
        depth += (sign in "([{") - (sign in ")]}")
        if depth < 0 or (sign == "," and depth == 0):
            arguments.append(declaration[start:place].strip())
            start = place + 1
        if depth < 0:
            end = place
            break
    lines = ",\n".join(f"    {argument}" for argument in arguments)
    return f"{declaration[:begin]}\n{lines}\n{declaration[end:]}"


def entry(name, code, kind, words, more=""):
    return f"### {name}\n\n```{kind}\n{code.rstrip()}\n```\n\n{plain(words)}\n\n{more}"


def rows(head, lines):
    table = [head, *(line for line in lines)]
    bar = "|".join("---" for _ in head)
    return (
        "\n".join(
            [
                f"| {' | '.join(table[0])} |",
                f"|{bar}|",
                *(f"| {' | '.join(line)} |" for line in table[1:]),
            ]
        )
        + "\n\n"
        if lines
        else ""
    )


def of_c(source):
    """A page: constants and enumerations, structs, functions, all by name."""
    sys.path.insert(0, str(source / "bindings"))
    from api import describe

    api = describe(source / "core/include")

    def typed(about):
        """const double *v[3]"""
        stars, lengths = (
            "*" * about.get("pointer", 0),
            "".join(f"[{length}]" for length in about.get("array", ())),
        )
        return f"{'const ' if about.get('const') else ''}{about['type']} {stars}{about.get('name', '')}{lengths}".rstrip()

    def signature(entity):
        return f"{typed({**entity['returns'], 'name': entity['name']})}({', '.join(map(typed, entity['arguments'])) or 'void'});"

    text = f"# Reference: C\n\nEvery name of the headers of carom {api['version']}, which are the manual.\n\n## Functions\n\n"
    text += "".join(
        entry(entity["name"], wrapped(signature(entity)), "c", entity["comment"])
        for entity in api["functions"]
    )
    text += "## Functions of the caller\n\n" + "".join(
        entry(entity["name"], wrapped(signature(entity)), "c", entity["comment"])
        for entity in api["callbacks"]
    )
    text += "## Structs\n\n"
    for entity in api["structs"]:
        fields = [
            [f"`{typed(field)}`", field.get("unit", ""), plain(field["comment"])]
            for field in entity["fields"]
        ]
        text += entry(
            entity["name"],
            f"{entity['name']} /* {entity['size']} bytes */",
            "c",
            entity["comment"],
            rows(["field", "unit", ""], fields),
        )
    text += "## Enumerations\n\n"
    for entity in api["enums"]:
        values = [
            [f"`{value['name']}`", str(value["value"]), plain(value["comment"])]
            for value in entity["values"]
        ]
        text += entry(
            entity["name"],
            f"enum {entity['name']}",
            "c",
            entity["comment"],
            rows(["name", "value", ""], values),
        )
    constants = [
        [f"`{entity['name']}`", str(entity["value"]), plain(entity["comment"])]
        for entity in api["constants"]
    ]
    return text + "## Constants\n\n" + rows(["name", "value", ""], constants)


# Modules of the package whose names are in `carom` itself.
WITHIN_CAROM = {
    "collisions",
    "cushions",
    "derivatives",
    "layouts",
    "plans",
    "results",
    "rules",
    "shots",
    "status",
}


def of_python(source):
    """A page: the names that the package offers, then the modules that one imports. mkdocstrings
    puts signatures and docstrings in place of the lines with colons.
    """
    folder = source / "python/src/carom"
    offered = names_of_python(source)
    modules = sorted(
        {path.stem for path in folder.glob("[a-z]*.py")} - WITHIN_CAROM | {"pooltool", "tracks"}
    )

    def holder(module):
        """The module that has the names: some only import the names of another one."""
        path = folder / f"{module}.py"
        found = path.is_file() and re.search(r"from ([\w.]+) import \*", path.read_text("utf-8"))
        return found[1] if found else f"carom.{module}"

    text = (
        "# Reference: Python\n\nEvery public call of the package `carom`. "
        "[python.md](../docs/using/python.md) is the manual.\n\n"
        f"## carom\n\n::: carom\n    options:\n      members: {offered}\n\n"
    )
    return text + "".join(f"## carom.{name}\n\n::: {holder(name)}\n\n" for name in modules)


def names_of_python(source):
    """What `carom` offers, without its modules."""
    package = source / "python/src/carom"
    offered = next(
        ast.literal_eval(node.value)
        for node in ast.parse((package / "__init__.py").read_text(encoding="utf-8")).body
        if isinstance(node, ast.Assign) and node.targets[0].id == "_OFFERED"
    )
    return [name for name in offered if not (package / f"{name}.py").is_file()]


def members_of_match(source):
    """What bindings/ makes of the class of a match, by the file that has the rest of the class."""
    sys.path.insert(0, str(source / "bindings"))
    from api import describe
    from match import TypeScript
    from write import CSharp, Rust

    api = describe(source / "core/include")
    npm, rust = TypeScript(api), Rust(api).match_lines()
    lines = {
        "web/npm/src/match.ts": npm.getter_lines() + npm.act_lines(),
        "bindings/csharp/Runtime/Matches.cs": CSharp(api).match_lines(),
        "bindings/rust/carom/src/match_game.rs": ["impl Match {", *rust, "}"],
    }
    return {file: "\n".join(several) + "\n" for file, several in lines.items()}


def documented(source, files, comment, kind, title, named):
    """A page: each declaration with a comment of that form above it, in the order of the files.

    A member has the name of its class too.
    """
    made = members_of_match(source)
    text, holder = f"# Reference: {title}\n\n", None
    for file in files:
        whole = (source / file).read_text(encoding="utf-8") + made.get(file, "")
        for found in re.finditer(comment, whole, flags=re.M | re.S):
            words, line = found.groups()
            # In Rust a member is in the block of its type; those of a trait are public.
            blocks = re.findall(
                r"^(?:pub )?(impl|trait)(?:<[^>]*>)? (?:\w+ for )?(\w+)[^\n]*\{$|^\}$",
                whole[: found.start()],
                flags=re.M,
            )
            block, inside = blocks[-1] if kind == "rust" and blocks else ("", "")
            name = "@internal" not in words and named(
                ("pub " if block == "trait" else "") + line.strip()
            )
            outer = not line.startswith(" ") or re.search(r"\bclass\b", line)
            if outer:
                holder = name
            if name and (holder or inside):
                words = re.sub(r"</?summary>|^\s*(?:\*|///) ?", " ", words, flags=re.M)
                # The fields of a struct, some of which have no description of their own.
                body = whole[found.start(2) :]
                body = (
                    body[
                        : re.search(rf"^{re.match(' *', line)[0]}\}}|\Z", body, flags=re.M).start()
                    ]
                    if re.search(r"\b(?:class|struct)\b", line)
                    else ""
                )
                fields = "".join(
                    f"\n{field}"
                    for field in re.findall(r"^ *pub(?:lic)? [^({\n]*[;,]$", body, flags=re.M)
                )
                signature = f"{inside}::{name}" if inside else name if outer else f"{holder}.{name}"
                text += entry(
                    signature,
                    re.sub(r"\s*\{.*$", "", line.strip(), flags=re.S) + fields,
                    kind,
                    words,
                )
    return text


def of_npm(line, public):
    if re.match(
        r"(?:const|let|private|protected|constructor|import|#|readonly #|function|class)", line
    ):
        return None
    found = re.match(
        r"(export )?(?:static |async |get |readonly |abstract |const )*(?:class |interface |type |function )?([A-Za-z]\w*)",
        line,
    )
    return found and found[2] if found and (not found[1] or found[2] in public) else None


def of_csharp(line):
    found = re.match(
        r"(?:public|protected) (?:static |sealed |unsafe |readonly |abstract |virtual )*(?:class )?(?:[\w\[\]<>.]+ )?(\w+)",
        line,
    )
    return found and found[1]


def of_rust(line):
    found = re.match(r"pub (?:fn|struct|trait|type|const|use) (\w+)", line)
    return found and found[1]


def pages(source):
    source = Path(source)
    block, slashes = (
        r"/\*\*((?:(?!\*/).)*)\*/\n([^\n]+)",
        r"((?:^ *///[^\n]*\n)+)(?: *#\[[^\n]*\n)*([^\n]+(?:\([^)]*\)[^\n]*)?)",
    )

    def files(pattern):
        return [str(path.relative_to(source)) for path in sorted(source.glob(pattern))]

    index = (source / "web/npm/src/index.ts").read_text(encoding="utf-8")
    public = set(
        re.findall(r"\w+", " ".join(re.findall(r"export (?:type )?\{([^}]*)\}", index)))
    ) | set(re.findall(r"^export \w+ (?:function )?(\w+)", index, flags=re.M))
    types = (source / "web/npm/src/types.ts").read_text(encoding="utf-8")
    public |= set(re.findall(r"^export (?:interface|type) (\w+)", types, flags=re.M))
    yield "C", "reference/c.md", of_c(source)
    yield "Python", "reference/python.md", of_python(source)
    yield (
        "npm",
        "reference/npm.md",
        documented(
            source, files("web/npm/src/*.ts"), block, "ts", "npm", lambda line: of_npm(line, public)
        ),
    )
    yield (
        "C#",
        "reference/csharp.md",
        documented(
            source, files("bindings/csharp/Runtime/*.cs"), slashes, "csharp", "C#", of_csharp
        ),
    )
    yield (
        "Rust",
        "reference/rust.md",
        documented(source, files("bindings/rust/carom/src/*.rs"), slashes, "rust", "Rust", of_rust),
    )


def options_of_command(program):
    """A page with the help of every subcommand of a built `carom`; none without one."""
    if not program.is_file():
        return []

    def printed(*words):
        return subprocess.run(
            [program, *words], check=True, stdout=subprocess.PIPE, text=True
        ).stdout

    page = ["# Options of the command\n\nThese are the texts of `carom COMMAND --help`.\n"]
    for name in printed("--complete").split():
        usage, about, *rest = printed(name, "--help").split("\n\n")
        page.append(f"## carom {name}\n\n`{usage.removeprefix('usage: ')}`\n\n{plain(about)}\n")
        page += [
            option_list(part) if part.startswith("options") else details(part) for part in rest
        ]
    return [("Options of the command", "reference/options.md", "\n".join(page))]


def option_list(part):
    """Options of the help, "  -o, --output OUT  text", as a list."""
    head, *rows = re.split(r"^  (?=-)", part, flags=re.M)
    text = f"**{head.strip().capitalize()}**\n\n"
    for row in rows:
        option, _, words = re.sub(r"\s*\n\s+", "  ", row.strip()).partition("  ")
        text += f"`{option}`\n:   {plain(words)}\n\n"
    return text


def details(part):
    """A paragraph of the help: a list where its lines are indented under a head."""
    return f"```text\n{part.rstrip()}\n```\n" if "\n  " in part else f"{plain(part)}\n"
