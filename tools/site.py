"""site.py SOURCE WORK: makes the static site of the pages in WORK/site, and fails where a link or
an anchor leads nowhere.

Pages keep their paths in the tree, so their links lead where they lead in the repository. Files
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

from reference import names_of_python, options_of_command, pages

SOURCE, WORK = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
PAGES, LINK = WORK / "pages", re.compile(r"\[([^]]*)\]\(([^)\s]+)\)")
# The navigation: what a reader wants to do, and the pages for it. A page of docs/ that no group names
# ends the making of the site.
ROWS = (SOURCE / "tools/site_pages.txt").read_text(encoding="utf-8")
GROUPS = {
    group: pages_of.split() for group, pages_of in re.findall(r"^(\w.*)\n((?:  .+\n)+)", ROWS, re.M)
}
FRONT = ["README.md", "docs/README.md"]
CONTRIBUTE = ["CONTRIBUTING.md", "docs/contributing/extending.md", "CHANGELOG.md", "SECURITY.md"]
ROOMS = sorted(
    str(page.relative_to(SOURCE))
    for room in ("bindings", "command", "core", "data", "games", "python", "study", "web")
    for page in SOURCE.glob(f"{room}/**/README.md")
    if "node_modules" not in page.parts
)
# Pages that a search shows before others: manuals before mentions, and the study for its words.
BOOSTS = {"docs/study/": 6, "docs/start/": 3, "docs/using/": 2, "docs/reference/": 2}
PROGRAM = WORK.parent / "carom"
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
        linked = (SOURCE / page).parent / link.partition("#")[0]
        if re.match(r"[a-z]+:|#", link):
            return match[0]
        if linked.is_dir():  # the site has pages of files only
            return (
                f"[{words}]({link.rstrip('/')}/README.md)"
                if (linked / "README.md").is_file()
                else words
            )
        if linked.suffix == ".ipynb":
            return f"[{words}]({link}.md)"
        if linked.is_file() and linked.suffix != ".md":
            name = linked.resolve().relative_to(SOURCE)
            (PAGES / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(linked, PAGES / name)
        return match[0]

    boost = next((boost for place, boost in BOOSTS.items() if page.startswith(place)), 1)
    put(page, f"---\nsearch: {{boost: {boost}}}\n---\n\n" + LINK.sub(target, text))


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
KATEX = WORK / "node_modules/katex/dist"
if KATEX.is_dir():
    shutil.copy(SOURCE / "tools/site_math.js", PAGES / "live")
    for part in ("katex.min.css", "katex.min.js", "contrib/auto-render.min.js"):
        shutil.copy(KATEX / part, PAGES / "live")
    shutil.copytree(
        KATEX / "fonts", PAGES / "live/fonts", ignore=shutil.ignore_patterns("*.ttf", "*.woff")
    )
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
for page in FRONT:
    add(page)
for page in [*sum(GROUPS.values(), []), *CONTRIBUTE, *ROOMS]:
    add(page)
unnamed = {str(page.relative_to(SOURCE)) for page in SOURCE.glob("docs/*/*.md")}
unnamed -= {*sum(GROUPS.values(), []), *CONTRIBUTE}
assert not unnamed, f"no group of tools/site.py has {unnamed}"
navigation = {"carom": [FRONT[0], *({title(page): page} for page in FRONT[1:])]}
navigation |= {name: [{title(page): page} for page in sheets] for name, sheets in GROUPS.items()}
if EXPLORER.is_file():
    shutil.copytree(EXPLORER.parent, PAGES / "explorer")
    navigation["carom"].append({"Play now": "explorer/index.html"})
programs = [
    *sorted((SOURCE / "examples").glob("*.c*")),
    *sorted((SOURCE / "python/examples").glob("*.py")),
    *sorted((SOURCE / "web/npm/examples").glob("*.mjs")),
]
add("examples/README.md")
notebooks = [*map(notebook, sorted((SOURCE / "python/examples").glob("*.ipynb")))]
example_pages = [*notebooks, *filter(None, map(example, programs))]
navigation["Write programs"].append(
    {"All programs": ["examples/README.md", *({Path(page).stem: page} for page in example_pages)]}
)
generated = [*pages(SOURCE), *options_of_command(PROGRAM)]
for _, page, text in generated:
    put(page, text)
navigation["Reference"] += [{name: page} for name, page, _ in generated]
navigation["Contribute"] = [
    *({title(page): page} for page in CONTRIBUTE),
    {
        "Folders of the repository": [
            {f"{page.removesuffix('/README.md')}/": page} for page in ROOMS
        ]
    },
]

project = tomllib.loads((SOURCE / "packaging/project.toml").read_text(encoding="utf-8"))
settings = {
    "INHERIT": str(SOURCE / "tools/site.yml"),
    "docs_dir": str(PAGES),
    "site_dir": str(WORK / "site"),
    "nav": [{name: pages_of} for name, pages_of in navigation.items()],
    "plugins": {"mkdocstrings": {"handlers": {"python": {"paths": [str(SOURCE / "python/src")]}}}},
}
if KATEX.is_dir():
    scripts = ("katex.min.js", "auto-render.min.js", "site_math.js")
    settings["extra_javascript"] = [f"live/{script}" for script in scripts]
    settings["extra_css"] = ["live/katex.min.css", "live/site.css"]
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
    len(example_pages) >= 4
    and len(notebooks) >= 2
    and len(built) >= 30
    and (WORK / "site/search/search_index.json").is_file()
), (len(example_pages), len(built))
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
    **({"katex": KATEX.parent / "LICENSE"} if KATEX.is_dir() else {}),
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
    for what, exists in (
        ("programs that run in their pages", LIVE),
        ("the explorer", EXPLORER.is_file()),
        ("the options of the command", PROGRAM.is_file()),
        ("typeset formulas", KATEX.is_dir()),
    )
    if not exists
]
print(f"{len(built)} pages, {len(example_pages)} examples: {WORK / 'site/index.html'}")
if without:
    print(
        f"without {' and '.join(without)}: ./run builds the command, ./run --web the page and npm; then make the site again"
    )
