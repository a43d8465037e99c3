"""The hub: the nave of the drowned foundry-monastery. South a porch with three doors that choose the skill, in the middle
a deep pool under a broken vault with bells above it, north the furnaces and the gate to the four gates, east the gallery of the
laboratory's scenes, and under water a way for those who want it hardest."""

from __future__ import annotations

from kit import Group, Map, Tex, fit
from start_gallery import gallery
from pieces import (balustrade, bell, candle_stand, candles, hanging_lamp, lancet, pew, pillar, rose, sconce, slipgate)

BAYS = [-640 + 256 * k for k in range(6)]  # y of the piers
NAVE, AISLE, SPRING, CROWN, SKY = 320, 544, 352, 608, 720
POOL_X, POOL_SOUTH, POOL_NORTH, POOL_DEPTH, WATER = 160, -320, 256, -352, -14


def shell(world: Map) -> None:
    """What closes the hall: floor, walls, roofs; with holes for doors, windows and the sky."""
    walls = Group()
    floor = {"all": "stone_a", "top": "stone_floor"}
    walls.box((-AISLE - 32, -672, -32), (AISLE + 32, 672, 0), floor)
    for side in (-1, 1):
        walls.box((side * AISLE, -672, 0), (side * (AISLE + 32), 672, 224), "stone_a")
        walls.box((side * NAVE, -672, 224), (side * (AISLE + 32), 672, 256), {"all": "stone_a", "bottom": "wood_plank"})
        walls.box((side * NAVE, -672, 0), (side * (NAVE + 32), 672, 224), "stone_a")
        walls.box((side * NAVE, -672, 256), (side * (NAVE + 32), 672, CROWN), "stone_b")
    for y in (-1, 1):
        walls.box((-AISLE, y * 640, 0), (AISLE, y * 672, 224), "stone_a")
        walls.box((-NAVE, y * 640, 224), (NAVE, y * 672, CROWN), "stone_b")
    walls.box((-NAVE - 32, -672, CROWN), (NAVE + 32, 672, CROWN + 16), "stone_a")
    # The arcades.
    for y in BAYS[:-1]:
        for side in (-1, 1):
            x0, x1 = sorted((side * NAVE, side * (NAVE + 32)))
            walls.cut((x0, y + 32, 0), (x1, y + 224, 200))
            walls.cut((x0 if side > 0 else x0 + 8, y + 80, 264), (x1 - 8 if side > 0 else x1, y + 176, 352))
    # Doors: three from the porch, the gate, the gallery, the chapel.
    for x in (-224, 0, 224):
        walls.cut((x - 48, -672, 0), (x + 48, -640, 128))
    walls.cut((-64, 640, 64), (64, 672, 240))
    walls.cut((AISLE, -64, 0), (AISLE + 32, 64, 144))
    walls.cut((-96, 640, 312), (96, 664, 504))  # the rose
    for x in (-224, 224):
        walls.cut((x - 56, 640, 24), (x + 56, 672, 136))
    walls.cut((-144, -128, CROWN), (144, 128, CROWN + 16))
    walls.cut((-POOL_X, POOL_SOUTH, -32), (POOL_X, POOL_NORTH, 0))
    for y in (BAYS[0], BAYS[1], BAYS[3], BAYS[4]):
        for side in (-1, 1):
            x0, x1 = sorted((side * AISLE, side * (AISLE + 16)))
            walls.cut((x0, y + 96, 64), (x1, y + 160, 192))
    world.add(walls)
    # The sky above the hole.
    world.box((-160, -144, SKY), (160, 144, SKY + 16), "sky_dusk")
    for side in (-1, 1):
        world.box((side * 144, -144, CROWN + 16), (side * 160, 144, SKY), "brick_dark")
        world.box((-144, side * 128, CROWN + 16), (144, side * 144, SKY), "brick_dark")


def vault(world: Map) -> None:
    """Pointed barrel vaults bay by bay with ribs; the middle one has lost its crown."""
    for k, y in enumerate(BAYS[:-1]):
        bay = Group()
        bay.arch((-NAVE, y, SPRING), (NAVE, y + 256, CROWN), Tex("brick_dark", align="face"), axis="y", segments=10,
                 pointed=True)
        if k == 2:
            kept = [b for b in bay.brushes if max(abs(p[0]) for p in b.points()) > 144]
            bay.brushes = kept
            for side in (-1, 1):
                bay.box((side * 128, y, 560), (side * 144, y + 256, CROWN), "brick_dark")
        world.detail.brushes.extend(bay.brushes)
    for y in BAYS:
        rib = Group()
        lo, hi = max(y - 14, -640), min(y + 14, 640)
        rib.arch((-NAVE + 20, lo, SPRING - 24), (NAVE - 20, hi, CROWN - 20), "stone_trim", axis="y", segments=10,
                 pointed=True)
        world.detail.brushes.extend(rib.brushes)
        for side in (-1, 1):
            # Shafts that carry the ribs, from the arcade's piers up.
            world.detail.cylinder((side * NAVE, y if abs(y) < 640 else y - 12 * (1 if y > 0 else -1)), 16, 0,
                                  SPRING - 24, "marble_white", sides=8)
            x0, x1 = sorted((side * NAVE, side * (NAVE - 26)))
            world.detail.box((x0, lo - 4, SPRING - 40), (x1, hi + 4, SPRING - 16), "stone_trim")


