"""Kicks: what they are, how large they are where the model is true, and where they show a wrong
constant.
"""

import json
import re

import numpy as np
import pytest
from test_fit import HAN
from test_tracks import RADIUS, TABLE, csv_of, struck, synthetic

import carom
from carom import tracks
from carom.results import EventType
from carom.tracks import _constants, _kicks, _strikes, fit


@pytest.fixture(scope="module")
def sample():
    return synthetic(24, constants=HAN, seed=2)


def plays_of(sample, **others):
    return _strikes.Plays(sample.recordings, TABLE, RADIUS, {**sample.constants, **others}, "han")


def with_kicks(strikes, *kicks):
    numbers = np.zeros((len(strikes), 6 + 5 * _kicks.CONTACTS))
    numbers[:, :6] = strikes
    numbers[:, 6 : 6 + len(kicks)] = kicks
    return numbers


def test_without_kicks_a_play_in_parts_is_that_of_a_shot(sample):
    plays, rows = plays_of(sample, drag=0.0), np.arange(24, dtype=np.int32)
    whole = plays.misfit(rows, sample.strikes, plays.ends, np.inf)
    parts = plays.misfit(rows, with_kicks(sample.strikes), plays.ends, np.inf)
    assert np.allclose(parts[:, :9], whole[:, :9], rtol=1e-5, atol=1e-8)
    square, gradient = _strikes.normal(parts)
    assert np.allclose(
        square[:, :6, :6], _strikes.normal(whole)[0], rtol=1e-2, atol=1e-5 * square[:, :6, :6].max()
    )
    # derivatives by kicks, against sums at kicks that are changed; those of contacts that do not
    # happen are 0
    for k in range(4):
        contacts = _kicks.contacts(plays, k, with_kicks(sample.strikes)[k])
        assert (square[k].diagonal()[6 + 5 * len(contacts) :] == 0.0).all() and len(contacts) > 3
        for number in (7, 6 + 5 * (len(contacts) - 2) + 1):
            cost = []
            for step in (-1e-5, 1e-5):
                numbers = with_kicks(sample.strikes)
                numbers[k, number] = step
                cost.append(
                    plays.misfit(
                        rows[k : k + 1], numbers[k : k + 1], plays.ends[k : k + 1], -np.inf
                    )[0, 0]
                )
            size = np.sqrt(square[k, number, number] * parts[k, 0]) + 1e-9
            assert abs((cost[1] - cost[0]) / 4e-5 - gradient[k, number]) < 0.03 * size


@pytest.mark.parametrize("kind", [EventType.BALL_BALL, EventType.RAIL])
def test_a_kick_is_the_change_of_motion_that_is_told(sample, kind):
    """By single calls: a shot that stops at the contact, the change in words, and a shot from
    there.
    """
    plays = plays_of(sample, drag=0.0)
    kicks = np.array([0.011, 0.007, -0.013, 0.02, 0.017])
    seen = 0
    for k in range(12):
        strike, cue = sample.strikes[k], sample.recordings[k].cue
        balls = plays.layouts[0, k].copy()
        balls["state"]["v"][cue, :2], balls["state"]["w"][cue] = strike[:2], strike[2:5] / RADIUS
        stopped = carom.simulate(
            plays.table, balls, cushion_model="han", stop_at=["ball_ball", "rail"]
        )
        event = stopped.events[-1]
        if event["type"] != kind or event["cluster"]:
            continue
        a, b = event["a"], event["b"]
        balls["state"] = stopped.final
        incoming = event["before"]
        if kind == EventType.RAIL:
            x, y = incoming[0]["r"][:2]
            n = np.array(
                [[0, -1], [1, 0], [0, 1], [-1, 0]][
                    int(np.argmin([y, TABLE[0] - x, TABLE[1] - y, x]))
                ],
                float,
            )
            t, V = np.array([n[1], -n[0]]), np.hypot(*incoming[0]["v"][:2])
            balls["state"]["v"][a, :2] += V * (kicks[0] * t - kicks[1] * n)
            balls["state"]["w"][a] += (
                V / RADIUS * np.array([*(kicks[2] * n + kicks[3] * t), kicks[4]])
            )
        else:
            n = (incoming[1]["r"] - incoming[0]["r"])[:2] / (2 * RADIUS)
            t, V = np.array([n[1], -n[0]]), (incoming[0]["v"] - incoming[1]["v"])[:2] @ n
            balls["state"]["v"][a, :2] += V * (kicks[1] * t - kicks[0] * n)
            balls["state"]["v"][b, :2] -= V * (kicks[1] * t - kicks[0] * n)
            balls["state"]["w"][[a, b]] += (
                V / RADIUS * np.array([[*(kicks[2] * t), kicks[3]], [*(kicks[2] * t), kicks[4]]])
            )
        shot = carom.simulate(plays.table, balls, cushion_model="han")
        times = np.linspace(0.0, 1.5, 40)
        _, places = plays.played(
            k, with_kicks(strike[None], *kicks)[0], times + stopped.time + strike[5]
        )
        assert np.abs(places.transpose(1, 0, 2) - shot.positions(times)[..., :2]).max() < 1e-9
        seen += 1
    assert seen >= 2


def output_table(table, row="all"):
    """Means and errors of a row, %."""
    cells = next(cells for cells in table if cells[0] == row)
    return np.array([re.fullmatch(r"(\S+) ± (\S+)", cell).groups() for cell in cells[3:]], float).T


