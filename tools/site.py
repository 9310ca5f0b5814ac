"""site.py SOURCE WORK: makes the static site of the pages in WORK/site, and fails where a link or
an anchor leads nowhere.

Pages keep their places in the tree, so their links lead where they lead in the repository. Files
that they link to are copied. Each example becomes a page: its head comment, its picture, its text.
Those in JavaScript run in their pages, and the explorer is a part of the site, where
`web/npm/build` and `npm run page` have built them.
"""

import ast
import json
import os
import re
import shutil
import subprocess
import sys
import tomllib
from importlib.metadata import distribution
from pathlib import Path

from reference import names_of_python, pages

SOURCE, WORK = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
PAGES, LINK = WORK / "pages", re.compile(r"\[([^]]*)\]\(([^)\s]+)\)")
FOLDERS = {
    "First steps": "docs/start",
    "Using": "docs/using",
    "Understanding": "docs/understanding",
    "Study": "docs/study",
    "Contributing": "docs/contributing",
}
REFERENCE = "docs/reference"

OTHERS = [
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    *sorted(
        str(page.relative_to(SOURCE))
        for room in ("cli", "data", "lab", "plan", "python", "src", "study", "tests", "web")
        for page in (*SOURCE.glob(f"{room}/README.md"), *SOURCE.glob(f"{room}/*/README.md"))
    ),
]
FIRST = [
    "player",
    "play",
    "command",
    "questions",
    "python",
    "javascript",
    "games",
    "examples",
    "shots",
    "physics",
    "accuracy",
]  # what a newcomer asks for, before the other pages
EXPLORER = SOURCE / "web/page/dist/index.html"
PACKAGE, ESBUILD = SOURCE / "web/npm/dist/index.js", SOURCE / "web/node_modules/.bin/esbuild"
LIVE = PACKAGE.is_file() and ESBUILD.is_file()


def title(page):
    return re.search(r"^# (.+)$", (PAGES / page).read_text(encoding="utf-8"), flags=re.M)[
        1
    ].replace("`", "")


def put(page, text):
    (PAGES / page).parent.mkdir(parents=True, exist_ok=True)
    (PAGES / page).write_text(text, encoding="utf-8")


