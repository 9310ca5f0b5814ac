"""conventions.py SOURCE BUILD: docs/reference/conventions.md has the axes, signs and equations of
carom.

Each row of its table of signs has a check here, by a stroke or an impact that the command computes. The
equations are read from the page: their increments, added in small steps, must give the motion that
`carom resolve` writes. The figure is what tools/conventions_figure.py draws. UPDATE=1 draws it.
"""

import csv
import io
import json
import math
import os
import random
import re
import subprocess
import sys
from pathlib import Path

SOURCE, BUILD = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
PAGE = SOURCE / "docs/reference/conventions.md"
FIGURE = SOURCE / "docs/figures/conventions.svg"
sys.path.insert(0, str(SOURCE / "tools"))
from conventions_figure import drawing  # noqa: E402

R = 0.028575  # of a pool ball, m
AIRBORNE = 5  # a label of a state
MOTION = ("v_x", "v_y", "w_x", "w_y", "w_z")
# Of the largest number of a collision: what Euler's steps differ by from the exact limit.
STEPS, CLOSE = 4000, 5e-4


def carom(*words, given=None):
    done = subprocess.run(
        [str(BUILD / "carom"), *words], input=given, capture_output=True, text=True
    )
    assert done.returncode == 0, f"carom {' '.join(words)}\n{done.stderr}"
    return done.stdout


def rows(text):
    return list(csv.DictReader(io.StringIO(text)))


# ---- Signs -------------------------------------------------------------------------------------


def stroke(*words, table="9ft"):
    """The line of a shot of a ball at 0.6, 0.8 m, with all its events."""
    return json.loads(carom("shoot", "--table", table, *words, "--events", "full"))


def struck(*words):
    """Velocity and angular velocity of the ball just after the strike."""
    shot = stroke("--cue", "0.6,0.8", "--speed", "2", *words)
    state = next(event for event in shot["events"] if event[1] == "stick_ball")[4][0]
    return state[4:7], state[7:10]


def first_rail(*words):
    """The name of the first rail that the ball meets, and its centre there."""
    text = carom("shoot", "--cue", "0.6,0.8", "--ball-speed", "3", "--tip", "0,0", "--csv", *words)
    event = next(row for row in rows(text) if row["what"] == "rail")
    return event["with"], (float(event["x_m"]), float(event["y_m"]))


def hit(*words):
    """The numbers of a collision: those before it with `before_`, and those that it leads to."""
    given = carom("hit", *words, "--csv")
    before = {f"before_{name}": value for name, value in rows(given)[0].items()}
    numbers = before | rows(carom("resolve", "--derived", "-", given=given))[0]
    names_only = ("before_id", "id", "status")
    return {name: float(value) for name, value in numbers.items() if name not in names_only}


def quantity(name, *words):
    return float(carom("hit", *words, "--quantity", name, "--csv").splitlines()[-1])


def check_phi():
    for phi in (0.0, 90.0, 30.0):
        (x, y, _), _ = struck("--aim", str(phi), "--tip", "0,0")
        assert abs(math.degrees(math.atan2(y, x)) - phi) < 1e-9, phi


def check_theta():
    # A raised cue presses the ball into the slate, from which it hops. Right of the centre it
    # turns the ball about its path, which therefore bends to the right.
    for theta, hops in (("0", False), ("45", True)):
        shot = stroke("--cue", "0.6,0.8", "--speed", "4", "--tip", "0,0", "--elevation", theta)
        labels = {state[0] for event in shot["events"] for state in event[4]}
        assert (AIRBORNE in labels) == hops, theta
    level = struck("--tip", "0.3,0")[1]
    raised = struck("--tip", "0.3,0", "--elevation", "45")[1]
    assert abs(level[1]) < 1e-12 < 1.0 < raised[1]


def check_tip():
    assert struck("--tip", "0.3,0")[1][2] > 1.0 > -1.0 > struck("--tip=-0.3,0")[1][2]
    assert struck("--tip", "0,0.3")[1][0] < -1.0 < 1.0 < struck("--tip=0,-0.3")[1][0]
    # in radii: w = 5/2 V/R times the offset
    v, w = struck("--tip", "0,0.3")
    assert abs(-w[0] * R / v[1] - 2.5 * 0.3) < 1e-12


