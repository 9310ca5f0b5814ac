#!/usr/bin/env python3
"""Records shots of pooltool in space: space_shots.py > data/shots-space.jsonl

Needs pooltool from its repository: commit 9a8abfe0 of main with what its authors proposed for space by then, the commits of PARTS.
Its engine there is flat by default; here it is one in space, as in pooltool's own tests of space (every model is declared fit for it). The
noses of rails get the radius 0, for which carom has the same geometry.

A shot is recorded until no ball flies any more, or one is beyond the noses, or up to MOST_EVENTS events: what happens on the cloth is
compared with shots-pooltool.jsonl.
"""
import json
import math
import random
import sys

import attrs
import numpy as np
import pooltool as pt
from pooltool.events import EventType
from pooltool.evolution.engine import SimulationEngine
from pooltool.physics.dimensionality import Dim
from pooltool.physics.resolve.ball_ball.frictional_inelastic import FrictionalInelastic3D
from pooltool.physics.resolve.ball_cushion.impulse_frictional_inelastic import (
    ImpulseFrictionalInelasticCircular3D,
    ImpulseFrictionalInelasticLinear3D,
)
from pooltool.physics.resolve.resolver import default_resolver
from pooltool.physics.resolve.stick_ball.instantaneous_point import InstantaneousPoint3D

COMMIT = "9a8abfe0da4c3b588dd7779e7f8530123170e742"
PARTS = {
    "349": "8d0c0ba6ff1efce87090777f01ed69390bc09abe",  # of it, the model of two balls in space
    "350": "bc745238066d7763cb76e793ee5b08e605afce38",  # flying balls find rails
    "351": "3e9976f2",  # of it, the impulse of a cushion in space
    "make_kiss": "9184332c, 81014440",  # spacers in space
}
SEED, MOST_EVENTS = 25, 10
AIRBORNE = 5
R = 0.028575


def engine():
    resolver = default_resolver()
    resolver.ball_ball = FrictionalInelastic3D()
    resolver.ball_linear_cushion = ImpulseFrictionalInelasticLinear3D()
    resolver.ball_circular_cushion = ImpulseFrictionalInelasticCircular3D()
    resolver.stick_ball = InstantaneousPoint3D()
    for field in attrs.fields(type(resolver)):
        model = getattr(resolver, field.name)
        if hasattr(model, "dim"):
            model.dim = Dim.THREE
    return SimulationEngine(resolver=resolver, is_3d=True)


def thin_noses(table):
    for name, segment in table.cushion_segments.linear.items():
        table.cushion_segments.linear[name] = attrs.evolve(segment, nose_radius=0.0)
    return table


def table_line(table):
    """The table as carom has it: a rail is where balls on the cloth touch it, so it lies behind pooltool's nose."""
    linear = []
    for s in table.cushion_segments.linear.values():
        size = math.hypot(s.lx, s.ly)
        back = (1 if s.direction == 1 else -1) * (R - math.sqrt(s.height * (2 * R - s.height)))
        move = [-back * s.lx / size, -back * s.ly / size, 0.0]
        linear.append({"id": s.id, "p1": [float(x + d) for x, d in zip(s.p1, move)], "p2": [float(x + d) for x, d in zip(s.p2, move)],
                       "lx": float(s.lx), "ly": float(s.ly), "l0": float(s.l0 + back * size), "direction": s.direction})
    return {"kind": "table", "id": "pocket", "w": table.w, "l": table.l, "ball_radius": R, "pocket_back": 7 / 5 * R, "linear": linear,
            "circular": [{"id": s.id, "center": [float(x) for x in s.center], "radius": float(s.radius)}
                         for s in table.cushion_segments.circular.values()],
            "pockets": [{"id": p.id, "center": [float(x) for x in p.center], "radius": float(p.radius), "depth": float(p.depth)}
                        for p in table.pockets.values()]}


def state_of(ball):
    return [int(ball.state.s), *(float(x) for row in ball.state.rvw for x in row)]


