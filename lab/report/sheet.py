"""A measured CSV in memory: notes (lines "# what: text"), a header, rows.

These are the project's own files, one record a line. Whatever a file contains, reading it does not fail: a line that is no row
costs that line, and `problems` says so; a column that is not there or holds no number is named by Missing when somebody asks
for it. Rows are found by the values of columns through an index that is made once, so that work stays proportional to the rows.
"""

import csv
import math

CONTROLS = str.maketrans({character: "\ufffd" for character in [*range(9), *range(11, 32), 127, 0xFFFE, 0xFFFF]})  # no XML has them
NOT_FOR_GNUPLOT = str.maketrans({character: "?" for character in "'\"`\\$\t"})


class Missing(Exception):
    """What a table or a figure needs and does not have, as a sentence without its full stop."""


class Row:
    """One row: row["kernel"] is text, "" where there is no such column; row.number("steps") a float, NaN where it is none."""

    __slots__ = ("sheet", "fields")

    def __init__(self, sheet, fields):
        self.sheet = sheet
        self.fields = fields

    def __getitem__(self, name):
        place = self.sheet.places.get(name)
        return "" if place is None else self.fields[place]

    def number(self, name):
        return number_of(self[name])


def number_of(text):
    try:
        return float(text)
    except ValueError:
        return math.nan


class Sheet:
    """A CSV by the name of its file, "steps.csv". Without a file it has no header and no rows."""

    def __init__(self, name, path=None):
        self.name = name
        self.notes, self.header, self.rows, self.problems = [], [], [], []
        self.places, self.indices = {}, {}
        if path is not None and path.is_file():
            with open(path, encoding="utf-8-sig", errors="replace") as file:
                for number, line in enumerate(file, 1):
                    self.take(number, line.rstrip("\n").translate(CONTROLS))
            if not self.header:
                self.problems.append(f"{name} has no header")

    def take(self, number, line):
        if line.startswith("#"):
            what, colon, text = line[1:].strip().partition(": ")
            self.notes.append((what, text) if colon else ("", what))
        elif line:
            fields = fields_of(line)
            if not self.header:
                self.header = fields or []
                self.places = {name: place for place, name in reversed(list(enumerate(self.header)))}
            elif fields is not None and len(fields) == len(self.header):
                self.rows.append(Row(self, fields))
            else:
                found = "not CSV" if fields is None else f"{len(fields)} fields, but the header has {len(self.header)}"
                self.problems.append(f"{self.name}:{number}: {found}: the row is left out")

    def note(self, what):
        """The text of the first note of that name, or None."""
        return next((text for name, text in self.notes if name == what), None)

    def needs(self, *columns):
        """Raises Missing unless there are rows and all of these columns."""
        absent = [name for name in columns if name not in self.places]
        if not self.rows:
            raise Missing(f"there are no data in {self.name}")
        if absent:
            raise Missing(f"{self.name} has no column {' and no column '.join(absent)}")

    def needs_numbers(self, *columns):
        """Raises Missing unless each of these columns has a finite number in some row."""
        self.needs(*columns)
        for name in columns:
            if not any(math.isfinite(row.number(name)) for row in self.rows):
                raise Missing(f"{self.name} has no number in the column {name}")

    def groups(self, *columns):
        """{values of these columns: their rows}, both in the order of the file."""
        if columns not in self.indices:
            index = self.indices[columns] = {}
            for row in self.rows:
                index.setdefault(tuple(row[name] for name in columns), []).append(row)
        return self.indices[columns]

    def first(self, **wanted):
        """The first row with these values, or None."""
        rows = self.groups(*wanted).get(tuple(wanted.values()))
        return rows[0] if rows else None

    def write_for_gnuplot(self, path):
        """The rows that were taken, without what the scripts' shell and awk would take for more than a value."""
        with open(path, "w", encoding="utf-8") as file:
            for what, text in self.notes:
                print(f"# {what}: {text}" if what else f"# {text}", file=file)
            for fields in [self.header] + [row.fields for row in self.rows]:
                print(",".join(field.replace(",", ";").translate(NOT_FOR_GNUPLOT) for field in fields), file=file)


def fields_of(line):
    """The fields of one line; None where a quote is left open."""
    if '"' not in line:
        return line.split(",")
    try:
        return next(csv.reader([line], strict=True))
    except (csv.Error, StopIteration):
        return None
