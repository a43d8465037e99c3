"""The court, under the open sky: where one arrives. A ruined colonnade, a channel of the works' water with a bridge, the
portal of the hall. Secret: behind the cracked wall in the west."""

from __future__ import annotations

from kit import Group, Map, Tex, fit
from people import item, monster, secret, trigger
from pieces import brazier, candles, crates, lancet, pillar, slipgate

X, SOUTH, NORTH, SKY = 320, -832, -64, 448


def rooms(walls: Group) -> None:
    walls.room((-X, SOUTH, 0), (X, NORTH, SKY), {"side": "moss_stone", "bottom": "cobble", "top": "sky_dusk"}, wall=32)
    walls.room((-X - 192, -416, 0), (-X - 64, -288, 96), {"side": "rock_a", "bottom": "dirt", "top": "rock_a"}, wall=32)
    # The channel's bed below the court's floor.
    walls.room((-X, -480, -96), (X, -384, -32), {"side": "tile_teal", "bottom": "dirt", "top": "stone_a"}, wall=32)
    walls.room((-64, SOUTH - 128, 0), (64, SOUTH - 32, 160), {"side": "stone_b", "bottom": "stone_floor", "top": "stone_b"})


def openings(walls: Group) -> None:
    walls.cut((-X, -480, -32), (X, -384, 0))
    walls.cut((-X - 64, -392, 0), (-X, -312, 80))
    walls.cut((-72, NORTH, 0), (72, 0, 176))
    walls.cut((-64, SOUTH - 32, 0), (64, SOUTH, 160))
    for x in (-192, 192):
        walls.cut((x - 40, NORTH, 176), (x + 40, NORTH + 24, 336))


def furnish(world: Map) -> None:
    world.box((-X, -480, -96), (X, -384, -20), "*water_a")
    part = world.detail
    # The bridge, a little humped.
    part.box((-56, -496, -8), (56, -368, 4), {"all": "wood_beam", "top": "wood_plank"})
    for x in (-56, 48):
        part.box((x, -496, 4), (x + 8, -368, 10), "wood_beam")
        for y in (-492, -436, -380):
            part.box((x, y, 10), (x + 8, y + 8, 44), "wood_beam")
        part.box((x + 1, -496, 40), (x + 7, -368, 46), "wood_beam")
    for y in (-484, -380):
        part.box((-X, y - 8 if y < -400 else y - 4, 0), (-56, y + 4 if y < -400 else y + 8, 8), "stone_trim")
        part.box((56, y - 8 if y < -400 else y - 4, 0), (X, y + 4 if y < -400 else y + 8, 8), "stone_trim")
    colonnade(world)
    portal(world)
    # Where the slipgate stands.
    world.add(slipgate(80, 128), (0, SOUTH - 96, 0))
    world.part("func_illusionary").box((-40, SOUTH - 98, 0), (40, SOUTH - 94, 128), "*teleport")
    part.stairs((-96, SOUTH, 0), (96, SOUTH + 32, 8), "stone_trim", "-y", steps=1)
    world.add(crates(3), (-240, -620, 0))
    world.add(crates(5), (250, -250, 0), turn=90)
    for x in (-150, 150):
        world.add(brazier(), (x, -130, 0))
    # The cracked wall, which a shot opens.
    hidden = world.part("func_door", angle=270, health=1, wait=-1, lip=4, speed=60, sounds=1)
    hidden.box((-X - 28, -392, 0), (-X - 4, -312, 80), "moss_stone")
    part.box((-X - 4, -396, 80), (-X + 6, -308, 88), "stone_trim")
    secret(world, (-X - 180, -400, 0), (-X - 80, -304, 64))
    # Somebody prayed at the wall that is no wall; within, what has grown in the dark lights the find.
    world.add(candles(4, 7, 90), (-X + 14, -298, 0))
    part.cylinder((-X - 176, -304), 8, 0, 26, "crystal_blue", sides=6, top_radius=3)
    part.cylinder((-X - 160, -298), 5, 0, 14, "crystal_blue", sides=6, top_radius=2)


