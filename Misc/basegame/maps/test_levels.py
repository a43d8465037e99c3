"""Plays the scripts of the ways through the second, third and fourth level, and of the whole game from the hub to its end; skipped where
no built game is named."""

import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from test_level import BUILD, GAME, GOLD, SILVER, edicts, play
from walker import UNSEEN

BUILT = (BUILD / "fullbright").exists() and (GAME / "id1/progs.dat").exists()


def developer_says(level: str, skill: int) -> tuple[str, list[dict[str, str]]]:
    """What QuakeC tells developers of where it put monsters and items, over two seconds, and the edicts after them.

    That a player "entered the game" is said by the clock on the wall, as in Quake: a busy machine does not say it."""
    with tempfile.TemporaryDirectory() as user:
        run = subprocess.run([BUILD / "fullbright", "-headless", "-size", "16x16", "-seed", "1", "-basedir", GAME, "-userdir", user, *UNSEEN,
                              "+host_framerate", "0.2", "+developer", "1", "+skill", str(skill), "+map", level, *["+wait"] * 40, "+sv_dump",
                              "places.txt", "+quit"], capture_output=True, text=True, timeout=300, check=False)
        dump = Path(user) / "id1/places.txt"
        return run.stdout + run.stderr, edicts(dump.read_text(encoding="latin-1")) if dump.exists() else []


class Played(unittest.TestCase):
    """What the marks of a script say."""

    level = script = ""

    @classmethod
    def setUpClass(cls):
        cls.said, cls.marks = play(cls.level, cls.script, skill=0)

    def mark(self, name: str) -> list[dict[str, str]]:
        self.assertIn(name, self.marks, self.said[-2000:])
        return edicts(self.marks[name])

    def items(self, name: str) -> int:
        return int(float(self.mark(name)[1]["items"]))

    def origin(self, name: str) -> list[float]:
        return [float(c) for c in self.mark(name)[1]["origin"].split()]

    def map_of(self, name: str) -> str:
        return self.mark(name)[0]["model"]

    def world(self, name: str, key: str) -> int:
        """A variable of the rules."""
        self.assertIn(name, self.marks, self.said[-2000:])
        found = re.search(rf'"{key}" "([^"]*)"', self.marks[name])
        return int(float(found.group(1))) if found else 0

    def of_class(self, name: str, classname: str) -> list[dict[str, str]]:
        return [e for e in self.mark(name) if e.get("classname") == classname]


@unittest.skipUnless(BUILT, "no built game")
class Places(unittest.TestCase):
    def test_nobody_stands_in_a_wall_and_nothing_lies_outside(self):
        for level in ("start", "gates", "fb1", "fb2", "fb3", "fb4"):
            for skill in (0, 2):  # the second has all that there is
                said, there = developer_says(level, skill)
                self.assertEqual([e.get("classname") for e in there[1:2]], ["player"], said)
                self.assertEqual(re.findall(r".*(?:stands in a wall|out of the level).*", said), [], f"{level}, skill {skill}")


@unittest.skipUnless(BUILT, "no built game")
class Water(Played):
    level, script = "fb2", "walk_fb2.cfg"

    def test_a_tunnel_leads_from_the_pool_to_the_silver_key(self):
        self.assertGreaterEqual(float(self.mark("walk_under_water")[1].get("waterlevel", "0")), 3)
        self.assertFalse(self.items("walk_under_water") & SILVER)
        self.assertTrue(self.items("walk_silver") & SILVER)

    def test_the_button_opens_the_way_back(self):
        self.assertLess(self.origin("walk_silver")[0], -640)
        self.assertGreater(self.origin("walk_back")[0], -416)

    def test_the_silver_door_takes_the_key_and_opens(self):
        self.assertFalse(self.items("walk_court") & SILVER)
        self.assertGreater(self.origin("walk_court")[1], 608)

    def test_the_rune_is_won_and_the_gate_leads_on(self):
        self.assertEqual(self.world("walk_court", "serverflags"), 0)
        self.assertEqual(self.world("walk_rune", "serverflags"), 2)
        self.assertEqual(self.map_of("walk_exit"), "maps/gates.bsp")


