"""The rows of core/src/schema as data: what the library says of itself at run time, for what is needed
before it runs.

rows.py json      numbers of a ball, options and words, as carom_number_of() and carom_word() tell
                  them
rows.py python    python/src/carom/_described.py
"""

import json
import re
import sys
import textwrap
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent / "core/src"


def arguments(text):
    """The arguments of a call of a macro, of which `text` begins behind the bracket; and where it
    ends.
    """
    found, begin, depth, position = [], 0, 0, 0
    for match in re.finditer(r'"(?:[^"\\]|\\.)*"|[(),]', text):
        position, sign = match.start(), match[0]
        if sign == "(":
            depth += 1
        elif depth == 0 and sign in ",)":
            found.append(" ".join(text[begin:position].split()))
            begin = position + 1
        if sign == ")":
            if depth == 0:
                break
            depth -= 1
    return found, position + 1


def rows(file, macro):
    """The rows of a macro of rows: the name of each call, and its arguments."""
    text = (SOURCE / file).read_text(encoding="utf-8")
    head = re.search(rf"#define {macro}\(([^)]*)\)((?:.*\\\n)*.*)\n", text)
    body, calls = head[2].replace("\\\n", "\n"), head[1].replace(" ", "").split(",")
    body = re.sub(
        r"\bCAROM_\w+_OPTIONS\(\w+\)",
        lambda call_match: "".join(
            f"{calls[0]}({', '.join(row)})"
            for _, row in rows(file, call_match[0][: -len(calls[0]) - 2])
        ),
        body,
    )
    call_of, found, position = re.compile(rf"\b({'|'.join(calls)})\("), [], 0
    while call := call_of.search(body, position):
        values, size = arguments(body[call.end() :])
        found.append((call[1], values))
        position = call.end() + size
    return found


def text_of(value):
    return "".join(re.findall(r'"((?:[^"\\]|\\.)*)"', value))


def end_of(value):
    """A number of a row, None for one that is not there; and whether it belongs to the range."""
    inner = re.fullmatch(r"CAROM_(?:ABOVE|BELOW)\((.*)\)", value)
    number = {"DBL_MAX": None, "-DBL_MAX": None, "NAN": None}.get(
        value, inner[1] if inner else value
    )
    return (None if number is None else float(number)), inner is None


def ends_of(*values):
    """The numbers that a range names."""
    return [x for x, _ in map(end_of, values) if x is not None]


def digits(x):
    """A number as 0, 0.5, 1e6 or 1e-12."""
    return re.sub(r"e\+?(-?)0*", r"e\1", f"{x:.0e}" if abs(x) >= 1e5 else f"{x:g}")


def range_of(unit, low, high, alternative):
    """A range as carom_number_range() writes it."""
    (low, from_), (high, is_end_open), (alternative, _) = (
        end_of(low),
        end_of(high),
        end_of(alternative),
    )
    begin = "" if alternative is None else f"{digits(alternative)}, or "
    if low is None:
        words = "finite" if high is None else f"at most {digits(high)}"
    elif high is None:
        words = f"{digits(low)} or more and finite" if from_ else f"above {digits(low)} and finite"
    elif from_ and is_end_open:
        words = f"{digits(low)} to {digits(high)}"
    elif not from_ and not is_end_open:
        words = f"between {digits(low)} and {digits(high)}"
    else:
        words = (
            f"above {digits(low)} and at most {digits(high)}"
            if is_end_open
            else f"{digits(low)} or more and below {digits(high)}"
        )
    return begin + words + (f", in {unit}" if unit else "")


def numbers():
    """The numbers of a ball, in the order of carom_ball_kind."""
    found = []
    for kind, (name, key, unit, low, high, alternative, error, reader, text) in rows(
        "schema/numbers.h", "CAROM_NUMBERS"
    ):
        found.append(
            {
                "name": name,
                "key": text_of(key),
                "unit": text_of(unit),
                "range": range_of(text_of(unit), low, high, alternative),
                "ends": ends_of(low, high, alternative),
                "error": f"CAROM_ERROR_{error}",
                "reader": reader,
                "of_cushion": kind == "CUSHION",
                "text": text_of(text),
            }
        )
    return found


