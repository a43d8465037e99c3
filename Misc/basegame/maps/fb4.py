"""The fourth level, the machine: the Engine. The power's button lights the hall, sets the crane going and puts the bridge out; the
way goes under three hammers, over the bridge, up by the lift, along the hall on the crane, to the button of the rune's door."""

from __future__ import annotations

import math

from kit import Group, Map, Tex, fit
from passages import arrival, way_out
from people import item, monster, secret, trigger
from pieces import crates, hanging_lamp, hollow, pipe_run

X, SOUTH, NORTH, TOP, BED, LAVA = 448, -512, 704, 416, -224, -152
NEAR, GAP, FAR = -256, 192, 320  # the near platform's edge, where the catwalk ends, the far platform's edge
GALLERY, DEEP = 192, 128  # height of the gallery and the balcony, depth of the gallery
HAMMERS = (-168, -24, 120)
MOUTHS = (-96, 96)  # y of the fires in the side walls
POWER = 32  # the light style of the hall's lamps


def rooms(walls: Group) -> None:
    walls.room((-96, -848, 0), (96, SOUTH - 32, 176), {"side": "steel_wall", "bottom": "metal_floor", "top": "metal_plate"}, wall=32)
    walls.room((-X, SOUTH, BED), (X, NORTH, TOP), {"side": "metal_rivet", "bottom": "rock_b", "top": "metal_rust"}, wall=32)
    walls.room((-832, -480, 0), (-X - 32, -320, 144), {"side": "steel_wall", "bottom": "metal_floor", "top": "metal_plate"}, wall=32)
    walls.room((X + 32, -480, 0), (X + 160, -352, 96), {"side": "metal_rust", "bottom": "metal_floor", "top": "metal_rust"}, wall=32)
    for side in (-1, 1):
        for y in MOUTHS:
            a, b = sorted((side * (X + 32), side * (X + 104)))
            walls.room((a, y - 56, 0), (b, y + 56, 128), "brick_red")
    walls.room((-192, NORTH + 32, 0), (192, 1120, 256), {"side": "copper_plate", "bottom": "metal_floor", "top": "metal_rust"}, wall=32)
    walls.room((-64, 1152, 0), (64, 1280, 160), {"side": "copper_plate", "bottom": "metal_floor", "top": "metal_plate"}, wall=32)


def openings(walls: Group) -> None:
    walls.cut((-64, SOUTH - 32, 0), (64, SOUTH, 144))
    walls.cut((-X - 32, -448, 0), (-X, -352, 128))
    walls.cut((X, -456, 0), (X + 32, -376, 80))
    for side in (-1, 1):
        for y in MOUTHS:
            a, b = sorted((side * X, side * (X + 32)))
            walls.cut((a, y - 56, 0), (b, y + 56, 128))
    walls.cut((-64, NORTH, 0), (64, NORTH + 32, 144))
    walls.cut((-64, 1120, 0), (64, 1152, 160))


