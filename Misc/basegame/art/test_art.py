"""Holds the pictures to what the game's conventions ask: formats read back, names, sizes, the same bytes twice."""

from __future__ import annotations

import pathlib
import sys
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from art import make  # noqa: E402
from art.palette import GLOW_FIRST, PALETTE, RAMPS, colormap, linear_from_srgb, nearest, oklab_from_srgb  # noqa: E402
from art.blackbody import light_of, off_the_locus, xyz_of_heat  # noqa: E402
from art.catalogue import OF_MAPS, TEXTURES  # noqa: E402
from art.surface import files, miptex  # noqa: E402
from formats import lmp, png, spr, wad  # noqa: E402

# What map makers were promised.
PROMISED = """
stone_a stone_b stone_floor stone_trim cobble rock_a rock_b dirt moss_stone brick_red brick_dark plaster plaster_crack
metal_plate metal_rivet metal_floor metal_rust metal_trim copper_plate copper_trim copper_floor steel_door steel_wall
wood_plank wood_beam wood_door tile_teal tile_white tile_check marble_white marble_black flesh_a flesh_b glass_teal
window_a window_b light_white light_warm light_cool light_red light_green light_strip lamp_round rune_a rune_b
crystal_blue crystal_red crystal_gold candle_wax door_iron door_gold door_silver door_rune +0button +1button +abutton
+0plate +1plate +2plate +3plate sign_exit sign_arrow skull_trim bones crate_a crate_b barrel_side barrel_top bookshelf
carpet_red {grate {vine {chain *water_a *water_b *water_still *slime_a *lava_a *teleport sky_night sky_dusk sky_storm skip clip
trigger origin hint box_shell box_nail box_rocket box_cell box_health box_mega box_shell_top box_nail_top
box_rocket_top box_cell_top box_health_top box_mega_top lab_white lab_grey lab_black lab_red lab_green lab_blue
lab_yellow lab_check lab_light lab_light_warm lab_light_dim lab_chrome lab_steel lab_marble
""".split()
# The status bar's pictures and their sizes, as engines draw them.
HUD_SIZES = {
    "num_": (24, 24),
    "anum_": (24, 24),
    "face": (24, 24),
    "sb_armor": (24, 24),
    "sb_shells": (24, 24),
    "sb_nails": (24, 24),
    "sb_rocket": (24, 24),
    "sb_cells": (24, 24),
    "sb_key": (16, 16),
    "sb_invis": (16, 16),
    "sb_invuln": (16, 16),
    "sb_suit": (16, 16),
    "sb_quad": (16, 16),
    "sb_sigil": (16, 8),
    "sbar": (24, 320),
    "ibar": (24, 320),
    "scorebar": (24, 320),
    "disc": (24, 24),
    "ram": (32, 32),
    "net": (32, 32),
    "turtle": (32, 32),
    "backtile": (64, 64),
}
HUD_NAMES = [f"{prefix}num_{sign}" for prefix in ("", "a") for sign in [*map(str, range(10)), "minus"]]
HUD_NAMES += ["num_colon", "num_slash", "sb_shells", "sb_nails", "sb_rocket", "sb_cells", "sb_armor1", "sb_armor2", "sb_armor3"]
HUD_NAMES += [
    "sb_key1",
    "sb_key2",
    "sb_invis",
    "sb_invuln",
    "sb_suit",
    "sb_quad",
    "sb_sigil1",
    "sb_sigil2",
    "sb_sigil3",
    "sb_sigil4",
]
HUD_NAMES += [f"face{state}{i}" for state in ("", "_p") for i in range(1, 6)]
HUD_NAMES += [
    "face_invis",
    "face_invul2",
    "face_inv2",
    "face_quad",
    "sbar",
    "ibar",
    "scorebar",
    "disc",
    "ram",
    "net",
    "turtle",
    "backtile",
]
WEAPONS = ["shotgun", "sshotgun", "nailgun", "snailgun", "rlaunch", "srlaunch", "lightng"]
MENU_SIZES = {
    "conback": (200, 320),
    "qplaque": (144, 32),
    "mainmenu": (112, 240),
    "menuplyr": (56, 48),
    "bigbox": (72, 72),
    "inter": (144, 160),
    "menudot1": (24, 16),
    "menudot6": (24, 16),
    "box_tl": (8, 8),
    "box_tm": (8, 16),
    "box_mm2": (8, 16),
    "help0": (200, 320),
    "help5": (200, 320),
}
MENU_NAMES = """ttl_main ttl_sgl ttl_cstm sp_menu mp_menu p_option p_load p_save p_multi loading pause complete finale ranking vidmodes
box_ml box_bl box_mm box_bm box_tr box_mr box_br dim_modm dim_drct dim_ipx dim_tcp dim_mult netmen1 netmen2 netmen3 netmen4 netmen5
help1 help2 help3 help4 menudot2 menudot3 menudot4 menudot5""".split()
# One of each kind of painter: what the slower tests look at.
SAMPLE = [
    "stone_a",
    "copper_plate",
    "rune_a",
    "light_green",
    "{vine",
    "*lava_a",
    "sky_dusk",
    "+0plate",
    "lab_light_dim",
    "stone_trim",
]


