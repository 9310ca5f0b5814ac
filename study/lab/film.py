"""film.py LIBRARY FILM.csv, which `carom-lab published --film FILM.csv` runs: filmed shots compared
with those of carom, in tables of Markdown. data/README.md has the columns.

1. Each shot with its strike alone fitted: speed, direction, follow, side and the time of the
   strike. The loss is robust: an error e counts as 2 (sqrt(1 + (e/s)^2) - 1) with s = 4 mm.
2. The constants of each table from its shots: Gauss-Newton steps over all shots, in which each
   shot takes its strike along. A constant is held near its built-in value by a prior.
3. Free rolls: the deceleration a + b v^2 over the stretches on which a track is a parabola.
4. Impacts on cushions and between balls, read off the tracks without a fit of the shot.

Errors come from leaving out one film at a time (jackknife). A film confirms a constant that lies
within two errors of its value, and refutes one beyond three.
"""

import csv
import ctypes
import sys

import numpy as np

from study.lab import published
from study.lab.cushions import SNOOKER, head, kind_for, on_table, row
from study.lab.published import GAME_POOL, GAME_SNOOKER, LIBRARY, OF, ball, reference

# By the first letter of a shot: game, width and length between the noses, radius of the balls, m.
TABLES = {
    "s": (GAME_SNOOKER, 1.778, 3.569, 0.02625),
    "b": (GAME_SNOOKER, 0.943, 1.881, 0.02615),
    "p": (GAME_POOL, 1.27, 2.54, 0.028575),
}
SCALE = 0.004  # m: s of the loss
LOST = 0.5  # m: the error of a position that no shot has
STATE, G = np.dtype(OF["carom_ball_state"]), 9.81


def refuse(path, *why):
    print(f"carom-lab: {path}:", *why, file=sys.stderr)
    sys.exit(2)


def read(path):
    """{shot: {ball: rows of t, x, y}}"""
    shots = {}
    try:
        with open(path, encoding="utf-8", newline="") as file:
            for line in (lines := csv.DictReader(file)):
                place = [float(line[name]) for name in ("t", "x", "y")]
                TABLES[line["shot"][:1]]
                shots.setdefault(line["shot"], {}).setdefault(line["ball"], []).append(place)
    except OSError as error:
        refuse(path, error.strerror)
    except (KeyError, TypeError, ValueError):
        refuse(
            f"{path}:{lines.line_num}", "not shot,ball,t,x,y of a shot that begins with s, b or p"
        )
    for name, balls in shots.items():
        if len(balls.get("cue", ())) < 4:
            refuse(path, f"{name}: needs 4 rows of its ball 'cue'")
    return {
        name: {ball: np.array(rows) for ball, rows in balls.items()}
        for name, balls in shots.items()
    }


def rectangle(game, width, length, radius):
    """A table without pockets."""
    corners = (OF["carom_corner"] * 4)((0, 0), (width, 0), (width, length), (0, length))
    shape, double = OF["carom_table"](), ctypes.c_double
    nose = double(ball(game).nose_height)
    LIBRARY.carom_table_polygon(corners, 4, nose, double(0), double(radius), reference(shape), None)
    return shape


def places(shape, balls, times):
    """Of each ball at each time, m; None where the shot fails."""
    events, shot = (OF["carom_event"] * 64)(), OF["carom_shot"](room=64)
    shot.events = ctypes.cast(events, ctypes.c_void_p)
    options = OF["carom_shot_options"](cushion_model=published.CUSHION_MODEL[0])
    states, within = np.empty((len(times), len(balls)), STATE), np.ascontiguousarray(times)
    failed = LIBRARY.carom_shoot(
        reference(shape), balls, len(balls), None, reference(options), reference(shot)
    ) or LIBRARY.carom_shot_frames(
        balls,
        len(balls),
        reference(shot),
        np.clip(within, 0, shot.time).ctypes.data_as(ctypes.c_void_p),
        ctypes.c_size_t(len(times)),
        None,
        states.ctypes.data_as(ctypes.c_void_p),
        None,
    )
    return None if failed else states["r"][:, :, :2]


# ---- Least squares with the robust loss


def loss(errors):
    return 2 * SCALE**2 * (np.sqrt(1 + (errors / SCALE) ** 2) - 1).sum()


