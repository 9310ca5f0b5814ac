"""Every argument that is a name: a misspelt one is quoted and its correction suggested, and synonyms
of C's table mean the same everywhere.

The names are found by calling all public functions with good arguments and one misspelt name.
"""

import inspect
import re

import numpy as np
import pytest

import carom
import carom.fit
import carom.games.plans
import carom.games.pool
import carom.games.potting
import carom.games.rules
import carom.tracks
from carom._rows import named, worded
from carom._shot_options import ShotOptions

TABLE = carom.tables.pool_9ft()
PAIR = carom.balls([[0.6, 0.8], [0.75, 1.6]])
RACK = carom.racks.eightball(TABLE)
CUE = carom.cue()
SHOT = carom.simulate(TABLE, PAIR, CUE)
BATCH = carom.simulate_batch(TABLE, PAIR, carom.cue(speed=[1.0, 2.0]), room=64)
HIT = carom.impacts(v_a=(1.0, 0.0, 0.0), r_b=(0.05715, 0.0, 0.0))
WALL = carom.cushion_impacts(v=(0.0, 1.0, 0.0))
SHORT = {"shots": 100, "table": TABLE, "balls": RACK}
OF_SHOTS = {"table": TABLE, "balls": PAIR, "cue": CUE}

# The good arguments of each function, and those that are names with a good value of each.
OPTIONS = {
    "world": "pooltool",
    "ball_model": "exact",
    "cushion_model": "mathavan",
    "friction": "alciatore",
    "space": "flat",
    "simultaneous": "cluster",
    "stop_at": "pocket",
}
CALLS = [
    (carom.Options, {}, OPTIONS),
    (carom.simulate, OF_SHOTS, OPTIONS),
    (
        carom.simulate_batch,
        {"table": TABLE, "layouts": PAIR, "cues": CUE},
        {**OPTIONS, "records": "brief"},
    ),
    (carom.cite, {}, {"cushion_model": "mathavan"}),
    (carom.collide, {"impacts": HIT}, {"solver": "exact", "slip": "pooltool"}),
    (carom.trace, {"impact": HIT}, {"solver": "euler", "slip": "paper"}),
    (
        carom.cushion,
        {"impacts": WALL},
        {"model": "stronge", "convention": "pooltool", "law": "constant", "game": "snooker"},
    ),
    (carom.cushion_impacts, {"v": (0.0, 1.0, 0.0)}, {"game": "billiard", "model": "smooth"}),
    (
        carom.cushion_trace,
        {"impact": WALL},
        {"model": "mathavan", "convention": "paper", "law": "constant"},
    ),
    (carom.calibrate, {"readings": None}, {"game": "snooker"}),
    (
        carom.balls,
        {"r": [[0.5, 0.5]]},
        {"game": "snooker", "cushion_model": "smooth"},
    ),
    (carom.cue, {}, {"game": "billiard"}),
    (carom.racks.nineball, {"table": TABLE}, {"cushion_model": "smooth"}),
    (carom.tables.measures, {}, {"table": "pool_9ft"}),
    (
        carom.by_number,
        {"balls": PAIR, "ids": ["cue", "3"]},
        {"rules": "nineball"},
    ),
    (
        carom.jacobian,
        {"table": TABLE, "layouts": PAIR, "cues": CUE, "wrt": ["cue.phi"]},
        {"of": "reach"},
    ),
    (carom.aim, {**OF_SHOTS, "ball": 1}, {"pocket": "foot-right"}),
    (carom.player, {"fargo": 500}, {"rules": "snooker"}),
    (
        carom.plan,
        SHORT,
        {"rules": "eightball", "group": "stripes", "in_hand": "anywhere"},
    ),
    (
        carom.sequence,
        {**SHORT, "balls": PAIR, "rules": "potting", "plays": 1},
        {"rules": "potting", "in_hand": "kitchen"},
    ),
    (carom.chances, {**SHORT, "cues": CUE}, {"rules": "eightball", "group": "open"}),
    (carom.value, {"table": TABLE, "balls": RACK}, {"rules": "eightball", "group": "stripes"}),
    (
        carom.referee,
        {"table": TABLE, "balls": RACK, "cue": CUE},
        {"rules": "eightball", "group": "solids"},
    ),
    (carom.review, {"table": TABLE, "balls": RACK, "cue": CUE}, {"rules": "eightball"}),
    (
        carom.best_breaks,
        {"table": TABLE, "balls": carom.racks.nineball(TABLE), "breaks": 16, "best": 1},
        {"rack": "nineball"},
    ),
    (
        carom.breaks,
        {"rack": "nineball", "table": TABLE, "balls": carom.racks.nineball(TABLE), "racks": 2},
        {"rack": "nineball", "aim": "full"},
    ),
    (carom.odds, {"ratings": (500, 600)}, {"order": "winner"}),
    (carom.Match, {"table": TABLE}, {"rules": "nineball"}),
    (carom.Match, {"table": TABLE, "rules": "eightball", "balls": RACK}, {"hand": "anywhere"}),
    (carom.Goal, {}, {}),
    (carom.games.pool.Pool, {}, {"game": "eightball", "cushion_model": "smooth"}),
    (carom.games.potting.Potting, {}, {"ball_set": "snooker", "cushion_model": "smooth"}),
]
# Arguments whose types list names, but which no call above has: why.
ELSEWHERE = {
    ("resume", "stop_at"): "needs a stopped shot; the same lookup as simulate",
    ("simulate_arrow", "cushion_model"): "passes its keywords on to simulate_batch",
    ("balls", "conditions"): "a list, tested below",
    ("Goal", "kind"): "checked by plan, tested below",
    ("Ruling", "hand"): "a result",
    ("sequence", "group"): "the same lookup as plan",
    ("why", "group"): "the same lookup as plan",
    ("why", "rules"): "the same lookup as plan",
}


