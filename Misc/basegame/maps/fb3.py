"""The third level, glass: the House of Glass. A hall with windows and shafts of sun, and a key in a case of glass; west a floor of
glass over lamps, east a maze of panes, each with a button: both lift the case. Behind the gold door a bridge of glass over a well."""

from __future__ import annotations

from kit import Group, Map, Tex, fit
from passages import arrival, way_out
from people import item, monster, secret, trigger
from pieces import candle_stand, candles, hanging_lamp, lancet, pillar, sconce

X, SOUTH, NORTH, TOP = 352, -512, 384, 336  # the hall
WING, WING_SOUTH, WING_NORTH = (384 + 32, 896), -256, 224  # wings: x from, to; both sides
DOME_X, DOME_SOUTH, DOME_NORTH, DOME_TOP, WELL = 448, 576, 1344, 416, -352
EDGE, FAR = 672, 1152  # where the bridge begins and ends
CLEAR = "glass_teal"


def pane(world: Map, lo, hi, tex: str = CLEAR, alpha: float = 0.35) -> None:
    """A body of glass, an entity of its own: it touches nothing (textures' .mat files; alpha is for other engines)."""
    world.part("func_wall", alpha=alpha).box(lo, hi, tex)


def rooms(walls: Group) -> None:
    walls.room((-96, -848, 0), (96, SOUTH - 32, 176), {"side": "plaster", "bottom": "tile_check", "top": "wood_plank"}, wall=32)
    walls.room((-X, SOUTH, 0), (X, NORTH, TOP), {"side": "plaster", "bottom": "tile_check", "top": "wood_plank"}, wall=32)
    walls.room((X + 32, -416, 176), (X + 160, 320, 480), {"all": "sky_dusk"}, wall=16)
    a, b = WING
    walls.room((-b, WING_SOUTH, -160), (-a, WING_NORTH, 224), {"side": "brick_dark", "bottom": "metal_rust", "top": "wood_plank"}, wall=32)
    walls.room((a, WING_SOUTH, 0), (b, WING_NORTH, 144), {"side": "marble_black", "bottom": "tile_white", "top": "plaster"}, wall=32)
    walls.room((-56, NORTH + 32, 0), (56, DOME_SOUTH - 32, 144), {"side": "marble_white", "bottom": "tile_check", "top": "plaster"}, wall=32)
    walls.room((-DOME_X, DOME_SOUTH, WELL), (DOME_X, DOME_NORTH, DOME_TOP), {"side": "stone_b", "bottom": "tile_teal", "top": "plaster"},
               wall=32)
    walls.room((-160, 752, DOME_TOP + 32), (160, 1072, DOME_TOP + 48), {"all": "sky_dusk"}, wall=16)
    walls.room((-64, DOME_NORTH + 32, 0), (64, DOME_NORTH + 160, 160), {"side": "marble_white", "bottom": "tile_check", "top": "plaster"},
               wall=32)
    walls.room((b + 32, -64, 0), (b + 160, 64, 96), {"side": "rock_a", "bottom": "dirt", "top": "rock_a"})  # the secret


def openings(walls: Group) -> None:
    a, b = WING
    walls.cut((-64, SOUTH - 32, 0), (64, SOUTH, 144))
    for y in (-320, -160, 160, 288):
        walls.cut((-X - 24, y - 48, 96), (-X, y + 48, 272))
    for y in (-352, -224, 192, 288):
        walls.cut((X, y - 24, 192), (X + 32, y + 24, 304))
    for y in (-48,):
        walls.cut((-a, y - 56, 0), (-X, y + 56, 128))
        walls.cut((X, y - 56, 0), (a, y + 56, 128))
    walls.cut((-56, NORTH, 0), (56, NORTH + 32, 144))
    walls.cut((-56, DOME_SOUTH - 32, 0), (56, DOME_SOUTH, 144))
    walls.cut((-128, 784, DOME_TOP), (128, 1040, DOME_TOP + 32))
    walls.cut((-64, DOME_NORTH, 0), (64, DOME_NORTH + 32, 160))
    walls.cut((b, -40, 0), (b + 32, 40, 80))
    for side in (-1, 1):
        for y in (768, 960, 1152):
            x0, x1 = sorted((side * DOME_X, side * (DOME_X + 24)))
            walls.cut((x0, y - 48, 64), (x1, y + 48, 272))