def hall(world: Map) -> None:
    part = world.detail
    world.box((-X, SOUTH, BED), (X, NORTH, LAVA), "*lava_a")
    plate = {"all": "metal_rivet", "top": "metal_floor", "bottom": "metal_rust"}
    part.box((-X, SOUTH, -32), (X, NEAR, 0), plate)
    part.box((-X, FAR, -32), (X, NORTH, 0), plate)
    part.box((-48, NEAR, -16), (48, GAP, 0), {"all": "metal_trim", "top": "metal_floor"})
    for x in (-400, -160, 144, 384):
        for y in (NEAR - 24, FAR):
            part.box((x, y, BED), (x + 24, y + 24, -32), "metal_rust")
    for y in range(NEAR + 40, GAP, 96):
        part.box((-40, y, BED), (-24, y + 16, -16), "metal_rust")
        part.box((24, y, BED), (40, y + 16, -16), "metal_rust")
    for side in (-1, 1):
        for y, z0, z1 in ((NEAR - 6, 0, 40), (FAR, 0, 40)):
            a, b = sorted((side * 64, side * (X - 112)))
            part.box((a, y, 34), (b, y + 6, 40), "metal_trim")
            for x in range(64, X - 112, 68):
                part.box((side * x, y, 0), (side * x + 6, y + 6, 36), "metal_trim")
    # Gallery and balcony.
    part.box((-X, NORTH - DEEP, GALLERY - 16), (X, NORTH, GALLERY), plate)
    part.box((-X, SOUTH, GALLERY - 16), (-64, SOUTH + 96, GALLERY), plate)
    for x in (-420, -110, 110, 400):
        part.box((x, NORTH - DEEP + 8, 0), (x + 20, NORTH - DEEP + 28, GALLERY - 16), "metal_rivet")
    part.box((-84, SOUTH + 72, 0), (-64, SOUTH + 92, GALLERY - 16), "metal_rivet")
    fires(world)
    ribs(world)
    hammers(world)
    bridge(world)
    crane(world)
    part.arch((-64, SOUTH - 32, 96), (64, SOUTH, 144), "metal_trim", axis="y")
    for x in (-140, 300):  # beside the crane's way
        world.add(hanging_lamp(130, "lamp_round", 11), (x, -370, TOP - 40))
    for x in (-240, 360):
        world.add(hanging_lamp(70, "lamp_round", 10), (x, 640, TOP - 40))
    for x in (-720, -580):
        world.add(hanging_lamp(20, "light_white", 9), (x, -400, 144))
    world.add(hanging_lamp(24, "lamp_round", 9), (0, -620, 176))
    world.add(crates(41), (380, -320, 0))
    world.add(crates(42), (-390, 650, 0))
    world.add(crates(43), (60, -800, 0))


def fires(world: Map) -> None:
    part = world.detail
    for side in (-1, 1):
        for y in MOUTHS:
            a, b = sorted((side * (X + 8), side * (X + 104)))
            world.box((a, y - 56, 0), (b, y + 56, 28), "*lava_a")
            a, b = sorted((side * X, side * (X + 14)))
            part.box((a, y - 56, 0), (b, y + 56, 34), "brick_dark")
            a, b = sorted((side * X, side * (X + 32)))
            part.arch((a, y - 56, 76), (b, y + 56, 128), "brick_red", axis="x", segments=8)
            a, b = sorted((side * (X + 6), side * (X + 10)))
            for k in range(-2, 3):
                part.box((a, y + 20 * k - 2, 34), (b, y + 20 * k + 2, 124), "metal_rust")
            a, b = sorted((side * (X - 16), side * X))
            for edge in (-72, 56):
                part.box((a, y + edge, -24), (b, y + edge + 16, 148), "metal_trim")
            part.box((a, y - 76, 148), (b, y + 76, 164), "copper_trim")


def ribs(world: Map) -> None:
    """Frames across the hall, lamps between them that the power lights, gears and pipes on the walls."""
    part = world.detail
    for y in (-448, -320, -208, 48, 208, 400, 528):
        part.box((-X, y - 10, TOP - 40), (X, y + 10, TOP), "metal_rivet")
        for side in (-1, 1):
            a, b = sorted((side * X, side * (X - 90)))
            part.prism([(side * X, TOP - 130), (side * (X - 90), TOP - 40), (side * X, TOP - 40)], y - 8, y + 8, "metal_rust", axis="y")
    for z in (300, 330):
        world.add(pipe_run(NORTH - SOUTH, 10, "copper_plate"), (X - 14, SOUTH, z), turn=90)
    for x, y, r in ((-X + 16, 330, 110), (-X + 16, 480, 56), (X - 16, 420, 90), (X - 16, 280, 60)):
        gear(world, x, y, 140, r)
    # Lamps under the frames: what a switch lights, with a picture that shows it.
    for y in (-384, -80, 128, 464):
        for x in (-224, 224):
            part.box((x - 40, y - 12, TOP - 60), (x + 40, y + 12, TOP - 44), "metal_trim")
            part.box((x - 3, y - 3, TOP - 44), (x + 3, y + 3, TOP), "metal_rust")
            world.entity("light", (x, y, TOP - 76), light=700, delay=2, _color=(255, 236, 200), style=POWER, targetname="power",
                         spawnflags=1)
    # Red ones that burn always, and a tube about to fail over the entry.
    for x in (-X, X - 8):
        for y in (-480, -290, 350, 560):
            part.box((x, y - 8, 96), (x + 8, y + 8, 120), {"all": "metal_trim", "east": fit("light_red"), "west": fit("light_red")})
    for x, y, z in ((0, -470, 220), (-640, -400, 130), (0, -700, 160)):
        world.entity("light", (x, y, z), light=220, delay=2, _color=(190, 225, 255), style=10)
        part.box((x - 40, y - 6, z + 8), (x + 40, y + 6, z + 14), "metal_trim")


