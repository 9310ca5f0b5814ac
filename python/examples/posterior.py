"""Constants of a table from where balls end, with their errors: emcee over `simulate_batch`, and NUTS
through `carom.jax`.

    pip install emcee numpyro
    python posterior.py

Thirty shots of two balls are played with known constants, and a camera sees both balls after 1.2 s
with an error of 3 mm. Four constants are to be found: sliding friction, rolling resistance, and the
restitution of balls and cushions. Where a constant changes which events a shot has, the density of
the posterior has a cliff that its gradient does not show. NUTS may then stay on one side of it,
without a divergence. So the second NUTS takes only shots that keep their events for REACH deviations
of the posterior, by the reach of their derivatives. The table has mean, deviation and R-hat of two
chains; the last column is how many deviations the mean is off.
"""

import argparse
import time
from collections.abc import Callable
from typing import Any

import emcee
import jax
import jax.numpy as jnp
import numpy as np
from numpy.typing import NDArray
import numpyro
import numpyro.distributions as dist
from numpyro.diagnostics import split_gelman_rubin
from numpyro.infer import MCMC, NUTS

import carom
import carom.jax

Doubles = NDArray[np.float64]
TRUTH: dict[str, Any] = {
    "mu_slide": 0.22,
    "mu_roll": 0.0085,
    "restitution": 0.93,
    "restitution_cushion": 0.83,
}
NAMES = [f"kind.{name}" for name in TRUTH]
LOW, HIGH = np.array([0.1, 0.004, 0.85, 0.6]), np.array([0.35, 0.02, 1.0, 1.0])
AFTER, NOISE = 1.2, 3e-3  # s, m
OPTIONS: Any = {"cushion_model": "han", "t_final": AFTER}
TABLE = carom.tables.pool_9ft()
REACH = 12.0
WALKERS = 24


class Shots:
    """Layouts, cues and what the camera saw."""

    def __init__(self, count: int, seed: int) -> None:
        random = np.random.default_rng(seed)
        first = random.uniform([0.3, 0.3], [0.9, 0.9], (count, 2))
        second = random.uniform([0.3, 1.3], [0.9, 2.2], (count, 2))
        self.places = np.stack([first, second], axis=1)
        way = second - first
        phi = np.degrees(np.arctan2(way[:, 1], way[:, 0])) + random.uniform(-1.5, 1.5, count)
        self.cues = carom.cue(speed=random.uniform(1.0, 2.0, count), phi=phi)
        played = carom.simulate_batch(
            TABLE, carom.balls(self.places, **TRUTH), self.cues, **OPTIONS
        )
        ends = played.final["r"][..., :2]
        self.seen: Doubles = ends + NOISE * random.normal(size=ends.shape)

    def some(self, mask: NDArray[np.bool_]) -> "Shots":
        part = Shots.__new__(Shots)
        part.places, part.cues, part.seen = self.places[mask], self.cues[mask], self.seen[mask]
        return part

    def ends(self, constants: Any, reach: bool = False) -> Any:
        """The final states of all shots with these constants, as JAX has them."""
        layouts, each = carom.balls(self.places), jnp.ones(len(self.places))
        numbers = {name: constants[k] * each for k, name in enumerate(NAMES)}
        return carom.jax.final(TABLE, layouts, self.cues, numbers, reach=reach, **OPTIONS)