def hall(world: Map) -> None:
    part = world.detail
    for k, y in enumerate((-320, -160, 160, 288)):
        world.add(lancet(96, 176, "window_a" if k % 2 else "window_b", 24), (-X, y, 96), turn=90)
    for y in (-352, -224, 192, 288):
        part.arch((X, y - 24, 276), (X + 32, y + 24, 304), "stone_trim", axis="x", pointed=True)
    for y in (-416, -256, -96, 64, 240, 368):
        part.box((-X, y - 12, TOP - 32), (X, y + 12, TOP), "wood_beam")
        for side in (-1, 1):
            x0, x1 = sorted((side * X, side * (X - 12)))
            part.box((x0, y - 12, 0), (x1, y + 12, TOP - 32), "marble_white")
    part.box((-40, SOUTH, 0), (40, NORTH, 1), "carpet_red")
    # Pillars of coloured glass, each round a lamp.
    for x, y, tex, lamp in ((-176, -336, "lab_red", "light_warm"), (176, -336, "lab_blue", "light_cool"),
                            (-176, 240, "lab_yellow", "light_warm"), (176, 240, CLEAR, "light_cool")):
        part.box((x - 36, y - 36, 0), (x + 36, y + 36, 16), {"all": "marble_black", "top": "copper_plate"})
        world.part("func_wall", alpha=0.35).ring((x, y), 14, 28, 17, 150, tex, sides=8)
        part.cylinder((x, y), 5, 16, 40, "metal_trim", sides=6)
        part.cylinder((x, y), 7, 40, 128, fit(lamp, (1, 2)), sides=6)
        part.cylinder((x, y), 5, 128, 152, "metal_trim", sides=6)
        part.cylinder((x, y), 34, 152, 164, "copper_plate", sides=8)
        part.cylinder((x, y), 20, 164, TOP, "marble_white", sides=8)
    case(world)
    # The gold door.
    gold = world.part("func_door", angle=-1, spawnflags=8, speed=100, lip=8, sounds=1, wait=-1)
    gold.box((-56, NORTH + 6, 0), (56, NORTH + 22, 144), fit("door_gold"))
    for side in (-1, 1):
        x0, x1 = sorted((side * 56, side * 76))
        part.box((x0, NORTH - 14, 0), (x1, NORTH, 160), "marble_black")
        world.add(candle_stand(140 + side), (side * 120, NORTH - 40, 0))
    part.box((-80, NORTH - 16, 160), (80, NORTH, 176), "copper_trim")
    # The entry, behind curtains of glass.
    part.arch((-64, SOUTH - 32, 96), (64, SOUTH, 144), "stone_trim", axis="y")
    world.add(hanging_lamp(32, "lamp_round", 9), (0, -660, 176))
    for side in (-1, 1):
        world.add(lancet(56, 96, "window_b", 14), (side * 96, -700, 40), turn=-90 * side)
        x0, x1 = sorted((side * 90, side * 66))
        pane(world, (x0, SOUTH + 40, 2), (x1, SOUTH + 48, 140), "lab_yellow")


