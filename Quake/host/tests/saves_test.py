#!/usr/bin/env python3
"""What is saved survives: saves_test.py BUILD_DIR [KILLS]. A server saves its game and its configuration again and again
and is killed (SIGKILL) at random moments, KILLS times (25); each time both files must be the former or the next ones, whole,
and the next start plays on from them. Then the same commands with a full disk and in a folder that may not be written: one
sentence each, the former files stay, the game goes on. Skipped, saying so, without the base game."""
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from network_game_test import SKIPPED, Program

LONGEST_WAIT = 0.12  # seconds before a kill, several rounds of writing
LOOP = 'alias go "save kept;writeconfig kept;save kept;writeconfig kept;wait;go"\nsys_ticrate 0.001\n'


def command(build, home, *words, before=()):
    return [*before, build / "fullbright", "-dedicated", "1", "-nolan", "-basedir", build / "game", "-userdir", home, *words]


class Kept:
    """The two files, with what makes them whole."""

    def __init__(self, home):
        self.folder = home / "id1"
        self.save, self.config = self.folder / "kept.sav", self.folder / "kept.cfg"

    def half(self):
        """Files that somebody writes, or that a killed program has left."""
        return list(self.folder.glob(".fullbright-*.new"))

    def check(self, run):
        """The run that wrote the configuration last; fails on a half file."""
        text = self.save.read_text()
        opened, closed = len(re.findall(r"^\{$", text, re.M)), len(re.findall(r"^\}$", text, re.M))
        empty = len(re.findall(r"^\{\n\}$", text, re.M))
        assert text.startswith("5\n") and text.endswith("}\n") and opened == closed > 50, \
            f"kill {run}: {self.save.name} is no whole save: {len(text)} bytes, {opened} of {closed} edicts, {empty} empty"
        config = self.config.read_text()
        marks = re.findall(r'^seta (?:aaa|zzz)_run "(\d+)"\n', config, re.M)
        assert len(marks) == 2 and marks[0] == marks[1] and config.endswith(f'seta zzz_run "{marks[1]}"\n'), \
            f"kill {run}: {self.config.name} is no whole configuration: {marks}, {len(config)} bytes"
        return int(marks[0])


def killed(build, home, kills, seed):
    dice, kept, amid = random.Random(seed), Kept(home), 0
    (home / "id1").mkdir(parents=True)
    (home / "id1" / "loop.cfg").write_text(LOOP)
    for run in range(kills + 1):
        begin = ["+map", "start"] if run == 0 else ["+exec", "kept.cfg", "+load", "kept"]
        game = Program("the server", command(build, home, *begin, "+exec", "loop.cfg", "+seta", "aaa_run", str(run),
                                             "+seta", "zzz_run", str(run), "+go"))
        try:
            game.wait_for("^wrote kept.cfg", 60)  # by now a game runs: without one nothing is saved
            time.sleep(dice.uniform(0, LONGEST_WAIT))
        finally:
            game.process.send_signal(signal.SIGKILL)
            game.process.wait()
        game.catch_up()
        wrong = [line for line in game.lines if re.search("cannot|no such|no game|malformed|makes no sense", line)]
        assert not wrong, f"run {run}: {wrong[0]}"
        amid += bool(kept.half())
        assert kept.check(run) in (run, run - 1)
    print(f"killed {kills} times, {amid} amid a write: every file whole")