def misspelt(name):
    """The name with its last two letters exchanged, or one letter more."""
    turned = name[:-2] + name[-1] + name[-2]
    return turned if turned != name else name + "x"


ROWS = [
    pytest.param(function, good, name, value, id=f"{function.__name__}-{name}")
    for function, good, names in CALLS
    for name, value in names.items()
]


@pytest.mark.parametrize("function, good, name, value", ROWS)
def test_a_misspelt_name_is_quoted_and_corrected(function, good, name, value):
    wrong = misspelt(value)
    with pytest.raises((ValueError, TypeError)) as caught:
        function(**{**good, name: wrong})
    text = str(caught.value)
    assert re.match(rf"{name}\b", text) and repr(wrong) in text, text
    assert f"did you mean {value!r}?" in text and len(text) < 410, text


@pytest.mark.parametrize("function, good, name, value", ROWS)
def test_case_and_hyphens_of_a_name_do_not_matter(function, good, name, value):
    function(**{**good, name: value})
    other = value.replace("_", "-").upper()
    if name not in ("of", "table") or "." not in value:
        function(**{**good, name: other})


def public():
    """The public functions and classes of the package, with their parameters."""
    for name in dir(carom):
        value = getattr(carom, name)
        if callable(value) and not (inspect.isclass(value) and issubclass(value, BaseException)):
            try:
                yield name, value, inspect.signature(value)
            except ValueError:
                continue


def test_no_function_with_names_is_missing():
    """A parameter whose type is one of the literal types of names is tested here."""
    literal = re.compile(
        r"\b(Game|Rules|Group|Hand|World|BallModel|ShotCushion|CushionModel|CushionConvention|"
        r"CushionLaw|Solver|Slip|Space|Simultaneous|StopAt|Condition|GoalKind|Literal)\b"
    )
    tested = {(function, name) for function, _, names in CALLS for name in names}
    missing = [
        (name, parameter.name)
        for name, value, signature in public()
        for parameter in signature.parameters.values()
        if literal.search(str(parameter.annotation))
        and parameter.name not in ("changes", "balls", "state", "seats")
        and (value, parameter.name) not in tested
        and (name, parameter.name) not in ELSEWHERE
        and not (
            inspect.isclass(value) and hasattr(value, "_fields") and value is not carom.Options
        )
    ]
    assert missing == []
    assert set(ShotOptions._fields) >= set(OPTIONS)