def descend(errors, point, step, low, high, turns):
    """The loss and the point where the steps of Levenberg and Marquardt end, within bounds."""
    point, damping = np.clip(point, low, high), 0.01
    current = errors(point)
    for _ in range(turns):
        # derivatives by differences, in units of the steps; the weights of the loss
        slopes = np.array([errors(point + change) - current for change in np.diag(step)])
        weighted = slopes / np.sqrt(1 + (current / SCALE) ** 2)
        square, slope = weighted @ slopes.T, weighted @ current

        # a shorter step until the loss falls
        incoming = loss(current)
        while damping < 1e6:
            damped = square + np.diag(damping * np.diag(square) + 1e-15)
            trial = np.clip(point - step * np.linalg.solve(damped, slope), low, high)
            errors_there = errors(trial)
            if loss(errors_there) < incoming:
                break
            damping *= 4
        else:
            break
        point, current, damping = trial, errors_there, damping / 8
        if loss(current) > incoming * (1 - 1e-5):
            break
    return loss(current), point


# ---- Shots


class Shot:
    """A filmed shot. A strike is the speed in m/s, the direction in degrees, follow and side in
    R w / v, and the time of the strike in s.
    """

    STEP = np.array([1e-4, 2e-3, 1e-3, 1e-3, 1e-4])

    def __init__(self, name, rows):
        self.name, self.rows = name, rows
        self.game, *size = TABLES[name[0]]
        self.radius = size[-1]
        self.shape = rectangle(self.game, *size)
        self.names = ["cue"] + [ball for ball in rows if ball != "cue"]

        # where the balls begin: in the middle of the first rows, if they lie
        first = [rows[ball][:3, 1:] for ball in self.names]
        self.begins = [r.mean(0) if np.ptp(r, axis=0).max() < 0.008 else r[0] for r in first]

        # the strike, about, by the first two intervals in which the cue ball moves
        cue = rows["cue"]
        gone = np.hypot(*(cue[:, 1:] - self.begins[0]).T)
        start = min(int(np.argmax(gone > 0.03)), len(cue) - 2)
        end = min(start + 2, len(cue) - 1)
        x, y = (cue[end, 1:] - cue[start, 1:]) / (cue[end, 0] - cue[start, 0])
        self.speed, self.direction = np.hypot(x, y), np.degrees(np.arctan2(y, x))
        self.time = cue[start, 0] - gone[start] / max(self.speed, 0.05)
        self.low = np.array([0.02, -1e9, -1.6, -1.6, self.time - 0.3])
        self.high = np.array([12, 1e9, 1.6, 1.6, self.time + 0.2])
        self.use_until(np.inf)

    def use_until(self, time):
        """Counts the rows up to a time only."""
        chosen = [self.rows[ball][self.rows[ball][:, 0] <= time] for ball in self.names]
        self.times, which = np.unique(
            np.concatenate([rows[:, 0] for rows in chosen]), return_inverse=True
        )
        index = np.repeat(np.arange(len(chosen)), [len(rows) for rows in chosen])
        self.which, self.film = (which, index), np.concatenate([rows[:, 1:] for rows in chosen])

    def errors(self, strike, **numbers):
        """carom's places less those of the film, m: x and y of each row."""
        speed, direction, follow, side, time = strike
        x, y = np.cos(np.radians(direction)), np.sin(np.radians(direction))
        spin = np.array([-follow * y, follow * x, side]) * speed / self.radius
        moves = [((speed * x, speed * y, 0), spin)] + [((0, 0, 0), (0, 0, 0))] * len(self.names)
        balls = [
            published.shot_ball(
                (*place, self.radius), *motion, self.game, **{"radius": self.radius, **numbers}
            )
            for place, motion in zip(self.begins, moves)
        ]
        found = places(self.shape, (OF["carom_shot_ball"] * len(balls))(*balls), self.times - time)
        if found is None:
            return np.full(self.film.size, LOST)
        return np.nan_to_num((found[self.which] - self.film).ravel(), nan=LOST)

    def follow_from(self, strike, turns, **numbers):
        return descend(
            lambda strike: self.errors(strike, **numbers),
            np.array(strike),
            self.STEP,
            self.low,
            self.high,
            turns,
        )

    def strike(self, **numbers):
        """The loss and the best strike. It is found from ever more of the shot: a search over what
        a ball meets later begins with the earlier part already right.
        """
        self.use_until(self.time + 0.5)
        found = [
            self.follow_from([1.02 * self.speed, self.direction, f, 0, self.time], 12, **numbers)
            for f in (-1, -0.3, 0.4, 1)
        ]
        found.sort(key=lambda candidate: candidate[0])
        starts = [[*best[:3], side, best[4]] for _, best in found[:3] for side in (-0.6, 0, 0.6)]
        for until, chosen, turns in ((1.2, 6, 12), (2.2, 4, 12), (3.6, 3, 15), (np.inf, 1, 40)):
            self.use_until(self.time + until)
            found = [self.follow_from(start, turns, **numbers) for start in starts]
            found.sort(key=lambda candidate: candidate[0])
            starts = [best for _, best in found[:chosen]]
        return found[0]

    def rms(self, strike, **numbers):
        """mm: root mean square and median of the distances."""
        off = 1e3 * np.hypot(*self.errors(strike, **numbers).reshape(-1, 2).T)
        return np.sqrt((off**2).mean()), np.median(off)


