"""tools/size [DIR]: how large each product is, in tokens of code and of tests. One number for the
whole is red above `most` of tools/products: whoever adds, cuts.

A token is a word, a number or one sign of punctuation. A comment counts nothing, a string of
characters two. Pygments finds comments and strings, in all languages. The files are those of git in
DIR (default: this tree), without data and pages; tools/products says whose a file is.
"""

import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

from pygments.lexers import BashLexer, PythonLexer, get_lexer_for_filename
from pygments.token import Comment, String
from pygments.util import ClassNotFound

NOT_CODE = "csv svg png expected jsonl json xz ipynb npy hex txt md".split()
TOKEN = re.compile(r"\w+|[^\w\s]")


def products():
    """(product, kind, pattern) of each row of tools/products; and the most tokens of all."""
    rows, most = [], 0
    for line in (Path(__file__).parent.parent / "products").read_text().splitlines():
        words = line.partition("#")[0].split()
        if words[:1] == ["most"]:
            most = int(words[1])
        elif words:
            kind, product, pattern = words
            rows.append((product, kind, re.compile(pattern)))
    return rows, most


def lexer_of(path, text):
    """By the name of the file, else by the first line of a script."""
    try:
        return get_lexer_for_filename(path.name)
    except ClassNotFound:
        if "python" in text.partition("\n")[0]:
            return PythonLexer()
        return BashLexer()


def tokens(path):
    """How many tokens a file has."""
    text = path.read_text(errors="replace")
    code, in_string = [], False
    for kind, piece in lexer_of(path, text).get_tokens(text):
        if kind in Comment and kind not in Comment.Preproc and kind not in Comment.PreprocFile:
            continue
        if kind in String.Doc:
            continue
        if kind in String:
            # The pieces of one string are one string.
            if not in_string:
                code.append('""')
            in_string = True
            continue
        in_string = False
        code.append(piece)
    return len(TOKEN.findall("".join(code)))


def main():
    if len(sys.argv) > 2 or sys.argv[1:2] == ["--help"]:
        sys.exit(__doc__)
    root = Path(sys.argv[1]) if len(sys.argv) == 2 else Path(__file__).resolve().parents[2]
    listing = subprocess.run(
        ["git", "-C", root, "ls-files"], check=True, capture_output=True, text=True
    )
    (rows, most), sizes = products(), Counter()
    for name in listing.stdout.splitlines():
        path = root / name
        if path.suffix[1:] in NOT_CODE or not path.is_file():
            continue
        for product, kind, pattern in rows:
            if pattern.search(name):
                sizes[product, kind] += tokens(path)
                break

    print(f"{'tokens':12} {'code':>9} {'tests':>9}")
    for product in dict.fromkeys(row[0] for row in rows):
        print(f"{product:12} {sizes[product, 'code']:9,} {sizes[product, 'tests']:9,}")
    code, tests = (
        sum(count for (_, kind), count in sizes.items() if kind == sort)
        for sort in ("code", "tests")
    )
    print(f"{'all':12} {code:9,} {tests:9,}   together {code + tests:,}, of at most {most:,}")
    if code + tests > most:
        sys.exit("too many tokens: cut as many as you add (tools/products has the number)")


if __name__ == "__main__":
    main()
