"""The second level, water: the Sunlit Baths. A bath hall under holes in its vault; from the pool's ground a tunnel to the drowned
cistern with the silver key and the button of the way back; behind the silver door the fountain's court with the rune."""

from __future__ import annotations

from kit import Group, Map, fit
from passages import arrival, way_out
from people import item, monster, secret, trigger
from pieces import balustrade, brazier, candles, crates, hanging_lamp, lancet, pillar, sconce

X, SOUTH, NORTH, TOP = 416, -448, 448, 304  # the bath hall
POOL_X, POOL_SOUTH, POOL_NORTH, BED, WATER = 256, -320, 256, -288, -16
OCULUS = (0, 0, 136)  # the large hole in the vault: x, y, half
CW, CE, CS, CN, CTOP = -1184, -640, -320, 320, 160  # the cistern
TUNNEL = (-64, 64, -176)  # south, north, top
COURT_X, COURT_SOUTH, COURT_NORTH, COURT_TOP = 384, 608, 1376, 416
BASIN = (-240, 240, 800, 1184, -64)  # the fountain's water: x from, to, y from, to, bed


def rooms(walls: Group) -> None:
    walls.room((-96, -816, 0), (96, -512, 176), {"side": "stone_b", "bottom": "tile_check", "top": "wood_plank"}, wall=32)
    walls.room((-X, SOUTH, 0), (X, NORTH, TOP), {"side": "tile_white", "bottom": "marble_white", "top": "plaster"}, wall=32)
    walls.room((-POOL_X, POOL_SOUTH, BED), (POOL_X, POOL_NORTH, -32), {"side": "tile_teal", "bottom": "tile_teal", "top": "stone_a"}, wall=32)
    walls.room((-X - 32, SOUTH, TOP + 32), (X + 32, NORTH, TOP + 48), {"all": "sky_dusk"}, wall=16)
    south, north, top = TUNNEL
    walls.room((CE + 32, south, BED), (-POOL_X - 32, north, top), {"side": "rock_a", "bottom": "rock_b", "top": "rock_a"}, wall=32)
    walls.room((CW, CS, BED), (CE, CN, CTOP), {"side": "brick_dark", "bottom": "rock_b", "top": "brick_dark"}, wall=32)
    walls.room((CE + 32, 224, 0), (-X - 32, 320, 128), {"side": "stone_b", "bottom": "stone_floor", "top": "wood_plank"}, wall=32)
    walls.room((CW - 128, -64, BED), (CW - 32, 64, BED + 96), "rock_a")  # the secret
    walls.room((-COURT_X, COURT_SOUTH, 0), (COURT_X, COURT_NORTH, COURT_TOP), {"side": "moss_stone", "bottom": "cobble", "top": "sky_dusk"},
               wall=32)
    walls.room((-56, NORTH + 32, 0), (56, COURT_SOUTH - 32, 128), {"side": "marble_black", "bottom": "tile_check", "top": "wood_plank"},
               wall=32)
    x0, x1, y0, y1, bed = BASIN
    walls.room((x0, y0, bed), (x1, y1, -32), {"side": "tile_teal", "bottom": "tile_white", "top": "stone_a"}, wall=32)
    walls.room((-64, COURT_NORTH + 32, 0), (64, COURT_NORTH + 160, 160), {"side": "marble_white", "bottom": "tile_check", "top": "stone_a"},
               wall=32)


def openings(walls: Group) -> None:
    walls.cut((-64, -512, 0), (64, SOUTH, 144))
    walls.cut((-POOL_X, POOL_SOUTH, -32), (POOL_X, POOL_NORTH, 0))
    x, y, half = OCULUS
    for a, b, c in ((x, y, half), (-260, -250, 40), (-260, 250, 40), (290, -250, 40), (290, 300, 40)):
        walls.cut((a - c, b - c, TOP), (a + c, b + c, TOP + 32))
    south, north, top = TUNNEL
    walls.cut((-POOL_X - 32, south, BED), (-POOL_X, north, top))
    walls.cut((CE, south, BED), (CE + 32, north, top))
    walls.cut((CE, 224, 0), (CE + 32, 320, 128))
    walls.cut((-X - 32, 224, 0), (-X, 320, 128))
    walls.cut((CW - 32, -40, BED), (CW, 40, BED + 80))
    walls.cut((-56, NORTH, 0), (56, NORTH + 32, 128))
    walls.cut((-56, COURT_SOUTH - 32, 0), (56, COURT_SOUTH, 128))
    x0, x1, y0, y1, _ = BASIN
    walls.cut((x0, y0, -32), (x1, y1, 0))
    walls.cut((-64, COURT_NORTH, 0), (64, COURT_NORTH + 32, 160))
    for y in (-192, 192):
        walls.cut((X, y - 48, 64), (X + 24, y + 48, 224))