# ---- Constants

# of what a film tells: the step of the differences, and how far a value may well be
FREE = {
    "mu_slide": (4e-3, 0.05),
    "mu_roll": (2e-4, 0.01),
    "drag": (1e-3, 0.02),
    "restitution": (4e-3, 0.06),
    "restitution_cushion": (4e-3, 0.1),
    "mu_cushion": (5e-3, 0.12),
}


def jackknife(values):
    """The standard error, from values that leave out one film each."""
    values = np.array(values)
    m = len(values)
    return np.sqrt((m - 1) / m * ((values - values.mean(0)) ** 2).sum(0))


def normal_equations(shot, strike, current, free):
    """Square and slope of a shot's loss by the constants, once the strike follows them."""
    step = np.array([FREE[name][0] for name in free])

    def slopes(change, point):
        return np.array([(change(d) - change(-d)) / 2 for d in np.diag(point)]).T

    errors = shot.errors(strike, **current)
    by_strike = slopes(lambda d: shot.errors(strike + d, **current), 10 * shot.STEP)
    by_number = slopes(
        lambda d: shot.errors(strike, **{n: current[n] + c for n, c in zip(free, d)}), step
    )

    # rows that another course of the shot moves tell nothing of a small change
    calm = (np.abs(by_number).max(1) < 0.06) & (np.abs(by_strike).max(1) < 0.06)
    calm &= np.abs(errors) < 0.1
    if calm.sum() < 20:
        return np.zeros((len(free), len(free))), np.zeros(len(free))
    weight = 1 / np.sqrt(np.maximum(1, np.abs(errors[calm]) / 0.006))[:, None]
    base, _ = np.linalg.qr(by_strike[calm] * weight)
    X, y = by_number[calm] / step * weight, errors[calm] * weight[:, 0]
    X, y = X - base @ (base.T @ X), y - base @ (base.T @ y)

    # neighbouring rows err alike: one in 16 counts
    noise = 4 * max(np.sqrt((y**2).mean()), 0.003)
    return X.T @ X / noise**2, X.T @ y / noise**2


def constants(shots, turns=5, free=tuple(FREE)):
    """{name: (built-in value, the films' value, its error)} and the strikes."""
    built_in = {name: getattr(ball(shots[0].game), name) for name in free}
    current = {name: max(value, FREE[name][0]) for name, value in built_in.items()}
    prior = np.array([FREE[name][1] for name in free]) ** -2.0
    strikes = {shot.name: shot.strike(**current)[1] for shot in shots}
    for turn in range(turns):
        parts = []
        for shot in shots:
            found = shot.follow_from(strikes[shot.name], 25, **current)
            if turn == 1:
                found = min(found, shot.strike(**current), key=lambda candidate: candidate[0])
            strikes[shot.name] = found[1]
            parts.append(normal_equations(shot, found[1], current, free))
        square, slope = (sum(part[k] for part in parts) for k in (0, 1))
        square = square + np.diag(prior)
        slope = slope + prior * [current[name] - built_in[name] for name in free]
        move = -np.linalg.solve(square, slope)
        without = [np.linalg.solve(square - A, g - slope) for A, g in parts]
        for name, change in zip(free, np.clip(0.8 * move, -0.04, 0.04)):
            current[name] = min(max(current[name] + change, FREE[name][0]), 1)
    error = jackknife(without)
    return {name: (built_in[name], current[name], e) for name, e in zip(free, error)}, strikes


