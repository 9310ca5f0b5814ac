"""cushions.py LIBRARY MEASURED.csv, which `carom-lab published --cushions` runs: the
cushions of pool and snooker in tables of Markdown, for docs/.

1. The errors of the sets of data/pool_systems.csv on the three tables of pool. 2. The sizes of
pockets by speed, compared with those of Alciatore's TP 3.5 and TP 3.6. 3. Snooker: the directions
of balls that roll once they have met a cushion, compared with the exact model,
   and the rebound by speed compared with the measured one.
4. What three banks tell of a table (carom_calibrate): tables are drawn, their banks are read with
   an error, and the other kicks and banks of the systems are played on them. With other laws of the
   cushion the three readings cannot be met exactly.
"""

import ctypes
from math import atan2, cos, degrees, inf, isnan, radians, sqrt, tan
from random import Random

from study.lab.computed import library, systems as played_systems
from study.lab.computed.pockets import size as size_of_pocket
from study.lab.computed.library import GAME_POOL, GAME_SNOOKER, LIBRARY, OF, Triple, ball, reference

# Of the library: SHOT_CUSHION_HAN and so on are made by library.types().
from study.lab.computed.library import (
    CUSHION_HAN,
    CUSHION_MATHAVAN,
    CUSHION_SMOOTH,
    SHOT_CUSHION_DEFAULT,
    SHOT_CUSHION_HAN,
    SHOT_CUSHION_MATHAVAN,
    TABLE_POOL_7FT,
    TABLE_POOL_8FT,
    TABLE_POOL_9FT,
)

BANKS, DIAMOND = 3, 2.54 / 8
TABLES = 160  # that are drawn for each law


def row(*cells):
    print("|", " | ".join(map(str, cells)), "|")


def head(*cells):
    print()
    row(*cells)
    row("---", *["--:"] * (len(cells) - 1))


def rms(errors):
    return sqrt(sum(e * e for e in errors) / len(errors))


# ---- Pool: systems and pockets


def systems():
    head("table", *"PGVCF", "T, degrees", "all")
    for name, kind in (("9ft", TABLE_POOL_9FT), ("8ft", TABLE_POOL_8FT), ("7ft", TABLE_POOL_7FT)):
        sets = [f"{played_systems.system(letter, kind):.2f}" for letter in "PGVCF"]
        across = max(map(abs, played_systems.twice_across(kind)))
        row(name, *sets, f"{across:.1f}", f"{played_systems.systems(kind):.2f}")


TP = {
    False: {45: 67.8, 35: 66.2, 25: 61.6, 20: 58.2, 15: 59.0, 10: 68.0, 6: 74.5},
    True: {0: 82.0, 20: 75.2, 40: 55.4, 50: 39.8},
}


def pockets():
    speeds = (1, 1.5, 2, 2.5)
    head("pocket", "angle", "TP 3.5, 3.6", *(f"carom, {v:g} m/s" for v in speeds))
    for side, sizes in TP.items():
        for angle, size in sizes.items():
            cells = [f"{size_of_pocket(side, angle, v):.0f}" for v in speeds]
            row("side" if side else "corner", angle, size, *cells)
    speeds = (1, 2, 3, 5, 8)
    head("corner pocket of `9ft`, mm", *(f"{v:g} m/s" for v in speeds))
    for angle in (45, 30, 15, 8):
        sizes = [size_of_pocket(False, angle, v, TABLE_POOL_9FT, 0.00025) for v in speeds]
        cells = [f"{size:.1f}" for size in sizes]
        row(f"{angle} degrees to the rail", *cells)


# ---- Snooker


def kind_for(game, model):
    kind = OF["carom_ball_kind"]()
    LIBRARY.carom_ball_kind_for(game, model, reference(kind))
    return kind


def impact(kind, model, v, w):
    """The motion after an impact on a rail along x."""
    options = OF["carom_cushion_options"](model=model)
    for name, *_ in options._fields_:
        if hasattr(kind, name):
            setattr(options, name, getattr(kind, name))
    nose = kind.nose_height or 1.4 * kind.radius
    numbers = (nose, kind.radius, kind.mass, kind.mu_slide, kind.mu_cushion)
    along = (ctypes.c_double * 2)(0, 1)
    contact = OF["carom_cushion_impact"](
        Triple(*v), Triple(*w), along, *numbers, kind.restitution_cushion
    )
    out = OF["carom_motion"]()
    LIBRARY.carom_cushion(reference(contact), reference(options), reference(out))
    return out


SNOOKER = {
    "smooth": (SHOT_CUSHION_DEFAULT, CUSHION_SMOOTH),
    "han": (SHOT_CUSHION_HAN, CUSHION_HAN),
    "mathavan": (SHOT_CUSHION_MATHAVAN, CUSHION_MATHAVAN),
}


def direction(name, across, angle, roll, side):
    """In degrees from the normal, of a ball that rolls again; its speed across is given."""
    shot_model, model = SNOOKER[name]
    kind = kind_for(GAME_SNOOKER, shot_model)
    along, R = across * tan(radians(angle)), kind.radius
    speed = across / cos(radians(angle))
    spin = (-roll * across / R, roll * along / R, side * speed / R)
    rebound = impact(kind, model, (along, across, 0), spin)
    v = Triple()
    LIBRARY.carom_rolling_velocity(rebound.v, rebound.w, ctypes.c_double(R), v)
    return degrees(atan2(v[0], -v[1]))


