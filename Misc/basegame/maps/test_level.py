"""Plays the script of a way through the level, and reads where it came by; skipped where no built game is named
(FULLBRIGHT_BUILD, the folder that holds `fullbright` and game/id1)."""

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from walker import UNSEEN

HERE = Path(__file__).resolve().parent
BUILD = Path(os.environ.get("FULLBRIGHT_BUILD", "nowhere"))
GAME = Path(os.environ.get("FULLBRIGHT_GAME", BUILD / "game"))
SILVER, GOLD = 1 << 17, 1 << 18  # bits of `items`


def play(level: str, script: str, skill: int) -> tuple[str, dict[str, str]]:
    """Plays a script; what the program said, and the dumps and demos that the script wrote by their names."""
    with tempfile.TemporaryDirectory() as user:
        folder = Path(user) / "id1"
        folder.mkdir()
        (folder / script).write_bytes((HERE / script).read_bytes())
        run = subprocess.run([BUILD / "fullbright", "-headless", "-size", "16x16", "-seed", "1", "-basedir", GAME, "-userdir",
                              user, *UNSEEN, "+host_framerate", "0.05", "+skill", str(skill), "+map", level, "+exec", script],
                             capture_output=True, text=True, timeout=900, check=False)
        written = [*folder.glob("*.txt"), *folder.glob("*.dem")]
        return run.stdout + run.stderr, {path.stem: path.read_text(encoding="latin-1") for path in written}


def edicts(text: str) -> list[dict[str, str]]:
    blocks = re.findall(r"\nedict \d+\n\{(.*?)\n\}", text, re.S)
    return [dict(re.findall(r'"([^"]+)" "([^"]*)"', block)) for block in blocks]


@unittest.skipUnless((BUILD / "fullbright").exists() and (GAME / "id1/progs.dat").exists(), "no built game")
class TheWayThroughTheLevel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.said, cls.marks = play("fb1", "walk_fb1.cfg", skill=0)

    def player(self, mark: str) -> dict[str, str]:
        self.assertIn(mark, self.marks, self.said[-2000:])
        return edicts(self.marks[mark])[1]

    def items(self, mark: str) -> int:
        return int(float(self.player(mark)["items"]))

    def origin(self, mark: str) -> list[float]:
        return [float(c) for c in self.player(mark)["origin"].split()]

    def test_the_train_brings_one_to_the_silver_key(self):
        self.assertFalse(self.items("walk_hall") & SILVER)
        self.assertTrue(self.items("walk_silver") & SILVER)
        self.assertLess(self.origin("walk_silver")[0], -1264)  # beyond the lava

    def test_the_silver_door_takes_the_key_and_opens(self):
        self.assertFalse(self.items("walk_under_water") & SILVER)
        self.assertGreater(self.origin("walk_under_water")[1], 800)

    def test_the_well_leads_under_water(self):
        self.assertGreaterEqual(float(self.player("walk_under_water").get("waterlevel", "0")), 3)
        self.assertLess(self.origin("walk_under_water")[2], -192)

    def test_the_island_has_the_gold_key(self):
        self.assertFalse(self.items("walk_under_water") & GOLD)
        self.assertTrue(self.items("walk_gold") & GOLD)

    def test_the_lift_goes_up_to_the_gallery(self):
        self.assertLess(self.origin("walk_cistern_door")[2], 30)
        self.assertGreater(self.origin("walk_lift")[2], 200)

    def test_the_gold_door_takes_the_key_and_opens(self):
        self.assertFalse(self.items("walk_tower") & GOLD)
        self.assertLess(self.origin("walk_tower")[0], -576)  # behind it

    def test_the_exit_leads_to_the_gates_with_the_rune(self):
        self.assertEqual(edicts(self.marks["walk_tower"])[0]["model"], "maps/fb1.bsp")
        self.assertEqual(edicts(self.marks["walk_exit"])[0]["model"], "maps/gates.bsp")
        self.assertIn('"serverflags" "0.', self.marks["walk_tower"])
        self.assertIn('"serverflags" "1.', self.marks["walk_exit"])


if __name__ == "__main__":
    unittest.main()