# What lights fall on: no measures of the laboratory, tools, liquids, lamps or gems, which are as dark as they like.
REFLECTORS = sorted(
    name
    for name in TEXTURES
    if not name.startswith(("lab_", "*", "sky_", "light_", "lamp_", "crystal_", "window_", "rune_"))
    and name not in ("skip", "clip", "trigger", "origin", "hint")
)
WARM_LAMPS = ["light_warm", "lamp_round", "light_strip", "lab_light_warm", *OF_MAPS]
MAPS = pathlib.Path(__file__).resolve().parents[1] / "maps"
# By how much the hue of a warm lamp may miss a black body's (Duv; lamps sold as white keep within 0.006).
MISS = 0.004


class WarmLight(unittest.TestCase):
    """What is to look hot has a black body's hue: not olive, not pink."""

    def test_black_bodies(self):
        for temperature, x, y in ((2855.5, 0.4476, 0.4074), (5000.0, 0.3451, 0.3516)):  # CIE illuminant A, and the tables'
            found = xyz_of_heat(temperature) / xyz_of_heat(temperature).sum()
            self.assertLess(max(abs(found[0] - x), abs(found[1] - y)), 0.003)
            distance, nearest_one = off_the_locus(light_of(xyz_of_heat(temperature)))
            self.assertLess(abs(distance), 0.0005)
            self.assertLess(abs(nearest_one / temperature - 1.0), 0.01)
        self.assertGreater(off_the_locus(np.array([0.5, 1.0, 0.5]))[0], 0.01)
        self.assertLess(off_the_locus(np.array([1.0, 0.4, 0.6]))[0], -0.01)

    def test_palette(self):
        for index in [*RAMPS["fire"][9:], *RAMPS["gold_glow"], 252, 253]:
            distance, temperature = off_the_locus(linear_from_srgb(PALETTE[index] / 255.0))
            self.assertLess(abs(distance), MISS, f"index {index}, {PALETTE[index]}")
            self.assertTrue(1700 < temperature < 6000, f"index {index}: {temperature:.0f} K")

    def test_lamps(self):
        for name in WARM_LAMPS:
            surface = make.paint(name)
            distance, temperature = off_the_locus(linear_from_srgb(surface.color)[surface.glow].mean(axis=0))
            self.assertLess(abs(distance), MISS, name)
            self.assertTrue(2200 < temperature < 5500, f"{name}: {temperature:.0f} K")

    def test_pictures_of_one_map(self):
        for name in OF_MAPS:
            level, texture = name.split("/")
            self.assertIn(texture, TEXTURES)
            self.assertTrue(list(MAPS.rglob(f"{level}.bsp")), name)
            self.assertEqual(sorted(files(name, make.paint(name))), [f"textures/{name}.png", f"textures/{name}_luma.png"])

    def test_lamps_have_their_hue_in_maps_too(self):
        for name in WARM_LAMPS[:4]:
            indices = wad.read_miptex(miptex(name, make.paint(name)))[1][0]
            lit = indices[(indices >= GLOW_FIRST) & (indices < 255)]
            self.assertLess(abs(off_the_locus(linear_from_srgb(PALETTE[lit] / 255.0).mean(axis=0))[0]), MISS, name)