def check_offsets():
    line = json.loads(carom("shoot", "--cue", "0.6,0.8", "--tip", "0.3,0.2", "--json"))
    assert (line["cue"]["a"], line["cue"]["b"]) == (-0.3, 0.2)


def check_rotation():
    # A ball that rolls has w = (-v_y, v_x, 0)/R; right english turns counterclockwise.
    shot = stroke("--cue", "0.6,0.8", "--aim", "60", "--ball-speed", "1", "--tip", "0,0")
    rolling = next(event for event in shot["events"] if event[1] == "sliding_rolling")[4][0]
    v, w = rolling[4:7], rolling[7:10]
    assert abs(w[0] * R + v[1]) < 1e-9 and abs(w[1] * R - v[0]) < 1e-9
    assert struck("--tip", "0.3,0")[1][2] > 1.0


def check_side():
    assert hit("--side", "50%")["before_w1z"] > 1.0
    assert hit("--cut", "full", "--side", "50%")["throw_deg"] > 1.0  # to the left
    assert struck("--tip", "0.3,0")[1][2] > 1.0


def check_spin():
    follow = hit("--spin", "20rad/s")
    assert follow["before_v1x"] > 0.0 and follow["before_w1y"] == 20.0
    assert hit("--spin", "stun")["before_w1y"] == 0.0


def check_cut():
    after = hit("--cut", "30")
    assert after["before_v1x"] > 0.0 < after["v2y"]
    text = carom(
        "shoot", "--cue", "0.6,0.8", "--balls", "0.6,1.6", "--at-ball", "1", "--cut", "30", "--csv"
    )
    left = [row for row in rows(text) if row["what"] == "meets"]
    assert float(left[0]["cut_deg"]) > 29.0, left
    moved = [float(row["x_m"]) for row in rows(text) if row["ball"] == "1"]
    assert moved[-1] != 0.6 and min(moved[:2]) < 0.6, moved


def check_angles():
    # A cut to the left throws its ball to the right, and turns the cue ball to the right.
    after = hit("--cut", "30")
    assert after["throw_deg"] < -1.0 and after["deflection_deg"] < -1.0
    right = hit("--cut", "-30")
    assert right["throw_deg"] > 1.0 and right["deflection_deg"] > 1.0


def check_quantities():
    for cut in ("30", "-30"):
        assert quantity("throw", "--cut", cut) > 1.0 < quantity("rolling-deflection", "--cut", cut)


def check_normal():
    columns = "vx,vy,vz,wx,wy,wz,R,M,h,mu_s,mu_w,e\n"
    numbers = "0,0,0,0,0.02857,0.17,0.0365,0.2,0.2,0.85\n"
    for speed, status in (("1", "ok"), ("-1", "separating")):
        given = f"{columns}0,{speed},{numbers}"
        after = rows(carom("resolve", "--cushion", "-", given=given))[0]
        assert after["status"] == status, after
        assert status != "ok" or float(after["vy"]) < 0.0


def check_slope():
    def moved(**slopes):
        table = "9ft" + "".join(f",{name}={value}" for name, value in slopes.items())
        shot = stroke("--cue", "0.6,1.2", "--aim", "45", "--ball-speed", "0.4", table=table)
        return shot["final"]["balls"]["cue"][1:3]

    level, x, y = moved(), moved(slope_x=0.004), moved(slope_y=0.004)
    assert x[0] < level[0] - 1e-3 and y[1] < level[1] - 1e-3, (level, x, y)


SIGNS = {
    "`phi`, `--aim`": check_phi,
    "`theta`, `--elevation`": check_theta,
    "`tip`, `--tip`: right, above": check_tip,
    "`a`, `b`: the tip in C, the packages and files, as in pooltool": check_offsets,
    "`w`": check_rotation,
    "`w_z`, `--side`": check_side,
    "`--spin` of `carom hit`": check_spin,
    "`--cut`, the cut of a pot": check_cut,
    "`throw_deg`, `deflection_deg` of `carom resolve`": check_angles,
    "`throw`, `rolling-deflection` of `carom hit`": check_quantities,
    "`normal` of an impact on a cushion": check_normal,
    "`slope_x`, `slope_y` of a table": check_slope,
}


