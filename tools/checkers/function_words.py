"""function_words.py [DIR]: names that are prepositions, adverbs or participles, such as `at`, `met`
or `kept`, where a name should be a noun of the field. Red from 5 in 1,000 names on, in C, in
TypeScript and in Python.

Every name in the code counts, each time that it is there; comments, strings and keywords do
not, nor do folders of tests. Nouns such as `first`, `last`, `found` and `left` are not in the list.
"""

import subprocess
import sys
from collections import Counter
from pathlib import Path

from pygments.lexers import CLexer, PythonLexer, TypeScriptLexer
from pygments.token import Name

MOST = 5.0  # in 1,000 names
WORDS = frozenset(
    [
        "after",
        "again",
        "all",
        "asked",
        "at",
        "bad",
        "before",
        "beside",
        "between",
        "by",
        "due",
        "from",
        "given",
        "here",
        "kept",
        "made",
        "may",
        "met",
        "near",
        "now",
        "of",
        "on",
        "one",
        "other",
        "own",
        "said",
        "since",
        "taken",
        "then",
        "there",
        "these",
        "those",
        "to",
        "told",
        "until",
        "wanted",
        "which",
        "who",
    ]
)
LANGUAGES = {
    "C": (CLexer, ("*.c", "*.h")),
    "TypeScript": (TypeScriptLexer, ("*.ts", "*.js", "*.mjs")),
    "Python": (PythonLexer, ("*.py",)),
}


def sources(root, patterns):
    """The files of git that are no tests."""
    names = subprocess.run(
        ["git", "ls-files", *patterns], cwd=root, capture_output=True, text=True, check=True
    ).stdout.splitlines()
    return [name for name in names if not {"test", "tests"} & {*Path(name).parts}]


def names_in(lexer, text):
    """The names in a text. An attribute of a module that is imported is a name like all others."""
    for kind, piece in lexer.get_tokens(text):
        if kind in Name:
            yield from piece.split(".")


def main(root):
    wrong = False
    for language, (lexer, patterns) in LANGUAGES.items():
        total, words, files = 0, Counter(), Counter()
        for name in sources(root, patterns):
            for word in names_in(lexer(), (root / name).read_text(errors="replace")):
                total += 1
                if word in WORDS:
                    words[word] += 1
                    files[name] += 1
        rate = 1000 * sum(words.values()) / max(total, 1)
        print(f"{language}: {rate:.1f} function words in 1,000 names")
        if rate >= MOST:
            wrong = True
            most = ", ".join(f"{word} {n}" for word, n in words.most_common(12))
            where = ", ".join(f"{name} {n}" for name, n in files.most_common(8))
            print(f"  must be below {MOST:g}: {most}; in {where}")
    return int(wrong)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
