"""The same batch of shots on this machine, over a cluster of Dask or over one of Ray, with the same
bits.

A part of the batch is a few numbers, from which whoever plays it draws its cues; what comes back is
how many shots potted how many balls, and a digest (SHA-256) of all final states, by which two ways
can be compared. Without --address a cluster of --workers processes is started here.

    python on_a_cluster.py --by local
    python on_a_cluster.py --by dask --workers 2
    python on_a_cluster.py --by ray --address auto
"""

from __future__ import annotations

import argparse
import concurrent.futures
import contextlib
import hashlib
import importlib
import time
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

import carom


class Part(NamedTuple):
    """Which shots: those of the part of this number, of a batch with this seed."""

    seed: int
    number: int
    shots: int
    threads: int


Summary = tuple[
    bytes, NDArray[np.int64]
]  # of a part: digest of the final states, and how many shots potted 0, 1, ... balls


def play(part: Part) -> Summary:
    """Plays a part: breaks of nine-ball with the cue's direction and speed drawn at random.

    This runs in the workers.
    """
    generator = np.random.default_rng([part.seed, part.number])
    cues = carom.cue(
        speed=generator.uniform(4.0, 10.0, part.shots),
        phi=generator.uniform(85.0, 95.0, part.shots),
    )
    table = carom.tables.pool_9ft()
    rack = carom.racks.nineball(table)
    rack["kind"] = carom.balls([[0.0, 0.0]], cushion_model="han")["kind"]
    shots = carom.simulate_batch(table, rack, cues, cushion_model="han", threads=part.threads)
    digest = hashlib.sha256(shots.final.tobytes() + shots.status.tobytes()).digest()
    down = (shots.final["label"] == carom.Label.POCKETED).sum(axis=-1)
    return digest, np.bincount(down, minlength=11)


def by_processes(parts: list[Part], workers: int, address: str) -> Iterator[Summary]:
    with concurrent.futures.ProcessPoolExecutor(workers) as pool:
        yield from pool.map(play, parts)


def by_dask(parts: list[Part], workers: int, address: str) -> Iterator[Summary]:
    """Over a scheduler of Dask. Summaries are taken in the order of the parts."""
    distributed: Any = importlib.import_module("distributed")
    with contextlib.ExitStack() as stack:
        if not address:
            cluster = distributed.LocalCluster(
                n_workers=workers, threads_per_worker=1, processes=True, dashboard_address=None
            )
            address = stack.enter_context(cluster).scheduler_address
        client = stack.enter_context(distributed.Client(address))
        for future in client.map(play, parts, pure=False):
            yield future.result()


def by_ray(parts: list[Part], workers: int, address: str) -> Iterator[Summary]:
    """Over Ray. Each task asks for as many processors as it has threads."""
    ray: Any = importlib.import_module("ray")
    if address:
        ray.init(address=address)
    else:
        ray.init(address="local", num_cpus=workers, include_dashboard=False, logging_level="error")
    remote = ray.remote(num_cpus=max(1, parts[0].threads))(play)
    for reference in [remote.remote(part) for part in parts]:
        yield ray.get(reference)
    ray.shutdown()


# local: in this process, one part after another; --threads of C
WAYS: dict[str, Callable[..., Iterator[Summary]]] = {
    "local": lambda parts, *_: map(play, parts),
    "processes": by_processes,
    "dask": by_dask,
    "ray": by_ray,
}


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--by", choices=WAYS, default="local")
    parser.add_argument(
        "--address", default="", help="of a scheduler of Dask or a head of Ray that runs already"
    )
    parser.add_argument(
        "--workers", type=int, default=2, help="processes: how many to start, or how many there are"
    )
    parser.add_argument("--threads", type=int, default=1, help="of each part; -1: all processors")
    parser.add_argument("--shots", type=int, default=100_000)
    parser.add_argument("--parts", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args(arguments)
    sizes = np.diff(np.linspace(0, options.shots, options.parts + 1).astype(int))
    parts = [Part(options.seed, k, int(size), options.threads) for k, size in enumerate(sizes)]

    together, potted, begun, first, skipped = (
        hashlib.sha256(),
        np.zeros(11, np.int64),
        time.monotonic(),
        0.0,
        len(parts),
    )
    for k, (digest, down) in enumerate(WAYS[options.by](parts, options.workers, options.address)):
        # the first summaries come when processes have started and libraries are loaded: the rate is
        # that of the others
        if k == (0 if options.by == "local" else options.workers - 1):
            first, skipped = time.monotonic(), k + 1
        together.update(digest)
        potted += down
    ended = time.monotonic()
    print(f"{options.shots} breaks by {options.by} in {ended - begun:.2f} s", end="")
    print(
        f"; once all workers run {sizes[skipped:].sum() / (ended - first):.0f} shots/s"
        if len(parts) > skipped
        else ""
    )
    print("balls potted:", *(f"{balls}: {count}" for balls, count in enumerate(potted) if count))
    print("digest:", together.hexdigest())


if __name__ == "__main__":
    main()