def hall(world: Map) -> None:
    part = world.detail
    world.box((-POOL_X, POOL_SOUTH, BED), (POOL_X, POOL_NORTH, WATER), "*water_a")
    # Columns round the pool that carry the vault, arches between them.
    for side in (-1, 1):
        x = side * (POOL_X + 56)
        for y in (-384, -192, 0, 192, 384):
            world.add(pillar(208, 16), (x, y, 0))
        for y in (-384, -192, 0, 192):
            part.arch((x - 12, y + 20, 168), (x + 12, y + 172, TOP), "plaster", axis="x", segments=8)
        for y in (-384, -192, 0, 192, 384):
            part.box((x - 12, y - 20, 208), (x + 12, y + 20, TOP), "plaster")
        a, b = sorted((side * (X - 4), side * X))
        part.box((a, SOUTH, 96), (b, NORTH, 104), "copper_trim")
    for y in (-192, 192):
        world.add(lancet(96, 160, "window_b", 24), (X, y, 64), turn=-90)
    x, y, half = OCULUS
    for dx, dy, w, d in ((-half - 14, -half - 14, 2 * half + 28, 14), (-half - 14, half, 2 * half + 28, 14), (-half - 14, -half, 14, 2 * half),
                         (half, -half, 14, 2 * half)):
        part.box((x + dx, y + dy, TOP - 14), (x + dx + w, y + dy + d, TOP), "copper_trim")
    # The rim, steps into the water on the south side, a rail on the north one.
    for lo, hi in (((-POOL_X - 16, POOL_SOUTH - 16), (POOL_X + 16, POOL_SOUTH)), ((-POOL_X - 16, POOL_NORTH), (POOL_X + 16, POOL_NORTH + 16)),
                   ((-POOL_X - 16, POOL_SOUTH), (-POOL_X, POOL_NORTH)), ((POOL_X, POOL_SOUTH), (POOL_X + 16, POOL_NORTH))):
        part.box((*lo, 0), (*hi, 6), "stone_trim")
    part.stairs((-96, POOL_SOUTH, -128), (96, POOL_SOUTH + 128, 0), "marble_white", "-y", steps=16)
    part.box((-96, POOL_SOUTH, BED), (96, POOL_SOUTH + 128, -128), "tile_teal")
    for x in (-216, 56):
        world.add(balustrade(160), (x, POOL_NORTH + 28, 0))
    # What lies on the ground: a fallen column, crystals where the tunnel begins, weeds.
    part.cylinder((120, BED + 20), 20, 40, 190, "marble_white", sides=8, axis="y")
    part.cylinder((170, -60), 20, BED, BED + 90, "marble_white", sides=8)
    for y in (TUNNEL[0] - 16, TUNNEL[1] + 16):
        part.cylinder((-POOL_X + 14, y), 11, BED, BED + 64, "crystal_blue", sides=6, top_radius=6)
        part.cylinder((-POOL_X + 14, y), 6, BED + 64, BED + 78, "crystal_blue", sides=6, top_radius=0)
    part.box((-POOL_X, TUNNEL[0] - 8, TUNNEL[2]), (-POOL_X + 10, TUNNEL[1] + 8, TUNNEL[2] + 12), "copper_trim")
    weeds = world.part("func_illusionary")
    for x, y, high in ((200, 180, 150), (180, 205, 110), (-150, 190, 170), (-120, 210, 120), (60, 210, 130), (210, -200, 160), (-200, -240, 140)):
        weeds.box((x - 16, y - 1, BED), (x + 16, y + 1, BED + high), "{vine")
        weeds.box((x - 1, y - 16, BED), (x + 1, y + 16, BED + high - 8), "{vine")
    # The silver door.
    for side in (-1, 1):
        a, b = sorted((0, side * 56))
        leaf = world.part("func_door", angle=180 if side < 0 else 0, spawnflags=16, speed=80, lip=4, sounds=1, wait=-1)
        leaf.box((a, NORTH + 4, 0), (b, NORTH + 20, 128), fit("door_silver"))
        a, b = sorted((side * 56, side * 72))
        part.box((a, NORTH - 12, 0), (b, NORTH, 144), "marble_black")
    part.box((-76, NORTH - 14, 144), (76, NORTH, 160), "marble_black")
    # The way back from the cistern.
    door = world.part("func_door", angle=-1, targetname="back", speed=90, lip=8, sounds=2, wait=-1, message="It opens from the other side")
    door.box((-X - 24, 224, 0), (-X - 8, 320, 128), fit("door_iron"))
    part.box((-X, 208, 0), (-X + 10, 224, 144), "metal_rivet")
    part.box((-X, 320, 0), (-X + 10, 336, 144), "metal_rivet")
    part.box((-X, 204, 144), (-X + 12, 340, 156), "metal_trim")
    # The entry.
    part.arch((-64, -512, 88), (64, SOUTH, 144), "stone_trim", axis="y")
    world.add(hanging_lamp(32, "lamp_round", 9), (0, -660, 176))
    for side in (-1, 1):
        world.add(pillar(176, 12), (side * 76, -620, 0))