def gear(world: Map, x: float, y: float, z: float, radius: float) -> None:
    part = world.detail
    side = 1 if x < 0 else -1
    a, b = sorted((x - side * 10, x + side * 6))
    part.ring((y, z), radius * 0.7, radius, a, b, "metal_rust", sides=16, axis="x")
    part.cylinder((y, z), radius * 0.2, a - 2, b + 2, "copper_plate", sides=8, axis="x")
    for k in range(4):
        angle = math.radians(20 + 45 * k)
        c, s, w, r = math.cos(angle), math.sin(angle), radius * 0.06, radius * 0.75
        spoke = [(r * c - w * s, r * s + w * c), (-r * c - w * s, -r * s + w * c), (-r * c + w * s, -r * s - w * c), (r * c + w * s, r * s - w * c)]
        part.prism([(round(4 * (y + p)) / 4, round(4 * (z + q)) / 4) for p, q in spoke], a + 2, b - 2, "metal_trim", axis="x")
    for k in range(12):
        angle = math.radians(30 * k + 15)
        c, s, w = math.cos(angle), math.sin(angle), radius * 0.09
        r0, r1 = radius * 0.95, radius * 1.12
        tooth = [(r0 * c - w * s, r0 * s + w * c), (r1 * c - w * s * 0.6, r1 * s + w * c * 0.6), (r1 * c + w * s * 0.6, r1 * s - w * c * 0.6),
                 (r0 * c + w * s, r0 * s - w * c)]
        part.prism([(round(4 * (y + p)) / 4, round(4 * (z + q)) / 4) for p, q in tooth], a, b, "metal_rust", axis="x")


def hammers(world: Map) -> None:
    """They fall on the catwalk one after another."""
    part = world.detail
    for k, y in enumerate(HAMMERS):
        head = world.part("func_train", target=f"hammer{k}_up", speed=260, dmg=15, sounds=0)
        head.box((-44, y, 132), (44, y + 56, 168), {"all": "metal_plate", "bottom": fit("metal_rust")})
        head.cylinder((0, y + 28), 16, 168, 400, "metal_trim", sides=8)
        # One that begins a little later than the last.
        world.entity("path_corner", (-44, y, 132), targetname=f"hammer{k}_up", target=f"hammer{k}_down", wait=1.2 + 0.3 * k)
        world.entity("path_corner", (-44, y, 4), targetname=f"hammer{k}_down", target=f"hammer{k}_up", wait=0.4)
        for side in (-1, 1):
            a, b = sorted((side * 60, side * 76))
            part.box((a, y + 12, -16), (b, y + 44, TOP), "metal_rivet")
            a, b = sorted((side * 48, side * 60))
            part.box((a, y + 16, -16), (b, y + 40, -4), "metal_rivet")
            a, b = sorted((side * 59, side * 61))
            part.box((a, y + 20, 60), (b, y + 36, 76), {"all": "metal_trim", "east": fit("light_red"), "west": fit("light_red")})
        part.box((-76, y + 4, 320), (76, y + 52, TOP), {"all": "metal_rivet", "bottom": "metal_rust"})


