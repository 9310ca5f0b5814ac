"""The game of match.c in Python: match.py FILE STROKES."""

import sys
from pathlib import Path

import carom

file, strokes = Path(sys.argv[1]), int(sys.argv[2])
players = [carom.player(fargo=fargo, rules="eightball") for fargo in (550, 650)]
saved = file.read_text().splitlines(keepends=True) if file.exists() else []
if saved:
    game = carom.Match.load(line for line in saved if line.endswith("\n"))
else:
    game = carom.Match("eightball", carom.tables.pool_9ft(), seed=5)
while strokes > 0 and game.phase != "over":
    me = game.seat
    best = game.plan(player=players[me], opponent=players[1 - me], shots=300, best=1)[0]
    game.take(best, carom.with_errors(best["cue"], players[me], 9, game.shots))
    print(f"{me + 1}: {game.ruling.words}")
    strokes -= 1
    if game.phase == "over":
        game.end()
file.write_text("".join(game.lines))
