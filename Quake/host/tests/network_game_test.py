#!/usr/bin/env python3
"""A network game of real processes: network_game_test.py BUILD_DIR [SECONDS]. A dedicated server and two headless
clients, one over IPv4 and one over IPv6 where there is any, all of it through a relay that loses one packet in ten,
repeats and reorders. Both walk for a minute; nobody may drop, and in the end both must show both players where the
server has them, to a step of the wire. Then one draws a picture that takes minutes, and must not be dropped for silence. Skipped, saying so, without game data, a compiler of QuakeC or a Vulkan device."""
import os
import pathlib
import queue
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import time

import default_signals  # noqa: F401
from lossy_relay import Relay, Weather
from programs_needed import librequake

SKIPPED = 77
FRAMES_A_SECOND = 20
COORDINATE_STEP, ANGLE_STEP = 1 / 8, 360 / 256  # protocol 666
MAP = "start"
# Eight seconds of each: the wait of a client is one of its frames.
WALKS = {
    "anna": "+forward\nw64\n+left\nw16\n-left\n+jump\nw4\n-jump\nw28\n-forward\n+back\n+right\nw24\n-right\n-back\n+attack\nw24\n-attack\n",
    "bert": "+moveright\n+forward\nw24\n-moveright\n+right\nw32\n-right\n+speed\nw32\n-speed\n+jump\nw8\n-jump\n-forward\n+left\nw40\n-left\nw24\n",
}


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


def script(name, seconds):
    waits = "".join(f'alias w{2 * n} "w{n};w{n}"\n' for n in (2, 4, 8, 16, 32))
    sums = 'alias w2 "wait;wait"\nalias w24 "w16;w8"\nalias w28 "w16;w8;w4"\nalias w40 "w32;w8"\n'
    rounds = (WALKS[name] + "entities\n") * max(1, seconds // 8)
    # Then back to where both see each other, a turn (a walk ends anywhere on a machine that stalls), and it stands and
  # says what it sees until it is ended.
    end = 'kill\nw16\n+right\nw8\n-right\nw16\necho walked\nalias watch "entities;w16;watch"\nwatch\n'
    return sums + waits + "w64\nw64\nentities\n" + rounds + end


class Program:
    """A process whose lines are read as they come."""

    def __init__(self, name, command):
        self.name, self.lines, self.fresh, self.deaf = name, [], queue.Queue(), False
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                        text=True, errors="replace", bufsize=1)
        threading.Thread(target=self.read, daemon=True).start()

    def read(self):
        for line in self.process.stdout:
            self.fresh.put(line.rstrip("\n"))
            if self.deaf:
                self.process.stdout.close()
                break
        self.fresh.put(None)

    def stop_reading(self):
        """After its next line, as `head` does."""
        self.deaf = True

    def say(self, line):
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()

    def wait_for(self, pattern, seconds):
        """The next line with the pattern; fails where it does not come."""
        until = time.monotonic() + seconds
        while (left := until - time.monotonic()) > 0:
            try:
                line = self.fresh.get(timeout=left)
            except queue.Empty:
                break
            if line is None:
                said = "\n".join(self.lines[-5:])
                raise AssertionError(f"{self.name} ended; it was to say {pattern!r}, and said last:\n{said}")
            self.lines.append(line)
            if re.search(pattern, line):
                return line
        raise AssertionError(f"{self.name} did not say {pattern!r} within {seconds} s")

    def catch_up(self):
        while not self.fresh.empty():
            line = self.fresh.get()
            if line is not None:
                self.lines.append(line)

    def end(self):
        if self.process.poll() is None:
            self.process.terminate()
            try:
                self.process.wait(10)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()
        self.catch_up()


def numbers(text):
    return [float(word) for word in text.split()]


def reports(lines):
    """What `entities` said, each time: number to place and angles."""
    report = {}
    for line in lines:
        if match := re.match(r" *(\d+): \S+:\d+ \((.*)\) \[(.*)\]$", line):
            report[int(match[1])] = (numbers(match[2]), numbers(match[3]))
        elif re.match(r"\d+ entities$", line):
            yield report
            report = {}


