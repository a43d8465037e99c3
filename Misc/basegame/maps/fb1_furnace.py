"""The furnace: a lake of lava that a train crosses. On the far side the silver key, a trap that taking it springs, and a
button that opens the catwalk back. Secret: a ledge round the corner of the near side."""

from __future__ import annotations

import random

from kit import Group, Map, Tex, fit
from people import item, monster, secret, trigger
from pieces import bell, crates, hanging_lamp, hollow, pipe_run

EAST, WEST, SOUTH, NORTH, TOP, BED = -640, -1408, -64, 512, 352, -192
LAVA = -112
NEAR, FAR = -768, -1264  # edges of the ledges


def rooms(walls: Group) -> None:
    walls.room((WEST, SOUTH, BED), (EAST, NORTH, TOP), {"side": "brick_dark", "bottom": "rock_b", "top": "metal_rust"}, wall=32)
    walls.room((EAST + 32, 144, 0), (-480, 240, 144), {"side": "metal_rivet", "bottom": "metal_floor", "top": "metal_plate"},
               wall=32)
    walls.room((FAR - 48, NORTH + 32, 0), (FAR + 48, NORTH + 160, 112), "metal_rust")  # the trap's closet
    walls.room((EAST - 120, SOUTH - 160, -64), (EAST - 8, SOUTH - 32, 48), "rock_a")  # the secret
    for y in (64, 224, 384):  # mouths of the western furnaces
        walls.room((WEST - 96, y - 48, 16), (WEST - 32, y + 48, 128), "brick_red")


def openings(walls: Group) -> None:
    walls.cut((EAST, 144, 0), (EAST + 32, 240, 144))
    walls.cut((-480, 144, 0), (-448, 240, 144))
    walls.cut((FAR - 40, NORTH, 0), (FAR + 40, NORTH + 32, 112))
    walls.cut((EAST - 112, SOUTH - 32, -64), (EAST - 48, SOUTH, 16))
    for y in (64, 224, 384):
        walls.cut((WEST - 32, y - 48, 16), (WEST, y + 48, 128))


def furnish(world: Map) -> None:
    world.box((WEST, SOUTH, BED), (EAST, NORTH, LAVA), "*lava_a")
    part = world.detail
    ledge = {"all": "metal_rivet", "top": "metal_floor", "bottom": "metal_rust"}
    part.box((NEAR, SOUTH + 80, -32), (EAST, NORTH, 0), ledge)
    part.box((WEST, SOUTH, -32), (FAR, NORTH, 0), ledge)
    for x in (NEAR, FAR - 24):
        for y in (40, 216, 400):
            part.box((x, y, BED), (x + 24, y + 24, -32), "metal_rust")
    # Rails, open where the train stops and where the catwalk begins.
    for x in (NEAR, FAR - 6):
        for a, b in ((16, 128), (288, 424)):
            part.box((x, a, 34), (x + 6, b, 40), "metal_trim")
            for y in range(a, b, 48):
                part.box((x, y, 0), (x + 6, y + 6, 36), "metal_trim")
    crust(world)
    catwalk(world)
    train(world)
    mouths(world)
    # A crucible hangs over the lake, half full.
    world.add(hollow([(0, 30), (16, 52), (72, 64), (84, 68)], 6, Tex("metal_rust", align="face")), (-1016, 64, 120))
    part.cylinder((-1016, 64), 45, 120, 126, "metal_rust", sides=12)
    part.cylinder((-1016, 64), 55, 126, 178, "lab_light_warm", sides=12)
    for dx in (-62, 58):
        part.box((-1016 + dx, 62, 190), (-1012 + dx, 66, TOP), "metal_trim")
    part.box((WEST, 40, TOP - 40), (EAST, 88, TOP - 16), "metal_rivet")
    for y in (24, 480):
        world.add(pipe_run(-WEST + EAST, 12), (WEST, y if y > 100 else SOUTH + 16, 250))
    for x in (-704, -1336):
        for y in (120, 380):
            world.add(hanging_lamp(110, "lamp_round", 10), (x, y, TOP))
    part.arch((EAST, 144, 96), (EAST + 32, 240, 144), "metal_trim", axis="x")
    part.arch((-480, 144, 96), (-448, 240, 144), "metal_trim", axis="x")
    # The secret: down from the ledge's south end to a rock shelf, and into the cleft.
    part.box((EAST - 128, SOUTH, -96), (EAST, SOUTH + 80, -64), "rock_a")
    secret(world, (EAST - 112, SOUTH - 150, -64), (EAST - 16, SOUTH - 40, 0))
    # The corridor's trap: spikes out of a skull's mouth for those who come back, eastwards.
    part.box((-568, 232, 24), (-536, 240, 56), {"all": "metal_rust", "south": fit("skull_trim", (1, 1))})
    world.entity("trap_spikeshooter", (-552, 224, 40), angle=270, targetname="corridor_spikes", spawnflags=1)
    trigger(world, "multiple", (-620, 144, 0), (-600, 240, 96), angle=360, target="corridor_spikes", wait=1)