# ---- Free rolls


def parabola(rows):
    """Coefficients of 1, t and t^2 in x and y about the middle of the rows; what remains; the time
    they span.
    """
    t = rows[:, 0] - rows[:, 0].mean()
    A = np.array([np.ones(len(t)), t, t * t]).T
    fitted = np.linalg.lstsq(A, rows[:, 1:], rcond=None)[0]
    return fitted, rows[:, 1:] - A @ fitted, t[-1] - t[0]


def stretches(rows, most=0.0022):
    """The longest parts of a track that are parabolas: a ball that rolls, or slides straight on."""
    interval, begin = np.median(np.diff(rows[:, 0])), 0
    while begin < len(rows) - 6:
        found, end = None, begin + 7
        while end <= len(rows) and np.diff(rows[begin:end, 0]).max() < 5.5 * interval:
            fitted, off, span = parabola(rows[begin:end])
            if np.sqrt((off**2).mean()) > most or np.abs(off[-3:]).max() > 4 * most:
                break
            found, end = (fitted, off, span, end - begin), end + 1
        if found:
            yield found
        begin += found[3] if found else 1


def rolls(tracks):
    """(film, speed, deceleration, its variance) of each stretch of 0.7 s or more."""
    for name, balls in tracks.items():
        for rows in balls.values():
            for fitted, off, span, count in stretches(rows):
                speed = np.hypot(*fitted[1])
                error = 1.5 * np.sqrt(720 / count) * off.std() / span**2
                if count < 8 or span < 0.7 or speed < 0.05 or error > 0.05:
                    continue
                slowing = -2 * fitted[2] @ fitted[1] / speed
                if slowing < 0.35:  # m/s^2; a ball that slides slows by 2
                    yield name, speed, slowing, error**2 + 0.012**2


def rolling(tracks):
    """mu_roll and drag with their errors, and the numbers of stretches and films."""
    found = list(rolls(tracks))
    names = np.array([candidate[0] for candidate in found])
    speed, slowing, variance = np.array([candidate[1:] for candidate in found]).T

    def fit(chosen):
        A = (
            np.array([np.full(chosen.sum(), G), speed[chosen] ** 2]).T
            / np.sqrt(variance[chosen])[:, None]
        )
        return np.linalg.lstsq(A, slowing[chosen] / np.sqrt(variance[chosen]), rcond=None)[0]

    films = sorted(set(names))
    errors = jackknife([fit(names != film) for film in films])
    return fit(names == names), errors, len(found), len(films)


# ---- Impacts on cushions


def line(rows, at):
    """Velocity of rows, and how far they lie off a straight line, rms."""
    A = np.array([np.ones(len(rows)), rows[:, 0] - at]).T
    fitted = np.linalg.lstsq(A, rows[:, 1:], rcond=None)[0]
    return fitted[1], np.sqrt(((rows[:, 1:] - A @ fitted) ** 2).mean())


def is_rolling(rows):
    """Whether the rows before an impact are a parabola of a ball that does not slide."""
    if len(rows) < 12 or rows[-1, 0] - rows[0, 0] > 0.85:
        return False
    fitted, off, span = parabola(rows)
    way = fitted[1] + fitted[2] * span
    slowing = abs(2 * fitted[2] @ way) / np.hypot(*way)
    return bool(np.sqrt((off**2).mean()) < 0.0035 and slowing < 0.4)