def by_emcee(shots: Shots, steps: int) -> Doubles:
    """Chains (steps, walkers, constants). All walkers are one batch."""

    def density(point: Doubles) -> Doubles:
        inside = ((point > LOW) & (point < HIGH)).all(axis=1)
        found = np.full(len(point), -np.inf)
        constants: dict[str, Any] = {
            name: point[inside][:, k, None, None] for k, name in enumerate(TRUTH)
        }
        places = np.broadcast_to(shots.places, (int(inside.sum()), *shots.places.shape))
        played = carom.simulate_batch(
            TABLE, carom.balls(places, **constants), shots.cues[None], **OPTIONS
        )
        off = (played.final["r"][..., :2] - shots.seen) / NOISE
        found[inside] = -2.5 * np.log1p(off**2 / 4.0).sum(axis=(1, 2, 3))
        return found

    sampler = emcee.EnsembleSampler(WALKERS, len(TRUTH), density, vectorize=True)
    random = np.random.default_rng(1)
    begin = LOW + (HIGH - LOW) * (0.45 + 0.02 * random.normal(size=(WALKERS, len(TRUTH))))
    sampler.run_mcmc(begin, steps)
    return np.asarray(sampler.get_chain(discard=steps // 2))


def by_nuts(shots: Shots, steps: int) -> tuple[Doubles, int]:
    """Two chains (2, steps, constants) from different places, and how many divergences they had."""

    def model() -> None:
        unit = numpyro.sample("unit", dist.Uniform(jnp.zeros(len(TRUTH)), 1.0).to_event(1))
        ends = shots.ends(LOW + unit * (HIGH - LOW)).r
        numpyro.sample("seen", dist.StudentT(4.0, ends, NOISE).to_event(3), obs=shots.seen)

    chains, divergences = [], 0
    for seed, begin in ((0, [0.4, 0.4, 0.5, 0.5]), (1, [0.5, 0.3, 0.6, 0.6])):
        start = numpyro.infer.init_to_value(values={"unit": jnp.array(begin)})
        kernel = NUTS(model, dense_mass=True, max_tree_depth=6, init_strategy=start)
        run = MCMC(kernel, num_warmup=steps, num_samples=steps, progress_bar=False)
        run.run(jax.random.PRNGKey(seed))
        chains.append(LOW + np.asarray(run.get_samples()["unit"]) * (HIGH - LOW))
        divergences += int(run.get_extra_fields()["diverging"].sum())
    return np.array(chains), divergences


def steady(shots: Shots, means: Doubles, deviations: Doubles) -> NDArray[np.bool_]:
    """Which shots keep their events for REACH deviations of each constant."""
    found = shots.ends(means, reach=True)
    far = np.stack([np.asarray(found.reach[name]) for name in NAMES], axis=-1) / deviations
    return np.asarray((far > REACH).all(axis=-1))


def show(what: str, chains: Doubles, seconds: float, more: str = "") -> None:
    """A row of the table for each constant."""
    print(f"\n{what}: {seconds:.0f} s{more}\n")
    print("| constant | mean | deviation | R-hat | off |\n|---|--:|--:|--:|--:|")
    for k, (name, true) in enumerate(TRUTH.items()):
        chain = chains[..., k]
        ratio = float(split_gelman_rubin(chain))
        off = (chain.mean() - true) / chain.std()
        print(f"| {name} | {chain.mean():.5f} | {chain.std():.5f} | {ratio:.2f} | {off:+.1f} |")


def timed(work: Callable[[], Any]) -> tuple[Any, float]:
    begin = time.process_time()
    found = work()
    return found, time.process_time() - begin


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument(
        "--steps", type=int, default=200, help="of a chain of NUTS, half of emcee's"
    )
    parser.add_argument("--shots", type=int, default=30)
    options = parser.parse_args(arguments)
    numpyro.enable_x64()
    shots = Shots(options.shots, seed=0)
    chains, seconds = timed(lambda: by_emcee(shots, 20 * options.steps))
    show(f"emcee, {options.shots} shots", chains.swapaxes(0, 1), seconds)
    means, deviations = chains.mean(axis=(0, 1)), chains.std(axis=(0, 1))
    (chains, divergences), seconds = timed(lambda: by_nuts(shots, options.steps))
    show(f"NUTS, {options.shots} shots", chains, seconds, f", {divergences} divergences")
    good = steady(shots, means, deviations)
    (chains, divergences), seconds = timed(lambda: by_nuts(shots.some(good), options.steps))
    what = f"NUTS, the {good.sum()} shots whose reach is above {REACH:g} deviations"
    show(what, chains, seconds, f", {divergences} divergences")


if __name__ == "__main__":
    main()