def case(world: Map) -> None:
    """Round the key: five panes that rise when both buttons are pressed."""
    part = world.detail
    part.box((-56, -88, 0), (56, 24, 8), "marble_white")
    part.box((-44, -76, 8), (44, 12, 16), {"all": "marble_black", "top": "copper_plate"})
    glass = world.part("func_door", angle=-1, targetname="case", lip=-60, speed=60, sounds=1, wait=-1, alpha=0.35,
                       message="Two buttons lift it, one in each wing")
    for lo, hi in (((-40, -72), (40, -66)), ((-40, 2), (40, 8)), ((-40, -66), (-34, 2)), ((34, -66), (40, 2))):
        glass.box((*lo, 17), (*hi, 96), CLEAR)
    glass.box((-40, -72, 96), (40, 8, 102), CLEAR)
    item(world, "key2", 0, -32, 16)
    world.add(hanging_lamp(100, "lamp_round", 11), (0, -32, TOP - 24))
    world.entity("trigger_counter", (0, -32, 200), targetname="both", target="case", count=2)


def west(world: Map) -> None:
    """A floor of glass over lamps; what holds is the way to the button."""
    part = world.detail
    a, b = WING
    part.box((-a - 64, WING_SOUTH, -32), (-a, WING_NORTH, 0), {"all": "brick_dark", "top": "tile_check"})
    part.box((-b, WING_SOUTH, -32), (-b + 64, WING_NORTH, 0), {"all": "brick_dark", "top": "tile_check"})
    for k, x in enumerate(range(-b + 65, -a - 64, 117)):
        for m, y in enumerate(range(WING_SOUTH + 1, WING_NORTH, 120)):
            tex = ("lab_red", CLEAR, "lab_yellow", CLEAR)[(k + m) % 4]
            pane(world, (x, y, -9), (min(x + 115, -a - 65), y + 117, -1), tex)
    for x in range(-b + 64, -a - 63, 117):
        part.box((x - 1, WING_SOUTH, -24), (x, WING_NORTH, -10), "metal_trim")
    for x in (-b + 150, (-a - b) / 2, -a - 150):
        for y in (-160, 120):
            part.cylinder((x, y), 18, -160, -120, "copper_plate", sides=8)
            part.cylinder((x, y), 14, -120, -84, fit("lamp_round"), sides=8)
            part.cylinder((x, y), 18, -84, -78, "copper_trim", sides=8)
    for y in (-180, -16, 150):
        part.arch((-b, y - 10, 160), (-a, y + 10, 224), "stone_trim", axis="y", segments=10)
    button(world, (-b, -48), 1)
    world.add(sconce("light_warm"), (-b, 60, 110), turn=90)
    world.add(sconce("light_warm"), (-b, -156, 110), turn=90)
    part.arch((-a, -104, 88), (-X, 8, 128), "stone_trim", axis="x")
    part.arch((X, -104, 88), (a, 8, 128), "stone_trim", axis="x")


def button(world: Map, at: tuple[float, float], side: int) -> None:
    """On the end wall of a wing, towards the hall (side: where that lies, 1 is east)."""
    x, y = at
    x0, x1 = sorted((x, x + side * 8))
    press = world.part("func_button", angle=180 if side > 0 else 360, target="both", speed=40, wait=-1, lip=2)
    press.box((x0, y - 16, 40), (x1, y + 16, 72), {"all": "metal_trim", "east": fit("+0button"), "west": fit("+0button")})
    x0, x1 = sorted((x, x + side * 5))
    world.detail.box((x0, y - 24, 28), (x1, y + 24, 40), "copper_trim")
    world.detail.box((x0, y - 24, 72), (x1, y + 24, 84), "copper_trim")


