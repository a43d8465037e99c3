"""What players know of weapons: damage, ammunition, pace. Played by a player without a window against a wall that counts."""

import sys
import pathlib
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

from qc.testing.case import PlayCase  # noqa: E402

WALL = {"classname": "func_button", "model": "*1", "health": "10000", "wait": "-1"}


def wall_at(x: int):
    return [((x, -400, -256), (x + 16, 400, 400))]


class WeaponsTest(PlayCase):
    def shoot(self, number: int, distance: int, seconds: str = "0.05", before: tuple[str, ...] = ()):
        """Fires weapon `number` at the wall; returns (damage, states before and after)."""
        self.game.write_map("test", [{"classname": "info_player_start", "origin": "0 0 -230"}, WALL], wall_at(distance))
        script = [
            "0.5",
            *before,
            "impulse 9",
            "0.2",
            f"impulse {number}",
            "0.2",
            "see before",
            "+attack",
            seconds,
            "-attack",
        ]
        session = self.game.play([*script, "1", "see after"])
        health = [session[s].number("health", session[s].one(model="*1")) for s in ("before", "after")]
        return health[0] - health[1], session["before"], session["after"]

    def spent(self, before, after, kind: str) -> float:
        return before.number("ammo_" + kind) - after.number("ammo_" + kind)

    def test_axe(self):
        damage, _, _ = self.shoot(1, 50)
        self.assertEqual(damage, 20)

    def test_axe_reaches_64_units(self):
        damage, _, _ = self.shoot(1, 70)
        self.assertEqual(damage, 0)

    def test_shotgun(self):
        damage, before, after = self.shoot(2, 300)
        self.assertEqual(damage, 6 * 4)
        self.assertEqual(self.spent(before, after, "shells"), 1)

    def test_super_shotgun(self):
        damage, before, after = self.shoot(3, 300)
        self.assertEqual(damage, 14 * 4)
        self.assertEqual(self.spent(before, after, "shells"), 2)

    def test_nailgun(self):
        damage, before, after = self.shoot(4, 300, "1")
        nails = self.spent(before, after, "nails")
        self.assertEqual(damage, 9 * nails)
        self.assertAlmostEqual(nails, 10, delta=1)  # ten a second

    def test_super_nailgun(self):
        damage, before, after = self.shoot(5, 300, "1")
        nails = self.spent(before, after, "nails")
        self.assertEqual(damage, 9 * nails)  # 18 for two
        self.assertAlmostEqual(nails, 20, delta=2)

    def test_rocket(self):
        damage, before, after = self.shoot(7, 500)
        self.assertTrue(100 <= damage <= 120, damage)
        self.assertEqual(self.spent(before, after, "rockets"), 1)

    def test_lightning(self):
        damage, before, after = self.shoot(8, 500, "1")
        cells = self.spent(before, after, "cells")
        self.assertEqual(damage, 30 * cells)
        self.assertAlmostEqual(cells, 10, delta=1)

    def test_lightning_ends_after_600_units(self):
        self.assertEqual(self.shoot(8, 630, "0.5")[0], 0)

    def test_quad_makes_it_four_times_as_much(self):
        self.assertEqual(self.shoot(2, 300, before=("impulse 255", "0.1"))[0], 4 * 6 * 4)

    def test_grenade_goes_off_after_two_and_a_half_seconds(self):
        self.game.write_map("test", [{"classname": "info_player_start", "origin": "0 0 -230"}], [])
        script = [
            "0.5",
            "impulse 9",
            "0.2",
            "impulse 6",
            "0.2",
            "+attack",
            "0.1",
            "-attack",
            "2.1",
            "see before",
            "0.5",
            "see after",
        ]
        session = self.game.play(script)
        self.assertEqual(len(session["before"].all("grenade")), 1)
        self.assertEqual(session["before"].one(classname="grenade")["model"], "progs/grenade.mdl")
        left = session["after"].all("grenade")
        self.assertTrue(not left or left[0]["model"] == "progs/s_explod.spr")

    def test_pace(self):
        """Shots in the first three seconds of a held button."""
        for number, kind, each, shots in [
            (2, "shells", 1, 6),
            (3, "shells", 2, 5),
            (6, "rockets", 1, 5),
            (7, "rockets", 1, 4),
        ]:
            with self.subTest(number):
                _, before, after = self.shoot(number, 900, "2.9")
                self.assertAlmostEqual(self.spent(before, after, kind) / each, shots, delta=0.5 if number != 2 else 1)

    def test_next_best_when_empty(self):
        self.game.write_map("test", [{"classname": "info_player_start", "origin": "0 0 -230"}], [])
        session = self.game.play(["0.5", "+attack", "14", "-attack", "0.5", "see end"])
        self.assertEqual(session["end"].number("ammo_shells"), 0)
        self.assertEqual(session["end"].number("weapon"), 4096)
        self.assertEqual(session["end"].player["weaponmodel"], "progs/v_axe.mdl")

    def test_keys_of_next_and_previous_weapon(self):
        self.game.write_map("test", [{"classname": "info_player_start", "origin": "0 0 -230"}], [])
        script = ["0.5", "impulse 9", "0.2", "impulse 10", "0.2", "see next", "impulse 10", "0.2", "see wrapped"]
        session = self.game.play([*script, "impulse 12", "0.2", "see back"])
        self.assertEqual([session[s].number("weapon") for s in ("next", "wrapped", "back")], [64, 4096, 64])

    def test_lightning_under_water(self):
        self.game.write_map("test", [{"classname": "info_player_start", "origin": "-800 -600 -200"}], [])
        session = self.game.play(
            ["0.5", "impulse 9", "0.2", "impulse 8", "0.2", "+attack", "0.1", "-attack", "0.3", "see end"]
        )
        self.assertEqual(session["end"].number("ammo_cells"), 0)
        self.assertLess(session["end"].number("health"), 1)


if __name__ == "__main__":
    unittest.main()
