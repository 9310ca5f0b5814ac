"""What the tests of the report share: making one from the stored run, and reading the page it makes."""

import os
import subprocess
import sys
import xml.etree.ElementTree as tree
from collections import Counter
from pathlib import Path

import pytest

STORED = Path(__file__).resolve().parent
ROOT = STORED.parent.parent
sys.path.insert(0, str(ROOT))


class Made:
    """One run of the report: what it said, its exit code, and the folder that it wrote."""

    def __init__(self, folder, *words, **more):
        self.folder = folder
        command = [sys.executable, "-m", "lab.report", *map(str, words), str(folder)]
        environment = {**os.environ, "PYTHONPATH": str(ROOT), **more}
        done = subprocess.run(command, capture_output=True, text=True, env=environment, cwd=folder.parent)
        self.code, self.out, self.complaints = done.returncode, done.stdout, done.stderr

    @property
    def page(self):
        return (self.folder / "index.html").read_text(encoding="utf-8")

    @property
    def elements(self):
        """The page's elements; it is well-formed XML or this fails."""
        page = tree.fromstring(self.page)
        twice = [name for name, count in Counter(e.get("id") for e in page.iter() if e.get("id")).items() if count > 1]
        assert twice == []
        return list(page.iter())

    def ids(self, *tags):
        return [e.get("id") for e in self.elements if e.tag in tags and e.get("id")]

    def missing(self):
        """What stands in the places of figures and tables that could not be made."""
        return ["".join(e.itertext()).strip() for e in self.elements if e.tag == "p" and e.get("class") == "missing"]

    def table(self, name):
        """The rows of the table under the heading of that name, as texts."""
        elements = self.elements
        place = next(k for k, e in enumerate(elements) if e.get("id") == f"table-{name}")
        table = next(e for e in elements[place:] if e.tag == "table")
        return [["".join(cell.itertext()) for cell in row] for row in table.iter("tr")]


@pytest.fixture
def make(tmp_path):
    """make("one", "--from", FOLDER, PATH="/nowhere") makes a report in the folder `one`."""
    return lambda name, *words, **more: Made(tmp_path / name, *words, **more)


@pytest.fixture
def stored(make):
    return make("stored", "--from", STORED)
