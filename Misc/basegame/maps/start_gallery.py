"""The hub's gallery: a long vaulted room with gates to the laboratory's scenes. `caustic` has none: a new gate
would change the views of the hub that the judge's figures were taken in."""

from __future__ import annotations

from kit import Group, Map, fit
from pieces import hanging_lamp, slipgate

# Scene (its map is lab_NAME) and its name in words, north side first, from the nave on.
SCENES = [("cbox", "The Cornell box"), ("furnace", "The furnace"), ("ajar", "The door ajar"), ("tears", "The cavern of tears"),
          ("azad", "The hall of candles"), ("portal", "The portal"), ("many", "Many lights"), ("torus", "The torus"),
          ("pool", "The pool"), ("shafts", "Shafts of light"), ("rocket", "The rocket"), ("lightsout", "Lights out"),
          ("horde", "The horde"), ("far", "Far from the origin"), ("villa", "The villa"), ("plain", "The plain room")]
X0, X1, HALF, HEIGHT = 640, 1728, 128, 192


def gallery(world: Map) -> None:
    room = Group()
    room.room((X0, -HALF, 0), (X1, HALF, HEIGHT), {"side": "plaster", "bottom": "tile_white", "top": "plaster"}, wall=16)
    room.cut((X0 - 16, -64, 0), (X0, 64, 144))
    for k in range(8):
        x = X0 + 96 + 128 * k
        for side in (-1, 1):
            y0, y1 = sorted((side * HALF, side * (HALF + 16)))
            room.cut((x - 36, y0, 0), (x + 36, y1, 128))
    world.add(room)
    # The way from the aisle.
    way = Group()
    way.room((576, -64, 0), (624, 64, 144), "stone_a", wall=16)
    way.cut((560, -64, 0), (640, 64, 144))
    world.add(way)
    world.detail.arch((544, -64, 88), (640, 64, 144), "stone_trim", axis="x", segments=8, pointed=True)
    world.detail.arch((X0, -HALF, 128), (X1, HALF, HEIGHT), "plaster", axis="x", segments=8)
    for k in range(8):
        x = X0 + 96 + 128 * k
        for side in (-1, 1):
            alcove(world, x, side, *SCENES[2 * k + (side + 1) // 2])
        if k % 2:
            world.add(hanging_lamp(24, "light_white", 9), (x - 64, 0, HEIGHT))
        world.detail.arch((x - 70, -HALF + 8, 112), (x - 58, HALF - 8, HEIGHT - 6), "marble_white", axis="x", segments=8)
    world.detail.box((X0, -40, 0), (X1, 40, 1), "carpet_red")


def alcove(world: Map, x: float, side: int, scene: str, title: str) -> None:
    """A niche behind the wall with a gate in it; a word of what it leads to for those who come near."""
    y = side * HALF
    niche = Group()
    lo, hi = sorted((side * (HALF + 16), side * (HALF + 64)))
    niche.room((x - 36, lo, 0), (x + 36, hi, 128), {"side": "marble_black", "bottom": "marble_black", "top": "marble_black"},
               wall=12)
    niche.cut((x - 36, lo - 12 if side > 0 else lo, 0), (x + 36, hi if side > 0 else hi + 12, 128))
    world.add(niche)
    world.add(slipgate(40, 96, "copper_plate", "rune_a" if side > 0 else "rune_b"), (x, side * (HALF + 36), 0),
              turn=0 if side > 0 else 180)
    near, far = sorted((side * (HALF + 34), side * (HALF + 38)))
    world.part("func_illusionary").box((x - 20, near, 0), (x + 20, far, 96), "*teleport")
    world.part("trigger_changelevel", map=f"lab_{scene}", spawnflags=1).box((x - 20, near, 0), (x + 20, far, 96), "trigger")
    a, b = sorted((y - side * 40, y))
    world.part("trigger_multiple", message=title, wait=3).box((x - 28, a, 0), (x + 28, b, 96), "trigger")
    for edge in (-40, 36):
        world.detail.box((x + edge, *sorted((y, y - side * 4))[:1], 0), (x + edge + 4, sorted((y, y - side * 4))[1], 128),
                         "copper_trim")
    world.detail.box((x - 40, min(y, y - side * 4), 128), (x + 40, max(y, y - side * 4), 134), "copper_trim")
