#!/usr/bin/env python3
"""Takes the impacts on cushions out of recorded shots: cushion_events.py SHOTS.jsonl > EVENTS.csv

SHOTS.jsonl is a file of shots that the simulator pooltool has recorded (kinds meta, table, shot;
states before and after each event). A row of EVENTS.csv is one impact in the columns of `carom
resolve --cushion`, the direction into the cushion being that after pooltool has moved the ball to
its spacer of 1e-6 m (its make_kiss), and the motion after it (avx ... awz).
"""

import cmath
import csv
import json
import math
import sys

SPACER = 1e-6


def linear_normal(segment, v):
    """The unit normal of a rail, turned to where the ball goes."""
    x, y = segment["lx"], segment["ly"]
    length = math.hypot(x, y)
    sign = 1 if x * v[0] + y * v[1] > 0 else -1
    return sign * x / length, sign * y / length


def circular_normal(segment, r, v, moving, radius):
    """The direction from the ball to the axis of a jaw, once the ball has been moved to its spacer."""
    dx, dy = r[0] - segment["center"][0], r[1] - segment["center"][1]
    reach = radius + segment["radius"] + SPACER
    a, b, c = v[0] ** 2 + v[1] ** 2, 2 * (v[0] * dx + v[1] * dy), dx * dx + dy * dy - reach * reach
    moved = False
    if moving and a > 0:
        root = cmath.sqrt(b * b - 4 * a * c)
        times = [
            t
            for t in ((-b + root) / (2 * a), (-b - root) / (2 * a))
            if abs(t.imag) < 1e-3 * abs(t.real)
        ]
        if times:
            t = min(times, key=abs).real
            if abs(t) * math.sqrt(a) <= 5 * SPACER:
                dx, dy, moved = dx + t * v[0], dy + t * v[1], True
    if not moved:  # outward along the radius: the direction stays
        pass
    length = math.hypot(dx, dy)
    return -dx / length, -dy / length


def rows(lines):
    tables = {}
    for line in lines:
        entry = json.loads(line)
        if entry["kind"] == "table":
            tables[entry["id"]] = {
                "ball_linear_cushion": {s["id"]: s for s in entry["linear"]},
                "ball_circular_cushion": {s["id"]: s for s in entry.get("circular", [])},
            }
        if entry["kind"] != "shot":
            continue
        params = {ball["id"]: ball["params"] for ball in entry["balls"]}
        for number, event in enumerate(entry["events"]):
            kind, ids, initial, final = event[1:5]
            if not kind.endswith("_cushion"):
                continue
            segment, p, state = tables[entry["table"]][kind][ids[1]], params[ids[0]], initial[0]
            r, v, w = state[1:4], state[4:7], state[7:10]
            if kind == "ball_linear_cushion":
                normal, height, jaw = linear_normal(segment, v), segment["p1"][2], 0
            else:
                normal = circular_normal(segment, r, v, state[0] in (2, 3), p["R"])
                height, jaw = segment["center"][2], segment["radius"]
            yield [
                f"{entry['id']}:{number}",
                *v,
                *w,
                *normal,
                height,
                p["R"],
                p["m"],
                p["u_s"],
                p["f_c"],
                p["e_c"],
                jaw,
                *final[0][4:7],
                *final[0][7:10],
            ]


def main():
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow(
        [
            "id",
            "vx",
            "vy",
            "vz",
            "wx",
            "wy",
            "wz",
            "nx",
            "ny",
            "h",
            "R",
            "M",
            "mu_s",
            "mu_w",
            "e",
            "rho",
            "avx",
            "avy",
            "avz",
            "awx",
            "awy",
            "awz",
        ]
    )
    with open(sys.argv[1], encoding="utf-8") as lines:
        out.writerows(rows(lines))


if __name__ == "__main__":
    main()