def words():
    """The words of each enumeration, (word, text), by the names of carom_words."""
    found = {}
    for file, macro in (
        ("schema/words.h", "CAROM_WORD_ROWS"),
        ("../../games/rules/words.h", "CAROM_GAME_WORD_ROWS"),
    ):
        for _, (word_set, _value, word, text) in rows(file, macro):
            found.setdefault(word_set, []).append((text_of(word), text_of(text)))
    models = [
        (text_of(row[1]), text_of(row[-1]))
        for _, row in rows("cushion/list.h", "CAROM_CUSHION_MODELS")
    ]
    found["CUSHION_MODEL"] = models
    found["SHOT_CUSHION"] += models
    found["RULES"] = [
        (text_of(row[2]), text_of(row[3]))
        for _, row in rows("../../games/rules/games.h", "CAROM_GAMES")
    ]
    found["BALL_FRICTION"] = [
        (text_of(row[1]), text_of(row[-1]))
        for _, row in rows("friction/laws.h", "CAROM_FRICTION_LAWS")
    ]
    return found


def parts():
    """The numbers of cue, table, its parts and measures, and states, as numbers() has those of
    balls, by the names of their structs.
    """
    found = {}
    for struct in ("cue", "table", "rail", "jaw", "pocket", "ball_state", "measures"):
        found[f"carom_{struct}"] = [
            {
                "name": name,
                "key": text_of(key),
                "unit": text_of(unit),
                "range": range_of(
                    text_of(unit), low, high.replace("CAROM_BALLS_MOST - 1", "31"), alternative
                ),
                "ends": ends_of(low, high, alternative) if kind == "ROW" else [],
                "error": f"CAROM_ERROR_{error}",
                "text": text_of(text),
            }
            for kind, (name, key, unit, low, high, alternative, error, text) in rows(
                "schema/numbers.h", f"CAROM_{struct.removeprefix('ball_').upper()}_NUMBERS"
            )
        ]
    return found


def games():
    """What each game of words()["RULES"] has: its balls, table and rack, the highest number of a ball,
    where the cue ball is at first, whether a call is made, the members of its state.
    """
    named = {row[1]: text_of(row[2]) for _, row in rows("schema/words.h", "CAROM_WORD_ROWS")}
    return {
        text_of(word): {
            "balls": named[f"GAME_{balls}"],
            "rack": named[f"RACK_{rack}"],
            "last": int(last),
            "table": named[f"TABLE_{table}"],
            "opening": opening.lower(),
            "calls": calls != "0",
            "members": members.lower().split(" | "),
        }
        for _, (
            _name,
            _rules,
            word,
            _text,
            balls,
            table,
            rack,
            last,
            opening,
            _hand,
            calls,
            members,
            _may,
        ) in rows("../../games/rules/games.h", "CAROM_GAMES")
    }


STRUCTS = {
    "MOTION": "carom_shot_options",
    "STOP": "carom_shot_options",
    "COMPUTE": "carom_shot_options",
    "IMPACT": "carom_options",
    "RAIL": "carom_cushion_options",
    "PLAN": "carom_plan_options",
}


