"""Each bad argument has its error: of the right kind, beginning with the argument's name, and
saying what would be right.
"""

import enum
import re
import warnings
from typing import get_args

import numpy as np
import pytest
from conftest import refused, refused_by_name
from numpy import inf, nan  # noqa: F401

import carom
import carom.record
from carom._carom import ffi, lib
from carom._described import ShotCushion

TABLE = carom.tables.pool_9ft()
RACK, CUE = carom.racks.nineball(TABLE), carom.cue()
GOOD = carom.impacts(v_a=(1.0, 0.0, 0.0), r_b=(0.05715, 0.0, 0.0))
WALL = carom.cushion_impacts(v=(0.0, 1.0, 0.0))
ROWS = np.tile(carom.dtypes.plain(GOOD), (4, 1))
POCKETED = RACK.copy()
POCKETED["state"]["label"][3] = carom.Label.POCKETED
MASKED = np.ma.masked_array(ROWS, mask=np.zeros_like(ROWS, bool))


def changed_cue(**fields):
    """A cue whose numbers were changed after it was made."""
    cue = carom.cue()
    for name, value in fields.items():
        cue[name] = value
    return cue


def shot(**fields):
    return carom.simulate(TABLE, POCKETED, changed_cue(**fields))


def balls(**fields):
    return carom.simulate(TABLE, carom.balls(**{"r": [[0.5, 0.5], [0.7, 0.5]], **fields}), CUE)


def unknown_motion():
    layout = RACK.copy()
    layout["state"]["v"][1] = 0.0, np.nan, 0.0
    return layout


def billiard(**fields):
    return carom.simulate(
        carom.tables.threecushion(), carom.balls([[0.7, 1.0]], game="billiard", **fields)
    )


def spoiled():
    table = carom.tables.pool_9ft()
    rails = table.rails.copy()
    rails["restitution"][3] = np.nan
    return table.changed(rails=rails)


def rows_of(part):
    """The numbers of a part: name, range, error."""
    k, text = 0, ffi.new("char[]", 100)
    while (row := lib.carom_number_of(part, k)) != ffi.NULL:
        lib.carom_number_range(row, text, 100)
        yield ffi.string(row.name).decode(), re.escape(ffi.string(text).decode()), row.error
        k += 1


def numbers_in_error():
    """Refusals by the ranges in the library, in the form of the rows of test_messages.txt."""
    for name, allowed, error in rows_of(lib.CAROM_PART_CUE):
        for value in ("99", "-1") if name == "ball" else ("nan", "inf", "-2000000000.0"):
            message = rf"cue\.{name} = {value}: it must be {allowed}$"
            if (name, value) != ("theta", "nan"):
                yield f"carom.cue({name}={value})", "CaromError", message
            if error not in (0, lib.CAROM_ERROR_MISCUE) and value in ("99", "-1", "nan"):
                yield f"shot({name}={value})", "CaromError", message
    for name, allowed, _ in rows_of(lib.CAROM_PART_BALL):
        message = rf"balls\[1\]\.kind\.{name} = nan: it must be {allowed}$"
        call = f"balls({name}=[RACK[0]['kind']['{name}'], nan])"
        yield call, "CaromError", message


def test_message(refusal):
    refused(refusal, globals())


@pytest.mark.parametrize("refusal", list(numbers_in_error()), ids=lambda row: row[0])
def test_number_in_error(refusal):
    refused(refusal, globals())


def test_what_is_wrong_is_refused_when_it_is_made():
    # of many layouts a wrong one costs its own shot
    layouts = carom.balls([[[0.6, 0.8]], [[np.nan, 0.8]]])
    assert carom.simulate_batch(TABLE, layouts, CUE).refused.tolist() == [False, True]
    for wrong in ({"cushion_model": "hann"}, {"steps": -1}, {"t_final": -1.0}, {"first_of": 99}):
        (name,) = wrong
        with pytest.raises(ValueError, match=f"^{name}: "):
            carom.Options(**wrong)


def test_a_generator_is_a_seed():
    """It draws a seed, so that each call has another, and the same generator gives the same."""

    def racks(generator):
        return [carom.racks.nineball(TABLE, seed=generator).tobytes() for _ in range(2)]

    first, second = (racks(np.random.default_rng(5)) for _ in range(2))
    assert first == second and first[0] != first[1]


SHOT, BATCH = (
    carom.simulate(TABLE, RACK, CUE),
    carom.simulate_batch(TABLE, RACK, carom.cue(speed=[1.0, 2.0])),
)
STOPPED, PAIR = (
    carom.simulate(TABLE, RACK, CUE, t_final=0.1),
    carom.balls([[0.6, 0.8], [0.75, 1.6]]),
)
CORNERS = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]


def test_a_value_of_another_kind_is_refused_by_the_name_of_its_argument(argument_row):
    refused_by_name(argument_row, globals())


PRIVATE = re.compile(r"(?<![\w.])_[a-z]\w*|\._[a-z]\w*|ShotOptions")