def edicts(dump):
    """Number to place and angles of every edict in sv_dump's text."""
    found = {}
    for match in re.finditer(r"^edict (\d+)\n\{\n(.*?)^\}", dump, re.M | re.S):
        fields = dict(re.findall(r'^"(\w+)" "(.*)"$', match[2], re.M))
        found[int(match[1])] = [numbers(fields.get(key, "0 0 0")) for key in ("origin", "angles")] + [fields]
    return found


def furthest(a, b):
    return max(abs(x - y) for x, y in zip(a, b))


def turn(a, b):
    return abs((a - b + 180) % 360 - 180)


def compile_rules(sources, target):
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(sources, folder, dirs_exist_ok=True)
        subprocess.run(["fteqcc", "-O0", "-Tstandard", "-srcfile", "progs.src"], cwd=folder, check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        shutil.copy(pathlib.Path(folder, "progs.dat"), target)


def has_ipv6():
    try:
        with socket.socket(socket.AF_INET6, socket.SOCK_DGRAM) as probe:
            probe.bind(("::1", 0))
        return True
    except OSError:
        return False


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("", 0))
        return probe.getsockname()[1]


class Game:
    """The three programs and what is between them."""

    def __init__(self, build, data, folder, seconds):
        self.folder, self.programs, self.headless = folder, [], [build / "fullbright", "-headless", "-basedir", data]
        self.port = port = free_port()
        self.relay = Relay(port, Weather(seed=4))
        doors = [("127.0.0.2", socket.AF_INET), ("::1", socket.AF_INET6) if has_ipv6() else ("127.0.0.3", socket.AF_INET)]
        self.server = self.start("server", [build / "fullbright", "-dedicated", "2", "-port", str(port), "-seed", "1",
                                            "-basedir", data], [f"+map {MAP}"])
        self.server.wait_for("^Server spawned", 60)
        self.clients = []
        for name, (address, family) in zip(WALKS, doors):
            door = f"[{address}]" if ":" in address else address
            door += f":{self.relay.open_door(family, address)}"
            user = self.user_folder(name)
            (user / "id1" / "walk.cfg").write_text(script(name, seconds))
            self.clients.append(self.start(
                name, [*self.headless, "-size", "32x18"],
                ["+r_bounces 0", f"+host_maxfps {FRAMES_A_SECOND}", f"+name {name}", f"+connect {door}", "+exec walk"]))
        self.relay.start()

    def user_folder(self, name):
        user = self.folder / name
        (user / "id1").mkdir(parents=True, exist_ok=True)
        shutil.copy(self.folder / "progs.dat", user / "id1")
        return user

    def start(self, name, command, commands):
        command = [str(word) for word in command + ["-userdir", self.user_folder(name)]]
        for line in commands:
            command += line.split(" ")
        self.programs.append(Program(name, command))
        return self.programs[-1]

    def dump(self):
        """The server's state while both stand."""
        self.server.say("sv_dump end.txt")
        self.server.say("echo dumped")
        self.server.wait_for("^dumped", 20)
        return edicts((self.folder / "server" / "id1" / "end.txt").read_text())

    def end(self):
        for program in self.programs:
            program.end()
        if self.relay.is_alive():
            self.relay.end()


def check_players(state):
    for number in (1, 2):
        assert state[number][2].get("classname") == "player", f"player {number} is not in the game"
    names = {state[number][2].get("netname") for number in (1, 2)}
    assert names == set(WALKS), f"who is in the game: {names}"


def check_walk(client, number):
    places = [report[number][0] for report in reports(client.lines) if number in report]
    assert len(places) >= 4, f"{client.name} saw itself {len(places)} times"
    way = max(furthest(place, places[0]) for place in places)
    assert way > 100, f"{client.name} has walked {way} units"
    return way


