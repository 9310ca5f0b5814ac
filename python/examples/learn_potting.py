"""An agent learns which ball to pot, and how: a policy of ten numbers, found by the cross-entropy method.

A stroke of `carom.potting.Potting` with noise of execution: four balls and the cue ball lie at random. For every ball and pocket the
policy takes the ghost ball, the place where the cue ball must touch the ball to drive it to the pocket. It has a value for each of these
aims, plays the best one, and chooses the speed, a correction of the aim and the height of the tip:

    value      = -w1 cut - w2 way of the cue ball - w3 way of the ball - w4 balls in the way
    speed      = s0 + s1 way of the cue ball + s2 way of the ball + s3 cut
    correction = c sin(cut) degrees, to the thinner side: friction throws the ball towards the thicker
    tip        = t above the centre

with w, s, c and t to be learnt. Each generation draws policies from normal distributions, one for each number, and all of them play the
same layouts, in one batch; the distributions move to the mean and spread of the best eighth (R. Y. Rubinstein, Methodology and Computing in
Applied Probability 1 (1999) 127-190). The curve is the mean of balls potted less fouls by the policy in the middle, on layouts that it has
not learnt from.

    python learn_potting.py --generations 40 --seed 1 --out learning.svg
"""

from __future__ import annotations

import argparse

import numpy as np
import numpy.typing as npt

import carom
import picture
from carom.potting import Draws, Potting

Doubles = npt.NDArray[np.float64]
NAMES = "w1 w2 w3 w4 s0 s1 s2 s3 c t".split()
FIRST = np.array([0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0])  # any aim, at 2 m/s, on the line of the ghost ball
SPREAD = np.array([1.0, 1.0, 1.0, 1.0, 0.7, 0.5, 0.5, 0.5, 1.0, 0.3])
POPULATION, LAYOUTS, TESTED = 48, 96, 2000


def blocked(start: Doubles, end: Doubles, centres: Doubles, radius: float) -> Doubles:
    """How many balls stand in the ways from start to end, (..., 2), of a ball; centres (..., n, 2), nan for those that do not count."""
    way = end - start
    along = ((centres - start[..., np.newaxis, :]) * way[..., np.newaxis, :]).sum(-1) / (way**2).sum(-1)[..., np.newaxis]
    nearest = start[..., np.newaxis, :] + np.clip(along, 0.0, 1.0)[..., np.newaxis] * way[..., np.newaxis, :]
    off = np.linalg.norm(centres - nearest, axis=-1)
    return np.asarray((off < 2.0 * radius).sum(axis=-1), dtype=np.float64)


class Aims:
    """All aims of layouts, (games, balls, pockets): what a policy knows of them."""

    def __init__(self, rules: Potting, layouts: carom.dtypes.Records) -> None:
        centres = layouts["state"]["r"][..., :2]
        cue_ball, balls = centres[:, np.newaxis, np.newaxis, 0], centres[:, 1:, np.newaxis]
        to_pocket = rules.table.pockets["centre"] - balls
        self.way = np.linalg.norm(to_pocket, axis=-1)
        line = to_pocket / self.way[..., np.newaxis]
        ghost = balls - 2.0 * rules.radius * line
        to_ghost = np.broadcast_to(ghost - cue_ball, ghost.shape)
        self.reach = np.linalg.norm(to_ghost, axis=-1)
        self.phi = np.degrees(np.arctan2(to_ghost[..., 1], to_ghost[..., 0]))
        cross = to_ghost[..., 0] * line[..., 1] - to_ghost[..., 1] * line[..., 0]
        self.cut = np.arctan2(cross, (to_ghost * line).sum(-1))  # signed, rad
        own = np.eye(rules.balls, dtype=bool)[:, np.newaxis]
        others = np.where(own[..., np.newaxis], np.nan, centres[:, np.newaxis, np.newaxis, 1:])
        start = np.broadcast_to(balls, ghost.shape)
        pockets = np.broadcast_to(rules.table.pockets["centre"], ghost.shape)
        cue_start = np.broadcast_to(cue_ball, ghost.shape)
        radius = rules.radius
        self.in_the_way = blocked(start, pockets, others, radius) + blocked(cue_start, ghost, others, radius)

    def actions(self, rules: Potting, policies: Doubles) -> Doubles:
        """The actions of policies, (policies, 10), in all layouts: (policies, games, 4)."""
        w, s, c, t = policies[:, :4], policies[:, 4:8], policies[:, 8], policies[:, 9]
        known = np.stack([np.abs(self.cut), self.reach, self.way, self.in_the_way], axis=-1)
        # A ball that would have to be cut by a right angle or more cannot be driven to that pocket.
        values = np.where(np.abs(self.cut) < 1.5, -np.einsum("pk,gbok->pgbo", w, known), -1e6)
        chosen = values.reshape(*values.shape[:2], -1).argmax(axis=-1)
        games = np.arange(len(known))
        cut, reach, way, phi = (x.reshape(len(known), -1)[games, chosen] for x in (self.cut, self.reach, self.way, self.phi))
        speed = s[:, :1] + s[:, 1:2] * reach + s[:, 2:3] * way + s[:, 3:] * np.abs(cut)
        thinner = c[:, np.newaxis] * np.sin(cut)
        return rules.actions(phi - thinner, np.clip(speed, *rules.speeds), b=np.clip(t, -1.0, 1.0)[:, np.newaxis])


