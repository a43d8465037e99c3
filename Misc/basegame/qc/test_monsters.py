"""Monsters played against a player who stands still: what they are, when they wake, that they hurt and die, and how
they get on with one another. The plays themselves are in testing/test_monsters.qc."""

import pathlib
import socket
import subprocess
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from qc.testing.case import PlayCase  # noqa: E402

# name: health, width, height, what each of its hits costs at least and at most (without armour), first and last frame of
# its pains, last frames of its deaths, what it leaves
KINDS = {
    "army": (30, 32, 64, (4, 16), (40, 72), (17, 28), {"shells": 5}),
    "dog": (25, 64, 64, (1, 24), (26, 47), (16, 25), {}),
    "ogre": (200, 64, 88, (1, 40), (67, 111), (125, 135), {"rockets": 2}),
    "knight": (75, 32, 64, (1, 9), (28, 41), (85, 96), {}),
    "hell_knight": (250, 32, 64, (1, 9), (37, 41), (53, 62), {}),
    "wizard": (80, 32, 64, (9, 9), (42, 45), (53,), {}),
    "demon1": (300, 64, 88, (10, 50), (39, 44), (53,), {}),
    "shambler": (600, 64, 88, (1, 120), (77, 82), (93,), {}),
    "zombie": (60, 32, 64, (10, 10), (162, 191), None, {}),
    "tarbaby": (80, 32, 64, (10, 20), None, None, {}),
    "shalrath": (400, 64, 88, (25, 40), (11, 15), (22,), {}),
    "fish": (25, 32, 48, (1, 6), (57, 65), (38,), {}),
    "enforcer": (80, 32, 64, (15, 15), (66, 101), (54, 65), {"cells": 5}),
}
ACTORS = [
    ("army", "soldier", {"target": "switch"}), ("ogre", "ogre", {}), ("knight", "knight", {}), ("knight", "knight2", {}),
    ("army", "soldier2", {}), ("zombie", "risen", {}), ("army", "seer", {}), ("army", "friend", {}),
    ("army", "ambush", {"spawnflags": "1"}), ("knight", "walker", {}), ("demon1", "jumper", {}), ("ogre_marksman", "spare", {}),
    ("hell_knight", "caster", {}), ("shalrath", "vore", {}), ("knight", "watcher", {}),
]
PEN = ((-1024, 384, -256), (1024, 400, 1024))
SCREEN = ((-278, -1024, -256), (-262, -172, 1024))
CLOSET = ((940, 950, -256), (1020, 1020, -150))
SPRING = ((-198, -620, -256), (-134, -556, -192))
RODS = [((300, -100, 200), (316, -84, 300)), ((600, -100, 200), (616, -84, 300))]
BOXES = [PEN, SCREEN, CLOSET, SPRING, *RODS]


def entity(classname: str, **keys: str) -> dict[str, str]:
    return {"classname": classname, **keys}


def things() -> list[dict[str, str]]:
    """The hall's furniture, and what the plays at the end need."""
    rod = {"target": "lightning", "targetname": "rod", "angle": "-1", "wait": "-1", "speed": "200"}
    return [
        entity("info_player_start", origin="0 -300 -231"), entity("test_monsters"), entity("test_switch", targetname="switch"),
        entity("func_wall", model="*1"), entity("func_wall", model="*2"),
        entity("trigger_teleport", model="*3", targetname="tele", target="there"),
        entity("info_teleport_destination", targetname="there", origin="250 -600 -256"),
        entity("trigger_monsterjump", model="*4", angle="90"),
        entity("func_door", model="*5", **rod), entity("func_door", model="*6", **rod),
        entity("event_lightning", targetname="bolt"),
        entity("path_corner", targetname="corner1", target="corner2", origin="450 -500 -232", wait="1"),
        entity("path_corner", targetname="corner2", origin="550 -500 -232"),
        entity("monster_knight", targetname="closet", origin="980 990 -231"),
        entity("monster_boss", target="switch", origin="500 -300 -232"), entity("monster_oldone", origin="-800 0 -232"),
    ]  # fmt: skip


def crowd() -> list[dict[str, str]]:
    """Everybody waits in the pen, in rows."""
    cast = [(kind, part, {}) for part in ("first", "second") for kind in KINDS] + ACTORS
    place = [f"{-440 + 135 * (i % 11)} {470 + 140 * (i // 11)} -231" for i in range(len(cast))]
    return [entity(f"monster_{k}", targetname=n, origin=o, **keys) for (k, n, keys), o in zip(cast, place)]