def refused(build, home, what, before=(), prepare=lambda: None):
    """With the former files there, no file can be written any more."""
    kept = Kept(home)
    (home / "id1").mkdir(parents=True, exist_ok=True)
    if not kept.save.exists():
        subprocess.run(command(build, home, "+map", "start", "+seta", "aaa_run", "1", "+seta", "zzz_run", "1", "+save", "kept",
                               "+writeconfig", "kept", "+quit"), check=True, capture_output=True, timeout=60)
    former = {path: path.read_bytes() for path in (kept.save, kept.config)}
    prepare()
    ran = subprocess.run(command(build, home, "+map", "start", "+seta", "filler", "x" * 4000, "+save", "kept", "+writeconfig", "kept", "+save", "other/new",
                                 "+echo", "still here", "+sv_run", "1", "+edictcount", "+quit", before=before),
                         text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=60)
    said = ran.stdout.splitlines()
    for name in ("kept.sav", "kept.cfg", "other/new.sav"):
        sentences = [line for line in said if name in line and "cannot be" in line]
        assert len(sentences) == 1, f"{what}: {name}: {sentences} of\n{ran.stdout}"
    assert "still here" in said and any("num_edicts" in line for line in said), f"{what}: the game is over:\n{ran.stdout}"
    assert not any(re.match("saved as|wrote", line) for line in said), ran.stdout
    for path, data in former.items():
        assert path.read_bytes() == data, f"{what}: {path.name} has changed"
    assert not kept.half(), f"{what}: a half file is left"
    print(f"{what}: one sentence for each file, the former ones stay")


def can(*words):
    return shutil.which(words[0]) is not None and subprocess.run(words, capture_output=True).returncode == 0


def full_disk(build, home):
    """Files that may not grow beyond 2 KB, which fails amid a write; and where a disk can be mounted, one of 64 KB."""
    refused(build, home / "limit", "files limited in size", before=["sh", "-c", 'ulimit -f 2; exec "$@"', "sh"])  # blocks of 1 KB, or half that
    if not can("unshare", "-rm", "true"):
        return print("skipped: no small disk can be mounted here")
    disk = home / "disk"
    disk.mkdir()
    inside = 'mount -t tmpfs -o size=64k none "$0" && cp -r "$0.kept/." "$0" && dd if=/dev/zero of="$0/filler" 2>/dev/null; "$@"; ' \
             'rm "$0/filler"; cp -r "$0/." "$0.kept"; exit 0'
    kept = home / "disk.kept"
    small = Kept(kept)
    subprocess.run(command(build, kept, "+map", "start", "+writeconfig", "kept", "+quit"), check=True, capture_output=True, timeout=60)
    before = small.config.read_bytes()
    ran = subprocess.run(["unshare", "-rm", "sh", "-c", inside, disk, *command(
        build, disk, "+map", "start", "+save", "kept", "+writeconfig", "kept", "+echo", "still here", "+edictcount", "+quit")],
        text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=60)
    for name in ("kept.sav", "kept.cfg"):
        assert len(re.findall(f"{name}: cannot be written: No space", ran.stdout)) == 1, ran.stdout
    assert "still here" in ran.stdout and "num_edicts" in ran.stdout, ran.stdout
    assert small.config.read_bytes() == before and not small.half()
    print("full disk: one sentence for each file, the former one stays")


def read_only(build, home):
    before = []
    if os.geteuid() == 0:  # root may write anywhere, unless it gives that up
        before = ["setpriv", "--bounding-set", "-dac_override,-dac_read_search"]
        if not can(*before, "true"):
            return print("skipped: root cannot give up its rights here, so no folder is closed to it")
    folder = home / "locked"

    def lock():
        for path in (folder / "id1", folder):
            path.chmod(0o555)
    try:
        refused(build, folder, "read-only folder", before, lock)
    finally:
        for path in (folder, folder / "id1"):
            path.chmod(0o755)


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    kills = int(sys.argv[2]) if len(sys.argv) > 2 else 25
    if not (build / "game" / "id1" / "progs.dat").exists():
        print("skipped: the base game is not built")
        return SKIPPED
    seed = random.SystemRandom().randrange(1 << 32)
    print(f"seed {seed}")
    with tempfile.TemporaryDirectory() as name:
        home = pathlib.Path(name)
        killed(build, home / "killed", kills, seed)
        full_disk(build, home)
        read_only(build, home)
    return 0


if __name__ == "__main__":
    sys.exit(main())