def test_kicks_of_the_true_model_are_as_large_as_the_noise(sample):
    found = struck(sample)
    kicks = found.kicks()
    assert np.median(kicks.rmse) < 1.1 * np.sqrt(2) * tracks.NOISE and len(kicks.contacts) > 120
    moved = kicks.contacts["error"] > 0.0
    off = np.abs(kicks.contacts["kick"][moved] / kicks.contacts["error"][moved])
    # of normal errors 68 % and 95 %
    assert 0.55 < (off < 1).mean() < 0.85 and (off < 2).mean() > 0.88, (
        (off < 1).mean(),
        (off < 2).mean(),
    )
    means, errors = output_table(kicks.tables[0])
    assert (np.abs(means) < 0.1).all() and (np.abs(means) < 4 * errors + 0.02).all()
    assert np.median(kicks.contacts["effect"]) < 0.4e-3


@pytest.mark.parametrize(
    ("constant", "off", "cushion", "output", "mean"),
    [
        ("restitution_cushion", -0.01, True, 1, 0.8),
        pytest.param("roll_loss", 0.01, True, 2, 0.6, marks=pytest.mark.release),
        pytest.param("restitution", -0.01, False, 0, 0.5, marks=pytest.mark.release),
        ("law_a", 0.01, False, 2, -0.9),
    ],
)
def test_a_wrong_constant_shows_at_its_contacts_in_its_output(
    sample, constant, off, cushion, output, mean
):
    value = sample.constants[constant] + off
    found = struck(sample, constants={**sample.constants, constant: value})
    kicks = found.kicks()
    assert np.median(kicks.rmse) < 0.7 * found.median_rmse
    means, errors = output_table(kicks.tables[0 if cushion else 1])
    others, spread = output_table(kicks.tables[1 if cushion else 0])
    assert means[output] == pytest.approx(mean, rel=0.5) and abs(means[output]) > 4 * errors[output]
    # at a cushion nothing else is wrong
    rest, error = (
        (np.delete(means, output), np.delete(errors, output)) if cushion else (others, spread)
    )
    assert (np.abs(rest) < 0.3 * abs(means[output]) + 3 * error).all()


def test_the_command_tells_kicks(sample, tmp_path, capsys):
    (tmp_path / "tracks.csv").write_text(csv_of(sample.recordings[:12]))
    (tmp_path / "in.json").write_text(json.dumps({**sample.constants, "restitution_cushion": 0.85}))
    words = (
        f"{tmp_path}/tracks.csv --table 2.84,1.42 --radius 0.03075 --constants {tmp_path}/in.json"
    )
    words += f" --cushion-model han --free none --kicks --summary {tmp_path}/page.html"
    assert fit.main(f"{words} -o {tmp_path}/out.json".split()) == 0
    words = capsys.readouterr().out
    assert (
        re.search(r"with kicks: RMSE median \S+ cm", words)
        and "| cushions | contacts | effect, mm | along, % |" in words
    )
    written = json.loads((tmp_path / "out.json").read_text(), parse_constant=pytest.fail)
    assert set(written["kicks"][0]) == set(_kicks.contact.names) and len(written["kicks"]) > 60
    # a picture of a shot marks the contacts; all rebounds are too slow here
    page = (tmp_path / "page.html").read_text()
    assert (
        page.count("<title>contact ") > 12
        and re.search(r">away \+\d\.\d %</text>", page)
        and "<h2>Kicks</h2>" in page
    )


def test_jaws_have_kicks():
    """Away from the jaw and along it, over the speed of the ball before."""
    table = carom.tables.pool_9ft()
    jaw = next(j for j in table.jaws if j["centre"][0] < 0.1 and 1.0 < j["centre"][1] < 1.27)
    start = np.array([0.4, 1.27])
    way = jaw["centre"] - start
    way /= np.hypot(*way)
    times = np.arange(0.0, 2.0, 0.02)
    rows = np.column_stack([times, np.tile(start, (len(times), 1)) + np.outer(times, 0.3 * way)])
    shot = tracks.Recording(1, (1,), (rows,))
    ball = carom.balls([start], game="pool")["kind"][0]
    constants, model = _constants.complete({}, "smooth", game="pool")
    plays = _strikes.Plays([shot], "9ft", float(ball["radius"]), constants, model)
    strike = np.array([*(1.5 * way), 0.0, 0.0, 0.0, 0.0])
    (met, *_) = _kicks.contacts(plays, 0, with_kicks(strike[None])[0])
    assert met["type"] == EventType.JAW
    after = [met["time"] + np.array([0.0, 0.01])]
    speed, ends = np.hypot(*met["before"][0]["v"][:2]), []
    for kicks in ((0.0,), (0.0, 0.1), (0.1,)):
        _, places = plays.played(0, with_kicks(strike[None], *kicks)[0], after[0])
        ends.append(places[0])
    n = jaw["centre"] - met["before"][0]["r"][:2]
    n /= np.hypot(*n)
    apart = (np.array(ends[1:]) - ends[0])[:, 1] / 0.01 / speed
    assert np.allclose(apart[0], -0.1 * n, atol=2e-3)
    assert np.allclose(apart[1], 0.1 * np.array([n[1], -n[0]]), atol=2e-3)
