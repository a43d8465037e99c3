#!/usr/bin/env python3
"""Compares the screen with QuakeSpasm's, pixel by pixel: status bar, scoreboards, plaques, the texts between levels.

    Misc/compare_hud.py BUILD [--keep DIR]

Writes a small demo for each state of the screen (STATES), which both programs play with their 3D picture black, and compares
their pictures, each at the same size and scale. QuakeSpasm runs in a virtual X server. Prints a line for each state; exit
status 1 if one differs, with both pictures and their difference in out/failed/hud_STATE; 77 where something that this needs is
absent, having said what. FULLBRIGHT_TEST_DATA names the game data (../shared/librequake).
"""

from __future__ import annotations

import argparse
import dataclasses
import os
import pathlib
import pwd
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
WIDTH, HEIGHT = 640, 400
FRAMES = 14  # between a demo's start and its picture; a tenth of a second each
EVEN = "host_maxfps 1000; con_notifytime 0; scr_conspeed 100000; host_framerate 0.1; v_gunkick 0"
# Their picture of the world, and ours, black.
THEIRS_BLACK = "r_drawworld 0; r_drawentities 0; r_drawviewmodel 0; r_particles 0; r_clearcolor 0; r_fastsky 1; " \
    "gl_texturemode gl_nearest_mipmap_linear; scr_showfps 0"
OURS_BLACK = "r_autoexposure 0; r_exposure 0.0001; r_local_exposure 0; r_bloom 0; r_bounces 0; r_denoise 0; r_scale 0.1; " \
    "scr_autoscale 0"

SHOTGUN, SUPER_SHOTGUN, NAILGUN, LIGHTNING = 1, 2, 4, 64
SHELLS, ROCKETS, CELLS = 256, 1024, 2048
AXE, ARMOR1, ARMOR3 = 4096, 8192, 32768
KEY1, KEY2, INVISIBLE, INVULNERABLE, SUIT, QUAD = (1 << bit for bit in range(17, 23))
SIGIL1, SIGIL4 = 1 << 28, 1 << 31


@dataclasses.dataclass
class State:
    """What the server says, and the settings."""

    health: int = 100
    armor: int = 0
    ammo: int = 25
    counts: tuple[int, int, int, int] = (25, 0, 0, 0)
    items: int = SHOTGUN | AXE | SHELLS
    weapon: int = SHOTGUN
    max_clients: int = 1
    deathmatch: bool = False
    players: tuple = ()  # (name, frags, colours)
    stats: tuple[int, int, int, int] = (12, 40, 3, 7)  # all secrets, all monsters, secrets, monsters
    messages: bytes = b""  # after the signon
    gains: int = 0  # items from then on
    at: int = 0  # the messages come with this frame's
    cvars: str = ""
    tolerance: int = 0  # of 255, in every channel
    pack: str = ""  # the mission pack, whose servers send the number of the weapon's bit
    level: str = "the Hall of Numbers"


PLAYERS = (("ranger", 12, 0x4D), ("", 0, 0), ("grunt", -3, 0xC1), ("a longer name", 105, 0x04), ("knight", 12, 0x00))
# Numbers of the server's messages.
TIME, SET_VIEW, SERVER_INFO, NAME, FRAGS, CLIENT_DATA, COLORS, STAT, DAMAGE = 7, 5, 11, 13, 14, 15, 17, 3, 19
PAUSE, SIGNON, CENTER_PRINT, INTERMISSION, FINALE, BASELINE, CD_TRACK, CUTSCENE = 24, 25, 26, 30, 31, 22, 32, 34


TINTS = "gl_polyblend 1; scr_sbaralpha 0.75"


def text(message: int, line: str) -> bytes:
    return bytes([message]) + line.encode("latin-1") + b"\0"


