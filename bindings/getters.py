"""How a match stands, said once for all languages: the getters of its class, and what each reads."""

from typing import NamedTuple

# The name of a getter, the member of carom_match that it reads, the form of its result, and its
# description where the comment of the member says something else. A language makes the forms for
# which it has a template:
#   index   a ball, a seat or a side
#   seat    a seat, or none: the member is -1
#   count   how many there are of something
#   word    a value of the enumeration that the comment of the member names
#   words   several of its values, of which the member is the sum
#   balls   a set of balls: the member has bit k for ball k
#   side    a side, or none: the member is 1 + the side, 0 or CAROM_DRAWN
#   drawn   whether that member is CAROM_DRAWN
#   struct  a copy of a struct
ROWS = [
    ("phase", "phase", "word", ""),
    ("side", "record.side", "index", "The side at the table."),
    ("seat", "seat", "index", ""),
    ("actor", "record.actor", "seat", "The seat that acted last."),
    ("winner", "winner", "side", "The side that has won."),
    ("drawn", "winner", "drawn", "Whether the match is over without a winner."),
    ("shots", "record.shots", "count", ""),
    ("may", "may", "words", ""),
    ("cue_ball", "cue_ball", "index", ""),
    ("cue", "cue", "struct", ""),
    ("on", "on", "balls", ""),
    ("touching", "touching", "balls", ""),
]


class Getter(NamedTuple):
    """A getter of a match."""

    name: str
    path: list[str]  # the members that lead to the value: ["record", "side"]
    field: dict  # the last of them, as api.py describes it
    form: str
    type: str  # of the value, or the enumeration that its comment names
    comment: str


def getters(api):
    """The getters of a match. A row of a member that is not there ends the program."""
    structs = {entry["name"]: entry["fields"] for entry in api["structs"]}
    enums = {entry["name"] for entry in api["enums"]}
    for name, member, form, text in ROWS:
        field = {"type": "carom_match"}
        for part in member.split("."):
            fields = structs.get(field["type"], [])
            field = next((one for one in fields if one["name"] == part), None)
            if field is None:
                raise SystemExit(f"bindings/getters.py: {name}: carom_match has no {member}")
        words = (word.strip(".,:;()") for word in field["comment"].split())
        named = next((word for word in words if word in enums), "")
        type_ = named if form.startswith("word") else field["type"]
        yield Getter(name, member.split("."), field, form, type_, text or field["comment"])
