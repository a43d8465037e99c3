"""A player's body: liquids, falls, death, levels one after the other, and what a game among players counts."""

import sys
import pathlib
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

from qc.make import HERE  # noqa: E402
from qc.testing.case import PlayCase  # noqa: E402

START = {"classname": "info_player_start", "origin": "0 0 -230"}
# In the pool: its liquids are 256 deep and reach up to z = 0.
WATER, SLIME, LAVA = "-800 -600 -231", "-800 0 -231", "-800 600 -231"


class PlayerTest(PlayCase):
    def session(self, script, entities=(), boxes=(), setup=""):
        self.game.write_map("test", [START, *entities], list(boxes))
        return self.game.play(["0.6", *script], setup)

    def test_begins_with_what_everybody_has(self):
        state = self.session(["see start"])["start"]
        self.assertEqual([state.number(n) for n in ("health", "ammo_shells", "armorvalue", "weapon")], [100, 25, 0, 1])
        self.assertEqual(int(state.number("items")) & 4097, 4097)

    def test_a_game_at_which_nobody_looks_is_not_drawn(self):
        said = self.session(["host_speeds 1", "1", "echo LOOKS", "r_norefresh 0", "1"]).said
        unseen, seen = said.split("LOOKS\n")
        self.assertNotIn(" ms, host", unseen)
        self.assertIn(" ms, host", seen)

    def test_breath_lasts_twelve_seconds(self):
        session = self.session([f"at {WATER}", "11", "see before", "1.6", "see first", "1", "see second"])
        health = [session[s].number("health") for s in ("before", "first", "second")]
        self.assertEqual(health, [100, 96, 90])  # 4, then 6

    def test_suit_has_air(self):
        suit = {"classname": "item_artifact_envirosuit", "origin": "0 300 -200"}
        session = self.session(["at 0 300 -231", "0.2", f"at {WATER}", "14", "see later"], [suit])
        self.assertEqual(session["later"].number("health"), 100)

    def test_slime_burns_twelve_a_second(self):
        session = self.session([f"at {SLIME}", "2.2", "see burnt"])
        self.assertIn(session["burnt"].number("health"), (100 - 24, 100 - 36))

    def test_lava_burns_thirty_each_fifth_of_a_second(self):
        session = self.session([f"at {LAVA}", "0.35", "see burnt"])
        self.assertIn(session["burnt"].number("health"), (70, 40))
        session = self.session([f"at {LAVA}", "2", "see dead"])
        self.assertGreater(session["dead"].number("deadflag"), 0)
        self.assertIn("player went up in flames", session.said)

    def test_falls(self):
        low = self.session(["at 0 0 -50", "1.5", "see down"])
        self.assertEqual(low["down"].number("health"), 100)
        high = self.session(["at 0 0 500", "2.5", "see down"])
        self.assertEqual(high["down"].number("health"), 95)

    def test_water_takes_a_fall(self):
        session = self.session(["at -800 -600 700", "2.5", "see down"])
        self.assertEqual(session["down"].number("health"), 100)

    def test_jump(self):
        session = self.session(["+jump", "0.1", "see up", "-jump"])
        self.assertGreater(session["up"].place()[2], -231.9 + 15)

    def test_swims_up(self):
        session = self.session([f"at {WATER}", "0.2", "+jump", "1", "-jump", "see up"])
        self.assertGreater(session["up"].place()[2], -231 + 50)

    def test_climbs_out_of_water(self):
        ledge = {"classname": "func_wall", "model": "*1"}
        times = [f"at_{i}" for i in range(12)]
        script = [
            "at -700 -590 -40",
            "0.2",
            "+forward",
            "+jump",
            *(line for name in times for line in ("0.2", f"see {name}")),
        ]
        session = self.session(script, [ledge], [((-640, -640, -256), (-540, -540, 8))])
        heights = [session[name].place()[2] for name in times if -656 <= session[name].place()[0] <= -524]
        self.assertTrue(any(h >= 8 + 24 for h in heights), [session[name].place() for name in times])

    def test_gibs(self):
        hurt = {"classname": "trigger_hurt", "model": "*1", "dmg": "200"}
        session = self.session(["at 0 450 -231", "0.3", "see dead"], [hurt], [((-64, 400, -256), (64, 500, -100))])
        self.assertEqual(session["dead"].player["model"], "progs/h_player.mdl")
        self.assertEqual(len(session["dead"].all("gib")), 3)

    def test_exit_keeps_what_he_carries(self):
        exit_ = {"classname": "trigger_changelevel", "model": "*1", "map": "test"}
        camera = {"classname": "info_intermission", "origin": "10 20 300", "mangle": "10 90 0"}
        script = [
            "impulse 9",
            "0.2",
            "impulse 255",
            "at 0 450 -231",
            "0.5",
            "see tally",
            "2.2",
            "+attack",
            "0.2",
            "-attack",
            "1.5",
            "see next",
        ]
        session = self.session(script, [exit_, camera], [((-64, 400, -256), (64, 500, -100))])
        tally = session["tally"]
        self.assertEqual(float(tally.globals["intermission_running"]), 1)
        self.assertEqual(tally.place(), (10, 20, 300))
        after = session["next"]
        self.assertLess(after.time, 5)
        self.assertEqual(
            [after.number(n) for n in ("ammo_rockets", "ammo_nails", "weapon", "health")], [100, 200, 32, 100]
        )
        self.assertEqual(int(after.number("items")) & (131072 | 262144 | 4194304), 0)  # neither keys nor powers

    def test_tally_waits_two_seconds(self):
        exit_ = {"classname": "trigger_changelevel", "model": "*1", "map": "test"}
        script = ["at 0 450 -231", "0.5", "+attack", "1", "see early", "-attack"]
        session = self.session(script, [exit_], [((-64, 400, -256), (64, 500, -100))])
        self.assertEqual(float(session["early"].globals["intermission_running"]), 1)

    def test_a_rune_brings_a_text(self):
        exit_ = {"classname": "trigger_changelevel", "model": "*1", "map": "test"}
        rune = {"classname": "item_sigil", "spawnflags": "1", "origin": "300 0 -200"}
        script = ["at 300 0 -231", "0.2", "at 0 450 -231", "2.6", "+attack", "0.2", "-attack", "0.3", "see text"]
        session = self.session(script, [exit_, rune], [((-64, 400, -256), (64, 500, -100))])
        self.assertEqual(float(session["text"].globals["intermission_running"]), 2)

    def test_fraglimit_and_timelimit(self):
        start = {"classname": "info_player_deathmatch", "origin": "0 0 -230"}
        session = self.session(["see playing", "sv_run 61", "see over"], [start], setup="deathmatch 1\ntimelimit 1")
        self.assertEqual(float(session["playing"].globals.get("intermission_running", "0")), 0)
        self.assertEqual(float(session["over"].globals["intermission_running"]), 1)

    def test_dead_player_comes_back_in_deathmatch(self):
        start = {"classname": "info_player_deathmatch", "origin": "100 100 -230"}
        hurt = {"classname": "trigger_hurt", "model": "*1", "dmg": "110"}
        script = ["+forward", "0.6", "-forward", "0.2", "see dead", "2", "+attack", "0.1", "-attack", "0.3", "see back"]
        session = self.session(script, [start, hurt], [((160, 40, -256), (260, 160, -100))], "deathmatch 1")
        dead, back = session["dead"], session["back"]
        self.assertGreater(dead.number("deadflag"), 0)
        self.assertEqual(dead.number("frags"), -1)
        self.assertEqual(len(dead.all("backpack")), 1)
        self.assertEqual(back.number("health"), 100)
        self.assertEqual(back.place()[:2], (100, 100))
        body = [e for e in back.all("body") if e.get("model") == "progs/player.mdl"]
        self.assertEqual(len(body), 1)

    def test_suicide_costs_two_frags(self):
        start = {"classname": "info_player_deathmatch", "origin": "100 100 -230"}
        session = self.session(["kill", "0.5", "see after"], [start], setup="deathmatch 1")
        self.assertEqual(session["after"].number("frags"), -2)

    def test_coop_begins_at_its_own_starts_with_what_the_level_began_with(self):
        start = {"classname": "info_player_coop", "origin": "500 500 -230"}
        hurt = {"classname": "trigger_hurt", "model": "*1", "dmg": "110"}
        key = {"classname": "item_key1", "origin": "500 500 -200"}
        script = ["see start", "+forward", "0.6", "-forward", "2", "+attack", "0.1", "-attack", "0.3", "see again"]
        session = self.session(script, [start, hurt, key], [((560, 440, -256), (660, 560, -100))], "coop 1")
        begun, again = session["start"], session["again"]
        self.assertEqual(begun.place()[:2], (500, 500))
        self.assertEqual(begun.one(classname="item_key1")["solid"], "1.000000")  # for the others
        self.assertEqual(again.number("health"), 100)
        self.assertGreaterEqual(again.number("ammo_shells"), 25)  # and perhaps the backpack that he left
        self.assertNotIn(
            "Server spawned: test", session.said.split("Server spawned: test", 1)[1]
        )  # nobody else begins anew

    def test_a_saved_game_goes_on(self):
        door = {"classname": "func_door", "model": "*1", "angle": "-1"}
        script = [
            "impulse 9",
            "0.2",
            "at 160 0 -231",
            "0.2",
            "at 0 0 -231",
            "0.5",
            "impulse 7",
            "+attack",
            "0.1",
            "-attack",
            "see saved",
            "save s",
            "6",
            "see closed",
            "load s",
            "0.5",
            "see loaded",
            "2",
            "see open",
            "5",
            "see closed_again",
        ]
        session = self.session(script, [door], [((200, -50, -256), (216, 50, -100))])
        height = {
            s: session[s].place(session[s].one(model="*1"))[2]
            for s in ("saved", "closed", "loaded", "open", "closed_again")
        }
        self.assertTrue(0 < height["saved"] < height["loaded"] < 148, height)
        self.assertEqual([height["closed"], height["open"], height["closed_again"]], [0, 148, 0])
        self.assertEqual(session["loaded"].number("ammo_rockets"), session["saved"].number("ammo_rockets"))
        self.assertEqual(session["closed_again"].player["think"], "PlayerStands")

    def test_comes_back_to_the_hub_elsewhere(self):
        other = {"classname": "info_player_start2", "origin": "400 0 -230"}
        session = self.session(["impulse 11", "0.2", "changelevel test", "1", "see back"], [other])
        self.assertEqual(session["back"].place()[0], 400)


class AgainTest(PlayCase):
    extra = (HERE / "testing" / "test_quitter.qc",)

    def levels(self, script) -> int:
        self.game.write_map("test", [START, {"classname": "test_quitter"}], [])
        return self.game.play(["0.6", *script], quits=False).said.count("Server spawned: test")

    def test_who_died_begins_the_level_again(self):
        self.assertEqual(self.levels(["kill", "0.5"]), 2)

    def test_who_lives_does_not(self):
        self.assertEqual(self.levels(["0.5"]), 1)


if __name__ == "__main__":
    unittest.main()
