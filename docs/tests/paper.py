"""paper.py SOURCE BUILD: the paper of packaging/paper is complete: sections, length, pictures with
their commands, references cited and defined as `carom --cite` has them, figures as the pages have
them. Where pandoc is there, it builds.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE, CAROM = Path(sys.argv[1]).resolve(), Path(sys.argv[2], "carom")
FOLDER = SOURCE / "packaging/paper"
text = (FOLDER / "paper.md").read_text(encoding="utf-8")
_, body = text.split("---\n", 2)[1:]
wrong = [
    f"no section {name}"
    for name in ("Summary", "Statement of need", "State of the field", "References")
    if f"\n# {name}\n" not in body
]
words = len(re.sub(r"\[@[^]]*\]|!\[|\]\([^)]*\)", " ", body).split())
if not 750 <= words <= 1750:
    wrong.append(f"{words} words; the Journal of Open Source Software takes 750 to 1750")

# References, which the library has the same.
bib = (FOLDER / "paper.bib").read_text(encoding="utf-8")
entries = {
    key: whole for whole, key in re.findall(r"^(@\w+\{([\w-]+),\n.*?^\}$)", bib, flags=re.M | re.S)
}
cited = {
    key for group in re.findall(r"\[(@[^]]*)\]", body) for key in re.findall(r"@([\w-]+)", group)
}
wrong += [f"{key} is cited and not defined" for key in cited - entries.keys()] + [
    f"{key} is defined and not cited" for key in entries.keys() - cited
]
models = [["--cushion", model] for model in ("mathavan", "han", "smooth", "stronge")]
said = "".join(
    subprocess.run([CAROM, "--cite", *more], stdout=subprocess.PIPE, text=True, check=True).stdout
    for more in ([], *models, ["--world", "pooltool"])
)
own = {key: entry for key, entry in entries.items() if f"{{{key},\n" in said}
wrong += [f"{key} is not as carom --cite tells" for key, entry in own.items() if entry not in said]

# Each picture has a command, and each measured figure stands on a page.
pictures = re.findall(r"!\[(.*?)\]\(([^)]*)\)", body, flags=re.S)
wrong += [
    f"no picture {path}, or no command for it"
    for words_of, path in pictures
    if not (FOLDER / path).is_file() or "`carom" not in words_of
]
pages = "".join(
    path.read_text(encoding="utf-8")
    for path in [SOURCE / "README.md", *SOURCE.glob("docs/understanding/*.md")]
)
figures = re.findall(r"\d+(?:\.\d+)?(?:e-\d+)?(?= (?:ns|cm|%|values|of the fastest))", body)
wrong += [
    f"{figure} stands on no page"
    for figure in figures
    if not re.search(rf"(?<![\d.]){re.escape(figure)}(?![\d.]\d)", pages)
]
assert len(own) >= 8 and len(figures) >= 3 and pictures, (sorted(own), figures)
if shutil.which("pandoc"):
    with tempfile.TemporaryDirectory() as work:
        done = subprocess.run(
            ["pandoc", "--citeproc", "--standalone", "paper.md", "-o", f"{work}/paper.html"],
            cwd=FOLDER,
            stderr=subprocess.PIPE,
            text=True,
        )
        wrong += [f"pandoc: {done.stderr}"] if done.returncode or "not found" in done.stderr else []
else:
    print("skipped: not built, as there is no pandoc (Debian: pandoc)")
if wrong:
    sys.exit("\n".join(wrong))
print(f"{words} words, {len(entries)} references, {len(figures)} figures")
