"""Doors, buttons, lifts, trains and secret doors: when they move, how far, and who pays."""

import sys
import pathlib
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

from qc.testing.case import PlayCase  # noqa: E402

START = {"classname": "info_player_start", "origin": "0 0 -230"}
DOOR_BOX = ((200, -50, -256), (216, 50, -100))  # 156 high: 148 to go


class MoversTest(PlayCase):
    def session(self, entities, boxes, script):
        self.game.write_map("test", [START, *entities], boxes)
        return self.game.play(["0.6", *script])

    def height(self, state, model: str = "*1") -> float:
        return state.place(state.one(model=model))[2]

    def test_door_opens_waits_and_closes(self):
        door = {"classname": "func_door", "model": "*1", "angle": "-1"}
        walk = ["at 160 0 -231", "0.1", "at 0 0 -231"]
        session = self.session(
            [door],
            [DOOR_BOX],
            [*walk, "0.7", "see up", "1.2", "see open", "2.1", "see still", "1.2", "see down", "1.5", "see closed"],
        )
        self.assertTrue(40 < self.height(session["up"]) < 110, self.height(session["up"]))
        self.assertEqual(self.height(session["open"]), 148)
        self.assertEqual(self.height(session["still"]), 148)  # 3 seconds
        self.assertTrue(0 < self.height(session["down"]) < 148)
        self.assertEqual(self.height(session["closed"]), 0)

    def test_doors_that_touch_open_together(self):
        doors = [{"classname": "func_door", "model": f"*{i}", "angle": a} for i, a in ((1, "90"), (2, "270"))]
        boxes = [((200, 0, -256), (216, 50, -100)), ((200, -50, -256), (216, 0, -100))]
        session = self.session(doors, boxes, ["at 160 40 -231", "1.5", "see open"])
        state = session["open"]
        self.assertEqual([state.place(state.one(model=m))[1] for m in ("*1", "*2")], [42, -42])

    def test_door_with_a_name_waits_for_its_button(self):
        door = {"classname": "func_door", "model": "*1", "angle": "-1", "targetname": "d", "wait": "-1"}
        button = {"classname": "func_button", "model": "*2", "angle": "0", "target": "d"}
        boxes = [DOOR_BOX, ((60, 190, -256), (70, 210, -180))]
        script = [
            "at 150 0 -231",
            "1",
            "see before",
            "at 20 200 -231",
            "0.2",
            "+forward",
            "0.5",
            "-forward",
            "0.1",
            "see pressed",
        ]
        session = self.session([door, button], boxes, [*script, "1", "see released", "6", "see long"])
        self.assertEqual(self.height(session["before"]), 0)
        pressed = session["pressed"]
        self.assertEqual(pressed.number("frame", pressed.one(model="*2")), 1)
        self.assertEqual(pressed.place(pressed.one(model="*2"))[0], 6)  # ten units but for a lip of four
        self.assertEqual(self.height(session["long"]), 148)  # for good

    def test_shot_button(self):
        door = {"classname": "func_door", "model": "*1", "angle": "-1", "targetname": "d", "wait": "-1"}
        button = {"classname": "func_button", "model": "*2", "angle": "0", "target": "d", "health": "1"}
        session = self.session(
            [door, button],
            [((600, -50, -256), (616, 50, -100)), ((300, -50, -256), (316, 50, -100))],
            ["+attack", "0.05", "-attack", "3", "see end"],
        )
        self.assertEqual(self.height(session["end"]), 148)

    def test_toggled_door_stays_until_it_is_used_again(self):
        door = {"classname": "func_door", "model": "*1", "angle": "-1", "targetname": "d", "spawnflags": "32"}
        again = {"classname": "trigger_multiple", "model": "*2", "target": "d", "wait": "1"}
        boxes = [DOOR_BOX, ((-100, -300, -256), (100, -200, -100))]
        step = ["at 0 -250 -231", "0.3", "at 0 0 -231"]
        session = self.session([door, again], boxes, [*step, "5", "see open", *step, "3", "see closed"])
        self.assertEqual(self.height(session["open"]), 148)
        self.assertEqual(self.height(session["closed"]), 0)

    def test_door_with_a_key(self):
        door = {"classname": "func_door", "model": "*1", "angle": "-1", "spawnflags": "16"}
        key = {"classname": "item_key1", "origin": "0 300 -220"}
        walk = ["at 150 0 -231", "+forward", "0.5", "-forward"]
        script = [*walk, "1.5", "see locked", "at 0 300 -231", "0.2", "see key", "2", *walk, "2", "see open"]
        session = self.session([door, key], [DOOR_BOX], script)
        self.assertEqual(self.height(session["locked"]), 0)
        self.assertIn("silver key", session.said)
        self.assertTrue(int(session["key"].number("items")) & 131072)
        self.assertFalse(int(session["open"].number("items")) & 131072)  # the door has it now
        self.assertEqual(self.height(session["open"]), 148)

    def test_lift(self):
        plat = {"classname": "func_plat", "model": "*1", "height": "200"}
        box = ((200, -64, -256 + 200 - 16), (328, 64, -256 + 200))
        session = self.session([plat], [box], ["see bottom", "at 264 0 -231", "0.3", "at 264 0 -200", "3", "see top"])
        self.assertEqual(self.height(session["bottom"]), -200)
        top = session["top"]
        self.assertEqual(self.height(top), 0)
        self.assertGreater(top.place()[2], -256 + 200)  # and the player with it

    def test_lift_with_a_name_is_up_until_it_is_used(self):
        plat = {"classname": "func_plat", "model": "*1", "height": "200", "targetname": "p"}
        box = ((200, -64, -72), (328, 64, -56))
        use = {"classname": "trigger_once", "model": "*2", "target": "p"}
        boxes = [box, ((-100, -300, -256), (100, -200, -100))]
        session = self.session([plat, use], boxes, ["see up", "at 0 -250 -231", "2.5", "see down"])
        self.assertEqual(self.height(session["up"]), 0)
        self.assertEqual(self.height(session["down"]), -200)

    def test_train_goes_round_and_waits(self):
        corners = [("a", "b", "300 300 -256", "0"), ("b", "c", "500 300 -256", "2"), ("c", "a", "500 500 -256", "0")]
        path = [
            {"classname": "path_corner", "targetname": n, "target": t, "origin": o, "wait": w} for n, t, o, w in corners
        ]
        train = {"classname": "func_train", "model": "*1", "target": "a", "speed": "200"}
        session = self.session(
            [*path, train], [((0, 0, 0), (64, 64, 64))], ["0.9", "see at_b", "1.3", "see waits", "1.3", "see on"]
        )
        at = [session[s].place(session[s].one(model="*1")) for s in ("at_b", "waits", "on")]
        self.assertEqual(at[0], (500, 300, -256))
        self.assertEqual(at[1], at[0])
        self.assertGreater(at[2][1], at[0][1])

    def test_secret_door_is_shot_open_and_comes_back(self):
        door = {"classname": "func_door_secret", "model": "*1", "angle": "0", "speed": "100", "wait": "1"}
        box = ((300, -50, -256), (332, 50, -100))
        # 100 to the side (its width), a second, 32 along; a second; and back.
        session = self.session(
            [door], [box], ["+attack", "0.05", "-attack", "0.6", "see side", "2.3", "see end", "4.5", "see home"]
        )
        side, end, home = (session[s].place(session[s].one(model="*1")) for s in ("side", "end", "home"))
        self.assertLess(side[1], 0)
        self.assertEqual(side[0], 0)
        self.assertAlmostEqual(end[1], -100, delta=0.1)
        self.assertAlmostEqual(end[0], 32, delta=0.1)
        self.assertEqual(home, (0, 0, 0))

    def test_blocked_door_hurts_and_goes_back(self):
        door = {"classname": "func_door", "model": "*1", "angle": "-2", "targetname": "d", "dmg": "7", "lip": "-60"}
        use = {"classname": "trigger_once", "model": "*2", "target": "d"}
        boxes = [((-60, -310, -150), (60, -190, -100)), ((-60, -310, -256), (60, -190, -200))]
        session = self.session([door, use], boxes, ["at 0 -250 -231", "2", "see end"])
        self.assertLess(session["end"].number("health"), 100)
        self.assertGreater(session["end"].number("health"), 60)

    def test_gates_of_episodes(self):
        gates = [
            {"classname": "func_episodegate", "model": "*1", "spawnflags": "1"},
            {"classname": "func_bossgate", "model": "*2"},
        ]
        self.game.write_map("test", [START, *gates], [DOOR_BOX, DOOR_BOX])
        session = self.game.play(
            [
                "0.5",
                "see none",
                "impulse 11",
                "0.2",
                "changelevel test",
                "1",
                "see first",
                "impulse 11",
                "0.2",
                "impulse 11",
                "0.2",
                "impulse 11",
                "0.2",
                "changelevel test",
                "1",
                "see all",
            ]
        )
        there = [
            [e["model"] for e in session[s].edicts.values() if e.get("model", "").startswith("*")]
            for s in ("none", "first", "all")
        ]
        self.assertEqual(there, [["*2"], ["*1", "*2"], ["*1"]])


if __name__ == "__main__":
    unittest.main()