def free_port() -> str:
    """A UDP port that nobody has just now."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("", 0))
        return str(probe.getsockname()[1])


class MonstersCase(PlayCase):
    extra = (HERE / "testing" / "test_monsters.qc",)

    @classmethod
    def results(cls, **cvars: str) -> dict[tuple[str, str], float]:
        """Plays everything, and returns what the plays report."""
        cls.game.write_map("test", things() + crowd(), BOXES)
        command = [cls.game.engine, "-dedicated", "1", "-port", free_port(), "-seed", "1"]
        command += ["-basedir", str(cls.game.folder), "-userdir", str(cls.game.folder / "user")]
        for name, value in cvars.items():
            command += [f"+{name}", value]
        command += ["+host_framerate", "0.05", "+map", "test", "+sv_run", "800"]
        done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
        cls.said = done.stdout + done.stderr
        lines = [line.split() for line in cls.said.splitlines() if line.startswith("RESULT ")]
        found = {(name, what): float(number) for _, name, what, number in lines}
        if ("level", "end") not in found:
            raise AssertionError(f"the plays did not come to their end:\n{cls.said[-3000:]}")
        return found


class MonstersTest(MonstersCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.found = cls.results()

    def of(self, what: str, *without: str) -> dict[str, float]:
        return {kind: self.found["monster_" + kind, what] for kind in KINDS if kind not in without}

    def assert_all(self, expected: float, what: str, *without: str) -> None:
        wrong = {kind: number for kind, number in self.of(what, *without).items() if number != expected}
        self.assertEqual(wrong, {}, f"{what}: not {expected}")

    def test_nothing_is_wrong_with_the_level(self):
        wrong = [line for line in self.said.splitlines() if "error" in line.lower() or "not precached" in line or "in a wall" in line]
        self.assertEqual(wrong, [])

    def test_everybody_is_there_and_counted(self):
        cast = 2 * len(KINDS) + len(ACTORS) + 1
        self.assertEqual(self.found["level", "monsters"], cast)
        self.assertEqual(self.found["level", "total_monsters"], cast + 2)  # Chthon and the Old One

    def test_health_and_size(self):
        bodies = {k: tuple(self.found["monster_" + k, w] for w in ("health", "width", "height")) for k in KINDS}
        self.assertEqual(bodies, {kind: row[:3] for kind, row in KINDS.items()})

    def test_sleeps_with_a_silent_player_behind_it(self):
        self.assert_all(1, "sleeps")

    def test_wakes_at_noise(self):
        self.assert_all(1, "hears")

    def test_wakes_at_sight(self):
        self.assert_all(1, "sees")

    def test_hurts(self):
        for kind, row in KINDS.items():
            with self.subTest(kind):
                least, most = row[3]
                self.assertGreaterEqual(self.found["monster_" + kind, "least_damage"], least)
                self.assertLessEqual(self.found["monster_" + kind, "most_damage"], most)
                self.assertGreaterEqual(self.found["monster_" + kind, "damage"], least)

    def test_flinches(self):
        for kind, row in KINDS.items():
            if row[4]:
                self.assertIn(self.found["monster_" + kind, "pain_frame"], range(row[4][0], row[4][1] + 1), kind)

    def test_dies_and_is_counted_once(self):
        self.assert_all(1, "dead_counts")
        self.assert_all(0, "dead_solid")
        for kind, row in KINDS.items():
            if row[5]:
                self.assertIn(self.found["monster_" + kind, "dead_frame"], row[5], kind)

    def test_leaves_ammunition(self):
        for what in ("shells", "rockets", "cells"):
            self.assertEqual(self.of(what), {kind: row[6].get(what, 0) for kind, row in KINDS.items()}, what)

    def test_bursts_and_is_counted_once(self):
        self.assert_all(1, "burst", "fish")
        self.assert_all(1, "burst_counts")

    def assert_play(self, name: str, **expected: float) -> None:
        self.assertEqual({what: self.found[name, what] for what in expected}, expected)

    def test_infighting(self):
        self.assert_play("infight", turns=1, knights=0, soldiers=1, returns=1, death_target=1)

    def test_zombie_lies_down_gets_up_and_ends_by_one_hard_hit(self):
        self.assert_play("zombie", down_solid=0, down_health=60, up_solid=3, up_health=60, survives=1, bursts=1)

    def test_notices_whom_it_may(self):
        self.assert_play("notice", ring=0, notarget=0, seen=1, forgets=1, used=1)

    def test_alarm_wakes_who_sees_it_but_not_an_ambush(self):
        self.assert_play("alarm", seer=1, friend_before=0, friend=1, ambush=0)

    def test_leaps(self):
        self.assertGreaterEqual(self.found["monster_demon1", "most_damage"], 40)

    def test_spikes_fly_uphill(self):
        self.assertIn(self.found["spikes", "damage"], (9, 18, 27))  # most of the fan goes by

    def test_ball_follows(self):
        self.assert_play("vore", before=0)
        self.assertGreater(self.found["vore", "damage"], 20)

    def test_walks_to_the_last_corner(self):
        self.assertLess(self.found["walker", "distance"], 40)
        self.assertEqual(self.found["walker", "stands"], 1)

    def test_is_thrown_by_monsterjump(self):
        self.assertGreater(self.found["jump", "height"], 36)  # 24 is where it walks

    def test_arrives_by_a_teleporter_that_is_set_off(self):
        self.assertEqual(self.found["closet", "waits"], 1)
        self.assertLess(self.found["closet", "moved"], 5)

    def test_chthon(self):
        self.assert_play("boss", hidden=0, health=3, not_struck=3, counts=1, gone=1, target=1)
        self.assertGreater(self.found["boss", "damage"], 100)

    def test_old_one(self):
        self.assert_play("oldone", heals=40000, counts=1, gone=1, ending=3)


class SkillsTest(MonstersCase):
    def test_easy_needs_one_bolt(self):
        self.assertEqual(self.results(skill="0")["boss", "health"], 1)

    def test_nightmare_knows_no_rest(self):
        normal, nightmare = self.results(skill="1"), self.results(skill="3")
        self.assertEqual(nightmare["level", "skill"], 3)
        for kind in ("army", "wizard", "shambler"):
            hits = [found["monster_" + kind, "hits"] for found in (normal, nightmare)]
            self.assertGreater(hits[1], 1.5 * hits[0], kind)

    def test_none_in_deathmatch(self):
        found = self.results(deathmatch="1")
        self.assertEqual((found["level", "monsters"], found["level", "total_monsters"]), (0, 0))


if __name__ == "__main__":
    unittest.main()