def cistern(world: Map) -> None:
    """Deep water without sun; a ledge along its north with the key and the button."""
    part = world.detail
    south, north, top = TUNNEL
    world.box((CE, south, BED), (-POOL_X, north, top), "*water_a")
    world.box((CW, CS, BED), (CE, CN, WATER - 16), "*water_a")
    world.box((CW - 128, -64, BED), (CW, 64, BED + 96), "*water_a")
    part.box((CW, 176, -32), (CE, CN, 0), {"all": "stone_trim", "top": "stone_floor"})
    for x in range(CW + 16, CE, 128):
        part.box((x, 176, BED), (x + 32, 208, -32), "stone_a")
    part.stairs((CW + 64, 64, -112), (CW + 192, 176, 0), {"all": "stone_trim", "top": "stone_floor"}, "+y", steps=14)
    part.box((CW + 64, 64, BED), (CW + 192, 176, -112), "stone_a")
    for x in (CW + 136, CE - 136):
        part.cylinder((x, -64), 20, BED, 96, "marble_black", sides=8)
        part.cylinder((x, -64), 20, 96, 116, "stone_trim", sides=8, top_radius=32)
        part.box((x - 32, CS, 116), (x + 32, CN, CTOP), "brick_dark")
    for x, y in ((CW + 40, -250), (CE - 50, -240), (CW + 60, 20), (CE - 120, 60), (-900, -280), (-860, -110)):
        part.cylinder((x, y), 16, BED, BED + 70, "crystal_blue", sides=6, top_radius=9)
        part.cylinder((x, y), 9, BED + 70, BED + 90, "crystal_blue", sides=6, top_radius=0)
    for y in (south + 10, north - 10):
        part.cylinder((-470, y), 8, BED, BED + 34, "crystal_blue", sides=6, top_radius=3)
    for x in (CW + 60, -912, CE - 60):
        world.add(sconce("light_cool"), (x, CN, 96))
    for x in (-1000, -800):
        world.add(hanging_lamp(60, "light_cool", 8), (x, -180, CTOP))
    part.box((-1056, 250, 0), (-1008, 298, 14), {"all": "copper_plate", "top": fit("rune_b")})
    button = world.part("func_button", angle=90, target="back", speed=40, wait=-1, lip=2, message="The iron door to the baths is open")
    button.box((-816, CN - 8, 40), (-784, CN, 72), {"all": "metal_trim", "south": fit("+0button")})
    part.box((-824, CN - 5, 28), (-776, CN, 40), "copper_trim")
    part.box((-824, CN - 5, 72), (-776, CN, 84), "copper_trim")
    part.arch((CE, 224, 88), (CE + 32, 320, 128), "stone_trim", axis="x")
    world.add(crates(31), (CW + 70, 290, 0))
    secret(world, (CW - 120, -64, BED), (CW - 40, 64, BED + 80))
    part.cylinder((CW - 110, 48), 7, BED, BED + 28, "crystal_gold", sides=6, top_radius=3)


