"""client.py HOST PORT: plays a seat of a server by plans, or looks on, and prints the match."""

import socket
import sys

import carom


def act(match):
    """The lines of the best stroke of the seat at the table, and of what comes before it."""
    mine = match.copy()
    mine.take(mine.plan(shots=100)[0])
    return mine.lines[len(match.lines) :]


def play(server):
    """Receives the match to its end, and returns it. The copy's lines count when they come back."""
    begin, match, seat, awaited = [], None, None, ""
    for line in server.makefile(newline="\n"):
        if line.startswith("refused "):  # such as an act that came after its time
            sys.stderr.write(line)
            awaited = ""
            continue
        if line.startswith("seat "):
            match, seat = carom.Match.load(begin), int(line.removeprefix("seat "))
        elif match is None:
            begin.append(line)
            continue
        else:
            match.receive(line, None)
        if line == awaited:
            awaited = ""
        if line.startswith('{"end"'):
            return match
        if match.phase in ("stroke", "place") and match.seat == seat and not awaited:
            lines = act(match)
            awaited = lines[-1]
            server.sendall("".join(lines).encode())
    raise ConnectionError("the server has left before the end")


host, port = sys.argv[1:]
with socket.create_connection((host, int(port))) as server:
    print("".join(play(server).lines), end="")