STATES = {
    "start": State(),
    "full": State(health=100, armor=200, ammo=100, counts=(100, 200, 100, 42), weapon=LIGHTNING, items=127 | AXE | CELLS | ARMOR3 |
                  KEY1 | KEY2 | INVISIBLE | SUIT | 15 << 28),
    "low": State(health=3, armor=25, ammo=10, counts=(10, 7, 0, 0), items=SHOTGUN | SUPER_SHOTGUN | NAILGUN | AXE | SHELLS | ARMOR1,
                 weapon=SUPER_SHOTGUN),
    "quad": State(items=SHOTGUN | AXE | ROCKETS | QUAD, health=180),
    "invulnerable": State(items=SHOTGUN | AXE | INVULNERABLE, weapon=0, ammo=0, armor=7),
    "both": State(items=SHOTGUN | AXE | INVULNERABLE | INVISIBLE),
    "hurt": State(health=59),
    "pain": State(health=70, messages=bytes([DAMAGE, 0, 10]) + bytes(6), at=13),
    "new_weapons": State(gains=SUPER_SHOTGUN | NAILGUN | LIGHTNING, at=8),
    "new_weapons_later": State(gains=SUPER_SHOTGUN | NAILGUN | LIGHTNING, at=6),
    "numbers": State(health=-5, armor=100, ammo=255, counts=(255, 1, 0, 99), cvars="viewsize 110"),
    "bar_alone": State(cvars="viewsize 110"),
    "nothing": State(cvars="viewsize 120"),
    "dead": State(health=0),
    "scores": State(cvars="+showscores"),
    "scores_at_120": State(cvars="+showscores; viewsize 120"),
    "scaled": State(cvars="scr_sbarscale 2; crosshair 1; scr_crosshairscale 2; scr_sbaralpha 0.75", tolerance=1, armor=150, items=127 | AXE | SHELLS | ARMOR1, weapon=NAILGUN),
    "translucent": State(cvars="scr_sbaralpha 0.75", tolerance=1),
    "invisible_bar": State(cvars="scr_sbaralpha 0"),
    "cooperative": State(max_clients=8, players=PLAYERS),
    "deathmatch": State(max_clients=8, deathmatch=True, players=PLAYERS),
    "deathmatch_low": State(max_clients=8, deathmatch=True, players=PLAYERS, cvars="viewsize 110"),
    "deathmatch_scores": State(max_clients=8, deathmatch=True, players=PLAYERS, cvars="+showscores; scr_menuscale 2"),
    "opaque_and_scaled": State(cvars="scr_sbarscale 2"),
    "crosshair": State(cvars="crosshair 1; scr_clock 1; scr_sbaralpha 0.75", tolerance=1),
    "smaller_view": State(cvars="viewsize 70; crosshair 1"),
    "smaller_view_scaled": State(cvars="viewsize 90; scr_sbarscale 2; crosshair 1; scr_crosshairscale 2"),
    "view_above_the_bar": State(cvars="viewsize 110; crosshair 1"),
    "view_below_the_bar": State(cvars="viewsize 60; scr_sbaralpha 0.75; crosshair 1", tolerance=1),
    "paused": State(messages=bytes([PAUSE, 1]), at=4),
    "center_print": State(messages=text(CENTER_PRINT, "You need the\ngold key!\n"), at=8),
    "center_print_long": State(messages=text(CENTER_PRINT, "one\ntwo\nthree\nfour\nfive\nsix"), at=8, cvars="scr_menuscale 2"),
    "center_print_crosshair": State(messages=text(CENTER_PRINT, "You need the\nsilver key!"), at=8, cvars="crosshair 1; scr_sbaralpha 0.75",
                                    tolerance=1),
    "level_end": State(messages=bytes([INTERMISSION]), at=4),
    "level_end_scaled": State(messages=bytes([INTERMISSION]), at=4, cvars="scr_menuscale 2"),
    "level_end_deathmatch": State(messages=bytes([INTERMISSION]), at=4, max_clients=8, deathmatch=True, players=PLAYERS),
    "finale": State(messages=text(FINALE, "The walls fall silent. What you came for\nlies broken behind you, and the way\nis open."), at=4),
    "finale_typed": State(messages=text(FINALE, "One.\nTwo.\nThree, four, five."), at=9, cvars="scr_printspeed 20"),
    "cutscene": State(messages=text(CUTSCENE, "Meanwhile,\nelsewhere"), at=4),
    "tint_quad": State(items=SHOTGUN | AXE | QUAD, cvars=TINTS, tolerance=1),
    "tint_suit": State(items=SHOTGUN | AXE | SUIT, cvars=TINTS, tolerance=1),
    "tint_invisible": State(items=SHOTGUN | AXE | INVISIBLE, cvars=TINTS + "; gl_cshiftpercent_powerup 50", tolerance=1),
    "tint_damage": State(health=70, messages=bytes([DAMAGE, 20, 10]) + bytes(6), at=12, cvars=TINTS, tolerance=3),  # theirs fades in whole percents
    "gamma": State(cvars="gamma 0.6", tolerance=1),
    "gamma_and_contrast": State(cvars="gamma 1.4; contrast 1.6", tolerance=1),
    "hipnotic": State(pack="hipnotic", items=127 | SHELLS | KEY1 | KEY2 | QUAD | 1 << 7 | 1 << 23 | 1 << 24 | 1 << 25 | 3 << 29, weapon=7),
    "hipnotic_new_weapons": State(pack="hipnotic", gains=16 | 1 << 16 | 1 << 7 | 1 << 23, at=8),
    "hipnotic_launcher": State(pack="hipnotic", items=SHOTGUN | 16 | 1 << 16 | ROCKETS | KEY2, weapon=4),
    "hipnotic_proximity": State(pack="hipnotic", items=SHOTGUN | 16 | 1 << 16 | ROCKETS, weapon=16),
    "hipnotic_proximity_alone": State(pack="hipnotic", items=SHOTGUN | 1 << 16, weapon=16),
    "hipnotic_neither": State(pack="hipnotic", items=SHOTGUN | 16 | 1 << 16 | 1 << 23, weapon=23, cvars="scr_sbarscale 2"),
    "rogue": State(pack="rogue", items=127 | 1 << 8 | KEY1 | QUAD | 1 << 24 | 3 << 29, weapon=2, armor=90),
    "rogue_lava_nails": State(pack="rogue", items=127 | 1 << 26 | 1 << 23, weapon=12, armor=25),
    "rogue_plasma": State(pack="rogue", items=127 | 1 << 27 | 1 << 25, weapon=16),
    "rogue_multi_rockets": State(pack="rogue", items=127 | 1 << 28, weapon=15),
    "rogue_teams": State(pack="rogue", max_clients=8, deathmatch=True, players=PLAYERS, cvars="teamplay 4"),
    "rogue_teams_white": State(pack="rogue", max_clients=8, deathmatch=True, players=(("ranger", 105, 0x0D),), cvars="teamplay 6"),
    "rogue_no_teams": State(pack="rogue", max_clients=8, deathmatch=True, players=PLAYERS, cvars="teamplay 1"),
}
# Pictures that only the mission packs have, and their sizes; the data has none of them, so that they are made up.
PACK_PICTURES = {f"{state}_{weapon}": (24, 16) for state in ("inv", "inv2", *(f"inva{i}" for i in range(1, 6)))
                 for weapon in ("laser", "mjolnir", "gren_prox", "prox_gren", "prox")}
