#!/usr/bin/env python3
"""Programs that share the player's folder: shared_folder_test.py BUILD_DIR [KILLS]. Two servers, then four, save under
one name and write one configuration again and again, while they and this script read them: nothing fails, and every
file is whole whenever it is read. Then servers are killed (SIGKILL) at random moments, KILLS times (12), amid others that
go on: nothing of the others is touched, and what the killed ones left is gone with the next start. Then QuakeC writes
1,000 files: each is whole, and they are put on the disk together. Skipped, saying so, without the base game."""
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

from network_game_test import SKIPPED, Program
from saves_test import Kept, can, command

ROUNDS = 150  # that each server writes at least
LONGEST_WAIT = 0.12  # seconds before a kill, several rounds of writing
LOOP = 'alias go "save kept;writeconfig kept;exec kept.cfg;wait;go"\nsys_ticrate 0.001\n'
WRONG = "cannot|no such|malformed|makes no sense|another program|couldn't exec kept|unknown command"
FILES = 1000
WRITER = """
float(string name, float mode) fopen = #110;
void(float handle) fclose = #111;
void(float handle, string text, ...) fputs = #113;
string(float f) number_text = #26;
string(string a, string b) joined = #115;
void(string text) localcmd = #46;
float written;
void() StartFrame = {
  local float i, f;
  if (written) return;
  written = 1;
  for (i = 0; i < %d; i = i + 1) { f = fopen(joined("n", number_text(i)), 2); fputs(f, "whole ", number_text(i), "\\n"); fclose(f); }
  localcmd("echo all written\\n");
};
""" % FILES


class Server:
    def __init__(self, build, home, number):
        self.game = Program(f"server {number}", command(
            build, home, "+map", "start", "+seta", "aaa_run", str(number), "+seta", "zzz_run", str(number), "+exec", "loop.cfg", "+go"))
        self.written = 0

    def count(self):
        """How often it has written; fails on the first sentence that says that something went wrong."""
        self.game.catch_up()
        wrong = [line for line in self.game.lines if re.search(WRONG, line, re.I)]
        assert not wrong, f"{self.game.name}: {wrong[0]}"
        assert self.game.process.poll() is None, f"{self.game.name} ended:\n" + "\n".join(self.game.lines[-5:])
        self.written += sum(line == "wrote kept.cfg" for line in self.game.lines)
        self.game.lines.clear()
        return self.written

    def kill(self):
        self.game.process.send_signal(signal.SIGKILL)
        self.game.process.wait()


class Reader(threading.Thread):
    """Reads both files for as long as it lives."""

    def __init__(self, kept):
        super().__init__(daemon=True)
        self.kept, self.reads, self.failure, self.over = kept, 0, None, False

    def run(self):
        while not self.over and not self.failure:
            try:
                self.kept.check(f"read {self.reads}")
                self.reads += 1
            except (AssertionError, OSError) as failure:
                self.failure = failure

    def end(self):
        self.over = True
        self.join()
        assert not self.failure, self.failure
        assert self.reads > 10, f"only {self.reads} reads"


def folder_of(home):
    (home / "id1").mkdir(parents=True)
    (home / "id1" / "loop.cfg").write_text(LOOP)
    return Kept(home)


def begin(build, home, kept, count):
    servers = [Server(build, home, number) for number in range(count)]
    for server in servers:
        server.game.wait_for("^wrote kept.cfg", 60)
    reader = Reader(kept)
    reader.start()
    return servers, reader


def wait_until(servers, reader, enough):
    until = time.monotonic() + 120
    while not enough([server.count() for server in servers]):
        assert not reader.failure, reader.failure
        assert time.monotonic() < until, "the servers stand still"
        time.sleep(0.02)