def options():
    """The options of each struct, in the order of carom_number_of(), by its name.

    `form` is words, count, flag, seed, number or set; `words` the name in words() of an enumeration
    or a set; `group` motion, stop or compute.
    """
    found = {}
    for group, struct in STRUCTS.items():
        for _, (name, key, form, low, high, error, text, *_place) in rows(
            "../../games/search/plan_options.h" if group == "PLAN" else "schema/options.h",
            f"CAROM_{group}_OPTIONS",
        ):
            kind, word_set = re.fullmatch(r"(\w+)(?:\((.*)\))?", form).groups()
            words_of, unit = (
                (word_set if kind in ("WORDS", "SET") and word_set != "BALLS" else None),
                text_of(word_set or ""),
            )
            if kind == "WORDS":
                several = [word for word, _ in words()[word_set]]
                range_ = " or ".join([", ".join(several[:-1]), several[-1]])
            elif kind in ("SET", "SEED"):
                range_ = f"a set of bits 0 to {63 if high == 'UINT64_MAX' else int(high).bit_length() - 1}"
            elif high == "INT32_MAX":
                range_ = f"{low} or more"
            else:
                range_ = range_of(
                    unit,
                    low,
                    high,
                    "0" if end_of(low)[0] is not None and end_of(low)[0] > 0 else "NAN",
                )
            found.setdefault(struct, []).append(
                {
                    "name": name,
                    "key": text_of(key),
                    "form": kind.lower(),
                    "words": words_of,
                    "unit": unit,
                    "range": range_,
                    "ends": ends_of(low, high)
                    if kind in ("COUNT", "NUMBER") and high != "INT32_MAX"
                    else [],
                    "error": f"CAROM_ERROR_{error}",
                    "group": group.lower() if group in ("STOP", "COMPUTE") else "motion",
                    "text": text_of(text),
                }
            )
    return found


OF_PYTHON = [
    "WORLD",
    "BALL_MODEL",
    "SHOT_CUSHION",
    "BALL_FRICTION",
    "SPACE",
    "SIMULTANEOUS",
    "CUSHION_MODEL",
    "CUSHION_CONVENTION",
    "CUSHION_LAW",
    "GAME",
    "SOLVER",
    "SLIP",
    "RULES",
    "CONDITION",
    "TURN",
    "LEAVE",
    "CHOICE",
    "PHASE",
    "GOAL",
]
# Options of shots that Python has in another form: their types, defaults, texts.
OWN = [
    (
        "t_final",
        "float | None",
        "None",
        "The shot stops at exactly this time, s, with the status STOPPED_AT_TIME if balls still move. Without it a shot that "
        "lasts longer than 1000 s is an error.",
    ),
    (
        "stop_at",
        "StopAt | Iterable[StopAt]",
        "()",
        'The shot stops after the first event of these kinds, with the status STOPPED_AT_EVENT: "contact", of the '
        'cue ball with another, or a `carom.EventType` in lower case, such as "pocket". `carom.resume` continues a stopped shot.',
    ),
    (
        "first_of",
        "int | Iterable[int]",
        "()",
        "Indices of balls. The shot stops right after the first contact of the cue ball with another ball, with the "
        "status STOPPED_AT_EVENT, unless that ball is one of these. (): it does not stop.",
    ),
]


def name_of(words_of):
    """The type of words in Python: BallModel."""
    return "".join(part.capitalize() for part in words_of.split("_"))


def shot_options():
    """The options of shots in Python, (name, type, default, text, enumeration or bound): models,
    then counts, then its own.
    """
    chosen_options = [
        option
        for option in options()["carom_shot_options"]
        if option["form"] in ("words", "count", "flag") and option["name"] != "threads"
    ]
    chosen_options.sort(
        key=lambda option: (
            option["form"] == "flag",
            option["group"] == "stop",
            option["form"] == "count",
            option["name"] if option["form"] == "count" else "",
        )
    )
    for option in chosen_options:
        if option["form"] == "words":
            yield (
                option["name"],
                name_of(option["words"]),
                json.dumps(words()[option["words"]][0][0]),
                option["text"],
                option["words"],
            )
        else:
            yield (
                option["name"],
                "bool" if option["form"] == "flag" else "int",
                "False" if option["form"] == "flag" else "0",
                option["text"],
                int(most[1])
                if (most := re.fullmatch(r"0 to (\d+)", option["range"]))
                else 2**31 - 1,
            )
    for option in OWN:
        yield *option, None


def wrapped(text, indent, width=140):
    """Lines of a text."""
    return textwrap.wrap(text, width, initial_indent=indent, subsequent_indent=indent)