PACK_PICTURES |= {name: (16, 16) for name in ("sb_wsuit", "sb_eshld", "r_shield1", "r_agrav1")}
PACK_PICTURES |= {name: (24, 16) for name in ("r_lava", "r_superlava", "r_gren", "r_multirock", "r_plasma")}
PACK_PICTURES |= {name: (24, 24) for name in ("r_teambord", "r_ammolava", "r_ammomulti", "r_ammoplasma")}
PACK_PICTURES |= {name: (320, 24) for name in ("r_invbar1", "r_invbar2")}


def client_data(state: State, frame: int = 0) -> bytes:
    bits = 512 | 1024 | 8192  # items, on the ground, armour
    items = state.items | (state.gains if frame >= state.at else 0)
    out = struct.pack("<BHiB", CLIENT_DATA, bits, items - (1 << 32 if items >> 31 else 0), state.armor)
    return out + struct.pack("<hB4BB", state.health, state.ammo, *state.counts, state.weapon)


def demo(state: State, level: str) -> bytes:
    """The demo's file: signon, then frames of a tenth of a second."""
    blocks = []
    info = struct.pack("<BiBB", SERVER_INFO, 15, state.max_clients, int(state.deathmatch)) + state.level.encode() + b"\0"
    info += f"maps/{level}.bsp".encode() + b"\0progs/player.mdl\0\0" + b"misc/null.wav\0\0"
    blocks.append(info + bytes([CD_TRACK, 0, 0]) + struct.pack("<Bh", SET_VIEW, 1) + bytes([SIGNON, 1]))
    blocks.append(bytes([SIGNON, 2]))
    signon = struct.pack("<Bf", TIME, 1.0)
    # The player floats far above the map and looks up: the world is out of sight, also where cheats are not allowed.
    signon += struct.pack("<BhBBBB", BASELINE, 1, 0, 0, 0, 0) + struct.pack("<hBhBhB", 0, 0, 0, 0, 3000 * 8, 0)
    for i, (name, frags, colors) in enumerate(state.players):
        signon += text(NAME, "")[:1] + bytes([i]) + name.encode() + b"\0" + struct.pack("<BBh", FRAGS, i, frags) + bytes([COLORS, i, colors])
    for number, value in zip((11, 12, 13, 14), state.stats):
        signon += struct.pack("<BBi", STAT, number, value)
    blocks.append(signon + client_data(state) + bytes([SIGNON, 3]))
    for frame in range(4 * FRAMES):
        block = struct.pack("<Bf", TIME, 1.0 + 0.1 * frame) + client_data(state, frame)
        if frame == state.at:
            block += state.messages
        blocks.append(block + bytes([128, 1]))  # the player, as the baseline is
    return b"-1\n" + b"".join(struct.pack("<i3f", len(block), -89, 0, 0) + block for block in blocks)