def together(build, home, count):
    kept = folder_of(home)
    servers, reader = begin(build, home, kept, count)
    try:
        wait_until(servers, reader, lambda written: min(written) >= ROUNDS)
        reader.end()
        for server in servers:
            server.game.process.terminate()
        for server in servers:
            assert server.game.process.wait(60) == -signal.SIGTERM, f"{server.game.name} did not end in order"
    finally:
        for server in servers:
            server.kill()
    left = {path.name for path in kept.folder.iterdir()}
    assert left == {"loop.cfg", "kept.sav", "kept.cfg"}, left
    print(f"{count} servers: {[server.written for server in servers]} rounds, {reader.reads} reads, every file whole")


def killed(build, home, kills, seed):
    dice, kept, amid = random.Random(seed), folder_of(home), 0
    servers, reader = begin(build, home, kept, 3)
    try:
        for kill in range(kills):
            victim = servers.pop(dice.randrange(len(servers)))
            time.sleep(dice.uniform(0, LONGEST_WAIT))
            victim.kill()
            before = [server.count() for server in servers]
            wait_until(servers, reader, lambda written: all(now > then for now, then in zip(written, before)))
            servers.append(Server(build, home, 10 + kill))
            servers[-1].game.wait_for("^wrote kept.cfg", 60)
        reader.end()
    finally:
        for server in servers:
            server.kill()
    amid = len(kept.half())
    subprocess.run(command(build, home, "+map", "start", "+save", "last", "+quit"), check=True, capture_output=True, timeout=60)
    assert not kept.half(), f"{kept.half()} stays"
    print(f"{kills} killed amid others: every file whole; {amid} that they left are gone")


def compile_writer(rules):
    shutil.copytree("testdemos/rules", rules)
    main = rules / "main.qc"
    main.write_text(main.read_text().replace("void() StartFrame = {};", WRITER))
    subprocess.run(["fteqcc", "-O0", "-Tstandard", "-srcfile", "progs.src"], cwd=rules, check=True, capture_output=True)
    return rules / "progs.dat"


def mods_files(build, home):
    """Each is whole once it is closed, whatever ends the program; and none waits for the disk by itself."""
    folder = home / "id1"
    folder.mkdir(parents=True)
    shutil.copy(compile_writer(home / "rules"), folder)
    game = Program("the writer", command(build, home, "+map", "start"))
    try:
        game.wait_for("^all written", 60)
    finally:
        game.process.kill()
        game.process.wait()
    for number in range(FILES):
        assert (folder / "data" / f"n{number:g}").read_text() == f"whole {number}\n", number
    assert len(list((folder / "data").iterdir())) == FILES
    print(f"{FILES} files of QuakeC: all whole in a program that was killed")
    trace, calls = home / "calls", ["strace", "-f", "-e", "trace=fsync,fdatasync,syncfs,sync"]
    if not can(*calls, "true"):
        return print("strace is not here: how often the disk is waited for is not counted")
    subprocess.run([*calls, "-o", trace, *command(build, home, "+map", "start", "+sv_run", "1", "+quit")], check=True, capture_output=True,
                   timeout=120, env=os.environ | {"ASAN_OPTIONS": os.environ.get("ASAN_OPTIONS", "") + ":detect_leaks=0"})  # not beside strace
    waits = len(re.findall(r"sync(?:fs)?\(", trace.read_text()))
    assert 1 <= waits <= 50, f"{waits} waits for the disk"
    print(f"and {waits} waits for the disk where all were written again")


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    kills = int(sys.argv[2]) if len(sys.argv) > 2 else 12
    if not (build / "game" / "id1" / "progs.dat").exists():
        print("skipped for want of the base game")
        return SKIPPED
    seed = random.SystemRandom().randrange(1 << 32)
    print(f"seed {seed}")
    with tempfile.TemporaryDirectory() as name:
        home = pathlib.Path(name)
        for count in (2, 4):
            together(build, home / f"together{count}", count)
        killed(build, home / "killed", kills, seed)
        if shutil.which("fteqcc"):
            mods_files(build, home / "mod")
        else:
            print("fteqcc is not installed: QuakeC's files are skipped")
    return 0


if __name__ == "__main__":
    sys.exit(main())
