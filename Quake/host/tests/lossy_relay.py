"""A UDP relay on loopback addresses that loses, repeats and reorders, for tests of real processes: it stands before a
server that talks NetQuake's protocol, and takes the port that the server names to each client to one of its own, so
that all of a game goes through it. What happens to a packet comes from a seed, in the order in which packets come."""
import heapq
import random
import selectors
import socket
import struct
import threading
import time

CONTROL, ACCEPT = 0x80, 0x81


class Weather:
    """Chances of a packet, and seconds that it takes; what takes longer than the next is overtaken by it."""

    def __init__(self, seed, loss=0.1, repeat=0.05, delay=0.01, more_delay=0.08):
        self.random = random.Random(seed)
        self.loss, self.repeat, self.delay, self.more_delay = loss, repeat, delay, more_delay

    def delays(self):
        """One for each copy that arrives."""
        if self.random.random() < self.loss:
            return []
        copies = 2 if self.random.random() < self.repeat else 1
        return [self.delay + self.more_delay * self.random.random() for _ in range(copies)]


class Session:
    """A client: where it is heard and answered, and how the server knows it."""

    def __init__(self, client, upstream):
        self.client, self.upstream = client, upstream
        self.game_port, self.game_door = None, None


class Relay(threading.Thread):
    def __init__(self, server_port, weather):
        super().__init__(daemon=True)
        self.server_port, self.weather = server_port, weather
        self.selector = selectors.DefaultSelector()
        self.sessions, self.flying, self.number, self.over = {}, [], 0, False
        self.sent = self.lost = self.repeated = self.overtaken = 0
        self.last_due = {}

    def open_door(self, family, address):
        """Where clients come to; returns the port."""
        door = self.open_socket(family, address)
        self.selector.register(door, selectors.EVENT_READ, lambda: self.from_client(door, None))
        return door.getsockname()[1]

    def open_socket(self, family, address):
        opened = socket.socket(family, socket.SOCK_DGRAM)
        opened.bind((address, 0))
        opened.setblocking(False)
        return opened

    def run(self):
        while not self.over:
            for key, _ in self.selector.select(0.005):
                key.data()
            while self.flying and self.flying[0][0] <= time.monotonic():
                _, _, out, data, to = heapq.heappop(self.flying)
                try:
                    out.sendto(data, to)
                except OSError:
                    pass  # its port has closed: lost, as any packet may be

    def end(self):
        self.over = True
        self.join()

    def send(self, out, data, to):
        delays = self.weather.delays()
        self.sent += 1
        self.lost += not delays
        self.repeated += len(delays) > 1
        for delay in delays:
            due = time.monotonic() + delay
            self.overtaken += due < self.last_due.get(out, 0.0)
            self.last_due[out] = due
            self.number += 1
            heapq.heappush(self.flying, (due, self.number, out, data, to))

    def packets(self, door):
        while True:
            try:
                yield door.recvfrom(65536)
            except OSError:
                return

    def from_client(self, door, session):
        for data, client in self.packets(door):
            known = session or self.session_of(client, door)
            port = self.server_port if session is None else known.game_port
            self.send(known.upstream, data, (server_address(known.upstream), port))

    def session_of(self, client, door):
        if client not in self.sessions:
            upstream = self.open_socket(door.family, server_address(door))
            session = self.sessions[client] = Session(client, upstream)
            self.selector.register(upstream, selectors.EVENT_READ, lambda: self.from_server(session, door))
        return self.sessions[client]

    def from_server(self, session, door):
        for data, sender in self.packets(session.upstream):
            if sender[1] == self.server_port:
                self.send(door, self.with_own_port(session, door, data), session.client)
            elif session.game_door is not None and sender[1] == session.game_port:
                self.send(session.game_door, data, session.client)

    def with_own_port(self, session, door, data):
        if len(data) < 9 or data[0] != CONTROL or data[4] != ACCEPT:
            return data
        port = struct.unpack_from("<i", data, 5)[0]
        if port != session.game_port:
            session.game_port = port
            session.game_door = game_door = self.open_socket(door.family, door.getsockname()[0])
            self.selector.register(game_door, selectors.EVENT_READ, lambda: self.from_client(game_door, session))
        return data[:5] + struct.pack("<i", session.game_door.getsockname()[1]) + data[9:]


def server_address(of):
    return "::1" if of.family == socket.AF_INET6 else "127.0.0.1"
