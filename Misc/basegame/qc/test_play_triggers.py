"""Triggers: who sets off what, when, and how often; teleporters, pushes and traps."""

import sys
import pathlib
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

from qc.testing.case import PlayCase  # noqa: E402

START = {"classname": "info_player_start", "origin": "0 0 -230"}
BOX = ((-64, 400, -256), (64, 500, -100))
INSIDE, OUTSIDE = "at 0 450 -231", "at 0 0 -231"
DOOR = {"classname": "func_door", "model": "*2", "angle": "-1", "targetname": "d", "wait": "-1"}
DOOR_BOX = ((200, -50, -256), (216, 50, -100))


class TriggersTest(PlayCase):
    def session(self, entities, script, boxes=(BOX, DOOR_BOX), setup=""):
        self.game.write_map("test", [START, *entities], list(boxes))
        return self.game.play(["0.6", *script], setup)

    def is_open(self, state) -> bool:
        return state.place(state.one(model="*2"))[2] > 0

    def test_relay_waits_its_delay(self):
        once = {"classname": "trigger_once", "model": "*1", "target": "r"}
        relay = {
            "classname": "trigger_relay",
            "targetname": "r",
            "target": "d",
            "delay": "1",
            "message": "a word of the relay",
        }
        session = self.session([once, relay, DOOR], [INSIDE, "0.9", "see early", "0.5", "see late"])
        self.assertFalse(self.is_open(session["early"]))
        self.assertTrue(self.is_open(session["late"]))
        self.assertEqual(session["late"].all("trigger_once"), [])  # it is gone

    def test_counter(self):
        multiple = {"classname": "trigger_multiple", "model": "*1", "target": "c", "wait": "0.5"}
        counter = {"classname": "trigger_counter", "targetname": "c", "target": "d", "count": "3"}
        session = self.session(
            [multiple, counter, DOOR], [INSIDE, "0.2", "see one", "0.5", "see two", "0.7", "see three"]
        )
        self.assertEqual([self.is_open(session[s]) for s in ("one", "two", "three")], [False, False, True])

    def test_killtarget_removes_and_sets_off_nothing(self):
        once = {"classname": "trigger_once", "model": "*1", "killtarget": "k", "target": "d"}
        session = self.session(
            [once, {"classname": "info_notnull", "targetname": "k"}, DOOR], [INSIDE, "1", "see after"]
        )
        self.assertEqual(session["after"].all("info_notnull"), [])
        self.assertFalse(self.is_open(session["after"]))

    def test_secret_counts_once(self):
        secret = {"classname": "trigger_secret", "model": "*1"}
        session = self.session(
            [secret, DOOR], ["see before", INSIDE, "0.3", OUTSIDE, "0.2", INSIDE, "0.3", "see after"]
        )
        self.assertEqual(float(session["before"].globals["total_secrets"]), 1)
        self.assertEqual(float(session["before"].globals.get("found_secrets", "0")), 0)
        self.assertEqual(float(session["after"].globals["found_secrets"]), 1)

    def test_trigger_with_an_angle_asks_where_one_looks(self):
        for angle, opens in (("360", True), ("180", False)):  # the player looks east
            once = {"classname": "trigger_once", "model": "*1", "target": "d", "angle": angle}
            session = self.session([once, DOOR], [INSIDE, "0.6", "see after"])
            self.assertEqual(self.is_open(session["after"]), opens, angle)

    def test_trigger_that_is_shot(self):
        once = {"classname": "trigger_once", "model": "*1", "target": "d", "health": "1"}
        boxes = (((300, -50, -256), (316, 50, -100)), ((400, 200, -256), (416, 300, -100)))
        session = self.session([once, DOOR], ["+attack", "0.05", "-attack", "0.6", "see after"], boxes)
        self.assertTrue(self.is_open(session["after"]))

    def test_teleport(self):
        teleport = {"classname": "trigger_teleport", "model": "*1", "target": "t"}
        there = {"classname": "info_teleport_destination", "targetname": "t", "origin": "500 0 -200", "angle": "90"}
        session = self.session([teleport, there, DOOR], [INSIDE, "0.15", "see after"])
        place = session["after"].place()
        self.assertEqual(place[0], 500)
        self.assertGreater(place[1], 5)  # 300 a second to the north
        self.assertAlmostEqual(float(session["after"].player["angles"].split()[1]), 90, delta=1)

    def test_teleport_with_a_name_must_be_used(self):
        teleport = {"classname": "trigger_teleport", "model": "*1", "target": "t", "targetname": "now"}
        there = {"classname": "info_teleport_destination", "targetname": "t", "origin": "500 0 -200", "angle": "90"}
        use = {"classname": "trigger_relay", "targetname": "unused", "target": "now"}
        session = self.session([teleport, there, use, DOOR], [INSIDE, "0.4", "see after"])
        self.assertEqual(session["after"].place()[0], 0)

    def test_push(self):
        push = {"classname": "trigger_push", "model": "*1", "angle": "-1", "speed": "60"}
        session = self.session([push, DOOR], [INSIDE, "0.4", "see after"])
        self.assertGreater(session["after"].place()[2], -100)

    def test_hurt_once_a_second(self):
        hurt = {"classname": "trigger_hurt", "model": "*1", "dmg": "7"}
        session = self.session([hurt, DOOR], [INSIDE, "2.6", "see after"])
        self.assertEqual(session["after"].number("health"), 100 - 3 * 7)

    def test_skill(self):
        skill = {"classname": "trigger_setskill", "model": "*1", "message": "3"}
        session = self.session([skill, DOOR], [INSIDE, "0.3", "skill"])
        self.assertIn('"skill" is "3"', session.said)

    def test_lamp_with_a_switch(self):
        lamp = {"classname": "light", "targetname": "l", "style": "32", "spawnflags": "1", "origin": "0 0 0"}
        plain = {"classname": "light", "origin": "0 0 50"}
        once = {"classname": "trigger_once", "model": "*1", "target": "l"}
        session = self.session([lamp, plain, once, DOOR], ["see off", INSIDE, "0.3", "see on"])
        self.assertEqual(len(session["off"].all("light")), 1)  # nobody switches the other
        self.assertEqual([session[s].number("spawnflags", session[s].all("light")[0]) for s in ("off", "on")], [1, 0])

    def test_spike_trap(self):
        trap = {
            "classname": "trap_spikeshooter",
            "targetname": "s",
            "origin": "400 450 -215",
            "angle": "180",
            "spawnflags": "1",
        }
        once = {"classname": "trigger_once", "model": "*1", "target": "s"}
        session = self.session([trap, once, DOOR], [INSIDE, "0.3", "see flying", "1", "see hit"])
        self.assertEqual(len(session["flying"].all("spike")), 1)
        self.assertEqual(session["hit"].number("health"), 100 - 18)

    def test_explosive_box(self):
        box = {"classname": "misc_explobox", "origin": "300 -16 -250"}
        session = self.session(
            [box, DOOR],
            ["see before", "+attack", "0.05", "-attack", "1.5", "see after"],
            (BOX, ((0, 600, 0), (9, 609, 9))),
        )
        self.assertEqual(len(session["before"].all("misc_explobox")), 1)
        self.assertEqual(session["after"].all("misc_explobox"), [])

    def test_what_maps_name_is_used(self):
        """A map may give barrel_explode to anything."""
        thing = {"classname": "info_notnull", "use": "barrel_explode", "targetname": "b", "origin": "60 450 -215"}
        once = {"classname": "trigger_once", "model": "*1", "target": "b"}
        session = self.session([thing, once, DOOR], [INSIDE, "1.5", "see after"])
        self.assertLess(session["after"].number("health"), 100)

    def test_lava_ball(self):
        times = [f"at_{i}" for i in range(6)]
        script = [line for name in times for line in ("1", f"see {name}")]
        session = self.session([{"classname": "misc_fireball", "origin": "400 400 -200"}, DOOR], script)
        # The first comes within five seconds, and is in the air for more than one.
        self.assertTrue(any(session[name].all("fireball") for name in times))

    def test_everything_else_spawns(self):
        """One of each thing that only stands or sounds, and the game goes on."""
        names = "light_fluoro light_fluorospark light_globe light_torch_small_walltorch light_flame_large_yellow"
        names += (
            " light_flame_small_yellow light_flame_small_white air_bubbles event_lightning viewthing ambient_suck_wind"
        )
        names += " ambient_drone ambient_flouro_buzz ambient_drip ambient_comp_hum ambient_thunder ambient_light_buzz"
        names += " ambient_swamp1 ambient_swamp2 info_null misc_noisemaker trap_shooter misc_explobox2 item_weapon"
        things = [{"classname": n, "origin": "-800 -600 -100", "spawnflags": "1"} for n in names.split()]
        session = self.session([*things, DOOR], ["3", "see after"])
        self.assertNotIn("No spawn function", session.said)
        self.assertTrue(session["after"].all("bubble"))
        self.assertTrue(session["after"].all("spike"))


if __name__ == "__main__":
    unittest.main()