def ball_at(name, x, y, z=R, v=(0, 0, 0), w=(0, 0, 0)):
    ball = pt.Ball.create(name, xy=(x, y))
    ball.state.rvw[0, 2] = z
    ball.state.rvw[1] = v
    ball.state.rvw[2] = w
    if z != R or v[2] != 0:
        ball.state.s = AIRBORNE
    return ball


class Draws(random.Random):
    def vector(self, size):
        return [self.uniform(-size, size) for _ in range(3)]


def hop(r, table):
    """The cue ball alone, struck from above."""
    cue = {"V0": r.uniform(0.5, 2.5), "phi": r.uniform(70, 110), "theta": r.uniform(5, 80)}
    cue |= {"a": r.uniform(-0.3, 0.3), "b": r.uniform(-0.3, 0.3)}
    return cue, [ball_at("0", r.uniform(0.4, 0.6), r.uniform(0.3, 0.8))]


def jump(r, table):
    """A ball ahead of the cue ball, to be hit in flight or jumped over."""
    x, y, phi = r.uniform(0.4, 0.6), r.uniform(0.3, 0.6), r.uniform(70, 110)
    ahead, aside = r.uniform(0.08, 0.5), r.uniform(-1, 1) * R
    c, s = math.cos(math.radians(phi)), math.sin(math.radians(phi))
    cue = {"V0": r.uniform(1, 3), "phi": phi, "theta": r.uniform(20, 65), "a": r.uniform(-0.2, 0.2), "b": r.uniform(-0.2, 0.2)}
    return cue, [ball_at("0", x, y), ball_at("1", x + ahead * c - aside * s, y + ahead * s + aside * c)]


def fall(r, table):
    """A ball falls on another one, which lies there or rolls."""
    x, y = r.uniform(0.3, 0.7), r.uniform(0.4, 1.5)
    v = [r.uniform(-0.5, 0.5), r.uniform(-0.5, 0.5), 0.0] if r.random() < 0.5 else [0.0, 0.0, 0.0]
    rolls = ball_at("1", x, y, v=v, w=(-v[1] / R, v[0] / R, 0.0))
    rolls.state.s = 3 if any(v) else 0
    height = r.uniform(0.05, 0.3)
    t = math.sqrt(2 * (height - R) / 9.81)
    u = r.vector(1.0)
    above = [x + t * (v[0] - u[0]) + r.uniform(-R, R), y + t * (v[1] - u[1]) + r.uniform(-R, R), R + height]
    return {"V0": 0}, [ball_at("0", *above, (u[0], u[1], 0.0), r.vector(60)), rolls]


def meet(r, table):
    """Two balls in the air on their way to each other."""
    x, y, z = r.uniform(0.4, 0.6), r.uniform(0.8, 1.2), r.uniform(0.1, 0.3)
    t, u, v = r.uniform(0.05, 0.12), r.vector(1.5), r.vector(1.5)
    z += 9.81 / 2 * t * t
    a = [x - t * u[0], y - t * u[1], z - t * u[2]]
    b = [x - t * v[0] + r.uniform(-R, R), y - t * v[1] + r.uniform(-R, R), z - t * v[2] + r.uniform(-R, R)]
    flying = [ball_at(name, c[0], c[1], max(c[2], 0.08), speed, r.vector(60)) for name, c, speed in (("0", a, u), ("1", b, v))]
    return {"V0": 0}, flying


def rail(r, table):
    """A ball flies into the nose of a rail, at any height, or over it."""
    t = r.uniform(0.05, 0.15)
    v = [r.uniform(1.0, 4.0), r.uniform(-1.0, 1.0), 0.0]
    z = R + (r.uniform(0.0, 1e-3) if r.random() < 0.2 else r.uniform(1e-3, 0.03))  # where it comes to the nose
    x = table.w - R - t * v[0]
    v[2] = r.uniform(-1.0, 9.81 / 2 * t)
    return {"V0": 0}, [ball_at("0", x, r.uniform(0.3, 0.6), max(z - t * v[2] + 9.81 / 2 * t * t, R), v, r.vector(60))]