def east(world: Map) -> None:
    """The maze: panes from floor to ceiling, lamps in sleeves of blue glass."""
    part = world.detail
    a, b = WING
    for x, y0, y1 in ((512, WING_SOUTH + 1, 112), (608, -144, WING_NORTH - 1), (704, WING_SOUTH + 1, 112), (800, -144, WING_NORTH - 1)):
        for k, y in enumerate(range(y0, y1, 90)):
            pane(world, (x, y, 1), (x + 6, min(y + 88, y1), 142), "lab_blue" if k % 3 == 1 else CLEAR)
        part.box((x - 2, y0, 143), (x + 8, y1, 144), "copper_trim")
    for x, y in ((440, 200), (536, -232), (632, 200), (728, -232), (872, 200), (440, -232), (872, -232)):
        part.cylinder((x, y), 12, 0, 24, "marble_white", sides=8)
        part.cylinder((x, y), 7, 24, 72, fit("light_cool", (1, 1)), sides=8)
        part.cylinder((x, y), 14, 72, 80, "copper_trim", sides=8)
        world.part("func_wall", alpha=0.35).ring((x, y), 10, 16, 25, 71, "lab_blue", sides=8)
    for x in (464, 564, 656, 752, 850):
        world.add(hanging_lamp(10, "light_white", 7), (x, 0, 144))
    button(world, (b, 100), -1)
    # The secret: a slab of the end wall that a shot opens.
    slab = world.part("func_door", angle=-2, health=1, wait=-1, lip=4, speed=60, sounds=1)
    slab.box((b + 4, -40, 0), (b + 20, 40, 80), "marble_black")
    part.box((b - 4, -44, 80), (b, 44, 88), "copper_trim")
    secret(world, (b + 40, -60, 0), (b + 150, 60, 80))
    part.cylinder((b + 140, 44), 8, 0, 26, "crystal_gold", sides=6, top_radius=3)


def dome(world: Map) -> None:
    """The well: ledges, the bridge, water below and a lift out of it."""
    part = world.detail
    ledge = {"all": "stone_a", "top": "tile_check", "bottom": "stone_b"}
    world.box((-DOME_X, DOME_SOUTH, WELL), (DOME_X, DOME_NORTH, WELL + 80), "*water_a")
    part.box((-DOME_X, DOME_SOUTH, -32), (DOME_X, EDGE, 0), ledge)
    part.box((-DOME_X, FAR, -32), (DOME_X, DOME_NORTH, 0), ledge)
    for k, y in enumerate(range(EDGE + 1, FAR - 1, 80)):
        pane(world, (-44, y, -12), (44, min(y + 78, FAR - 1), -1), (CLEAR, "lab_blue", CLEAR, "lab_yellow", CLEAR, "lab_red")[k])
        for side in (-1, 1):
            x0, x1 = sorted((side * 45, side * 51))
            part.box((x0, y - 1, -20), (x1, min(y + 79, FAR), 4), "copper_trim")
    part.arch((-DOME_X, DOME_SOUTH, 240), (DOME_X, 752, DOME_TOP), Tex("plaster", align="face"), axis="y", segments=10)
    part.arch((-DOME_X, 1072, 240), (DOME_X, DOME_NORTH, DOME_TOP), Tex("plaster", align="face"), axis="y", segments=10)
    for side in (-1, 1):
        for y, tex in ((768, "window_b"), (960, "window_a"), (1152, "window_b")):
            world.add(lancet(96, 208, tex, 24), (side * DOME_X, y, 64), turn=-90 * side)
        for y in (676, 864, 1056, 1248):
            part.cylinder((side * (DOME_X - 10), y), 16, WELL, 240, "marble_white", sides=8)
            x0, x1 = sorted((side * DOME_X, side * (DOME_X - 34)))
            part.box((x0, y - 22, 232), (x1, y + 22, 248), "copper_trim")
        for x, y, tex in ((side * 360, 720, "crystal_blue"), (side * 300, 1110, "crystal_gold"), (side * 180, 900, "crystal_red")):
            for r, dx, high in ((20, 0, 150), (13, 30, 100), (11, -26, 90)):
                part.cylinder((x + dx, y), r, WELL, WELL + high, tex, sides=6, top_radius=r * 0.6)
                part.cylinder((x + dx, y), r * 0.6, WELL + high, WELL + high + 24, tex, sides=6, top_radius=0)
    # Out of the water: a lift of glass at the near ledge; its shaft stands on a step.
    part.box((-320, EDGE + 1, WELL), (-192, EDGE + 100, WELL + 72), {"all": "stone_a", "top": "tile_check"})
    plat = world.part("func_plat", height=-WELL - 84, speed=140, sounds=2, alpha=0.35)
    plat.box((-304, EDGE + 2, -10), (-208, EDGE + 98, -1), CLEAR)
    part.arch((-64, DOME_NORTH, 96), (64, DOME_NORTH + 32, 160), "copper_plate", axis="y")
    for side in (-1, 1):
        x0, x1 = sorted((side * 64, side * 84))
        part.box((x0, DOME_NORTH - 14, 0), (x1, DOME_NORTH, 164), {"all": "copper_plate", "south": fit("rune_b", (1, 5))})
        world.add(candles(6, 11, 150 + side), (side * 46, DOME_NORTH + 60, 0))
        world.add(candle_stand(160 + side), (side * 110, DOME_NORTH - 40, 0))
        world.add(pillar(200, 16), (side * 120, 604, 0))
    part.box((-88, DOME_NORTH - 16, 164), (88, DOME_NORTH, 180), "copper_trim")
    world.add(way_out(4), (0, DOME_NORTH + 112, 0))