def arcade(world: Map) -> None:
    """Arches to the aisles, strings along the wall, windows above."""
    for side in (-1, 1):
        x0, x1 = sorted((side * NAVE, side * (NAVE + 32)))
        for k, y in enumerate(BAYS[:-1]):
            world.detail.arch((x0, y + 32, 112), (x1, y + 224, 200), "stone_trim", axis="x", segments=8, pointed=True)
            window = lancet(96, 88, "window_a" if k % 2 else "window_b", 24)
            world.add(window, (side * NAVE, y + 128, 264), turn=-90 if side > 0 else 90)
            if k != 2:
                aisle_window = lancet(64, 128, "window_b")
                world.add(aisle_window, (side * AISLE, y + 128, 64), turn=-90 if side > 0 else 90)
        xa, xb = sorted((side * (NAVE - 8), side * NAVE))
        world.detail.box((xa, -640, 232), (xb, 640, 248), "copper_trim")
        xa, xb = sorted((side * (NAVE + 32), side * AISLE))
        for y in BAYS[1:-1]:
            world.detail.box((xa, y - 12, 200), (xb, y + 12, 224), "wood_beam")


def pool(world: Map) -> None:
    """The deep: tiled walls, crystals that light it from below, the way to the hidden room."""
    x, s, n, d = POOL_X, POOL_SOUTH, POOL_NORTH, POOL_DEPTH
    tiles = Group()
    for side in (-1, 1):
        tiles.box((side * x, s, d), (side * (x + 32), n, -32), "tile_teal")
    tiles.box((-x - 32, s - 32, d), (x + 32, s, -32), "tile_teal")
    tiles.box((-x - 32, n, d), (x + 32, n + 32, -32), "tile_teal")
    tiles.box((-x - 32, s - 32, d - 32), (x + 32, n + 32, d), {"all": "tile_teal", "top": "tile_check"})
    tiles.cut((-x - 32, -48, d), (-x, 48, d + 96))
    world.add(tiles)
    world.box((-x, s, d), (x, n, WATER), "*water_a")
    # The rim, two steps of marble that one can climb out over.
    rim = world.detail
    for side in (-1, 1):
        xa, xb = sorted((side * (x - 8), side * (x + 24)))
        rim.box((xa, s - 24, 0), (xb, n + 24, 6), "marble_white")
        ya, yb = (s - 24, s + 8) if side < 0 else (n - 8, n + 24)
        rim.box((-x + 8, ya, 0), (x - 8, yb, 6), "marble_white")
        xa, xb = sorted((side * x, side * (x - 32)))
        rim.box((xa, -192, -40), (xb, 128, -24), "marble_white")
    # Columns of crystal that stand in the deep, and a sunken bell.
    for cx, cy, tex, height in ((-112, -256, "crystal_blue", 72), (112, -220, "crystal_blue", 48),
                                (-108, 180, "crystal_blue", 56), (116, 200, "crystal_blue", 88)):
        world.detail.cylinder((cx, cy), 14, d, d + height, tex, sides=6, top_radius=8)
        world.detail.cylinder((cx, cy), 8, d + height, d + height + 20, tex, sides=6, top_radius=0)
    world.add(bell(72, 8), (0, -40, d))
    hidden_way(world)