HEAD = '''"""Names and parameters of the library. Written by bindings/rows.py: UPDATE=1 ctest -R bindings/rows."""

from __future__ import annotations

import enum
from collections.abc import Iterable
from typing import Literal, NamedTuple, TypedDict

import numpy.typing as npt
'''
EVENTS = '''

class {}(enum.IntEnum):
    """{}"""
'''
OPTIONS = '''

class ShotOptions(NamedTuple):
    """Options of a shot. `carom.simulate` accepts them as keywords, as an object of this class, or both.

    Attributes
    ----------'''
CHANGES = '''

class Changes(TypedDict, total=False):
    """Options as keywords."""
'''
KINDS = """

# The options that are names, with their enumerations, and the largest values of the integers.
WORDS = {"""
CUSHIONS = '''

class CushionNumbers(TypedDict, total=False):
    """Parameters of an impact on a cushion, with the models that use them."""
'''
BALLS = '''

class BallNumbers(TypedDict, total=False):
    """Properties of a ball and its cushions, the fields of `carom.dtypes.ball_kind`."""
'''


def quoted(several):
    return ", ".join(map(json.dumps, several))


def python_event_types():
    """Labels and types of events as enumerations, and the literal type of the latter."""
    every_word = [row for _, row in rows("schema/words.h", "CAROM_WORD_ROWS")]
    lines = []
    for name, word_set, text in (
        ("Label", "LABEL", "The motion of a ball."),
        ("EventType", "EVENT", "The type of an event, of ball a with ball, rail, jaw or pocket b."),
    ):
        values = [row[1].partition("_")[2] for row in every_word if row[0] == word_set]
        lines.append(EVENTS.format(name, text))
        lines += [f"    {value} = {k}" for k, value in enumerate(values, word_set == "EVENT")]
    events = quoted(["contact", *map(str.lower, values)])
    return ["StopAt = Literal[", *wrapped(f"{events},", "    "), "]  # fmt: skip", *lines]


def python():
    """Types for checkers of types, which know nothing of the library: words, and the numbers of one
    impact on a cushion.
    """
    lines, chosen = [HEAD], list(shot_options())
    for word_set in OF_PYTHON:
        lines.append(
            f"{name_of(word_set)} = Literal[{quoted(word for word, _ in words()[word_set])}]"
        )
    lines += [*python_event_types(), OPTIONS]
    for name, kind, _, text, word_set in chosen:
        several = (
            f"{{{quoted(word for word, _ in words()[word_set])}}}" if word_set in words() else kind
        )
        lines += [f"    {name} : {several}", *wrapped(text[0].upper() + text[1:], "        ")]
    lines += ['    """', ""]
    lines += [f"    {name}: {kind} = {default}" for name, kind, default, *_ in chosen]
    lines += [CHANGES, *(f"    {name}: {kind}" for name, kind, *_ in chosen), KINDS]
    kinds = ", ".join(
        f'"{name}": "{word_set}"' for name, *_, word_set in chosen if word_set in words()
    )
    counts = ", ".join(
        f'"{name}": {word_set}' for name, *_, word_set in chosen if isinstance(word_set, int)
    )
    lines += [*wrapped(f"{kinds},", "    "), "}  # fmt: skip", f"COUNTS = {{{counts}}}", CUSHIONS]
    for option in numbers():
        if option["of_cushion"]:
            reader = re.match(r"(?:BY_CUSHION|WITH)\((\w+)", option["reader"])
            model = reader[1].lower() if reader else "any model"
            lines.append(f"    {option['name']}: float")
            lines.append(f'    """{model}: {option["text"]}; {option["range"]}"""')
    lines.append(BALLS)
    for option in numbers():
        lines.append(f"    {option['name']}: npt.ArrayLike | None")
        lines.append(f'    """{option["text"]}; {option["range"]}"""')
    return "\n".join([*lines, ""])


if __name__ == "__main__":
    outputs = {
        "json": lambda: json.dumps(
            {
                "numbers": numbers(),
                "options": options(),
                "parts": parts(),
                "words": words(),
                "games": games(),
            },
            indent=1,
        )
        + "\n",
        "python": python,
    }
    sys.stdout.write(outputs[sys.argv[1]]())