def impacts(rows, width, length, radius):
    """(whether the ball rolls, velocity before, mean velocity over five rows after), across the
    cushion and along it, m/s.
    """
    interval = np.median(np.diff(rows[:, 0]))
    for axis, size in ((0, width), (1, length)):
        k = 4
        while k < len(rows) - 5:
            place = rows[:, 1 + axis]
            side = 1 if place[k] > size / 2 else -1
            wall = size - radius if side > 0 else radius
            turns = (
                abs(place[k] - wall) < 0.05
                and (place[k] - place[k - 1]) * side >= 0
                and (place[k + 1] - place[k]) * side <= 0
                and abs(place[k - 1] - place[k - 3]) > 0.008
            )
            k += 1
            if not turns:
                continue
            incoming, outgoing = rows[max(0, k - 7) : k - 1], rows[k : k + 5]
            gaps = np.ptp(incoming[:, 0]), np.ptp(outgoing[:, 0]), rows[k, 0] - rows[k - 2, 0]
            if (np.array(gaps) > np.array([8, 7, 3.2]) * interval).any():
                continue

            # straight lines through what does not touch the cushion
            incoming, outgoing = (
                part[abs(part[:, 1 + axis] - wall) > 0.004] for part in (incoming, outgoing)
            )
            if min(len(incoming), len(outgoing)) < 3:
                continue
            v, off_before = line(incoming, incoming[-1, 0])
            u, off_after = line(outgoing, outgoing[0, 0])
            if max(off_before, off_after) > 0.004:
                continue
            along = np.sign(v[1 - axis]) or 1
            v, u = ((w[axis] * side, w[1 - axis] * along) for w in (v, u))
            if v[0] > 0.08 and u[0] < -0.03:
                yield is_rolling(rows[max(0, k - 17) : k - 2]), np.array(v), np.array(u)
                k += 3


WIDE = (4, 8)  # m: a table on which a ball meets one cushion only


def seen(game, radius, incoming, side=0, **numbers):
    """The mean velocity that the film would see after an impact of a ball that rolls."""
    x, y = incoming
    spin = np.array([-y, x, side * np.hypot(x, y)]) / radius
    start = (WIDE[0] - radius - 1e-4, 2, radius)
    rolls = published.shot_ball(start, (x, y, 0), spin, game, **{"radius": radius, **numbers})
    times = 0.04 * np.arange(1, 6)
    found = places(rectangle(game, *WIDE, radius), (OF["carom_shot_ball"] * 1)(rolls), times)[:, 0]
    return np.polyfit(times, found, 1)[0]


# ---- Impacts of two balls


def speed_at_hit(times, gone, friction):
    """The speed of a ball and the time at which it left its position, from how far it is gone: it
    slides until it has lost 2/7 of the speed, and rolls on.
    """
    slowing = friction * G

    def errors(point):
        speed, start = point
        until = 2 * speed / 7 / slowing
        t = np.maximum(times - start, 0)
        slid = np.minimum(t, until)
        return speed * t - slowing * slid * (t - slid / 2) - gone

    interval = times[-1] - times[-2]
    start = [gone[-1] / (times[-1] - times[0] + interval), times[0] - interval / 2]
    return descend(errors, start, np.array([1e-4, 1e-5]), -np.inf, np.inf, 40)[1]


def hits(tracks):
    """(film, cut in degrees, speed of the cue ball, restitution) of first hits: the object ball's
    speed along its way, over that of the cue ball in this direction just before.
    """
    for name, balls in tracks.items():
        game, width, length, radius = TABLES[name[0]]
        cue, found = balls["cue"], []
        interval = np.median(np.diff(cue[:, 0]))
        for rows in (balls[ball] for ball in balls if ball != "cue"):
            gone = np.hypot(*(rows[:, 1:] - rows[:3, 1:].mean(0)).T)
            first = int(np.argmax(gone > 0.012))
            if first > 1:
                found.append((rows[first, 0], first, rows, gone))
        if not found:
            continue

        # the first five rows of the ball that moves first, away from cushions
        _, first, rows, gone = min(found, key=lambda candidate: candidate[0])
        part = slice(first, first + 5)
        x, y = rows[part, 1:].T
        free = np.minimum.reduce([x, width - x, y, length - y]) > radius + 0.02
        times, gone = rows[part, 0][free], gone[part][free]
        if len(times) < 4:
            continue
        speed, start = speed_at_hit(times, gone, ball(game).mu_slide)
        way = line(rows[part][free], start)[0]
        way /= np.hypot(*way)

        # the cue ball at that time, by the parabola of the rows before
        incoming = cue[(cue[:, 0] < start - 0.2 * interval) & (cue[:, 0] > start - 8.5 * interval)]
        if len(incoming) < 6 or start - incoming[-1, 0] > 3 * interval:
            continue
        fitted, off, _ = parabola(incoming)
        v = fitted[1] + 2 * fitted[2] * (start - incoming[:, 0].mean())
        along = v @ way
        if off.std() < 0.004 and along > 0.3:
            cut = np.degrees(np.arccos(min(along / np.hypot(*v), 1)))
            yield name, cut, np.hypot(*v), 2 * speed / along - 1