def cushion(r, table):
    """A ball on the cloth slides into a rail."""
    v, angle = r.uniform(0.5, 3.0), r.uniform(-0.8, 0.8)
    v = (v * math.cos(angle), v * math.sin(angle), 0.0)
    ball = ball_at("0", table.w - R - r.uniform(0.01, 0.1), r.uniform(0.4, 0.6), v=v, w=r.vector(60))
    ball.state.s = 2
    return {"V0": 0}, [ball]


def pocket(r, table):
    """A ball flies to a pocket."""
    to = r.choice(list(table.pockets.values()))
    aim = [to.center[0] + r.uniform(-0.5, 0.5) * to.radius, to.center[1] + r.uniform(-0.5, 0.5) * to.radius]
    side = to.id[1] == "c"  # a side pocket is played along x, one in a corner at 45 degrees
    middle = [table.w / 2, to.center[1] + (0.0 if side else math.copysign(table.w / 2, table.l / 2 - to.center[1])) + r.uniform(-0.1, 0.1)]
    away = math.hypot(aim[0] - middle[0], aim[1] - middle[1])
    v, reach = r.uniform(1.5, 4.0), r.uniform(0.25, 0.4)
    c, s = (aim[0] - middle[0]) / away, (aim[1] - middle[1]) / away
    t = reach / v
    v_z = 9.81 / 2 * t + r.uniform(-0.2, 0.4)
    return {"V0": 0}, [ball_at("0", aim[0] - reach * c, aim[1] - reach * s, R, (v * c, v * s, v_z), r.vector(60))]


FAMILIES = [(hop, 15), (jump, 25), (fall, 15), (meet, 10), (rail, 15), (cushion, 10), (pocket, 10)]


def flies(ball):
    return int(ball.state.s) == AIRBORNE


def record(name, make, r, engine):
    table = thin_noses(pt.Table.default())
    def on_table(ball):
        return all(R < x < size - R for x, size in zip(ball.state.rvw[0], (table.w, table.l)))

    cue, balls = make(r, table)
    while not all(on_table(b) for b in balls):
        cue, balls = make(r, table)
    stick = pt.Cue(cue_ball_id="0")
    stick.set_state(**{"phi": 0, "theta": 0, "a": 0, "b": 0, **cue})
    shot = pt.System(cue=stick, table=table, balls={b.id: b for b in balls})
    line = {"kind": "shot", "id": name, "family": make.__name__, "table": "pocket",
            "cue": {**{key: float(getattr(stick, key)) for key in ("V0", "phi", "theta", "a", "b")}, "ball": "0"},
            "balls": [{"id": b.id, "state": state_of(b), "params": {"game": "pooltool_pool"}} for b in balls], "events": []}
    failure = None
    try:
        pt.simulate(shot, engine=engine, inplace=True, max_events=3 * MOST_EVENTS)
    except (AssertionError, ValueError) as error:  # pooltool ends here; the events before are good
        failure = f"{type(error).__name__} {error}".strip()
    flying = {b.id for b in balls if flies(b)}
    for event in shot.events:
        if event.event_type == EventType.NONE:
            continue
        agents = [a for a in event.agents if a.agent_type.value == "ball"]
        kind = "slate" if event.event_type == EventType.BALL_TABLE else event.event_type.value
        states = [[state_of(a.initial) for a in agents], [state_of(a.final) for a in agents]]
        line["events"].append([float(event.time), kind, list(event.ids), *states])
        for a in agents:
            (flying.add if flies(a.final) else flying.discard)(a.id)
        gone = any(not (0 < x < table.w and 0 < y < table.l) for x, y in (a.final.state.rvw[0, :2] for a in agents))
        if not flying or gone or len(line["events"]) == MOST_EVENTS:
            return line
    return {**line, "fails": failure} if failure else line


def main():
    r, play = Draws(SEED), engine()
    print(json.dumps({"kind": "meta", "engine": "space", "pooltool_commit": COMMIT, "parts": PARTS, "seed": SEED}))
    print(json.dumps(table_line(thin_noses(pt.Table.default()))))
    for make, count in FAMILIES:
        for k in range(count):
            print(json.dumps(record(f"{make.__name__}-{k}", make, r, play)))


if __name__ == "__main__":
    sys.exit(main())