def court(world: Map) -> None:
    """The fountain's court: shallow water under the sky, the rune before the gate in the north."""
    part = world.detail
    x0, x1, y0, y1, bed = BASIN
    world.box((x0, y0, bed), (x1, y1, -12), "*water_a")
    part.stairs((x0, y0, bed), (x1, y0 + 64, 0), "marble_white", "-y", steps=8)
    part.stairs((x0, y1 - 64, bed), (x1, y1, 0), "marble_white", "+y", steps=8)
    for r, low, high, tex in ((88, bed, -4, "stone_trim"), (56, -4, 20, "marble_white"), (20, 20, 72, "marble_white")):
        part.cylinder((0, 992), r, low, high, tex, sides=12)
    part.cylinder((0, 992), 22, 72, 88, "copper_plate", sides=12, top_radius=52)
    part.cylinder((0, 992), 12, 88, 130, "crystal_blue", sides=6, top_radius=5)
    for x in (-1, 1):
        for y in (704, 864, 1120, 1280):
            world.add(pillar(224, 18, "marble_white"), (x * 312, y, 0))
        a, b = sorted((x * 286, x * 338))
        part.box((a, 660, 224), (b, 1324, 248), {"all": "stone_trim", "bottom": "wood_plank"})
        part.box((sorted((x * 300, x * COURT_X))[0], 660, 248), (sorted((x * 300, x * COURT_X))[1], 1324, 260), "brick_red")
        for y in (784, 992, 1200):
            world.add(hanging_lamp(30, "lamp_round", 9), (x * 350, y, 248))
        world.add(brazier(), (x * 110, COURT_NORTH - 50, 0))
        vines = world.part("func_illusionary")
        for y in (740, 930, 1060, 1250):
            a, b = sorted((x * (COURT_X - 2), x * (COURT_X - 1)))
            vines.box((a, y - 32, 60), (b, y + 32, 240), "{vine")
    part.arch((-64, COURT_NORTH, 96), (64, COURT_NORTH + 32, 160), "copper_plate", axis="y")
    for side in (-1, 1):
        a, b = sorted((side * 64, side * 84))
        part.box((a, COURT_NORTH - 14, 0), (b, COURT_NORTH, 164), {"all": "copper_plate", "south": fit("rune_b", (1, 5))})
    part.box((-88, COURT_NORTH - 16, 164), (88, COURT_NORTH, 180), "copper_trim")
    world.add(way_out(2), (0, COURT_NORTH + 112, 0))
    world.add(candles(6, 11, 131), (-46, COURT_NORTH + 60, 0))
    world.add(candles(6, 11, 132), (46, COURT_NORTH + 60, 0))


def people(world: Map) -> None:
    arrival(world, 0, -720, 0, "The Sunlit Baths")
    world.entity("info_intermission", (-380, -400, 230), mangle=(20, 48, 0))
    for x, y, z, angle in ((-360, 0, 0, 0), (360, 300, 0, 225), (-700, 260, 0, 180), (-360, -200, 0, 45)):
        world.entity("info_player_deathmatch", (x, y, z + 28), angle=angle)
    monster(world, "knight", 378, 380, 0, 180)
    monster(world, "army", -378, 380, 0, 0)
    monster(world, "army", 360, -100, 0, 90, skill=1)
    monster(world, "wizard", -340, 120, 60, 90, skill=1)
    monster(world, "wizard", 120, 380, 80, 0, skill=2)
    monster(world, "fish", 150, 100, -220, 90)
    monster(world, "fish", -800, -200, -220, 180)
    monster(world, "fish", -1000, -100, -200, 0, skill=1)
    monster(world, "fish", -900, 60, -240, 90, skill=2)
    monster(world, "enforcer", -720, 250, 0, 180)
    monster(world, "knight", -1100, 250, 0, 0, skill=1)
    monster(world, "hell_knight", 200, 1260, 0, 180)
    monster(world, "ogre", -330, 992, 0, 90)
    monster(world, "ogre", 330, 960, 0, 90, skill=1)
    monster(world, "dog", -150, 1240, 0, 0)
    monster(world, "demon1", -240, 1220, 0, 0, skill=2)
    item(world, "shells", -330, -400, 0)
    item(world, "weapon_supershotgun", 330, -400, 0)
    item(world, "health", 380, 40, 0)
    item(world, "spikes", -380, -100, 0)
    item(world, "weapon_nailgun", 0, 400, 0)
    item(world, "key1", -1032, 274, 14)
    item(world, "health", -900, 290, 0)
    item(world, "spikes", -680, 210, 0)
    item(world, "artifact_super_damage", CW - 84, 0, BED)
    item(world, "armor1", 0, 560, 0)
    item(world, "health", -340, 680, 0)
    item(world, "shells", 340, 680, 0)
    item(world, "spikes", 340, 1240, 0)
    item(world, "health", -340, 1330, 0)
    for x, y, z in ((-60, 60, BED + 20), (140, -150, BED + 20), (-960, -120, BED + 20)):
        world.entity("air_bubbles", (x, y, z))


def build() -> Map:
    world = Map("The Sunlit Baths", sounds=3, worldtype=0, _wateralpha=0.5, _minlight=22, fog="0.02 0.62 0.68 0.7", _sunlight=760,
                _sunlight_color="255 226 180", _sun_mangle="222 -64 0", _sunlight_penumbra=4, _sunlight2=190,
                _sunlight2_color="160 190 225")
    walls = Group()
    rooms(walls)
    openings(walls)
    world.add(walls)
    for part in (hall, cistern, court, people):
        part(world)
    return world