def returns(rules: Potting, policies: Doubles, layouts: carom.dtypes.Records, aims: Aims, seed: int) -> Doubles:
    """The rewards of policies in layouts, (policies, games), each stroke with its own noise."""
    actions = aims.actions(rules, policies)
    many = actions.shape[0] * actions.shape[1]
    done = rules.disturbed(actions.reshape(many, 4), Draws(np.arange(many) + (seed << 32)), np.arange(many))
    return rules.play(layouts, done.reshape(actions.shape)).rewards


def learn(rules: Potting, generations: int, seed: int) -> tuple[Doubles, Doubles, Doubles]:
    """The policies in the middle, (generations + 1, 10), their curve, and that of the best eighth, (generations,)."""
    generator = np.random.default_rng(seed)
    tested = rules.deal(Draws(np.arange(TESTED) + (1 << 62)), np.arange(TESTED))
    test_aims = Aims(rules, tested)
    middle, spread = FIRST.copy(), SPREAD.copy()
    policies, curve, best = [middle.copy()], [], []
    for generation in range(generations + 1):
        curve.append(returns(rules, middle[np.newaxis], tested, test_aims, 0).mean())
        if generation == generations:
            break
        layouts = rules.deal(Draws(generator.integers(2**62, size=LAYOUTS)), np.arange(LAYOUTS))
        drawn = middle + spread * generator.standard_normal((POPULATION, len(middle)))
        gains = returns(rules, drawn, layouts, Aims(rules, layouts), generation + 1).mean(axis=1)
        elite = drawn[np.argsort(gains)[-POPULATION // 8 :]]
        best.append(np.sort(gains)[-POPULATION // 8 :].mean())
        # Half of the way, so that a lucky generation does not end the search.
        middle += 0.5 * (elite.mean(axis=0) - middle)
        spread += 0.5 * (elite.std(axis=0) - spread)
        policies.append(middle.copy())
    return np.array(policies), np.array(curve), np.array(best)


def main(arguments: list[str] | None = None) -> tuple[Doubles, Doubles]:
    """Learns, prints, draws the curve; gives the last policy and the curve."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--generations", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", default="learning.svg")
    given = parser.parse_args(arguments)
    rules = Potting(balls=4, strokes=1, noise=(0.3, 0.05, 0.01), cushion_model="han", threads=carom.ALL_THREADS)
    policies, curve, best = learn(rules, given.generations, given.seed)
    print(f"{POPULATION * LAYOUTS * given.generations} strokes of {POPULATION} policies in {given.generations} generations")
    print(f"balls potted a stroke, less fouls: {curve[0]:.2f} at first, {curve[-1]:.2f} at the end")
    print("  ".join(f"{name} {value:.2f}" for name, value in zip(NAMES, policies[-1], strict=True)))

    figure, (left, right) = picture.start(2, (10.0, 4.0))
    left.plot(np.arange(len(curve)), curve, color=picture.BLUE, label="policy in the middle, 2000 layouts not learnt from")
    left.plot(np.arange(len(best)), best, ".", color=picture.ORANGE, label="best eighth, on the layouts it is chosen by")
    left.set(xlabel="generation", ylabel="balls potted a stroke, less fouls")
    right.plot(policies, label=NAMES)
    right.set(xlabel="generation", ylabel="number of the policy")
    left.legend(frameon=False, fontsize="small")
    right.legend(frameon=False, fontsize="small", ncols=2)
    picture.save(figure, given.out)
    return policies[-1], curve


if __name__ == "__main__":
    main()