def bridge(world: Map) -> None:
    """Within the far platform until the power's button is pressed; the door of the rune; the buttons."""
    part = world.detail
    span = world.part("func_door", angle=270, targetname="power", lip=8, speed=70, sounds=2, wait=-1)
    span.box((-44, FAR + 1, -20), (44, FAR + 137, -3), {"all": "metal_trim", "top": fit("metal_floor", (1, 2))})
    press = world.part("func_button", angle=180, target="power", speed=40, wait=-1, lip=2, sounds=3, message="The engine has its power")
    press.box((-832, -416, 40), (-824, -384, 72), {"all": "metal_trim", "east": fit("+0button")})
    part.box((-832, -424, 28), (-827, -376, 40), "copper_trim")
    part.box((-832, -424, 72), (-827, -376, 84), "copper_trim")
    for y in (-462, -340):
        part.box((-832, y - 14, 20), (-812, y + 14, 110), {"all": "steel_wall", "east": fit("rune_a", (1, 2))})
    for x in (-760, -680, -600):
        part.box((x, -480, 100), (x + 48, -474, 112), {"all": "metal_trim", "north": fit("light_strip")})
    part.box((-700, -336, 0), (-560, -320, 96), "metal_plate")
    part.box((-690, -338, 40), (-570, -336, 84), fit("light_green", (4, 1)))
    part.arch((-X - 32, -448, 88), (-X, -352, 128), "metal_trim", axis="x")
    door = world.part("func_door", angle=-1, targetname="rune_door", speed=80, lip=8, sounds=2, wait=-1,
                      message="The button is on the balcony at the hall's other end")
    door.box((-64, NORTH + 8, 0), (64, NORTH + 24, 144), fit("door_iron"))
    for side in (-1, 1):
        a, b = sorted((side * 64, side * 84))
        part.box((a, NORTH - 12, 0), (b, NORTH, 160), {"all": "copper_plate", "south": fit("rune_a", (1, 5))})
    second = world.part("func_button", angle=270, target="rune_door", speed=40, wait=-1, lip=2, sounds=3, message="The rune's door is open")
    z = GALLERY + 40
    second.box((-304, SOUTH, z), (-272, SOUTH + 8, z + 32), {"all": "metal_trim", "north": fit("+0button")})
    part.box((-312, SOUTH, z - 12), (-264, SOUTH + 5, z), "copper_trim")
    part.box((-312, SOUTH, z + 32), (-264, SOUTH + 5, z + 44), "copper_trim")
    lift = world.part("func_plat", height=GALLERY, speed=130, sounds=2)
    lift.box((240, NORTH - DEEP - 96, GALLERY - 16), (336, NORTH - DEEP, GALLERY), {"all": "metal_trim", "top": fit("metal_floor")})
    # The secret, behind a plate that a shot opens.
    slab = world.part("func_door", angle=-2, health=1, wait=-1, lip=4, speed=60, sounds=2)
    slab.box((X + 6, -456, 0), (X + 22, -376, 80), fit("metal_plate"))
    part.box((X - 6, -460, 80), (X, -372, 88), "copper_trim")
    secret(world, (X + 40, -470, 0), (X + 150, -360, 80))
    part.cylinder((X + 148, -364), 8, 0, 26, "crystal_gold", sides=6, top_radius=3)


def crane(world: Map) -> None:
    """Two that go along the hall: a platform that carries players once there is power, and a crucible of light that always does."""
    x = -336
    body = world.part("func_train", targetname="power", target="crane_north", speed=110, sounds=1, dmg=0)
    body.box((x, 472, GALLERY - 16), (x + 96, 568, GALLERY), {"all": "metal_rust", "top": fit("metal_floor")})
    for a in (0, 88):
        for b in (0, 88):
            body.box((x + a, 472 + b, GALLERY), (x + a + 8, 480 + b, GALLERY + 30), "metal_trim")
            body.box((x + a + 2, 474 + b, GALLERY + 30), (x + a + 6, 478 + b, TOP - 44), "metal_rust")
    world.entity("path_corner", (x, 476, GALLERY - 16), targetname="crane_north", target="crane_south", wait=5)
    world.entity("path_corner", (x, SOUTH + 100, GALLERY - 16), targetname="crane_south", target="crane_north", wait=5)
    pot = world.part("func_train", target="pot_south", speed=60, sounds=0, dmg=0)
    bowl = hollow([(0, 26), (14, 44), (60, 54), (70, 58)], 6, Tex("metal_rust", align="face"))
    for brush in bowl.detail.brushes:
        pot.brush(_moved(brush, (232, 0, 120)))
    pot.cylinder((232, 0), 38, 120, 126, "metal_rust", sides=12)
    pot.cylinder((232, 0), 47, 126, 170, "lab_light_warm", sides=12)
    for dx in (-52, 48):
        pot.box((232 + dx, -2, 184), (236 + dx, 2, TOP - 44), "metal_trim")
    world.entity("path_corner", (174, -190, 120), targetname="pot_south", target="pot_north", wait=2)
    world.entity("path_corner", (174, 330, 120), targetname="pot_north", target="pot_south", wait=2)
    for a in (x + 4, x + 84, 178, 278):
        world.detail.box((a, SOUTH, TOP - 44), (a + 8, NORTH, TOP - 40), "metal_trim")