def pictures_of(pak: pathlib.Path) -> bytes:
    """The pak's gfx.wad, its backtile cut to 64 texels a side: of LibreQuake's 128, squeezed into 64 pixels, each pixel's middle
    lies on the border of two, and which one shows is the driver's choice."""
    data = pak.read_bytes()
    start, size = struct.unpack_from("<ii", data, 4)
    for at in range(start, start + size, 64):
        if data[at : at + 56].split(b"\0")[0] == b"gfx.wad":
            offset, length = struct.unpack_from("<ii", data, at + 56)
            wad = bytearray(data[offset : offset + length])
            count, directory = struct.unpack_from("<ii", wad, 4)
            for entry in range(directory, directory + 32 * count, 32):
                if bytes(wad[entry + 16 : entry + 32]).split(b"\0")[0].lower() == b"backtile":
                    lump = struct.unpack_from("<i", wad, entry)[0]
                    width, height = struct.unpack_from("<ii", wad, lump)
                    texels = np.frombuffer(wad, np.uint8, width * height, lump + 8).reshape(height, width)[:64, :64].tobytes()
                    wad[lump : lump + 8 + len(texels)] = struct.pack("<ii", 64, 64) + texels
                    struct.pack_into("<ii", wad, entry + 4, 8 + len(texels), 8 + len(texels))
            return with_pack_pictures(wad)
    raise SystemExit(f"{pak} has no gfx.wad")