# ---- Tables


def verdict(built_in, value, error):
    off = abs(value - built_in) / error
    return "confirmed" if off <= 2 else "refuted" if off > 3 else "open"


def judged(name, how, built_in, value, error):
    if not error > 0:
        row(name, f"{built_in:.4g}", "-", "not told", how)
        return
    places = max(0, 1 - int(np.floor(np.log10(error))))
    film = f"{value:.{places}f} ± {error:.{places}f}"
    row(name, f"{built_in:.4g}", film, verdict(built_in, value, error), how)


def strikes(shots):
    """Table 1."""
    found = {}
    head("shot", "rms, mm", "median", "m/s", "degrees", "follow", "side")
    for shot in shots:
        best = shot.strike()[1]
        found[shot.name], middle = shot.rms(best)
        speed, direction, follow, side, _ = best
        numbers = f"{speed:.2f}", f"{direction % 360:.1f}", f"{follow:.2f}", f"{side:.2f}"
        row(shot.name, f"{found[shot.name]:.1f}", f"{middle:.1f}", *numbers)
    print()
    for letter in TABLES:
        of_table = [rms for name, rms in found.items() if name[0] == letter]
        if of_table:
            print(f"{letter}_: median rms {np.median(of_table):.1f} mm of {len(of_table)} shots")


def numbers(shots, tracks):
    """Tables 2 to 4: the numbers of snooker."""
    snooker = ball(GAME_SNOOKER)
    head("snooker", "built in", "films", "verdict", "by")
    for name, values in constants(shots)[0].items():
        judged(name, f"{len(shots)} whole shots", *values)
    values, errors, count, films = rolling(tracks)
    for name, value, error in zip(("mu_roll", "drag"), values, errors):
        judged(name, f"{count} free rolls of {films} films", getattr(snooker, name), value, error)
    restitution = [e for _, cut, _, e in hits(tracks) if cut < 45]
    error = np.std(restitution, ddof=1) / np.sqrt(len(restitution))
    how = f"{len(restitution)} hits, cut below 45 degrees"
    judged("restitution", how, snooker.restitution, np.mean(restitution), error)


def impacts_by_laws(tracks):
    """Table 5: m/s and degrees from the normal, of balls that roll, without side spin in carom."""
    head("impact", "before", *("after: film", *SNOOKER))
    for name, balls in tracks.items():
        game, *size = TABLES[name[0]]
        for label, rows in balls.items():
            for rolls, v, u in impacts(rows, *size):
                # a ball that loses more has met another ball
                if not rolls or game != GAME_SNOOKER or np.hypot(*u) < 0.4 * np.hypot(*v):
                    continue
                outgoing = [u]
                for model, _ in SNOOKER.values():
                    kind = kind_for(GAME_SNOOKER, model)
                    on_table({name: getattr(kind, name) for name, *_ in kind._fields_}, model)
                    outgoing.append(seen(GAME_SNOOKER, size[2], v))
                on_table({}, 0)
                motions = [(v[0], v[1])] + [(-w[0], w[1]) for w in outgoing]
                angles = [np.degrees(np.arctan2(along, across)) for across, along in motions]
                cells = [f"{np.hypot(*w):.2f}, {a:.0f}" for w, a in zip(motions, angles)]
                row(f"{name} {label}", *cells)


if __name__ == "__main__":
    TRACKS = read(sys.argv[2])
    SHOTS = [Shot(name, rows) for name, rows in TRACKS.items()]
    strikes(SHOTS)
    numbers([shot for shot in SHOTS if shot.name[0] == "s"], TRACKS)
    impacts_by_laws(TRACKS)
