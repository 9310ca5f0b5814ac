"""servers.py MATCH SENDS ROWS KIND COMMAND... -- CLIENT...: a server of examples/server against cheats.

bindings/tests/hostile.c writes the files, so that no library is needed here. KIND is lines or
websocket, and COMMAND PORT SECONDS starts the server. Two clients play MATCH to its end by the lines
of SENDS, while both seats and other connections cheat: the match must end as recorded. Then a server
with a short time must end a shot that a client has stopped, and the turns of clients that are silent.
Then two clients that CLIENT HOST PORT starts play a match, which goes to played.jsonl next to MATCH.
"""

import contextlib
import random
import socket
import struct
import subprocess
import sys
import threading
import time
from pathlib import Path

PATIENCE = 60.0  # s, on a busy machine
HANDSHAKE = (
    b"GET / HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
    b"Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n"
)


class Lines:
    """A connection of lines that end with a line feed."""

    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=PATIENCE)
        self.rest = b""  # of the last line, which has not ended yet
        self.lines = []
        self.seen = 0  # how many of them were waited for
        self.begin()

    def begin(self):
        """What comes before the first line."""

    def send(self, line):
        """Sends a line, of bytes."""
        self.socket.sendall(line + b"\n")

    def receive(self):
        """The next bytes of lines; none: the server has closed the connection."""
        return self.socket.recv(65536)

    def wait(self, is_wanted):
        """The next line that is wanted."""
        while True:
            while self.seen < len(self.lines):
                self.seen += 1
                if is_wanted(self.lines[self.seen - 1]):
                    return self.lines[self.seen - 1]
            try:
                data = self.receive()
            except OSError:
                data = b""
            if data == b"":
                last = self.lines[-1:]
                raise SystemExit(f"a line is missing behind {self.seen} lines: the last is {last}")
            *whole, self.rest = (self.rest + data).split(b"\n")
            self.lines += [line.decode() for line in whole]

    @property
    def recording(self):
        """The lines of the match."""
        return [line for line in self.lines if line.startswith("{")]


class Websocket(Lines):
    """A connection of messages with lines."""

    def begin(self):
        self.bytes = b""
        self.socket.sendall(HANDSHAKE)
        while b"\r\n\r\n" not in self.bytes:
            self.more()
        self.bytes = self.bytes.split(b"\r\n\r\n", 1)[1]

    def more(self):
        data = self.socket.recv(65536)
        if data == b"":
            raise ConnectionError("the server has closed the connection")
        self.bytes += data

    def take(self, count):
        while len(self.bytes) < count:
            self.more()
        taken, self.bytes = self.bytes[:count], self.bytes[count:]
        return taken

    def send(self, line):
        # A text in one frame, masked by zeros.
        size = len(line)
        if size < 126:
            head = struct.pack(">BB", 0x81, 0x80 | size)
        else:
            head = struct.pack(">BBQ", 0x81, 0x80 | 127, size)
        self.socket.sendall(head + bytes(4) + line)

    def receive(self):
        kind, size = self.take(2)
        if size == 126:
            size = struct.unpack(">H", self.take(2))[0]
        elif size == 127:
            size = struct.unpack(">Q", self.take(8))[0]
        data = self.take(size)
        if kind & 15 == 8:  # closes
            return b""
        return data if kind & 15 == 1 else self.receive()


class Server:
    """A server that runs while the context lasts."""

    def __init__(self, command, seconds, connection):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        self.process = subprocess.Popen([*command, str(self.port), str(seconds)])
        self.connection = connection

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()

    def connect(self):
        """A connection, once the server listens."""
        end = time.monotonic() + PATIENCE
        while True:
            if self.process.poll() is not None:
                raise SystemExit(f"the server has ended with {self.process.returncode}")
            try:
                return self.connection(self.port)
            except OSError:
                if time.monotonic() > end:
                    raise SystemExit("the server does not answer") from None
                time.sleep(0.05)

    def listens(self):
        """Waits until the server listens, without a connection, which would take a seat."""
        end = time.monotonic() + PATIENCE
        listening = f":{self.port:04X} "
        while time.monotonic() < end:
            for table in ("tcp", "tcp6"):
                for row in Path("/proc/net", table).read_text().splitlines():
                    if listening in row and row.split()[3] == "0A":
                        return
            time.sleep(0.05)
        raise SystemExit("the server does not listen")

    def seats(self):
        """Clients of the two seats."""
        clients = []
        for seat in range(2):
            clients.append(self.connect())
            clients[-1].wait(lambda line, seat=seat: line == f"seat {seat}")
        return clients


def raw(port, data, *, resets=False):
    """Sends bytes by a connection, and leaves."""
    with socket.create_connection(("127.0.0.1", port), timeout=PATIENCE) as one:
        if resets:
            one.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        one.sendall(data)