def snooker():
    head("the ball", "smooth", "han")
    places = [(0.7 + 0.5 * k, 10 + 5 * n) for k in range(4) for n in range(14)]
    for name, roll, side in (
        ("rolls", 1, 0),
        ("slides", 0, 0),
        ("rolls, with running english of 0.5 R w/v", 1, 0.5),
        ("rolls, with reverse english of 0.5 R w/v", 1, -0.5),
    ):
        off = {
            model: rms(
                [
                    direction(model, *place, roll, side) - direction("mathavan", *place, roll, side)
                    for place in places
                ]
            )
            for model in ("smooth", "han")
        }
        row(name, *(f"{error:.1f}" for error in off.values()))
    head("speed of a rolling ball, m/s", "measured", "smooth", "han")
    for v, measured in ((0.5, 0.897), (1, 0.948), (1.5, 0.936), (2, 0.908), (2.5, 0.874)):
        cells = []
        for shot_model, model in (SNOOKER["smooth"], SNOOKER["han"]):
            kind = kind_for(GAME_SNOOKER, shot_model)
            cells.append(-impact(kind, model, (0, v, 0), (-v / kind.radius, 0, 0)).v[1] / v)
        row(v, measured, *(f"{share:.3f}" for share in cells))


# ---- Three banks


def on_table(numbers, model):
    """From now on, balls are played on this table."""
    library.PLAYED_ON.clear()
    library.PLAYED_ON.update(numbers)
    library.CUSHION_MODEL[0] = model


def numbers_of(model):
    kind = kind_for(GAME_POOL, model)
    return {name: getattr(kind, name) for name, *_ in kind._fields_}


def other_places():
    """Where the kicks and banks of the systems arrive, in diamonds; with 0.6 R w/v of english."""
    found = []
    for text in played_systems.rows_of_systems():
        if text["set"] not in played_systems.ARRIVES:
            continue
        line = {name: float(text[name]) for name in ("start", "aim", "roll")} | {"set": text["set"]}
        side = 0.6 if text["english"] == "free" else 0
        arrives = played_systems.ARRIVES[text["set"]]
        found += [arrives(TABLE_POOL_9FT, line, float(v), side) for v in text["speeds"].split()]
    return found


def banks_of_calibration():
    """Where the three banks return on the table that is played on, in diamonds."""
    found = []
    for k in range(BANKS):
        bank = OF["carom_bank"]()
        LIBRARY.carom_bank_of(k, reference(bank))
        line = {"set": "P", "start": 0, "aim": bank.aim, "roll": bank.roll}
        found.append(played_systems.bank(TABLE_POOL_9FT, line, bank.speed, 0))
    return found


def calibrated(readings):
    """The two numbers, or None where the readings are rejected."""
    found = OF["carom_calibration"]()
    read = (ctypes.c_double * BANKS)(*readings)
    status = LIBRARY.carom_calibrate(
        reference(library.table(TABLE_POOL_9FT)),
        reference(ball(GAME_POOL)),
        read,
        reference(found),
    )
    if status != 0:
        return None
    return {"restitution_cushion": found.restitution, "mu_cushion": found.friction}


# How tables differ: standard deviations. Those of the law are the differences from another set of
# seven numbers that fits the systems as well (q 0.20, x 1.17, t 1.065, nose 32.5 mm).
CUSHION = {"restitution_cushion": 0.05, "mu_cushion": 0.06}
LAW = {
    "nose_height": 0.0015,
    "roll_loss": 0.03,
    "smooth_q": 0.15,
    "smooth_x": 0.13,
    "smooth_t": 0.115,
}
READING = 0.025 / DIAMOND
DRAWN = {
    "smooth": (SHOT_CUSHION_DEFAULT, CUSHION),
    "smooth, with five more numbers drawn": (SHOT_CUSHION_DEFAULT, CUSHION | LAW),
    "han": (SHOT_CUSHION_HAN, CUSHION),
    "mathavan": (SHOT_CUSHION_MATHAVAN, CUSHION),
}


def drawn(usual, deviations, random):
    """The numbers of a table, each within two deviations and what the library accepts."""
    least = {"smooth_q": 0.05}
    most = {"smooth_q": 0.5, "restitution_cushion": 0.99}
    numbers = dict(usual)
    for name, deviation in deviations.items():
        off = inf
        while abs(off) > 2:
            off = random.gauss(0, 1)
        value = usual[name] + off * deviation
        numbers[name] = min(max(value, least.get(name, 0)), most.get(name, inf))
    return numbers


def calibrations():
    smooth = numbers_of(SHOT_CUSHION_DEFAULT)
    rough = smooth | {name: 0 for name in smooth if name.startswith(("smooth_", "roll_loss"))}
    rough |= {"nose_height": 0, "restitution_cushion": 0.85, "mu_cushion": 0.2}
    on_table(rough, SHOT_CUSHION_HAN)
    by_han = other_places()
    on_table(smooth, SHOT_CUSHION_DEFAULT)
    by_usual = other_places()

    head("law of the drawn tables", "tables", "Han's cushion, 0.85 and 0.2", "usual", "calibrated")
    for name, (model, deviations) in DRAWN.items():
        random, errors, played = Random(1), ([], [], []), 0
        usual = numbers_of(model)
        while played < TABLES:
            on_table(drawn(usual, deviations, random), model)
            truth = other_places()
            readings = [place + random.gauss(0, READING) for place in banks_of_calibration()]
            found = calibrated(readings)
            if found is None:
                continue
            played += 1
            on_table(smooth | found, SHOT_CUSHION_DEFAULT)
            for of_one, estimates in zip(errors, (by_han, by_usual, other_places())):
                of_one += [
                    min(abs(a - b), played_systems.MOST_OFF)
                    for a, b in zip(truth, estimates)
                    if not isnan(a - b)
                ]
        row(name, TABLES, *(f"{rms(series):.3f}" for series in errors))


if __name__ == "__main__":
    systems()
    pockets()
    snooker()
    calibrations()