class Palette(unittest.TestCase):
    def test_ramps_rise(self):
        lightness = oklab_from_srgb(PALETTE / 255.0)[:, 0]
        for name, ramp in RAMPS.items():
            if name != "grey":
                self.assertTrue((np.diff(lightness[ramp]) > 0).all(), name)
        self.assertGreater(lightness[254], 0.999)
        self.assertEqual(PALETTE[0].tolist(), [0, 0, 0])

    def test_nearest_finds_the_palette(self):
        found = nearest(PALETTE[:GLOW_FIRST] / 255.0)
        np.testing.assert_array_equal(PALETTE[found], PALETTE[:GLOW_FIRST])
        glowing = nearest(PALETTE[GLOW_FIRST:255] / 255.0, glow=True)
        np.testing.assert_array_equal(PALETTE[glowing], PALETTE[GLOW_FIRST:255])
        self.assertLess(nearest(np.array([1.0, 0.5, 0.1])), GLOW_FIRST)

    def test_colormap(self):
        table = colormap()
        self.assertEqual(table[32].tolist(), list(range(256)))
        light = linear_from_srgb(PALETTE[table] / 255.0)[:, :GLOW_FIRST].mean(axis=(1, 2))
        self.assertTrue((np.diff(light) <= 1e-3).all())
        self.assertEqual(table[63, 240], 240)


class Formats(unittest.TestCase):
    def test_png(self):
        for shape in [(5, 7), (4, 6, 3), (3, 2, 4)]:
            pixels = np.random.default_rng(1).integers(0, 256, shape, np.uint8)
            np.testing.assert_array_equal(png.read_png(png.write_png(pixels)).reshape(shape), pixels)
        with self.assertRaises(ValueError):
            png.read_png(b"GIF89a")

    def test_lmp(self):
        picture = np.arange(24, dtype=np.uint8).reshape(4, 6)
        np.testing.assert_array_equal(lmp.read_lmp(lmp.write_lmp(picture)), picture)
        with self.assertRaises(ValueError):
            lmp.read_lmp(lmp.write_lmp(picture)[:-1])

    def test_wad(self):
        lumps = [wad.Lump("ONE", 0x42, b"abc"), wad.Lump("two", 0x44, b"")]
        found = wad.read_wad(wad.write_wad(lumps))
        self.assertEqual(found["one"], lumps[0])
        self.assertEqual(found["two"], lumps[1])
        with self.assertRaises(ValueError):
            wad.write_wad([wad.Lump("a" * 16, 0x42, b"")])