@unittest.skipUnless(BUILT, "no built game")
class Glass(Played):
    level, script = "fb3", "walk_fb3.cfg"

    def test_both_buttons_lift_the_case(self):
        self.assertTrue(self.of_class("walk_west", "trigger_counter"))
        self.assertEqual(float(self.of_class("walk_west", "trigger_counter")[0]["count"]), 1)
        self.assertFalse(self.items("walk_east") & GOLD)
        self.assertTrue(self.items("walk_gold") & GOLD)

    def test_the_gold_door_takes_the_key_and_opens(self):
        self.assertFalse(self.items("walk_dome") & GOLD)
        self.assertGreater(self.origin("walk_dome")[1], 576)

    def test_who_falls_into_the_well_is_lifted_out(self):
        self.assertLess(self.origin("walk_well")[2], -200)
        self.assertGreater(self.origin("walk_lift")[2], 0)

    def test_the_rune_is_won_and_the_gate_leads_on(self):
        self.assertEqual(self.world("walk_lift", "serverflags"), 0)
        self.assertEqual(self.world("walk_rune", "serverflags"), 4)
        self.assertEqual(self.map_of("walk_exit"), "maps/gates.bsp")


@unittest.skipUnless(BUILT, "no built game")
class Machine(Played):
    level, script = "fb4", "walk_fb4.cfg"

    def test_the_power_brings_the_bridge(self):
        def bridge(name):
            return next(d for d in self.of_class(name, "door") if d.get("targetname") == "power")

        self.assertNotEqual(bridge("walk_hall").get("state", "0"), bridge("walk_bridge").get("state", "0"))
        self.assertGreater(self.origin("walk_bridge")[1], 320)  # beyond the gap
        self.assertGreater(self.origin("walk_bridge")[2], 0)

    def test_the_lift_and_the_crane_bring_one_to_the_balcony(self):
        self.assertGreater(self.origin("walk_lift")[2], 192)
        self.assertGreater(self.origin("walk_balcony")[2], 192)
        self.assertLess(self.origin("walk_balcony")[1], -416)

    def test_the_rune_is_won_and_the_gate_leads_on(self):
        self.assertEqual(self.world("walk_balcony", "serverflags"), 0)
        self.assertEqual(self.world("walk_rune", "serverflags"), 8)
        self.assertEqual(self.map_of("walk_exit"), "maps/gates.bsp")


@unittest.skipUnless(BUILT, "no built game")
class TheGame(Played):
    level, script = "start", "walk_game.cfg"

    def gates(self, name: str, classname: str) -> list[int]:
        """The runes of what stands there."""
        return sorted(int(float(e.get("spawnflags", "0"))) for e in self.of_class(name, classname))

    def test_the_hub_leads_to_the_gates_and_they_to_the_levels(self):
        self.assertEqual(self.map_of("game_hub"), "maps/start.bsp")
        self.assertEqual(self.map_of("game_gates"), "maps/gates.bsp")
        for level in ("fb1", "fb2", "fb3", "fb4"):
            self.assertEqual(self.map_of(f"game_{level}"), f"maps/{level}.bsp")

    def test_the_runes_are_kept_from_level_to_level(self):
        self.assertEqual([self.world(f"game_{name}", "serverflags") for name in ("gates", "after_fb1", "after_fb2", "after_fb3", "after_fb4")],
                         [0, 1, 3, 7, 15])

    def test_the_gates_show_what_is_done(self):
        """Each has a shutter and a lit crystal from its rune on."""
        self.assertEqual(self.gates("game_gates", "func_episodegate"), [])
        self.assertEqual(self.gates("game_after_fb1", "func_episodegate"), [1, 1])
        self.assertEqual(self.gates("game_after_fb3", "func_episodegate"), [1, 1, 2, 2, 4, 4])

    def test_the_lid_opens_for_four_runes(self):
        self.assertEqual(len(self.of_class("game_after_fb3", "func_bossgate")), 1)
        self.assertEqual(len(self.of_class("game_after_fb4", "func_bossgate")), 0)
        self.assertLess(self.origin("game_below")[2], -600)

    def test_the_end_is_told(self):
        self.assertEqual(self.world("game_below", "intermission_running"), 0)
        self.assertEqual(self.world("game_frag", "intermission_running"), 3)
        self.assertEqual(len(self.of_class("game_below", "monster_oldone")), 1)
        self.assertEqual(len(self.of_class("game_end", "monster_oldone")), 0)  # it has burst, and the text is shown
        self.assertIn("The old one is gone", self.marks["the_end"])


if __name__ == "__main__":
    unittest.main()
