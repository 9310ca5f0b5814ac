"""Throw against cut angle, for stun, follow and draw, where friction between the balls falls with the speed of their slip.

A cut leaves the object ball not quite on the line of centres: friction drags it along with the cue ball's surface. While the
surfaces slip throughout, the tangent of this throw is the coefficient of friction (of its part across); a slow or full hit ends
the slip before the balls part, and then the throw is less. The law is mu = a + b exp(-c |u|): `carom.mu_ball`.

Measured are three points: Marlow's friction at a cut of 45 degrees and 0.1, 1 and 10 m/s (W. C. Marlow, The Physics of Pocket
Billiards, 1995, table 10), as D. Alciatore's technical proofs TP A-14 and TP A-28 give them. Alciatore fitted the law to them:
they show that the solver turns a friction that was measured into that throw, and are no proof of the law between them.

    python throw.py --draws 400 --out throw.svg
"""

from __future__ import annotations

import argparse

import numpy as np
import numpy.typing as npt

import carom
import picture

Doubles = npt.NDArray[np.float64]
RADIUS = 0.028575  # m

# Marlow's points: speed of the cue ball (m/s) at a cut of 45 degrees, and the friction that was measured (dimensionless).
MEASURED_CUT = 45.0
MEASURED = ((0.1, 0.11), (1.0, 0.06), (10.0, 0.01))

# The cue ball's spin about the horizontal axis across its way, in units of that of a rolling ball.
SPINS = {"stun": 0.0, "follow": 1.0, "draw": -1.0}


def cuts(cut: float | Doubles, speed: float, spin: str) -> carom.dtypes.Records:
    """A cue ball that runs along x hits one at rest that lies to its left by the cut angles, degrees: impacts of their shape."""
    angle = np.radians(np.asarray(cut, dtype=np.float64))
    centres = 2 * RADIUS * np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=-1)
    pairs = carom.impacts(v_a=(speed, 0, 0), w_a=(0, SPINS[spin] * speed / RADIUS, 0), r_b=centres, radius=RADIUS)
    pairs["mu_ball"] = carom.mu_ball(pairs)
    return pairs


def throw(cut: float | Doubles, speed: float, spin: str) -> Doubles:
    """The angle from the line of centres to the object ball's way, towards the cue ball's, degrees."""
    motion, status = carom.collide(cuts(cut, speed, spin))
    assert (status == carom.Status.OK).all()
    v = motion["b"]["v"]
    return np.asarray(cut - np.degrees(np.arctan2(v[..., 1], v[..., 0])))


def measured_throw() -> Doubles:
    """What Marlow's friction throws a ball by that slips throughout, degrees, one for each of MEASURED."""
    angles: Doubles = np.degrees(np.arctan([mu for _, mu in MEASURED]))
    return angles


def draw(out: str, draws: int) -> None:
    """The picture: the law, throw by speed, throw by spin."""
    cut = np.linspace(0.0, 89.0, draws)
    figure, (law, by_speed, by_spin) = picture.start(3, (11.4, 4.0))
    hues = (picture.BLUE, picture.GREEN, picture.RED)

    # The friction itself, over slip; Marlow's slip is the part of the speed across the line of centres.
    a, b, c = carom.alciatore()
    slip = np.geomspace(0.01, 20, draws)
    law.semilogx(slip, a + b * np.exp(-c * slip), color=picture.INK)
    for (speed, mu), hue in zip(MEASURED, hues, strict=True):
        law.plot(speed * np.sin(np.radians(MEASURED_CUT)), mu, "o", ms=8, mfc="white", mec=hue, mew=2.2)
        law.text(speed * np.sin(np.radians(MEASURED_CUT)) * 1.5, mu + 0.003, f"{speed:g} m/s", color=hue)
    law.plot([], [], "o", ms=8, mfc="white", mec=picture.GREY, mew=2.2, label="measured (Marlow), cut 45°")
    law.plot([], [], color=picture.INK, label=f"μ = {a:.3g} + {b:.3g} exp(−{c:.4g} |u|)")
    law.legend(loc="upper right", frameon=False, borderpad=0, handlelength=1.2)
    law.set(title="Friction falls with slip", xlabel="speed of slip |u| before impact (m/s)", ylim=(0, 0.15))
    law.set_ylabel("friction between the balls μ (–)")
    law.set_yticks(np.arange(0, 0.15, 0.02))
    law.set_xticks([0.01, 0.1, 1, 10], ["0.01", "0.1", "1", "10"])

    # Stun: without vertical slip, so the throw is atan(mu) unless the slip ends.
    for (speed, _), at, hue in zip(MEASURED, measured_throw(), hues, strict=True):
        by_speed.plot(cut, throw(cut, speed, "stun"), color=hue)
        by_speed.plot(MEASURED_CUT, at, "o", ms=8, mfc="white", mec=hue, mew=2.2, zorder=3)
        by_speed.text(88, float(throw(88.0, speed, "stun")) + 0.18, f"{speed:g} m/s", color=hue, ha="right")
    by_speed.annotate(
        "here slip ends before\nthe balls part", (31.6, 5.15), (42, 4.88), arrowprops={"arrowstyle": "-", "color": picture.GREY}
    )
    by_speed.set(title="Stun, by the speed of the cue ball", xlabel="cut angle (degrees)", ylabel="throw (degrees)", ylim=(0, 7))

    # The same cut with spin: part of the friction lifts or presses, and less is left to throw.
    lines = ((picture.GREEN, "-", (31, 4.3)), (picture.ORANGE, "-", (46, 1.45)), (picture.PURPLE, "--", (60, 1.45)))
    for spin, (hue, line, place) in zip(SPINS, lines, strict=True):
        by_spin.plot(cut, throw(cut, 1.0, spin), color=hue, ls=line)
        by_spin.text(*place, spin if spin != "draw" else "and draw", color=hue)
    by_spin.set(title="By spin, at 1 m/s", xlabel="cut angle (degrees)", ylabel="throw (degrees)", ylim=(0, 7))
    for axes in (by_speed, by_spin):
        axes.set_xlim(0, 90)
        axes.set_xticks(range(0, 91, 15))
    picture.save(figure, out)


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--draws", type=int, default=400, help="cut angles a curve")
    parser.add_argument("--out", default="throw.svg", help="the picture, .svg or .png")
    given = parser.parse_args(arguments)
    cut = np.linspace(0.0, 89.0, given.draws)
    for spin in SPINS:
        angles = throw(cut, 1.0, spin)
        print(f"{spin:6} at 1 m/s: at most {angles.max():.2f} degrees, at a cut of {cut[angles.argmax()]:.1f}")
    for (speed, _), at in zip(MEASURED, measured_throw(), strict=True):
        ours = float(throw(MEASURED_CUT, speed, "stun"))
        print(f"stun at {speed:g} m/s, cut {MEASURED_CUT:g}: {ours:.3f} degrees; Marlow's friction gives {at:.3f}")
    draw(given.out, given.draws)


if __name__ == "__main__":
    main()
