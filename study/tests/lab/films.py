"""films.py: filmed shots for `carom-lab published --film` that carom did not play: rows on standard
output.

Two balls move by small steps of their equations on the cloth, and meet without friction. A shot ends
where a ball comes near a cushion, but for the last one, a ball that rolls into a cushion and keeps a
fraction of each speed. The numbers differ from carom's snooker where that shows what a film tells.
"""

import math
import random

R, G, STEP, RATE, NOISE = 0.02625, 9.81, 5e-4, 25, 7e-4
MU_SLIDE, MU_ROLL, DRAG, RESTITUTION = 2.075 / 9.81, 0.0105, 0.0107, 0.9
REBOUND, ALONG = 0.75, 0.9
WIDTH, LENGTH = 1.778, 3.569
BEFORE, LONGEST = 0.4, 4.0  # s at rest before a strike, and of a shot

chance = random.Random(7)


def advance(ball):
    """One step on the cloth; `roll` is the velocity of a ball that rolls as this one turns."""
    (x, y), (u, v), (p, q) = ball["place"], ball["v"], ball["roll"]
    slip, speed = math.hypot(u - p, v - q), math.hypot(u, v)
    if slip > 4 * MU_SLIDE * G * STEP:
        a, b = (MU_SLIDE * G * STEP * part / slip for part in (u - p, v - q))
        u, v, p, q = u - a, v - b, p + 2.5 * a, q + 2.5 * b
    else:
        left = max(0.0, 1 - (MU_ROLL * G + DRAG * speed**2) * STEP / speed) if speed else 0.0
        u, v = p, q = u * left, v * left
    ball.update(place=(x + u * STEP, y + v * STEP), v=(u, v), roll=(p, q))


def collide(cue, target):
    """An impact of equal balls, if they touch and approach."""
    x, y = (b - a for a, b in zip(cue["place"], target["place"]))
    distance = math.hypot(x, y)
    (u, v), (p, q) = cue["v"], target["v"]
    speed = ((u - p) * x + (v - q) * y) / distance
    if distance > 2 * R or speed <= 0:
        return
    a, b = ((1 + RESTITUTION) / 2 * speed * part / distance for part in (x, y))
    cue["v"], target["v"] = (u - a, v - b), (p + a, q + b)


def play(name, balls, width, length, rebounds):
    """Prints the rows of a shot, whose balls have their positions, velocities and rolls."""
    turned, step = False, 0
    while step * STEP < LONGEST:
        t = step * STEP
        near = [min(x, width - x, y, length - y) < R + 0.03 for x, y in (b["place"] for b in balls)]
        if any(near) and not rebounds:
            return
        if step % round(1 / RATE / STEP) == 0:
            for ball in balls:
                x, y = (part + chance.gauss(0, NOISE) for part in ball["place"])
                print(f"{name},{ball['name']},{t:.2f},{x:.5f},{y:.5f}")
        if t >= BEFORE:
            for ball in balls:
                advance(ball)
            if len(balls) > 1:
                collide(*balls)
        (x, y), (u, v) = balls[0]["place"], balls[0]["v"]
        if rebounds and not turned and width - x < R:
            balls[0].update(v=(-REBOUND * u, ALONG * v), roll=(-REBOUND * u, ALONG * v))
            turned = True
        step += 1


def ball(name, place, speed=0.0, direction=0.0, follow=1.0):
    v = (speed * math.cos(direction), speed * math.sin(direction))
    return {"name": name, "place": place, "v": v, "roll": (follow * v[0], follow * v[1])}


print("shot,ball,t,x,y")
for number in range(8):
    # a ball that is hit nearly full, as carom throws one that is cut
    target = (0.9 + chance.uniform(-0.2, 0.2), chance.uniform(1.2, 1.6))
    x, y = target[0] - 0.9, target[1] - 0.5
    aim = math.atan2(y, x) + math.asin(chance.uniform(-0.1, 0.1) * R / math.hypot(x, y))
    cue = ball("cue", (0.9, 0.5), chance.uniform(0.7, 1.3), aim, chance.uniform(0, 1))
    play(f"s_{number}", [cue, ball("red", target)], WIDTH, LENGTH, rebounds=False)
play("b_1", [ball("cue", (0.3, 0.5), 0.9, 0.6)], 0.943, 1.881, rebounds=True)
