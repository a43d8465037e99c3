"""What lies about: how much of it there is, who may take it, and how long it lasts."""

import sys
import pathlib
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

from qc.testing.case import PlayCase  # noqa: E402

START = {"classname": "info_player_start", "origin": "0 0 -230"}
PLACE = "300 0 -231"
HURT = {"classname": "trigger_hurt", "model": "*1"}
HURT_BOX = [((-64, 400, -256), (64, 500, -100))]
SILVER, GOLD = 131072, 262144
QUAD, SUIT, PENTAGRAM, RING = 4194304, 2097152, 1048576, 524288


class ItemsTest(PlayCase):
    def take(self, item: dict[str, str], before: tuple[str, ...] = (), setup: str = "", extra=(), boxes=()):
        """The player's state after walking over one item at PLACE."""
        origin = (
            "284 -16 -230"
            if item["classname"].startswith(("item_health", "item_s", "item_c", "item_r"))
            else "300 0 -230"
        )
        self.game.write_map("test", [START, {**item, "origin": origin}, *extra], list(boxes))
        return self.game.play(["0.6", *before, "see before", f"at {PLACE}", "0.3", "see after"], setup)

    def test_ammunition(self):
        for name, kind, small in [
            ("shells", "shells", 20),
            ("spikes", "nails", 25),
            ("rockets", "rockets", 5),
            ("cells", "cells", 6),
        ]:
            for big in (0, 1):
                with self.subTest(name, big=big):
                    session = self.take({"classname": f"item_{name}", "spawnflags": str(big)})
                    got = session["after"].number("ammo_" + kind) - session["before"].number("ammo_" + kind)
                    self.assertEqual(got, small * (1 + big))
                    self.assertEqual(session["after"].one(classname=f"item_{name}").get("solid", "0"), "0")

    def test_box_in_a_wall_comes_out_beside_it(self):
        self.game.write_map(
            "test", [START, {"classname": "item_shells", "origin": "300 1000 -230"}], []
        )  # the wall is at 1024
        session = self.game.play(["0.6", "see after"])
        x, y, z = session["after"].place(session["after"].one(classname="item_shells"))
        self.assertTrue(abs(x - 300) < 33 and 960 <= y <= 1000 - 8, (x, y, z))
        self.assertAlmostEqual(z, -256, delta=1)

    def test_weapons(self):
        weapons = [("supershotgun", 2, "shells", 5), ("nailgun", 4, "nails", 30), ("supernailgun", 8, "nails", 30)]
        weapons += [
            ("grenadelauncher", 16, "rockets", 5),
            ("rocketlauncher", 32, "rockets", 5),
            ("lightning", 64, "cells", 15),
        ]
        for name, bit, kind, ammo in weapons:
            with self.subTest(name):
                session = self.take({"classname": f"weapon_{name}"})
                after = session["after"]
                self.assertEqual(after.number("weapon"), bit)
                self.assertTrue(int(after.number("items")) & bit)
                self.assertEqual(after.number("ammo_" + kind) - session["before"].number("ammo_" + kind), ammo)
                self.assertEqual(after.number("currentammo"), after.number("ammo_" + kind))

    def test_armour(self):
        for name, part, points in [("armor1", 0.3, 100), ("armor2", 0.6, 150), ("armorInv", 0.8, 200)]:
            with self.subTest(name):
                after = self.take({"classname": f"item_{name}"})["after"]
                self.assertAlmostEqual(after.number("armortype"), part, places=5)
                self.assertEqual(after.number("armorvalue"), points)

    def test_armour_takes_its_part(self):
        hurt = {**HURT, "dmg": "50"}
        self.game.write_map("test", [START, {"classname": "item_armor2", "origin": "300 0 -230"}, hurt], HURT_BOX)
        session = self.game.play(["0.6", f"at {PLACE}", "0.2", "at 0 450 -231", "0.3", "see after"])
        # 0.6 as a float is a little more, and what armour takes is rounded up.
        self.assertEqual(session["after"].number("armorvalue"), 150 - 31)
        self.assertEqual(session["after"].number("health"), 100 - 19)

    def test_health(self):
        hurt = {**HURT, "dmg": "60"}
        for flags, health in [(0, 65), (1, 55), (2, 140)]:
            with self.subTest(flags):
                item = {"classname": "item_health", "spawnflags": str(flags)}
                session = self.take(item, ("at 0 450 -231", "0.3", "at 0 0 -231", "0.1"), "", [hurt], HURT_BOX)
                self.assertEqual(session["before"].number("health"), 40)
                self.assertEqual(session["after"].number("health"), health)

    def test_full_health_leaves_boxes(self):
        session = self.take({"classname": "item_health"})
        self.assertEqual(session["after"].one(classname="item_health")["solid"], "1.000000")

    def test_mega_health_fades_after_five_seconds(self):
        self.game.write_map(
            "test", [START, {"classname": "item_health", "spawnflags": "2", "origin": "284 -16 -230"}], []
        )
        session = self.game.play(["0.6", f"at {PLACE}", "0.3", "see got", "4.4", "see still", "3", "see fading"])
        self.assertEqual(session["got"].number("health"), 200)
        self.assertEqual(session["still"].number("health"), 200)
        self.assertTrue(196 <= session["fading"].number("health") <= 198)

    def test_keys(self):
        for kind, model in [("0", "progs/w_g_key.mdl"), ("1", "progs/m_g_key.mdl"), ("2", "progs/b_g_key.mdl")]:
            world = {"classname": "worldspawn", "worldtype": kind}
            self.game.write_map("test", [world, START, {"classname": "item_key2", "origin": "300 0 -200"}], [])
            session = self.game.play(["0.6", "see before", f"at {PLACE}", "0.2", "see after"])
            self.assertEqual(session["before"].one(classname="item_key2")["model"], model)
            self.assertTrue(int(session["after"].number("items")) & GOLD)

    def test_powers_last_thirty_seconds(self):
        powers = [("super_damage", QUAD, "super_damage_finished"), ("envirosuit", SUIT, "radsuit_finished")]
        powers += [("invulnerability", PENTAGRAM, "invincible_finished"), ("invisibility", RING, "invisible_finished")]
        for name, bit, field in powers:
            with self.subTest(name):
                item = {"classname": f"item_artifact_{name}", "origin": "300 0 -200"}
                self.game.write_map("test", [START, item], [])
                session = self.game.play(
                    ["0.6", f"at {PLACE}", "0.2", "see got", "sv_run 29", "see late", "sv_run 2", "see over"]
                )
                got = session["got"]
                self.assertTrue(int(got.number("items")) & bit)
                self.assertAlmostEqual(got.number(field) - got.time, 29.9, delta=0.3)
                self.assertTrue(int(session["late"].number("items")) & bit)
                self.assertFalse(int(session["over"].number("items")) & bit)

    def test_pentagram_saves_health_and_ring_leaves_eyes(self):
        hurt = {**HURT, "dmg": "60"}
        item = {"classname": "item_artifact_invulnerability", "origin": "300 0 -200"}
        ring = {"classname": "item_artifact_invisibility", "origin": "300 -200 -200"}
        self.game.write_map("test", [START, item, ring, hurt], HURT_BOX)
        session = self.game.play(
            ["0.6", "see before", f"at {PLACE}", "0.2", "at 0 450 -231", "0.5", "at 300 -200 -231", "0.3", "see after"]
        )
        self.assertEqual(session["after"].number("health"), 100)
        self.assertNotEqual(session["after"].number("modelindex"), session["before"].number("modelindex"))

    def test_rune_opens_the_way(self):
        session = self.take({"classname": "item_sigil", "spawnflags": "4"})
        self.assertEqual(float(session["after"].globals["serverflags"]), 4)

    def test_items_come_back_in_deathmatch(self):
        item = {"classname": "item_shells", "origin": "64 -16 -230"}
        start = {"classname": "info_player_deathmatch", "origin": "0 0 -230"}
        self.game.write_map("test", [START, start, item], [])
        script = [
            "0.6",
            "+forward",
            "0.5",
            "-forward",
            "0.1",
            "see taken",
            "+back",
            "0.5",
            "-back",
            "sv_run 31",
            "see back",
        ]
        for mode, back in (("1", "1.000000"), ("2", "0")):
            session = self.game.play(script, f"deathmatch {mode}")
            self.assertEqual(session["taken"].one(classname="item_shells").get("solid", "0"), "0")
            self.assertEqual(session["back"].one(classname="item_shells").get("solid", "0"), back)

    def test_weapons_stay_in_deathmatch_2(self):
        item = {"classname": "weapon_nailgun", "origin": "64 0 -230"}
        start = {"classname": "info_player_deathmatch", "origin": "0 0 -230"}
        self.game.write_map("test", [START, start, item], [])
        session = self.game.play(["0.6", "+forward", "0.4", "-forward", "1", "see after"], "deathmatch 2")
        self.assertEqual(session["after"].number("ammo_nails"), 30)  # and only once
        self.assertEqual(session["after"].one(classname="weapon_nailgun")["solid"], "1.000000")


if __name__ == "__main__":
    unittest.main()