def check_agreement(state, client):
    report = list(reports(client.lines))[-1]
    assert {1, 2} <= report.keys(), f"{client.name} sees {sorted(report)}"
    for number, (place, angles) in report.items():
        away = furthest(place, state[number][0])
        assert away <= COORDINATE_STEP, f"{client.name} shows {number} at {place}, the server has {state[number][0]}"
        turned = turn(angles[1], state[number][1][1])
        assert turned <= ANGLE_STEP, f"{client.name} shows {number} turned to {angles}, the server has {state[number][1]}"
    return len(report)


def play(game, seconds):
    for client in game.clients:
        client.wait_for("^walked", 4 * seconds + 120)
        client.wait_for(r"^([2-9]|\d{2,}) entities$", 30)  # on a slow machine their last way begins late
    time.sleep(3)  # falls and turns end, and what is on its way arrives
    state = game.dump()
    for client in game.clients:
        client.catch_up()
        for _ in range(2):
            client.wait_for(r"^\d+ entities$", 20)
    again = game.dump()
    assert [again[n][:2] for n in (1, 2)] == [state[n][:2] for n in (1, 2)], "the players stand"
    check_players(state)
    spoken = "\n".join(line for program in game.programs for line in program.lines)
    assert not re.search("has left|timed out|Lost the connection|Server disconnected|is thrown out|overflow", spoken), spoken
    owners = {state[number][2]["netname"]: number for number in (1, 2)}
    for client in game.clients:
        way = check_walk(client, owners[client.name])
        seen = check_agreement(state, client)
        print(f"{client.name}: walked up to {way:.0f} units away, shows {seen} things where the server has them")
    relay = game.relay
    print(f"the relay: {relay.sent} packets, {relay.lost} lost, {relay.repeated} repeated, {relay.overtaken} overtaken")
    assert relay.lost > relay.sent / 20 and relay.repeated > 0 and relay.overtaken > relay.sent / 20


def be_patient(game):
    """A player who computes for long says that it is there."""
    patience = 8  # seconds, of which the first packet after five is a word in time
    for client in game.clients:
        client.end()
        game.server.say(f"kick {client.name}")  # of ten goodbyes the relay loses one
    game.server.say(f"net_messagetimeout {patience}")
    busy = game.start("busy", [*game.headless, "-size", "1280x720"],
                      ["+r_spp 4096", f"+connect 127.0.0.1:{game.port}", *["+wait"] * 200, "+echo drawn"])
    for _ in range(60):
        game.server.say("status")
        if "1 active" in game.server.wait_for("^players: [0-9]+ active", 20):
            break
        time.sleep(1)
    time.sleep(3 * patience)
    game.server.say("status")
    game.server.wait_for("^players: 1 active", 20)
    busy.catch_up()
    spoken = "\n".join(game.server.lines + busy.lines)
    assert not re.search("timed out|Lost the connection|^drawn", spoken, re.M), spoken
    busy.process.kill()
    busy.process.wait()
    game.server.wait_for("timed out", 10 * patience)
    print(f"a player whose frame takes long stays, with {patience} s of patience, and goes once it is killed")


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    seconds = int(sys.argv[2]) if len(sys.argv) > 2 else 60
    data, lacks = librequake()
    if lacks:
        skip(lacks)
    if not shutil.which("fteqcc"):
        skip("fteqcc is not installed (Linux/install-deps.sh test)")
    if subprocess.run([build / "fullbright", "-listdevices"], capture_output=True).returncode != 0:
        skip("no Vulkan device, which headless clients need")
    with tempfile.TemporaryDirectory() as folder:
        compile_rules("testdemos/rules", pathlib.Path(folder) / "progs.dat")
        game = Game(build, data, pathlib.Path(folder), seconds)
        try:
            play(game, seconds)
            be_patient(game)
        except AssertionError as why:
            print(f"FAILED: {why}")
            game.end()
            for program in game.programs:
                print(f"--- {program.name}, its last lines:", *program.lines[-30:], sep="\n")
            return 1
        finally:
            game.end()
    return 0


if __name__ == "__main__":
    sys.exit(main())
