"""server.py PORT SECONDS: nine-ball between the first two who connect, with SECONDS for a stroke.
Others look on. README.md has the lines that it sends.
"""

import asyncio
import sys
import time

import carom

CLIENTS_MOST, LINE_MOST, BEHIND_MOST = 64, 8192, 1 << 20
match = carom.Match("nineball", carom.tables.pool_9ft(), seed=5)
clients: dict[int, asyncio.StreamWriter] = {}  # by seat


def send(seat, text):
    """Nobody waits for a client: one that does not read must leave."""
    transport = clients[seat].transport
    if not transport.is_closing():
        transport.write(text.encode())
    if transport.get_write_buffer_size() > BEHIND_MOST:
        transport.abort()


def publish(known):
    """Sends the lines behind those that are known to all."""
    if match.phase == "over" and '{"end"' not in match.lines[-1]:
        match.end()
    for seat in list(clients):
        send(seat, "".join(match.lines[known:]))


async def serve(reader, writer):
    """Who connects gets the first free seat, and the recording so far."""
    seat = next(k for k in range(CLIENTS_MOST + 1) if k not in clients)
    if seat == CLIENTS_MOST:
        writer.transport.abort()
        return
    clients[seat] = writer
    send(seat, "".join(match.lines) + f"seat {seat}\n")
    try:
        while (line := await reader.readline()).endswith(b"\n"):
            known = len(match.lines)
            try:
                if match.receive(line.decode(errors="replace"), seat):
                    publish(known)
            except carom.CaromError as refused:
                send(seat, f"refused {refused}\n")
    except (ValueError, OSError):  # the line is too long; the connection is broken
        pass
    finally:
        del clients[seat]
        writer.close()


async def main(port, seconds):
    server = await asyncio.start_server(serve, None, port, limit=LINE_MOST)
    turn, due = None, 0.0  # of the stroke, once both seats are taken
    while match.phase != "over":
        await asyncio.sleep(0.1)
        state = match.shots, match.seat
        is_due = turn == state and time.monotonic() >= due
        if is_due:
            known = len(match.lines)
            match.resume() if match.phase == "moving" else match.clock()
            publish(known)
        if is_due or (turn != state and (turn is not None or 1 in clients)):
            turn, due = (match.shots, match.seat), time.monotonic() + seconds
    server.close()
    await asyncio.sleep(1)  # in which all read the end
    for client in clients.values():
        client.transport.abort()
    await asyncio.sleep(0.1)


asyncio.run(main(int(sys.argv[1]), float(sys.argv[2])))
