"""What cameras do to recordings: rest before the strike, a clock of their own, lost and false rows,
swapped names, a crooked table.
"""

from dataclasses import replace

import numpy as np


def spoiled(
    recordings,
    seed=0,
    *,
    lead_in=0.0,
    rate=50.0,
    noise=0.35e-3,
    clock=0.0,
    lost=0.0,
    false=0.0,
    swaps=0,
    angle=0.0,
    scale=1.0,
    bend=(0.0, 0.0, 0.0),
    table=(2.84, 1.42),
):
    """Recordings with `lead_in` s of rows at rest in front, their clock later by `clock` s, a share
    of rows `lost`, a share `false`, that is anywhere on the table, names of two balls exchanged
    `swaps` times, and turned by `angle` (degrees), scaled and bent, by k |q|^2 q (1/m^2) and (g q)
    q (1/m), q from the middle.
    """
    random = np.random.default_rng(seed)
    changed_recordings = []
    for shot in recordings:
        tracks = []
        for track in shot.tracks:
            # rest in front, with the noise of the camera
            times = np.arange(0.0, lead_in, 1.0 / rate)
            rest = np.column_stack(
                [times, track[0, 1:] + random.normal(0.0, noise, (len(times), 2))]
            )
            track = np.vstack(
                [rest, track + (times[-1] + 1.0 / rate if len(times) else 0.0, 0.0, 0.0)]
            )
            # rows that are lost and rows that are anywhere
            track = track[(random.uniform(size=len(track)) >= lost) | (np.arange(len(track)) == 0)]
            wrong = random.uniform(size=len(track)) < false
            track[wrong, 1:] = random.uniform(0.05, np.array(table) - 0.05, (wrong.sum(), 2))
            tracks.append(track)
        for _ in range(swaps):
            a, b = random.choice(len(tracks), 2, replace=False)
            time = random.uniform(lead_in + 0.5, lead_in + 4.0)
            first, second = tracks[a], tracks[b]
            tracks[a] = np.vstack([first[first[:, 0] < time], second[second[:, 0] >= time]])
            tracks[b] = np.vstack([second[second[:, 0] < time], first[first[:, 0] >= time]])
        turn = scale * np.array(
            [
                [np.cos(np.radians(angle)), -np.sin(np.radians(angle))],
                [np.sin(np.radians(angle)), np.cos(np.radians(angle))],
            ]
        )
        places = [t[:, 1:] - np.array(table) / 2 for t in tracks]
        places = [
            q * (1.0 + bend[0] * (q * q).sum(axis=1) + q @ bend[1:])[:, None] + np.array(table) / 2
            for q in places
        ]
        changed_recordings.append(
            replace(
                shot,
                tracks=tuple(
                    np.column_stack([t[:, 0] + clock, r @ turn.T]) for t, r in zip(tracks, places)
                ),
            )
        )
    return changed_recordings
