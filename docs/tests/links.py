"""links.py SOURCE: every link in a page of the tree leads to a file of the tree, and to a heading
if it names one.

Checked are the Markdown files, links and pictures alike, and the paths of pages (docs/.../page.md)
that sources and tests name. Links to other sites are not followed. A page of docs/ begins with a
sentence that says what it covers, and ends with links to what the reader needs next; the index
docs/README.md has no such end. Every page can be reached from README by two links, and so can the
licence, the notice and the citation. Links read as a part of the sentence, not as the name of a file.
README has 170 lines at most.
"""

import re
import sys
from pathlib import Path

SOURCE = Path(sys.argv[1])
LINK = re.compile(r"\]\(([^)\s]+)\)")
PAGE = re.compile(r"(?<![\w/.-])docs/[\w/.-]+\.md\b")
INDEX = Path("docs/README.md")
FAR = 2  # links from README to any page
TEXT = {".c", ".h", ".py", ".pyi", ".md", ".txt", ".cmake", ".sh", ".toml", ".def", ".in", ""}


def anchors(page):
    """The names by which the headings of a page can be linked to."""
    text = re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.M | re.S)
    return {
        re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
        for heading in re.findall(r"^#+ (.*)$", text, flags=re.M)
    }


def pages_linked(page):
    """The files of the tree that a page links to; of a folder its README."""
    found = set()
    for link in LINK.findall(page.read_text(encoding="utf-8")):
        to = (page.parent / link.partition("#")[0]).resolve()
        to = to / "README.md" if to.is_dir() else to
        if not re.match(r"[a-z]+:|#", link) and to.is_file():
            found.add(to)
    return found


def too_far(source):
    """The pages, and what a reader must find, that are more than FAR links from README."""
    reached = unread = {source.resolve() / "README.md"}
    for _ in range(FAR):
        found = set().union(*(pages_linked(page) for page in unread if page.suffix == ".md"))
        unread = found - reached
        reached = reached | found
    wanted = [source / name for name in ("LICENSE", "NOTICE", "CITATION.cff")]
    wanted += sorted(source.glob("docs/*/*.md"))
    return [
        str(page.relative_to(source))
        for page in wanted
        if page.is_file() and page.resolve() not in reached
    ]


skipped = {"build", "dist", ".git", "__pycache__", "node_modules"}
files = [
    path
    for path in sorted(SOURCE.rglob("*"))
    if path.is_file()
    and not any(
        part in skipped or part.startswith("build-") for part in path.relative_to(SOURCE).parts
    )
]
wrong, links = [], 0
for file in files:
    name = file.relative_to(SOURCE)
    if file.suffix == ".md":
        for link in LINK.findall(file.read_text(encoding="utf-8")):
            if re.match(r"[a-z]+:", link):
                continue
            links += 1
            path, _, anchor = link.partition("#")
            to = (file.parent / path).resolve() if path else file
            if not to.exists():
                wrong.append(f"{name}: no file {link}")
            elif anchor and anchor not in anchors(to):
                wrong.append(f"{name}: {path or name} has no heading #{anchor}")
    if file.suffix == ".md" and name.parts[0] == "docs":
        paragraphs = file.read_text(encoding="utf-8").strip().split("\n\n")
        first = paragraphs[1]
        about_itself = re.match(r"(With|On|From|In) this (page|guide)|This page", first)
        if about_itself or not re.match(r"[A-Z]\w* .*[.:]", first, flags=re.S):
            wrong.append(
                f"{name}: the first paragraph is no sentence that says what the page covers"
            )
        if name != INDEX and not re.match(r"Next: \[", paragraphs[-1]):
            wrong.append(f"{name}: the last paragraph does not say where to go next ('Next: [...')")
    if file.suffix in TEXT and name.name not in ("links.py", "CHANGELOG.md"):
        for page in PAGE.findall(file.read_text(encoding="utf-8", errors="replace")):
            if not (SOURCE / page).exists():
                wrong.append(f"{name}: no page {page}")
manuals = [SOURCE / name for name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md")]
manuals += sorted(SOURCE.glob("docs/*/*.md"))
# Of an installed documentation, which lacks CONTRIBUTING.md, the rest is read.
texts = {page: page.read_text(encoding="utf-8") for page in manuals if page.is_file()}
wrong += [
    f"{page.relative_to(SOURCE)}: the link {name} reads as a file name"
    for page, text in texts.items()
    for name in re.findall(r"\[\w+\.md\]\(", text)
]
wrong += [f"{page}: README reaches it by more than {FAR} links" for page in too_far(SOURCE)]
lines = (SOURCE / "README.md").read_text(encoding="utf-8").count("\n")
if lines > 170:
    wrong.append(f"README.md: {lines} lines; a newcomer reads 170 at most")
if wrong:
    sys.exit("\n".join(wrong))
assert links >= 50, links
print(f"{links} links in {len(files)} files")
