"""rows.py SOURCE SHARED: the rows of numbers and words say what the headers and the library say.

Each member of a struct or an enumeration has a comment that is complete by itself, as editors of
other languages show it by itself: it does not continue that of the member before, and is not
continued. The comment of each member names the unit of its row, every number of its range, and its
default. bindings/rows.py has the texts and the ranges that the library tells. Each value of an
enumeration with words has one.
"""

import ctypes
import os
import re
import sys
from pathlib import Path

ROOT = Path(sys.argv[1])
sys.path.insert(0, str(ROOT / "bindings"))
from api import describe  # noqa: E402
from match import Python  # noqa: E402
from rows import digits, numbers, options, parts, python, rows, words  # noqa: E402

api = describe(ROOT / "core/include")
structs = {one["name"]: one["fields"] for one in api["structs"]}
constants = {one["name"]: one["value"] for one in api["constants"]}
OPTIONS = "carom_cushion_options"
faults = []

CONTINUES = r"(and|the same|these|those|of those|or|with|both|it|in the|instead|likewise)\b"
for of in api["structs"] + api["enums"]:
    for member in of.get("fields") or of["values"]:
        text = member["comment"]
        if not text or re.match(CONTINUES, text) or text.endswith((",", ";", ":")):
            faults.append(
                f"{of['name']}.{member['name']}: its comment does not stand alone: {text}"
            )


def comment(struct, name):
    return next(field["comment"] for field in structs[struct] if field["name"] == name)


def said_of(struct, number):
    text = comment(struct, number["name"])
    return f"{text} {comment(OPTIONS, number['name'])}" if OPTIONS in text else text


def compare(struct, one):
    """The unit, the range and the default of a row with the comment of its member."""
    text = said_of(struct, one)
    wanted = [digits(x) for x in one.get("ends", [])] + re.findall(
        r"\b0: (-?[\d.]+(?:e\d+)?)", one["text"]
    )
    named = re.sub(r"CAROM_\w+", lambda name: f"{constants.get(name[0], '')}", text)
    said = re.findall(r"-?\d[\d,]*(?:\.\d+)?(?:e-?\d+)?", named)
    said += [digits(float(value.replace(",", ""))) for value in said]
    faults.extend(
        f"{struct}.{one['name']}: its row has {value}, which its comment does not name: {text}"
        for value in wanted
        if value not in said
    )
    unit = next(field.get("unit", "") for field in structs[struct] if field["name"] == one["name"])
    if unit and unit != one["unit"]:
        faults.append(
            f"{struct}.{one['name']}: the unit is '{one['unit']}' in its row, '{unit}' in its comment"
        )
    if one["unit"] and not re.search(rf"\b{re.escape(one['unit'])}(?!\w)", text):
        faults.append(
            f"{struct}.{one['name']}: its comment does not name the unit {one['unit']}: {text}"
        )


described = numbers()
if [one["name"] for one in described] != [field["name"] for field in structs["carom_ball_kind"]]:
    faults.append("the rows are not in the order of carom_ball_kind")
own = [
    field["name"]
    for field in structs[OPTIONS]
    if field["type"] == "double" and field["name"] != "least_step"
]
if sorted(own) != sorted(one["name"] for one in described if one["of_cushion"]):
    faults.append("the rows of cushions are not the numbers of carom_cushion_options")
every = [
    (struct, one)
    for struct, several in {"carom_ball_kind": described, **parts(), **options()}.items()
    for one in several
]
for struct, one in every:
    compare(struct, one)


class Number(ctypes.Structure):
    _fields_ = [(name, ctypes.c_char_p) for name in ("name", "key", "unit", "text")]


library = ctypes.CDLL(sys.argv[2])
library.carom_number_of.restype = ctypes.POINTER(Number)
enums = {one["name"]: one["values"] for one in api["enums"]}

# The comment of each carom_part_kind that has numbers names its struct.
for part in enums["carom_part_kind"]:
    struct = (re.findall(r"carom_\w+", part["comment"]) or [None])[0]
    rows_of = (options() | parts() | {"carom_ball_kind": described}).get(struct, [])
    for k, one in enumerate(rows_of):
        told, room = library.carom_number_of(part["value"], k), ctypes.create_string_buffer(100)
        library.carom_number_range(told, room, ctypes.c_size_t(100))
        seen = (
            [
                value.decode()
                for value in (told[0].name, told[0].key, told[0].unit, told[0].text, room.value)
            ]
            if told
            else None
        )
        expected = [one[key] for key in ("name", "key", "unit", "text", "range")]
        if seen != expected:
            faults.append(f"the library tells {seen}, bindings/rows.py {expected}")
    if library.carom_number_of(part["value"], len(rows_of)):
        faults.append(f"{part['name']} has more than {len(rows_of)} numbers")

OF_GAMES = {row[0] for _, row in rows("../../games/rules/words.h", "CAROM_GAME_WORD_ROWS")}

# The comment of each carom_words names the enumeration whose values have words.
library.carom_word.restype = ctypes.c_char_p
for of in enums["carom_words"]:
    name = re.search(r"carom_\w+", of["comment"])[0]
    faults += [
        f"{value['name']} has no word"
        for value in enums[name]
        if value["value"] >= 0 and not library.carom_word(of["value"], value["value"])
    ]
    if of["name"].removeprefix("CAROM_WORDS_") in OF_GAMES:
        continue

    told = iter(range(1 if of["name"] == "CAROM_WORDS_EVENT" else 0, 100))
    expected = words()[of["name"].removeprefix("CAROM_WORDS_")]
    seen = [library.carom_word(of["value"], next(told)).decode() for _ in expected]
    if seen != [word for word, _ in expected]:
        faults.append(f"{of['name']}: the library tells {seen}, bindings/rows.py {expected}")

# The same of games: all values have words, which are the ends of their names, in the order of the
# rows.
for of in enums["carom_words"]:
    if of["name"].removeprefix("CAROM_WORDS_") not in OF_GAMES:
        continue
    values = enums[re.search(r"carom_\w+", of["comment"])[0]]
    ends = [word for word, _ in words()[of["name"].removeprefix("CAROM_WORDS_")]]
    seen = [library.carom_word(of["value"], value["value"]) for value in values]
    if [word and word.decode() for word in seen] != ends or not all(
        value["name"].lower().endswith(f"_{end}") for value, end in zip(values, ends)
    ):
        faults.append(f"{of['name']}: the library has {seen}, bindings/rows.py {ends}")

# What is made of the rows and of the headers, and kept.
package = ROOT / "python/src/carom"
for kept, text in (
    (package / "_described.py", python()),
    (package / "games/_described.py", Python(api).text()),
):
    if os.environ.get("UPDATE"):
        kept.write_text(text, encoding="utf-8")
    if not kept.exists() or kept.read_text(encoding="utf-8") != text:
        faults.append(f"{kept.relative_to(ROOT)} is not what is made of it; UPDATE=1 writes it")

print(
    "\n".join(faults)
    or f"{len(every)} numbers and options have the unit, range and default of their comments"
)
sys.exit(bool(faults))