def cheat(server, hostile, stop):
    """What connections without a seat do until they are stopped."""
    source = random.Random(1)
    begin = b"" if server.connection is Lines else HANDSHAKE
    silent = []  # they never read
    while not stop.is_set():
        rows = [line for _, line in hostile]
        noise = source.randbytes(4000)
        for data in (
            *[begin + line + b"\n" for line in rows],
            begin + noise,
            begin + b"\0" * 100 + b"\n" + b"\xff" * 5000 + b"\n",
            begin + b'{"shot":',
            begin + b"x" * 1_000_000,
            b"\n" * 1000,
            b"GET / HTTP/1.1\r\n\r\n",
        ):
            with contextlib.suppress(OSError):
                raw(server.port, data, resets=source.random() < 0.5)
        with contextlib.suppress(OSError):
            one = server.connection(server.port)
            silent = [*silent[-3:], one]
            for line in rows:
                one.send(line)
            one.socket.settimeout(0.5)
            for _ in range(2000):
                one.send(b"hello")
        with contextlib.suppress(OSError):
            crowd = [socket.create_connection(("127.0.0.1", server.port)) for _ in range(70)]
            for one in crowd:
                one.close()
        time.sleep(0.05)


def play(server, match, sends, hostile):
    """The match of the files, with cheats of all kinds."""
    clients = server.seats()
    third = server.connect()
    third.wait(lambda line: line == "seat 2")
    stop = threading.Event()
    thread = threading.Thread(target=cheat, args=(server, hostile, stop))
    thread.start()
    try:
        refused = 0
        for k, (seat, line) in enumerate(sends):
            other = line[:-4] + (b"1" if line[-4:-3] == b"0" else b"0") + line[-3:]  # a hash
            false = [(1 - seat, line), (seat, line[:-40]), (seat, other)]
            false += hostile if k == 1 else []
            for sender, text in false:
                clients[sender].send(text)
                third.send(text)
                empty = text.strip() == b"" or text.startswith(b'{"event"')
                if not empty and len(text) < 8000:
                    clients[sender].wait(lambda line: line.startswith("refused "))
                    refused += 1
            clients[seat].send(line)
            for client in clients:
                client.wait(lambda got, line=line: got == line.decode())
        for client in clients:
            client.wait(lambda got: got.startswith('{"end"'))
    finally:
        stop.set()
        thread.join()
    for seat, client in enumerate(clients):
        if client.recording != match:
            raise SystemExit(f"seat {seat} has another match than was recorded")
    if server.process.wait(PATIENCE) != 0:
        raise SystemExit(f"the server has ended with {server.process.returncode}")
    return refused


def run_out(server, place, stopped, clock):
    """Seat 0 stops its shot, and nobody goes on; then seat 1 is silent."""
    clients = server.seats()
    clients[0].send(place)
    clients[1].wait(lambda line: line == place.decode())
    clients[1].send(clock)  # of seat 0
    clients[1].wait(lambda line: line.startswith("refused ") and "seat 0" in line)
    clients[0].send(stopped)
    for client in clients:
        client.wait(lambda line: line.startswith('{"continue"'))
        client.wait(lambda line: line.startswith('{"act":{"act":4,"player":1'))
        client.wait(lambda line: line.startswith('{"game"'))


def meet(server, client, played):
    """Two clients play a match, and both have it."""
    server.listens()
    command = [*client, "127.0.0.1", str(server.port)]
    both = [subprocess.Popen(command, stdout=subprocess.PIPE) for _ in range(2)]
    matches = [one.communicate(timeout=5 * PATIENCE)[0] for one in both]
    if any(one.returncode != 0 for one in both) or matches[0] != matches[1]:
        raise SystemExit("the two clients do not have the same match")
    played.write_bytes(matches[0])


def main(match, sends, rows, kind, *commands):
    split = commands.index("--")
    command, client = commands[:split], commands[split + 1 :]
    recorded = Path(match).read_text().splitlines()
    acts = [line.split(b" ", 1) for line in Path(sends).read_bytes().splitlines()]
    stopped = next(line for word, line in acts if word == b"stop")
    honest = [(int(word), line) for word, line in acts if word != b"stop"]
    hostile = []
    for line in Path(rows).read_bytes().split(b"\n"):
        if line.startswith(b"row "):
            name, seat, text = line[4:].split(b"|", 2)
            if len(text) < 8000:  # a longer one makes its client leave
                hostile.append((int(seat), text))
            if name == b"another seat's clock":
                clock = text
    connection = {"lines": Lines, "websocket": Websocket}[kind]
    with Server(command, 600, connection) as server:
        refused = play(server, recorded, honest, hostile)
    with Server(command, 1, connection) as server:
        run_out(server, honest[0][1], stopped, clock)
    with Server(command, 600, connection) as server:
        meet(server, client, Path(match).with_name("played.jsonl"))
    print(f"the match has ended as recorded; {refused} lines of its seats were refused")


main(*sys.argv[1:])