def check_axes():
    """The rails and the origin: a ball touches a rail one radius from its line."""
    width, length = 1.27, 2.54
    for aim, rail, axis, place in (
        ("180", "left", 0, R),
        ("0", "right", 0, width - R),
        ("270", "head", 1, R),
        ("90", "foot", 1, length - R),
    ):
        name, centre = first_rail("--aim", aim)
        assert name == f"the {rail} rail" and abs(centre[axis] - place) < 1e-12, (name, centre)
    shot = stroke("--cue", "0.6,0.8", "--ball-speed", "1")
    assert shot["final"]["balls"]["cue"][3] == R


# ---- Equations ---------------------------------------------------------------------------------


def expression(formula):
    """A formula of the page as a function of the names in it."""
    text = formula.strip().strip("$")
    text = text.replace(r"\Delta P_1", "P1").replace(r"\Delta P_2", "P2").replace(r"\Delta P", "dP")
    text = text.replace("\\,", " ").replace(r"\mu_", "mu_").replace("{", "").replace("}", "")
    text = text.replace("|u|", "size_u").replace("|d|", "size_d").replace("|P2|", "abs(P2)")
    text = re.sub(r"(?<=[\w)]) +(?=[\w(])", " * ", " ".join(text.split()))
    code = compile(text, formula, "eval")
    return lambda names: eval(code, {"abs": abs}, names)


def equations(page):
    """The slips and impulses of the page, and the rows of its increments by impulse and ball."""
    formulas = {}
    for block in re.findall(r"\\begin\{aligned\}\n(.*?)\\end\{aligned\}", page, flags=re.S):
        for line in block.replace("\\\\", "").splitlines():
            sides = [side.strip() for side in line.split("&")]
            for left, right in zip(sides[::2], sides[1::2]):
                name = left.replace(r"\Delta P_", "P")
                formulas[name] = expression(right.removeprefix("="))
    cells = r"\| (contact|cloth) \| (i|j|pressed) \| (.*) \|\n"
    increments = {
        (impulse, ball): [expression(cell) for cell in row.split("|")]
        for impulse, ball, row in re.findall(cells, page)
    }
    assert set(formulas) == {"u_x", "u_z", "P1", "P2", "d_x", "d_y", "q_x", "q_y"}, set(formulas)
    assert len(increments) == 3 and all(len(row) == 5 for row in increments.values())
    return formulas, increments


def change(ball, row, names):
    """Adds a row of increments to the motion of a ball."""
    parts = [cell(names) for cell in row]
    per_spin = 5.0 / (2.0 * ball["M"] * R)
    for name, part in zip(("v_x", "v_y"), parts):
        ball[name] += part / ball["M"]
    for name, part in zip(("w_x", "w_y", "w_z"), parts[2:]):
        ball[name] += per_spin * part


def against(names, formulas, slip, wanted):
    """Evaluates a slip and the impulses against it, which are 0 without slip."""
    for axis in slip:
        names[axis] = formulas[axis](names)
    size = math.hypot(*(names[axis] for axis in slip))
    names[f"size_{slip[0][0]}"] = size
    for name in wanted:
        names[name] = formulas[name](names) if size > 1e-9 else 0.0


def integrated(page, balls, mu_b, e, slip_sign):
    """The motion after the collision, by small steps of the equations of the page."""
    formulas, increments = equations(page)
    i, j = ({**ball} for ball in balls)
    step = (i["v_y"] - j["v_y"]) / (1.0 / i["M"] + 1.0 / j["M"]) / STEPS
    work = compression = 0.0
    while not compression or work < (1.0 + e * e) * compression:
        names = {"R": R, "mu_b": mu_b, "dP": step}
        names |= {
            f"{name[0]}_{which}{name[2:]}": ball[name]
            for which, ball in (("i", i), ("j", j))
            for name in MOTION
        }
        against(names, formulas, ("u_x", "u_z"), ("P1", "P2"))
        pressed = j if names["P2"] > 0.0 else i
        names |= {name: pressed[name] for name in ("v_x", "v_y")}
        names |= {name: slip_sign * pressed[name] for name in ("w_x", "w_y")}
        names["mu_s"] = pressed["mu_s"]
        against(names, formulas, ("d_x", "d_y"), ("q_x", "q_y"))
        closing = j["v_y"] - i["v_y"]
        change(i, increments["contact", "i"], names)
        change(j, increments["contact", "j"], names)
        change(pressed, increments["cloth", "pressed"], names)
        work += step * abs(closing + j["v_y"] - i["v_y"]) / 2.0
        if not compression and j["v_y"] >= i["v_y"]:
            compression = work
    return i, j