def test_errors_name_public_names():
    """Of a misspelt argument, by each call and class of the package."""
    for module in (carom, carom.racks, carom.tables, carom.dtypes, carom.record, carom.derivatives):
        for call in (
            getattr(module, name, None) for name in dir(module)
        ):  # without the folders, of the core
            if callable(call) and not isinstance(call, enum.EnumMeta):
                with pytest.raises(TypeError) as caught:
                    call(misspelt=1)
                assert not PRIVATE.search(str(caught.value)), str(caught.value)
    for about in (carom.simulate, carom.tangents, carom.Options, carom.Shot, carom.Shots):
        assert not PRIVATE.search(about.__doc__), about


@pytest.mark.parametrize("play", [carom.simulate, carom.simulate_batch])
def test_balls_of_another_game_than_the_table_are_doubted(play):
    tables = {
        "snooker": carom.tables.snooker(),
        "billiard": carom.tables.threecushion(),
        "blackball": carom.tables.blackball(),
        "pyramid": carom.tables.pyramid(corner=0.073),
        "pool": TABLE,
        "snooker, by its number": carom.tables.polygon(CORNERS, ball_radius=0.02625),
    }
    for made_for, table in tables.items():
        for game in ("pool", "snooker", "billiard", "blackball", "pyramid"):
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                play(table, carom.balls([[0.5, 0.5]], game=game))
            doubt = f"balls: they are of {game}, .* made for those of {made_for.partition(',')[0]}"
            assert len(caught) == (not made_for.startswith(game)) and all(
                re.match(doubt, str(warning.message)) for warning in caught
            )
    for game in ("pool", "fourball"):  # tables of one size
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            play(carom.tables.fourball(), carom.balls([[0.5, 0.5]], game=game))


def test_a_model_of_the_cushion_has_its_own_constants_or_says_that_it_has_none():
    tables = {
        "pool": TABLE,
        "snooker": carom.tables.snooker(),
        "billiard": carom.tables.threecushion(),
    }
    models = get_args(ShotCushion)
    for game, table in tables.items():

        def played(model, options, play=carom.simulate):
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                layout = carom.balls([[0.5, 0.5]], game=game, cushion_model=options)
                count = len(caught)
                final = play(table, layout, carom.cue(speed=4.0), cushion_model=model).final
            return count, [str(warning.message) for warning in caught[count:]], final

        for model in models:
            none, caught, own_ball = played(model, model)
            message, doubt_of_default = played(model, "default")[1:]
            assert none == (len(caught) == 1) and all(
                f"{game} has no constants for it" in text for text in caught
            )
            # what is another shot, or has none of its own, is told
            assert (
                len(message)
                == (none or doubt_of_default.tobytes() != own_ball.tobytes())
                == len(played(model, "default", carom.simulate_batch)[1])
            )
            assert model not in ("default", "smooth") or (not message and not none)
        assert len(played("han", "mathavan")[1]) == 1


def test_completion_has_no_internals():
    """What dir() lists, which completion shows, is told in the docs or in the text of its class."""
    private = {
        "look_at",
        "jobs",
        "facts",
        "batch",
        "index",
        "directions",
        "seeds_of",
        "play",
        "check_table",
        "of_record",
        "Made",
        "judge",
        "colour",
    }
    for shown in (BATCH, BATCH[0], carom.derivatives, carom.layouts, carom.pictures, carom.shots):
        assert not private & set(dir(shown)), shown


def test_failures_of_a_batch():
    layouts = np.stack([RACK] * 4)
    layouts["kind"]["mass"][2, 3], layouts["state"]["r"][3, 5] = -1.0, 0.0
    shots = carom.simulate_batch(
        TABLE, layouts, carom.cue(speed=[1.0, np.nan, 1.0, 1.0], ball=[99, 0, 0, 0])
    )
    failures = [(index[0], text.partition(":")[0]) for index, text in shots.failures()]
    assert failures == [
        (0, "cue.ball = 99"),
        (1, "cue.speed = nan"),
        (2, "balls[3].kind.mass = -1.0"),
        (3, "balls[5].state.r = [0. 0. 0.]"),
    ]
    with pytest.raises(carom.CaromError, match=r"^balls\[3\]\.kind\.mass = -1\.0"):
        shots[2].positions(0.1)
    assert all("options." not in status.text for status in carom.Status)


@pytest.mark.parametrize(
    "angles",
    [
        {"phi": np.pi / 2},
        {"phi": np.linspace(0.0, 2.0 * np.pi, 100)},
        {"phi": -np.pi / 3},
        {"phi": 0.0, "theta": np.pi / 12},
    ],
)
def test_radians_are_doubted(angles):
    with pytest.warns(UserWarning, match="degrees are taken, but .* looks like radians") as caught:
        carom.cue(**angles)
    assert caught[0].filename == __file__


def test_degrees_are_not_doubted():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for phi in (
            0.0,
            90.0,
            1.5,
            np.linspace(0.0, 360.0, 100),
            np.zeros(0),
            [np.nan],
            [np.inf],
            360.0 * np.pi,
        ):
            carom.cue(phi=phi)


def test_balls_documents_each_number():
    """Editors and help() show what a ball may be given: all that the library knows."""
    words = set(re.findall(r"\w+", carom.balls.__doc__))
    assert [name for name in carom.dtypes.ball_kind.names if name not in words] == []