@pytest.mark.parametrize(
    "call, quoted, right",
    [
        (lambda: carom.balls([[0.5, 0.5]], conditions=["fast_clot"]), "fast_clot", "fast_cloth"),
        (lambda: carom.balls([[0.5, 0.5]], radus=0.03), "radus", "radius"),
        (
            lambda: carom.simulate(TABLE, PAIR, CUE, cushon_model="han"),
            "cushon_model",
            "cushion_model",
        ),
        (lambda: carom.simulate("9-foot", PAIR, CUE), "9-foot", "carom.tables.pool_9ft()"),
        (lambda: carom.cushion(WALL, omega_rato=1.5), "omega_rato", "omega_ratio"),
        (lambda: carom.tables.pool_9ft(corne=0.1), "corne", "corner"),
        (lambda: TABLE.changed(widht=1.0), "widht", "width"),
        (lambda: carom.tangents(SHOT, ["cue.phy"]), "cue.phy", "cue.phi"),
        (
            lambda: carom.tangents(BATCH, ["balls[1].knd.mass"]),
            "balls[1].knd.mass",
            "balls[1].kind.mass",
        ),
        (lambda: carom.aim(TABLE, PAIR, CUE, ball=1, pocket=0, via=["lft"]), "lft", "left"),
        (
            lambda: carom.plan(TABLE, RACK, goal=carom.Goal("neer"), shots=100),
            "neer",
            "near",
        ),
        (lambda: carom.plan(TABLE, RACK, state={"scre": (1, 2)}, shots=100), "scre", "score"),
        (lambda: carom.Match("nineball", TABLE, limits={"sped": 1}), "sped", "speed"),
        (lambda: carom.Match("nineball", TABLE, seats=[{"nam": "A"}, {}]), "nam", "name"),
        (lambda: carom.tables.measures("snoker"), "snoker", "snooker"),
        (lambda: carom.tracks.read("none.csv", unit="mmm"), "mmm", "mm"),
    ],
)
def test_names_in_lists_mappings_and_keywords(call, quoted, right):
    with pytest.raises((ValueError, TypeError)) as caught:
        call()
    assert repr(quoted) in str(caught.value) and right in str(caught.value)


def test_an_index_beyond_the_last_is_quoted_with_the_valid_ones():
    with pytest.raises(ValueError, match="^ball: there is no ball 2; use 0 to 1$"):
        carom.aim(TABLE, PAIR, CUE, ball=2, pocket=0)
    with pytest.raises(ValueError, match="^pocket: there is no pocket 6; use 0 to 5$"):
        carom.aim(TABLE, PAIR, CUE, ball=1, pocket=6)


def test_synonyms_mean_the_same_as_in_the_command():
    assert carom.Match("9-ball", TABLE).rules == carom.Match("nineball", TABLE).rules == "nineball"
    for rules in ("8ball", "8-ball", "Eight-ball"):
        assert carom.plan(TABLE, RACK, rules=rules, shots=100)["value"].size
    aimed = [
        carom.aim(TABLE, PAIR, CUE, ball=1, pocket=name) for name in ("top-right", "foot-right")
    ]
    assert aimed[0].phi == aimed[1].phi
    assert carom.tables.measures("9-foot") == carom.tables.measures("pool_9ft")
    assert carom.player(rating=600) == carom.player(fargo=600)
    assert named(worded("RACK"), "BILLIARDS", "rack") == "billiards"  # a synonym of another one
    with pytest.raises(ValueError, match="^fargo, rating: "):
        carom.player(fargo=600, rating=600)


def test_each_rack_has_the_balls_of_its_game_for_any_cushion():
    """A rack's game is known to C: another model of cushions does not change the size of its balls."""
    for name in worded("RACK"):
        make = getattr(carom.racks, name)
        for table in (TABLE, carom.tables.snooker(), carom.tables.threecushion()):
            try:
                usual = make(table)
                break
            except carom.CaromError:
                continue
        other = make(table, cushion_model="mathavan")
        np.testing.assert_array_equal(usual["kind"]["radius"], other["kind"]["radius"])