def add(page, text=None):
    """A page of the tree, with the files that it links to.

    The second word of a fence is for the tests.
    """
    text = text or re.sub(
        r"^```(\w+) [^\n]*$", r"```\1", (SOURCE / page).read_text(encoding="utf-8"), flags=re.M
    )

    def target(match):
        words, link = match.groups()
        to = (SOURCE / page).parent / link.partition("#")[0]
        if re.match(r"[a-z]+:|#", link):
            return match[0]
        if to.is_dir():  # the site has pages of files only
            return (
                f"[{words}]({link.rstrip('/')}/README.md)"
                if (to / "README.md").is_file()
                else words
            )
        if to.suffix == ".ipynb":
            return f"[{words}]({link}.md)"
        if to.is_file() and to.suffix != ".md":
            name = to.resolve().relative_to(SOURCE)
            (PAGES / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(to, PAGES / name)
        return match[0]

    # Manuals come before what mentions them in passing.
    manual = page.startswith(("docs/using/", f"{REFERENCE}/"))
    put(page, ("---\nsearch: {boost: 2}\n---\n\n" if manual else "") + LINK.sub(target, text))


def example(path):
    """The page of a program: head comment or docstring, picture, the rest of the text.

    Its name, or None for a file without such a head.
    """
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".py":
        tree = ast.parse(text)
        head, kind = ast.get_docstring(tree), "python"
        rest = "".join(text.splitlines(keepends=True)[tree.body[0].end_lineno :])
    else:
        found = re.match(r"/\*(.*?)\*/\n", text, flags=re.S)
        head, kind = (
            found and re.sub(r"^ ?\* ?", "", found[1], flags=re.M).strip(),
            {".c": "c", ".cpp": "cpp", ".mjs": "js"}[path.suffix],
        )
        rest = text[found.end() :] if found else ""
    if not head:
        return None
    page = f"{path.relative_to(SOURCE)}.md"
    picture = SOURCE / "docs/figures" / f"example-{path.stem.replace('_', '-')}.svg"
    put(page, f"# {path.name}\n\n{head}\n\n")
    up = "../" * (len(path.relative_to(SOURCE).parts) - 1)
    with (PAGES / page).open("a", encoding="utf-8") as out:
        if picture.is_file():
            out.write(f"![What {path.name} draws]({up}docs/figures/{picture.name})\n\n")
        out.write(f"```{kind}\n{rest.lstrip()}```\n")
        if LIVE and kind == "js":
            out.write(
                '\n<button id="live-run">Run it here</button> You may change the text first.\n\n<pre id="live-output" aria-live="polite"></pre>\n\n'
            )
            out.write(
                f'<script src="{up}live/carom.js"></script><script src="{up}live/site_live.js"></script>\n'
            )
    return page


def notebook(path):
    """The page of a notebook: its text, its code, what it printed, and its pictures, which
    python/tests/test_examples.py draws.
    """
    page, parts = f"{path.relative_to(SOURCE)}.md", []
    for k, cell in enumerate(json.loads(path.read_text(encoding="utf-8"))["cells"]):
        text, printed = (
            "".join(cell["source"]),
            "".join(line for output in cell.get("outputs", ()) for line in output["text"]),
        )
        parts += [
            f"```python\n{text}\n```" if cell["cell_type"] == "code" else text,
            f"```text\n{printed}```" * bool(printed),
        ]
        parts += [
            f"![What this cell draws](../../docs/figures/{drawn.name})"
            for drawn in sorted((SOURCE / "docs/figures").glob(f"notebook-{path.stem}-{k}[-.]*"))
        ]
    add(page, "\n\n".join(parts))
    return page


shutil.rmtree(PAGES, ignore_errors=True)
shutil.copytree(
    SOURCE / "docs/figures", PAGES / "docs/figures", ignore=shutil.ignore_patterns("data")
)
(PAGES / "live").mkdir()
shutil.copy(SOURCE / "tools/site.css", PAGES / "live")
if LIVE:
    shutil.copy(SOURCE / "tools/site_live.js", PAGES / "live")
    subprocess.run(
        [
            ESBUILD,
            PACKAGE,
            "--bundle",
            "--minify",
            "--format=iife",
            "--global-name=carom",
            "--log-level=warning",
            f"--outfile={PAGES / 'live/carom.js'}",
        ],
        check=True,
    )
navigation = [{"carom": "README.md"}]
add("README.md")
for name, folder in FOLDERS.items():
    sheets = [
        str(page.relative_to(SOURCE))
        for page in sorted(
            (SOURCE / folder).glob("*.md"),
            key=lambda page: (
                FIRST.index(page.stem) if page.stem in FIRST else len(FIRST),
                page.stem,
            ),
        )
    ]
    for page in sheets:
        add(page)
    navigation.append({name: [{title(page): page} for page in sheets]})
programs = [
    *sorted((SOURCE / "examples").glob("*.c*")),
    *sorted((SOURCE / "python/examples").glob("*.py")),
    *sorted((SOURCE / "web/npm/examples").glob("*.mjs")),
]
add("examples/README.md")
notebooks = [*map(notebook, sorted((SOURCE / "python/examples").glob("*.ipynb")))]
made = [*notebooks, *filter(None, map(example, programs))]
navigation.append(
    {"Examples": [{"Programs": "examples/README.md"}, *({Path(page).stem: page} for page in made)]}
)
for page in OTHERS:
    add(page)
navigation.append({"In the repository": [{title(page): page} for page in OTHERS]})
written = [str(page.relative_to(SOURCE)) for page in sorted((SOURCE / REFERENCE).glob("*.md"))]
for page in written:
    add(page)
generated = [(name, page, put(page, text)) for name, page, text in pages(SOURCE)]
navigation.append(
    {
        "Reference": [
            *({title(page): page} for page in written),
            *({name: page} for name, page, _ in generated),
        ]
    }
)
if EXPLORER.is_file():
    shutil.copytree(EXPLORER.parent, PAGES / "explorer")
    navigation.append({"Explorer": "explorer/index.html"})

project = tomllib.loads((SOURCE / "packaging/project.toml").read_text(encoding="utf-8"))
settings = {
    "INHERIT": str(SOURCE / "tools/site.yml"),
    "docs_dir": str(PAGES),
    "site_dir": str(WORK / "site"),
    "nav": navigation,
    "plugins": {"mkdocstrings": {"handlers": {"python": {"paths": [str(SOURCE / "python/src")]}}}},
}
# Not as repo_url, by which each page would ask that server for stars and versions.
link = (
    f'<a href="{project["address"].removesuffix(".git")}">Sources</a>' if project["address"] else ""
)
settings |= (
    {"copyright": " ".join(f"{project['year']} {project['copyright']} {link}".split())}
    if project["copyright"] or link
    else {}
)
(WORK / "mkdocs.yml").write_text(json.dumps(settings, indent=1), encoding="utf-8")
# Not --quiet, by which mkdocs counts no warnings.
done = subprocess.run(
    [sys.executable, "-m", "mkdocs", "build", "--strict", "--config-file", WORK / "mkdocs.yml"],
    text=True,
    stdout=subprocess.PIPE,
    stderr=subprocess.STDOUT,
    env={**os.environ, "NO_MKDOCS_2_WARNING": "1"},
)
if done.returncode:
    sys.exit("\n".join(line for line in done.stdout.splitlines() if not line.startswith("INFO")))
built = sorted((WORK / "site").rglob("*.html"))
assert all(
    "```text\n" in (text := (PAGES / page).read_text(encoding="utf-8")) and "/notebook-" in text
    for page in notebooks
), notebooks
assert (
    len(made) >= 4
    and len(notebooks) >= 2
    and len(built) >= 30
    and (WORK / "site/search/search_index.json").is_file()
), (len(made), len(built))
python_page = (WORK / "site/reference/python.html").read_text(encoding="utf-8")
missing = [name for name in names_of_python(SOURCE) if f'id="carom.{name}"' not in python_page]
assert not missing, f"the reference of Python lacks {missing}"
# The licences of what the site contains; the explorer has the others in itself.
(WORK / "site/licenses").mkdir()
theme = next(file for file in distribution("mkdocs-material").files if file.name == "LICENSE")
for name, file in {
    "carom": "LICENSE",
    "carom-NOTICE": "NOTICE",
    "webassembly": "web/npm/NOTICES",
    "mkdocs-material": theme.locate(),
}.items():
    shutil.copy(SOURCE / file, WORK / f"site/licenses/{name}.txt")
# A page asks no other server for a part of itself: mkdocs-material would get the search of a page
# that no server has from unpkg.com.
asks = []
for page in built:
    text = page.read_text(encoding="utf-8")
    alone = re.sub(r'<script src="https://unpkg\.com/iframe-worker/shim"></script>', "", text)
    if alone != text:
        page.write_text(alone, encoding="utf-8")
    asks += [
        f"{page}: {tag}"
        for tag in re.findall(
            r'<(?:script|link|img|iframe)\b[^>]*(?:src|href)="?https?://[^>]*>', alone
        )
    ]
assert not asks, asks
without = [
    what
    for what, there in (
        ("programs that run in their pages", LIVE),
        ("the explorer", EXPLORER.is_file()),
    )
    if not there
]
print(f"{len(built)} pages, {len(made)} examples: {WORK / 'site/index.html'}")
if without:
    print(f"without {' and '.join(without)}: ./run --web builds them, then make the site again")