def people(world: Map) -> None:
    arrival(world, 0, -752, 0, "The House of Glass")
    world.entity("info_intermission", (-320, -470, 250), mangle=(20, 58, 0))
    for x, y, angle in ((-300, 300, 315), (300, -400, 135), (-300, -400, 45), (850, -140, 90)):
        world.entity("info_player_deathmatch", (x, y, 28), angle=angle)
    monster(world, "knight", -240, 100, 0, 0)
    monster(world, "army", 240, 340, 0, 180)
    monster(world, "army", 280, -100, 0, 90, skill=1)
    monster(world, "enforcer", -860, 150, 0, 270)
    monster(world, "knight", -860, -200, 0, 90, skill=1)
    monster(world, "hell_knight", 872, -60, 0, 90)
    monster(world, "dog", 656, 80, 0, 270, skill=1)
    monster(world, "shalrath", 240, 100, 0, 180, skill=2)
    monster(world, "wizard", -200, 960, 60, 0)
    monster(world, "wizard", 200, 900, 100, 180, skill=1)
    monster(world, "wizard", 0, 1040, 160, 90, skill=2)
    monster(world, "fish", 100, 860, WELL + 10, 90)
    monster(world, "ogre", 260, 1240, 0, 180)
    monster(world, "demon1", -260, 1260, 0, 0, skill=1)
    item(world, "shells", -300, -460, 0)
    item(world, "weapon_supershotgun", 300, -460, 0)
    item(world, "health", 300, 60, 0)
    item(world, "shells", -310, 300, 0)
    item(world, "spikes", -864, 180, 0)
    item(world, "health", -864, -220, 0)
    item(world, "weapon_nailgun", 560, 180, 0)
    item(world, "spikes", 752, 180, 0)
    item(world, "health", 860, -220, 0)
    item(world, "armor2", 1000, 0, 0)
    item(world, "cells", 960, 40, 0)
    item(world, "weapon_lightning", 960, -30, 0)
    item(world, "rockets", -380, 620, 0)
    item(world, "health", 380, 620, 0)
    item(world, "spikes", 380, 1300, 0)
    item(world, "health", -380, 1300, 0)


def build() -> Map:
    world = Map("The House of Glass", sounds=2, worldtype=0, _wateralpha=0.5, _minlight=22, fog="0.025 0.6 0.58 0.55", _sunlight=460,
                _sunlight_color="255 210 160", _sun_mangle="172 -44 0", _sunlight_penumbra=4, _sunlight2=110,
                _sunlight2_color="160 180 215")
    walls = Group()
    rooms(walls)
    openings(walls)
    world.add(walls)
    for part in (hall, west, east, dome, people):
        part(world)
    return world