def hidden_way(world: Map) -> None:
    """From the pool's floor west and up into a small cave; its gate sets nightmare and leads back to the nave."""
    d = POOL_DEPTH
    cave = Group()
    cave.room((-480, -48, d), (-192, 48, d + 96), "rock_a", wall=16)
    cave.cut((-192, -48, d), (-176, 48, d + 96))
    cave.cut((-480, -48, d + 96), (-384, 48, d + 112))
    world.add(cave)
    chamber = Group()
    chamber.room((-480, -48, d + 112), (-384, 48, -64), "rock_a", wall=16)
    chamber.cut((-480, -48, d + 96), (-384, 48, d + 112))
    chamber.cut((-496, -48, -176), (-480, 48, -64))
    world.add(chamber)
    room = Group()
    room.room((-736, -96, -176), (-496, 96, -48), {"side": "rock_b", "bottom": "cobble", "top": "rock_a"}, wall=16)
    room.cut((-496, -48, -176), (-480, 48, -64))
    world.add(room)
    world.box((-480, -48, d), (-160, 48, d + 96), "*water_a")
    world.box((-480, -48, d + 96), (-384, 48, -190), "*water_a")
    world.add(slipgate(80, 112, "flesh_a", "rune_b"), (-704, 0, -176), turn=90)
    world.part("func_illusionary").box((-706, -40, -176), (-702, 40, -64), "*teleport")
    world.part("trigger_setskill", message="3").box((-700, -48, -176), (-600, 48, -64), "trigger")
    word(world, (-660, -48, -176), (-600, 48, -80), "Nightmare")
    world.part("trigger_teleport", target="from_the_deep").box((-712, -40, -176), (-700, 40, -64), "trigger")
    world.entity("info_teleport_destination", (0, 448, 72), angle=270, targetname="from_the_deep")
    world.add(candles(7, 14, 3), (-620, 70, -176))
    world.add(candles(5, 12, 4), (-640, -72, -176))
    # What shows the way: a frame of runes that one sees across the pool, crystals behind it.
    for side in (-1, 1):
        a, b = sorted((side * 48, side * 60))
        world.detail.box((-POOL_X, a, d), (-POOL_X + 6, b, d + 96), {"all": "copper_plate", "east": fit("rune_b", (1, 8))})
    world.detail.box((-POOL_X, -64, d + 96), (-POOL_X + 8, 64, d + 106), "copper_trim")
    for x, y in ((-290, 38), (-440, -38)):
        world.detail.cylinder((x, y), 9, d, d + 40, "crystal_blue", sides=6, top_radius=3)


def porch(world: Map) -> None:
    """Where one arrives. Three doors: green for easy, gold for normal, red for hard."""
    room = Group()
    room.room((-352, -1056, 0), (352, -704, 224), {"side": "stone_b", "bottom": "tile_check", "top": "wood_plank"}, wall=32)
    for x in (-224, 0, 224):
        room.cut((x - 48, -704, 0), (x + 48, -672, 128))
    for x in (-176, 176):
        room.cut((x - 32, -1072, 64), (x + 32, -1056, 192))
    world.add(room)
    for x, crystal, skill, text in ((-224, "light_green", 0, "Easy"), (0, "crystal_gold", 1, "Normal"),
                                    (224, "crystal_red", 2, "Hard")):
        world.detail.arch((x - 48, -704, 80), (x + 48, -640, 128), "stone_trim", axis="y", segments=8, pointed=True)
        world.detail.box((x - 60, -712, 0), (x - 48, -704, 140), "copper_plate")
        world.detail.box((x + 48, -712, 0), (x + 60, -704, 140), "copper_plate")
        world.detail.box((x - 60, -712, 140), (x + 60, -704, 152), "copper_trim")
        world.detail.cylinder((x, 170), 12, -710, -704, "metal_trim", sides=8, axis="y")
        world.detail.cylinder((x, 170), 9, -712, -706, fit(crystal), sides=8, axis="y")
        world.part("trigger_setskill", message=str(skill)).box((x - 48, -696, 0), (x + 48, -680, 128), "trigger")
        word(world, (x - 48, -752, 0), (x + 48, -704, 96), text)
    for x in (-176, 176):
        world.add(lancet(64, 128, "window_a"), (x, -1056, 64), turn=180)
    for x in (-112, 112):
        for y in (-960, -800):
            world.add(pillar(200, 16), (x, y, 0))
    for y in (-960, -800):
        world.detail.box((-352, y - 14, 200), (352, y + 14, 224), "wood_beam")
        world.add(hanging_lamp(48), (0, y, 200))
    world.detail.box((-64, -1040, 0), (64, -704, 1), {"all": "carpet_red", "top": "carpet_red"})
    for x in (-320, 320):
        world.add(candle_stand(11 if x < 0 else 12), (x, -880, 0))
    world.entity("info_player_start", (0, -992, 28), angle=90)
    for k, (x, y) in enumerate(((-64, -928), (64, -928), (-64, -864), (64, -864))):
        world.entity("info_player_coop", (x, y, 28), angle=90)