class Textures(unittest.TestCase):
    def test_names_and_sizes(self):
        self.assertEqual(sorted(set(PROMISED) - set(TEXTURES)), [])
        for name, (width, height, _) in TEXTURES.items():
            self.assertEqual((width % 16, height % 16), (0, 0), name)
            self.assertLessEqual(len(name), 15)

    def test_files_read_back(self):
        for name in SAMPLE:
            surface = make.paint(name)
            found, levels = wad.read_miptex(miptex(name, surface))
            width, height, _ = TEXTURES[name]
            self.assertEqual((found, levels[0].shape, levels[3].shape), (name, (height, width), (height // 8, width // 8)))
            for path, data in files(name, surface).items():
                self.assertEqual(png.read_png(data).shape[:2], (height * surface.scale, width * surface.scale), path)

    def test_only_lights_glow(self):
        glowing = {"rune_a": True, "light_green": True, "*lava_a": True, "+0plate": True, "lab_light_dim": True}
        for name in SAMPLE:
            indices = wad.read_miptex(miptex(name, make.paint(name)))[1][0]
            lit = (indices >= GLOW_FIRST) & (indices < 255)
            self.assertEqual(bool(lit.any()), glowing.get(name, False), name)
            self.assertEqual(bool((indices == 255).any()), name.startswith("{"), name)

    def test_sky_layers(self):
        indices = wad.read_miptex(miptex("sky_dusk", make.paint("sky_dusk")))[1][0]
        self.assertTrue(0.02 < (indices[:, :128] == 0).mean() < 0.9)
        self.assertFalse((indices[:, 128:] == 0).any())

    def test_reflectance(self):
        for name in REFLECTORS:
            surface = make.paint(name)
            kept = np.ones(surface.color.shape[:2], bool)
            for layer in (surface.glow, surface.holes):
                kept &= True if layer is None else ~layer
            mean = linear_from_srgb(surface.color)[kept].mean()
            self.assertTrue(0.15 <= mean <= 0.6, f"{name} reflects {mean:.3f}")

    def test_walls_of_the_cornell_box(self):
        red, green = (png.read_png(files(name, make.paint(name))[f"textures/{name}.png"]) for name in ("lab_red", "lab_green"))
        for picture, strongest in ((red, 0), (green, 1)):
            light = linear_from_srgb(picture[0, 0] / 255.0)
            self.assertEqual(int(light.argmax()), strongest)
            self.assertGreater(light[strongest], 3.0 * np.delete(light, strongest).max())

    def test_edges_meet(self):
        for name in ["stone_a", "copper_plate", "brick_red", "rock_a"]:
            color = make.paint(name).color
            for seam, inside in (
                (color[0] - color[-1], np.diff(color, axis=0)),
                (color[:, 0] - color[:, -1], np.diff(color, axis=1)),
            ):
                # Neighbours across the seam differ by no more than neighbours elsewhere at their worst.
                steps = (
                    np.abs(inside).mean(axis=(1, 2)) if seam.shape[0] == inside.shape[1] else np.abs(inside).mean(axis=(0, 2))
                )
                self.assertLess(np.abs(seam).mean(), 1.5 * steps.max() + 0.01, name)

    def test_normals_point_up_the_image(self):
        from art.surface import normal_map

        height = np.tile(np.linspace(8.0, 0.0, 16)[:, None], (1, 16))  # falls down the image
        normal = normal_map(height, 1, tiles=False)[8, 8].astype(int)
        self.assertEqual(normal[0], 128)
        self.assertLess(normal[1], 128)


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.hud = wad.read_wad(make.hud_files("*")["gfx.wad"])
        cls.menus = make.picture_files("*")

    def test_status_bar(self):
        names = HUD_NAMES + [f"{state}_{weapon}" for state in ("inv", "inv2", "inva1", "inva5") for weapon in WEAPONS]
        self.assertEqual(sorted(set(names) - set(self.hud)), [])
        for name in names:
            picture = lmp.read_lmp(self.hud[name].data)
            sizes = [size for prefix, size in HUD_SIZES.items() if name.startswith(prefix)]
            expected = sizes[0] if sizes else (16, 48 if name.endswith("lightng") else 24)
            self.assertEqual(picture.shape, expected, name)

    def test_console_letters(self):
        sheet = np.frombuffer(self.hud["conchars"].data, np.uint8).reshape(128, 128)
        cells = [sheet[8 * (i // 16) :, 8 * (i % 16) :][:8, :8] for i in range(256)]
        drawn = [bool(cell.any()) for cell in cells]
        empty = [i for i in range(128) if not drawn[i]]
        self.assertEqual(empty, [0, 10, 12, 32])
        self.assertEqual(len({cell.tobytes() for cell in cells[33:127]}), 94)
        self.assertFalse((cells[ord("A")] == cells[ord("A") + 128]).all())

    def test_menus(self):
        self.assertEqual(sorted(name for name in [*MENU_SIZES, *MENU_NAMES] if f"gfx/{name}.lmp" not in self.menus), [])
        for name, size in MENU_SIZES.items():
            self.assertEqual(lmp.read_lmp(self.menus[f"gfx/{name}.lmp"]).shape, size, name)
        for path, data in self.menus.items():
            self.assertLessEqual(lmp.read_lmp(data).shape[1], 320, path)
        self.assertFalse((lmp.read_lmp(self.menus["gfx/conback.lmp"]) == 255).any())

    def test_sprites(self):
        made = make.sprite_files("*")
        for name, frames, size in (("s_bubble", 2, 16), ("s_explod", 6, 64), ("s_light", 1, 32)):
            sprite = spr.read_spr(made[f"progs/{name}.spr"])
            self.assertEqual([frame.picture.shape for frame in sprite.frames], [(size, size)] * frames)
            self.assertEqual((sprite.frames[0].left, sprite.frames[0].top), (-size // 2, size // 2))
        with self.assertRaises(ValueError):
            spr.read_spr(made["progs/s_light.spr"][:-1])


class Maker(unittest.TestCase):
    def test_same_bytes_twice(self):
        for name in SAMPLE[:4]:
            self.assertEqual(miptex(name, make.paint(name)), miptex(name, make.paint(name)))
            self.assertEqual(files(name, make.paint(name)), files(name, make.paint(name)))

    def test_pattern(self):
        made = {path for _, part in make.make("textures/rune_a*") for path in part}
        self.assertEqual(made, {f"textures/rune_a{kind}.png" for kind in ("", "_norm", "_gloss", "_luma")})


if __name__ == "__main__":
    unittest.main()
