"""Plays a fight in the level's court, by a player whom its monsters may hurt and kill; skipped where no built game is named."""

import unittest

from test_level import BUILD, GAME, edicts, play


@unittest.skipUnless((BUILD / "fullbright").exists() and (GAME / "id1/progs.dat").exists(), "no built game")
class TheFightInTheCourt(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.said, cls.marks = play("fb1", "fight_fb1.cfg", skill=1)

    def player(self, mark: str) -> dict[str, str]:
        self.assertIn(mark, self.marks, self.said[-2000:])
        return edicts(self.marks[mark])[1]

    def living(self, mark: str) -> list[dict[str, str]]:
        """The court's monsters; what is north of it is another room's."""
        self.assertIn(mark, self.marks, self.said[-2000:])
        return [e for e in edicts(self.marks[mark]) if e.get("classname", "").startswith("monster_")
                and float(e.get("health", "0")) > 0 and float(e["origin"].split()[1]) < 0]

    def test_they_sleep_until_somebody_comes(self):
        self.assertEqual(len(self.living("fight_begin")), 4)
        self.assertFalse([m["classname"] for m in self.living("fight_begin") if float(m.get("enemy", "0"))])

    def test_they_wake_and_hurt_the_player(self):
        self.assertTrue([m["classname"] for m in self.living("fight_hurt") if m.get("enemy") == "1"])
        self.assertLess(float(self.player("fight_hurt")["health"]), 100)

    def test_they_can_be_killed_before_they_kill(self):
        self.assertEqual(self.living("fight_end"), [])
        self.assertGreater(float(self.player("fight_end")["health"]), 0)


if __name__ == "__main__":
    unittest.main()