def _moved(brush, at):
    from kit.brush import transformed

    return transformed(brush, 0, False, at)


def end(world: Map) -> None:
    """The rune's room between two fires."""
    part = world.detail
    for side in (-1, 1):
        for y in (820, 980):
            a, b = sorted((side * 192, side * 168))
            part.box((a, y - 8, 0), (b, y + 8, 256), "metal_rivet")
        part.cylinder((side * 140, 900), 34, 0, 30, "metal_rust", sides=10, top_radius=40)
        part.cylinder((side * 140, 900), 30, 30, 34, "*lava_a", sides=10)
        a, b = sorted((side * 64, side * 84))
        part.box((a, 1106, 0), (b, 1120, 164), {"all": "copper_plate", "south": fit("rune_b", (1, 5))})
        world.entity("light_flame_large_yellow", (side * 140, 900, 40))
    part.box((-88, 1104, 164), (88, 1120, 180), "copper_trim")
    part.arch((-192, NORTH + 32, 160), (192, 1120, 256), Tex("metal_rust", align="face"), axis="y", segments=8)
    world.add(way_out(8), (0, 1232, 0))


def people(world: Map) -> None:
    arrival(world, 0, -752, 0, "The Engine")
    world.entity("info_intermission", (-400, -240, 330), mangle=(24, 52, 0))
    for x, y, z, angle in ((-300, -320, 0, 45), (380, 600, 0, 225), (0, 650, GALLERY, 270), (-600, -420, 0, 0)):
        world.entity("info_player_deathmatch", (x, y, z + 28), angle=angle)
    monster(world, "army", 300, -320, 0, 180)
    monster(world, "enforcer", -700, -360, 0, 0)
    monster(world, "army", -560, -440, 0, 0, skill=1)
    monster(world, "ogre", 200, 400, 0, 270)
    monster(world, "ogre", -220, 440, 0, 270, skill=1)
    monster(world, "enforcer", 60, 640, GALLERY, 180)
    monster(world, "enforcer", -380, 640, GALLERY, 0, skill=1)
    monster(world, "shambler", -100, 510, 0, 270, skill=2)
    monster(world, "army", -130, -460, GALLERY, 180)
    monster(world, "hell_knight", -60, 1000, 0, 270)
    monster(world, "tarbaby", 90, 860, 0, 270, skill=1)
    item(world, "shells", -400, -480, 0)
    item(world, "weapon_supershotgun", 400, -280, 0)
    item(world, "health", 300, -480, 0)
    item(world, "spikes", -780, -350, 0)
    item(world, "weapon_nailgun", -640, -440, 0)
    item(world, "health", -540, -350, 0)
    item(world, "spikes", 400, 400, 0)
    item(world, "health", -400, 400, 0)
    item(world, "health", 400, 660, GALLERY)
    item(world, "shells", -400, 600, 0)
    item(world, "armor1", 200, 660, GALLERY)
    item(world, "spikes", -200, -450, GALLERY)
    item(world, "weapon_rocketlauncher", X + 96, -420, 0)
    item(world, "rockets", X + 130, -440, 0)
    item(world, "artifact_super_damage", X + 70, -400, 0)
    item(world, "health", 150, 1080, 0)


def build() -> Map:
    world = Map("The Engine", sounds=3, worldtype=0, _minlight=20, fog="0.035 0.45 0.36 0.3")
    walls = Group()
    rooms(walls)
    openings(walls)
    world.add(walls)
    for part in (hall, end, people):
        part(world)
    return world