def colonnade(world: Map) -> None:
    """Columns along both walls; some are broken."""
    for side in (-1, 1):
        x = side * 232
        for k, (y, height) in enumerate(((-752, 240), (-624, 152 if side < 0 else 240), (-240, 240), (-336, 240 if side < 0 else 96))):
            if height == 240:
                world.add(pillar(240, 18, "stone_a"), (x, y, 0))
            else:
                world.detail.box((x - 28, y - 28, 0), (x + 28, y + 28, 12), "stone_trim")
                world.detail.cylinder((x, y), 18, 12, height, "stone_a", sides=8)
                world.detail.frustum((x - 14, y - 14, height), (x + 14, y + 14, height + 14), (x + 4, y - 6), (x + 12, y + 4),
                                     "rock_b")
        # The beams that are left.
        world.detail.box((x - 26, -780, 240), (x + 26, -724 if side < 0 else -596, 264), "stone_trim")
        world.detail.box((x - 26, -364 if side < 0 else -268, 240), (x + 26, -212, 264), "stone_trim")
    # Buttresses on the walls.
    for side in (-1, 1):
        for y in (-704, -544, -288, -160):
            if side < 0 and -420 < y < -280:
                continue
            a, b = sorted((side * X, side * (X - 28)))
            world.detail.box((a, y - 20, 0), (b, y + 20, 300), "stone_b")
            c = side * (X - 2)
            world.detail.frustum((a, y - 20, 300), (b, y + 20, 360), (min(c, side * X), y - 20), (max(c, side * X), y + 20),
                                 "stone_b")


def portal(world: Map) -> None:
    """The hall's front: a pointed gate between pilasters, stained windows, a ledge."""
    part = world.detail
    part.arch((-72, NORTH, 96), (72, 0, 176), "stone_trim", axis="y", segments=10, pointed=True)
    for side in (-1, 1):
        a, b = sorted((side * 72, side * 104))
        part.box((a, NORTH - 20, 0), (b, NORTH, 216), {"all": "stone_b", "south": fit("copper_plate", (1, 6))})
        part.box((a - 4, NORTH - 24, 0), (b + 4, NORTH, 24), "stone_trim")
        part.box((a - 4, NORTH - 24, 200), (b + 4, NORTH, 216), "copper_trim")
        world.add(lancet(80, 160, "window_a", 24), (side * 192, NORTH, 176))
    part.box((-X, NORTH - 14, 352), (X, NORTH, 368), "copper_trim")
    part.frustum((-108, NORTH - 20, 216), (108, NORTH, 280), (-16, NORTH - 16), (16, NORTH), "stone_trim")
    part.cylinder((0, 240), 16, NORTH - 26, NORTH - 18, fit("crystal_blue"), sides=8, axis="y")


def people(world: Map) -> None:
    world.entity("info_player_start", (0, SOUTH - 64, 28), angle=90)
    for k, (x, y) in enumerate(((-40, SOUTH + 60), (40, SOUTH + 60), (-40, SOUTH + 120), (40, SOUTH + 120))):
        world.entity("info_player_coop", (x, y, 28), angle=90)
    world.entity("info_player_deathmatch", (-240, -200, 28), angle=315)
    world.entity("info_player_deathmatch", (256, -700, 28), angle=90)
    world.entity("info_intermission", (-270, -760, 300), mangle=(22, 62, 0))
    # They look aside: not at who arrives, but at who comes as far as the bridge.
    monster(world, "dog", 120, -260, 0, 180)
    monster(world, "dog", -140, -240, 0, 0, skill=1)
    monster(world, "army", -104, -150, 0, 0)
    monster(world, "army", 180, -300, 0, 170)
    monster(world, "army", -200, -560, 0, 40, skill=2)
    item(world, "shells", -280, -700, 0)
    item(world, "health", 280, -740, 0)
    item(world, "health", 180, -200, 0)
    item(world, "shells", -170, -110, 0)
    item(world, "weapon_supershotgun", -X - 128, -352, 0)
    item(world, "shells", -X - 160, -390, 0)
    trigger(world, "multiple", (-72, NORTH - 8, 0), (72, NORTH, 128), message="The Sunken Works", wait=-1)