def drawn(source):
    """Two balls just before a collision along +y, drawn at random."""

    def ball(least):
        return {
            "M": source.uniform(0.12, 0.22),
            "mu_s": source.uniform(0.1, 0.3),
            "v_x": source.gauss(0.0, 1.0),
            "v_y": least,
            "w_x": source.gauss(0.0, 20.0),
            "w_y": source.gauss(0.0, 20.0),
            "w_z": source.gauss(0.0, 20.0),
        }

    return ball(source.uniform(1.0, 3.0)), ball(source.uniform(-1.0, 0.5))


def row_of(balls, mu_b, e):
    """A row for `carom resolve`, in which y is the line of centres and so x = y cross z."""
    row = {"u_b": mu_b, "e_b": e}
    for k, ball in enumerate(balls, 1):
        row |= {f"r{k}x": 0.0, f"r{k}y": 2.0 * R * (k - 1), f"r{k}z": R, f"R{k}": R, f"v{k}z": 0.0}
        row |= {f"M{k}": ball["M"], f"u_s{k}": ball["mu_s"]}
        row |= {f"{name[0]}{k}{name[2]}": ball[name] for name in MOTION}
    return row


def check_collisions(page, count):
    """Compares the integrated equations of so many collisions with `carom resolve`."""
    source, worst = random.Random(1), 0.0
    for slip, sign in (("paper", 1.0), ("pooltool", -1.0)):
        cases = [
            (drawn(source), source.uniform(0.03, 0.2), source.uniform(0.7, 1.0))
            for _ in range(count)
        ]
        given = [row_of(*case) for case in cases]
        text = ",".join(given[0]) + "\n"
        text += "".join(",".join(map(repr, row.values())) + "\n" for row in given)
        for case, after in zip(cases, rows(carom("resolve", "--slip", slip, "-", given=text))):
            assert after["status"] == "ok", after
            came, wanted = [], []
            for k, ball in enumerate(integrated(page, *case, sign), 1):
                for name in MOTION:
                    unit = R if name[0] == "w" else 1.0
                    came.append(unit * ball[name])
                    wanted.append(unit * float(after[f"{name[0]}{k}{name[2]}"]))
            off = max(abs(a - b) for a, b in zip(came, wanted)) / max(map(abs, wanted))
            worst = max(worst, off)
    return worst


def main():
    page = PAGE.read_text(encoding="utf-8")
    table = page[page.index("## Signs") : page.index("## A collision")]
    named = re.findall(r"^\| (`.*?) \|", table, flags=re.M)
    assert named == list(SIGNS), f"{PAGE.name} has the rows {named}, and checks are {list(SIGNS)}"
    for check in (*SIGNS.values(), check_axes):
        check()
    worst = check_collisions(page, 4)
    assert worst < CLOSE, f"{PAGE.name}: the equations are {worst:.2g} off"
    # That a wrong sign is found, in an equation and in an increment.
    for right, wrong in (("- R\\,(w_{iz}", "+ R\\,(w_{iz}"), ("| $-q_x$ |", "| $q_x$ |")):
        assert right in page and check_collisions(page.replace(right, wrong), 1) > CLOSE, right
    if os.environ.get("UPDATE") == "1":
        FIGURE.write_text(drawing(), encoding="utf-8")
    assert FIGURE.read_text(encoding="utf-8") == drawing(), f"{FIGURE.name} is drawn otherwise now"
    print(f"{len(SIGNS)} rows of signs; equations within {worst:.1g}")


if __name__ == "__main__":
    main()