def crust(world: Map) -> None:
    """Cooled plates that float on the lake: the glow is what is between them."""
    chance = random.Random(21)
    for x in range(FAR + 8, NEAR - 8, 80):
        for y in range(SOUTH + 8, NORTH - 8, 80):
            if chance.random() < 0.25:
                continue
            a, b = x + chance.randint(0, 14), y + chance.randint(0, 14)
            c, d = x + chance.randint(58, 78), y + chance.randint(58, 78)
            cut = [chance.randint(6, 18) for _ in range(4)]
            plate = [(a + cut[0], b), (c - cut[1], b), (c, b + cut[1]), (c, d - cut[2]), (c - cut[2], d), (a + cut[3], d),
                     (a, d - cut[3]), (a, b + cut[0])]
            world.detail.prism(plate, LAVA - 24, LAVA + chance.choice((2, 3, 5)), "rock_b")


def catwalk(world: Map) -> None:
    """Along the north wall, closed by a gate that the far button opens."""
    part = world.detail
    part.box((FAR, 456, -16), (NEAR, NORTH, 0), {"all": "metal_trim", "top": "metal_floor"})
    part.box((FAR, 456, 34), (NEAR, 460, 40), "metal_trim")
    for k in range(11):
        part.box((FAR + 48 * k, 456, 0), (FAR + 48 * k + 4, 460, 36), "metal_trim")
    gate = world.part("func_door", angle=-1, targetname="catwalk_gate", lip=8, speed=80, sounds=2, wait=-1,
                      message="Closed from the far side")
    gate.box((NEAR - 16, 460, 0), (NEAR - 4, NORTH, 112), fit("steel_door"))
    part.box((NEAR - 20, 444, 0), (NEAR, 460, 128), "metal_rivet")
    part.box((NEAR - 20, 444, 112), (NEAR, NORTH, 136), "metal_rivet")
    button = world.part("func_button", angle=180, target="catwalk_gate", speed=40, wait=-1, lip=2, sounds=0,
                        message="The catwalk's gate is open")
    button.box((WEST, 468, 40), (WEST + 8, 500, 72), {"all": "metal_trim", "east": fit("+0button")})
    part.box((WEST, 460, 32), (WEST + 4, 508, 40), "copper_trim")
    part.box((WEST, 460, 72), (WEST + 4, 508, 80), "copper_trim")


def train(world: Map) -> None:
    """A platform that goes to and fro over the lava; it waits at both ends."""
    body = world.part("func_train", target="lake_near", speed=90, sounds=1, dmg=0)
    x, y = NEAR - 104, 160
    body.box((x, y, -20), (x + 96, y + 96, 0), {"all": "metal_rust", "top": fit("metal_floor")})
    for a in (0, 88):
        body.box((x + a, y, 0), (x + a + 8, y + 8, 30), "metal_trim")
        body.box((x + a, y + 88, 0), (x + a + 8, y + 96, 30), "metal_trim")
    # A train's corner comes to the corners of its way.
    world.entity("path_corner", (x, y, -20), targetname="lake_near", target="lake_far", wait=4)
    world.entity("path_corner", (FAR + 8, y, -20), targetname="lake_far", target="lake_near", wait=4)


def mouths(world: Map) -> None:
    for y in (64, 224, 384):
        world.box((WEST - 96, y - 48, 16), (WEST - 4, y + 48, 40), "*lava_a")
        part = world.detail
        part.box((WEST - 20, y - 48, 16), (WEST, y + 48, 44), "brick_red")
        part.arch((WEST - 32, y - 48, 84), (WEST, y + 48, 128), "brick_red", axis="x", segments=8)
        for a in (-30, 0, 30):
            part.box((WEST - 10, y + a - 2, 44), (WEST - 6, y + a + 2, 124), "metal_rust")
        for a in (-64, 48):
            part.box((WEST, y + a, 0), (WEST + 14, y + a + 16, 144), "metal_rivet")
        part.box((WEST, y - 64, 128), (WEST + 16, y + 64, 148), "metal_trim")


def people(world: Map) -> None:
    world.entity("info_player_deathmatch", (-704, 460, 28), angle=225)
    world.entity("info_player_deathmatch", (-1336, 0, 28), angle=45)
    monster(world, "ogre", -1361, 330, 0, 0)
    monster(world, "ogre", -1320, 40, 0, 0, skill=1)
    monster(world, "enforcer", -700, 400, 0, 270)
    monster(world, "wizard", -1000, 300, 80, 0, skill=1)
    item(world, "weapon_nailgun", -704, 330, 0)
    item(world, "spikes", -704, 440, 0)
    item(world, "health", -680, 60, 0)
    item(world, "health", -1370, -30, 0)
    # The key, and who comes when it is gone.
    part = world.detail
    part.box((-1352, 196, 0), (-1304, 244, 14), {"all": "copper_plate", "top": fit("rune_a")})
    item(world, "key1", -1328, 220, 14, target="key_trap")
    door = world.part("func_door", angle=-2, targetname="key_trap", lip=4, speed=120, sounds=4, wait=-1)
    door.box((FAR - 40, NORTH + 4, 0), (FAR + 40, NORTH + 24, 112), "metal_rust")
    monster(world, "demon1", FAR, NORTH + 100, 0, 270)
    monster(world, "knight", FAR - 120, 40, 0, 0, skill=1)
    item(world, "artifact_super_damage", EAST - 64, SOUTH - 110, -64)
    item(world, "spikes", EAST - 96, SOUTH - 70, -64)