def with_pack_pictures(wad: bytearray) -> bytes:
    """The wad with a picture of noise for each name of PACK_PICTURES."""
    count, start = struct.unpack_from("<ii", wad, 4)
    lumps, directory = bytearray(wad[12:start]), bytearray(wad[start : start + 32 * count])
    noise = np.random.default_rng(1)
    for name, (width, height) in PACK_PICTURES.items():
        picture = struct.pack("<ii", width, height) + noise.integers(0, 256, width * height, np.uint8).tobytes()
        directory += struct.pack("<iiiBBH16s", 12 + len(lumps), len(picture), len(picture), ord("B"), 0, 0, name.encode())
        lumps += picture
    return b"WAD2" + struct.pack("<ii", len(directory) // 32, 12 + len(lumps)) + bytes(lumps + directory)


def read_tga(path: pathlib.Path) -> np.ndarray:
    data = path.read_bytes()
    width, height, depth = struct.unpack_from("<HHB", data, 12)
    assert data[2] == 2 and depth == 24, path
    pixels = np.frombuffer(data, np.uint8, 3 * width * height, 18 + data[0]).reshape(height, width, 3)
    return pixels[::-1, :, ::-1] if not data[17] & 32 else pixels[:, :, ::-1]


def read_png(path: pathlib.Path) -> np.ndarray:
    """RGB of an 8-bit PNG without interlacing."""
    data, at, body = path.read_bytes(), 8, b""
    while at < len(data):
        (size,), kind = struct.unpack_from(">I", data, at), data[at + 4 : at + 8]
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack_from(">IIBB", data, at + 8)
        elif kind == b"IDAT":
            body += data[at + 8 : at + 8 + size]
        at += size + 12
    channels = {2: 3, 6: 4}[color]
    assert depth == 8, path
    rows = np.frombuffer(zlib.decompress(body), np.uint8).reshape(height, width * channels + 1)
    out = np.zeros((height + 1, width * channels + channels), np.uint8)
    for y in range(height):
        out[y + 1, channels:] = unfiltered(int(rows[y, 0]), rows[y, 1:], out[y], channels)
    return out[1:, channels:].reshape(height, width, channels)[..., :3]


def unfiltered(kind: int, row: np.ndarray, above: np.ndarray, channels: int) -> np.ndarray:
    """A PNG's row of bytes; `above` begins with a pixel of zeros."""
    if kind == 0:
        return row
    if kind == 1:
        return np.cumsum(row.reshape(-1, channels), axis=0, dtype=np.uint8).reshape(-1)
    if kind == 2:
        return row + above[channels:]
    up = above.tolist()
    now = [0] * channels
    for i, value in enumerate(row.tolist(), channels):
        left, top, corner = now[i - channels], up[i], up[i - channels]
        if kind == 3:
            near = (left + top) // 2
        else:
            by = left + top - corner
            a, b, c = abs(by - left), abs(by - top), abs(by - corner)
            near = left if a <= b and a <= c else top if b <= c else corner
        now.append((value + near) & 255)
    return np.array(now[channels:], np.uint8)


def write_png(path: pathlib.Path, pixels: np.ndarray) -> None:
    rows = np.pad(pixels.reshape(pixels.shape[0], -1), ((0, 0), (1, 0)))
    chunk = lambda kind, body: struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))  # noqa: E731
    head = struct.pack(">IIBBBBB", pixels.shape[1], pixels.shape[0], 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows.tobytes())) + chunk(b"IEND", b""))


def script(states: dict[str, State], black: str, screenshot: str) -> str:
    """Plays each demo and takes a picture of it. Settings go back to their defaults after each."""
    back = "-showscores; viewsize 100; scr_sbarscale 1; scr_sbaralpha 1; scr_menuscale 1; crosshair 0; scr_crosshairscale 1; scr_clock 0; " \
        "scr_printspeed 8; teamplay 0; gl_polyblend 0; gl_cshiftpercent_powerup 100; gamma 1; contrast 1"
    lines = [EVEN, black]
    for name, state in states.items():
        lines += [back, state.cvars, f"playdemo hud_{name}"] + ["wait"] * FRAMES + [screenshot.format(name), "wait", "stopdemo", "wait"]
    return "\n".join(lines) + "\nquit\n"


def skip(why: str) -> None:
    print(f"skipped: {why}")
    sys.exit(77)