def north_end(world: Map) -> None:
    """Stairs, furnaces on both sides, the rose window, and the gate to the four gates."""
    steps = world.detail
    world.detail.stairs((-192, 384, 0), (192, 480, 64), {"all": "stone_trim", "top": "stone_a"}, "+y")
    steps.box((-NAVE, 480, 0), (NAVE, 640, 24), {"all": "stone_a", "top": "stone_floor"})
    steps.box((-160, 480, 24), (160, 640, 64), {"all": "stone_a", "top": "tile_check"})
    for side in (-1, 1):
        world.add(balustrade(160), (side * 154, 480, 64), turn=90)
    world.add(rose(96, "window_a"), (0, 640, 408))
    for x in (-224, 224):
        furnace(world, x)
    way = Group()
    way.room((-64, 672, 64), (64, 832, 240), {"side": "copper_plate", "bottom": "metal_floor", "top": "metal_plate"}, wall=32)
    way.cut((-64, 640, 64), (64, 672, 240))
    world.add(way)
    world.detail.arch((-64, 640, 160), (64, 672, 240), "copper_plate", axis="y", segments=10)
    for side in (-1, 1):
        x0, x1 = sorted((side * 64, side * 84))
        steps.box((x0, 624, 64), (x1, 640, 240), {"all": "copper_plate", "south": fit("rune_a", (1, 8))})
        steps.box((x0 - 2, 620, 64), (x1 + 2, 640, 80), "copper_trim")
    steps.box((-92, 620, 240), (92, 640, 260), "copper_trim")
    world.add(slipgate(96, 144), (0, 790, 64))
    world.part("func_illusionary").box((-48, 788, 64), (48, 792, 208), "*teleport")
    world.part("trigger_changelevel", map="gates", spawnflags=1).box((-48, 784, 64), (48, 796, 208), "trigger")
    word(world, (-64, 600, 64), (64, 640, 160), "To the four gates")


def word(world: Map, lo, hi, message: str) -> None:
    """Said to who comes by."""
    world.part("trigger_multiple", message=message, wait=4).box(lo, hi, "trigger")


def furnace(world: Map, x: float) -> None:
    """A mouth of fire in the north wall behind an iron grate."""
    box = Group()
    box.room((x - 56, 672, 24), (x + 56, 752, 136), "brick_red", wall=16)
    box.cut((x - 56, 656, 24), (x + 56, 672, 136))
    world.add(box)
    world.box((x - 56, 660, 24), (x + 56, 752, 44), "*lava_a")
    part = world.detail
    part.box((x - 56, 640, 24), (x + 56, 660, 52), "brick_dark")
    part.arch((x - 56, 640, 88), (x + 56, 672, 136), "brick_red", axis="y", segments=8)
    for k in range(5):
        part.box((x - 46 + 22 * k, 644, 52), (x - 42 + 22 * k, 648, 132), "metal_rust")
    part.box((x - 56, 643, 92), (x + 56, 649, 97), "metal_rust")
    for side in (-1, 1):
        a, b = sorted((x + side * 56, x + side * 72))
        part.box((a, 624, 24), (b, 640, 152), "metal_rivet")
    part.box((x - 72, 624, 136), (x + 72, 640, 156), "metal_trim")
    part.frustum((x - 72, 624, 156), (x + 72, 640, 220), (x - 32, 632), (x + 32, 640), "copper_plate")


def furnish(world: Map) -> None:
    """Bells, lamps, pews, candles."""
    world.add(bell(64, 150), (0, -48, 380))
    world.detail.box((-144, -56, 613), (144, -40, 629), "wood_beam")
    world.add(bell(40, 60), (-96, -512, 440))
    world.add(bell(40, 60), (96, 320, 440))
    for y in (-512, -256, 256, 512):
        world.add(hanging_lamp(40), (-448, y, 224))
        world.add(hanging_lamp(40), (448, y, 224))
    for side in (-1, 1):
        for y in (-340, -280, -220):
            world.add(pew(128), (side * 448, y, 0))
        world.add(candle_stand(20 + side), (side * 290, 352, 0))
        world.add(candle_stand(30 + side, 40), (side * 210, 470, 0))
        for k, y in enumerate((-384, 128)):
            world.add(candles(5, 10, 40 + k + side), (side * 300, y + 40, 0))
    world.add(sconce("light_cool"), (AISLE, 96, 112), turn=-90)
    world.add(sconce("light_cool"), (AISLE, -96, 112), turn=-90)


def starts(world: Map) -> None:
    for x, y, angle in ((-448, -560, 90), (448, -560, 90), (-448, 560, 270), (448, 560, 270), (0, 560, 270)):
        world.entity("info_player_deathmatch", (x, y, 92 if y == 560 and x == 0 else 28), angle=angle)
    world.entity("info_intermission", (-250, -560, 220), mangle=(18, 62, 0))
    world.entity("info_intermission", (200, 430, 300), mangle=(28, 240, 0))


def build() -> Map:
    world = Map("The Drowned Foundry", sounds=2, _wateralpha=0.6, _minlight=22, fog="0.03 0.42 0.46 0.52", _sunlight=260,
                _sunlight_color="255 214 170", _sun_mangle="250 -62 0", _sunlight_penumbra=3, _sunlight2=100,
                _sunlight2_color="150 175 215")
    for part in (shell, vault, arcade, pool, porch, north_end, gallery, furnish, starts):
        part(world)
    return world