def run(command: list, what: str, wanted: list[pathlib.Path], **options) -> None:
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=500, **options)
    missing = [path.name for path in wanted if not path.exists()]
    if missing:
        print(done.stdout[-4000:], done.stderr[-4000:], f"{what} made no {', '.join(missing)}", sep="\n")
        sys.exit(1)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--keep", type=pathlib.Path, help="folder for all pictures of both programs")
    parser.add_argument("--only", nargs="*", default=list(STATES), metavar="STATE")
    arguments = parser.parse_args()
    build = arguments.build.resolve()
    data = pathlib.Path(os.environ.get("FULLBRIGHT_TEST_DATA", ROOT.parent / "shared/librequake")).resolve()
    theirs = shutil.which("quakespasm", path=os.environ.get("PATH", "") + ":/usr/games")
    if not (data / "id1/pak0.pak").exists():
        skip(f"no LibreQuake in {data}: FULLBRIGHT_TEST_DATA names the folder that holds its id1/pak0.pak")
    if not theirs or not shutil.which("xvfb-run"):
        skip("quakespasm or xvfb is not installed (Linux/install-deps.sh test)")
    if subprocess.run([build / "fullbright", "-listdevices"], capture_output=True, check=False).returncode != 0:
        skip("there is no Vulkan device")
    if not (build / "game/id1/progs.dat").exists():
        skip("the base game, whose rules quakespasm needs to start, was not built")
    states = {name: STATES[name] for name in arguments.only}
    with tempfile.TemporaryDirectory(prefix="hud") as name:
        work = pathlib.Path(name)
        game = work / "base" / work.name  # a name of its own: quakespasm writes into the user's own folder
        written = pathlib.Path(pwd.getpwuid(os.getuid()).pw_dir) / ".quakespasm" / work.name
        game.mkdir(parents=True)
        (work / "base/id1").symlink_to(data / "id1")
        shutil.copy(build / "game/id1/progs.dat", game)
        (game / "maps").mkdir()
        shutil.copy(ROOT / "Misc/basegame/maps/b_bh25.bsp", game / "maps/hudroom.bsp")
        (game / "gfx.wad").write_bytes(pictures_of(data / "id1/pak0.pak"))
        (game / "quake.rc").write_text("stuffcmds\n")
        for state_name, state in states.items():
            (game / f"hud_{state_name}.dem").write_bytes(demo(state, "hudroom"))
        expected, found = {}, {}
        for pack in sorted({state.pack for state in states.values()}):
            of_pack = {state_name: state for state_name, state in states.items() if state.pack == pack}
            option = ["-" + pack] if pack else []
            (work / "base" / pack).mkdir(exist_ok=True)
            (game / "theirs.cfg").write_text(script(of_pack, THEIRS_BLACK, "screenshot tga"))
            (game / "ours.cfg").write_text(script(of_pack, OURS_BLACK, "screenshot {}"))
            try:
                pictures = [written / f"spasm{i:04}.tga" for i in range(len(of_pack))]
                run(["xvfb-run", "-a", "-s", f"-screen 0 {WIDTH}x{HEIGHT}x24", theirs, "-basedir", work / "base", *option, "-game", work.name,
                     "-window", "-width", str(WIDTH), "-height", str(HEIGHT), "-nosound", "+vid_fsaa", "0", "+exec", "theirs.cfg"],
                    "quakespasm", pictures, cwd=work, env=os.environ | {"LIBGL_ALWAYS_SOFTWARE": "1", "SDL_AUDIODRIVER": "dummy"})
                expected |= dict(zip(of_pack, map(read_tga, pictures)))
            finally:
                shutil.rmtree(written, ignore_errors=True)
            made = {state_name: work / "user" / work.name / "screenshots" / f"{state_name}.png" for state_name in of_pack}
            run([build / "fullbright", "-basedir", work / "base", "-userdir", work / "user", *option, "-game", work.name, "-headless", "-size",
                 f"{WIDTH}x{HEIGHT}", "+exec", "ours.cfg"], "fullbright", list(made.values()))
            found |= {state_name: read_png(path) for state_name, path in made.items()}
        return report(states, expected, found, arguments.keep)


def report(states: dict[str, State], expected: dict, found: dict, keep: pathlib.Path | None) -> int:
    failures = 0
    for name, state in states.items():
        difference = np.abs(expected[name].astype(int) - found[name].astype(int))
        off = (difference > state.tolerance).any(axis=2)
        lit = int((expected[name] > 0).any(axis=2).sum())
        folders = [keep] if keep else []
        if off.any() or lit == 0 and name != "nothing":
            failures += 1
            folders.append(ROOT / "out/failed" / f"hud_{name}")
        rows, columns = np.nonzero(off)
        where = f", first at {columns[0]},{rows[0]}" if rows.size else ""
        print(f"{name}: {lit} pixels drawn, {off.sum()} differ{where}")
        for folder in folders:
            folder.mkdir(parents=True, exist_ok=True)
            write_png(folder / f"{name}_theirs.png", expected[name])
            write_png(folder / f"{name}_ours.png", found[name])
            write_png(folder / f"{name}_difference.png", np.where(off[..., None], 255, 0).astype(np.uint8).repeat(3, axis=2))
    print("ok" if failures == 0 else f"FAILED: {failures} of {len(states)}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
