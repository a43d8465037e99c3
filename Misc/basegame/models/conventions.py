"""What Quake's mods and levels expect of each animated model: its frames by name and number, in order."""

from __future__ import annotations

# Model -> (sequence, frames) in order; a frame's name is its sequence's name and a number from 1.
SEQUENCES: dict[str, list[tuple[str, int]]] = {
    "player": [
        ("axrun", 6),
        ("rockrun", 6),
        ("stand", 5),
        ("axstnd", 12),
        ("axpain", 6),
        ("pain", 6),
        ("axdeth", 9),
        ("deatha", 11),
        ("deathb", 9),
        ("deathc", 15),
        ("deathd", 9),
        ("deathe", 9),
        ("nailatt", 2),
        ("light", 2),
        ("rockatt", 6),
        ("shotatt", 6),
        ("axatt", 6),
        ("axattb", 6),
        ("axattc", 6),
        ("axattd", 6),
    ],
    "soldier": [
        ("stand", 8),
        ("death", 10),
        ("deathc", 11),
        ("load", 11),
        ("pain", 6),
        ("painb", 14),
        ("painc", 13),
        ("run", 8),
        ("shoot", 9),
        ("prowl_", 24),
    ],
    "dog": [
        ("attack", 8),
        ("death", 9),
        ("deathb", 9),
        ("pain", 6),
        ("painb", 16),
        ("run", 12),
        ("leap", 9),
        ("stand", 9),
        ("walk", 8),
    ],
    "ogre": [
        ("stand", 9),
        ("walk", 16),
        ("run", 8),
        ("swing", 14),
        ("smash", 14),
        ("shoot", 6),
        ("pain", 5),
        ("painb", 3),
        ("painc", 6),
        ("paind", 16),
        ("paine", 15),
        ("death", 14),
        ("bdeath", 10),
        ("pull", 11),
    ],
    "knight": [
        ("stand", 9),
        ("runb", 8),
        ("runattack", 11),
        ("pain", 3),
        ("painb", 11),
        ("attackb", 11),
        ("walk", 14),
        ("kneel", 5),
        ("standing", 4),
        ("death", 10),
        ("deathb", 11),
    ],
    "hknight": [
        ("stand", 9),
        ("walk", 20),
        ("run", 8),
        ("pain", 5),
        ("death", 12),
        ("deathb", 9),
        ("char_a", 16),
        ("magica", 14),
        ("magicb", 13),
        ("char_b", 6),
        ("slice", 10),
        ("smash", 11),
        ("w_attack", 22),
        ("magicc", 11),
    ],
    "wizard": [("hover", 15), ("fly", 14), ("magatt", 13), ("pain", 4), ("death", 8)],
    "demon": [("stand", 13), ("walk", 8), ("run", 6), ("leap", 12), ("pain", 6), ("death", 9), ("attacka", 15)],
    "shambler": [
        ("stand", 17),
        ("walk", 12),
        ("run", 6),
        ("smash", 12),
        ("swingr", 9),
        ("swingl", 9),
        ("magic", 12),
        ("pain", 6),
        ("death", 11),
    ],
    "zombie": [
        ("stand", 15),
        ("walk", 19),
        ("run", 18),
        ("atta", 13),
        ("attb", 14),
        ("attc", 12),
        ("paina", 12),
        ("painb", 28),
        ("painc", 18),
        ("paind", 13),
        ("paine", 30),
        ("cruc_", 6),
    ],
    "tarbaby": [("walk", 25), ("run", 25), ("jump", 6), ("fly", 4), ("exp", 1)],
    "shalrath": [("attack", 11), ("pain", 5), ("death", 7), ("walk", 12)],
    "fish": [("attack", 18), ("death", 21), ("swim", 18), ("pain", 9), ("base", 1)],
    "enforcer": [
        ("stand", 7),
        ("walk", 16),
        ("run", 8),
        ("attack", 10),
        ("death", 14),
        ("fdeath", 11),
        ("paina", 4),
        ("painb", 5),
        ("painc", 8),
        ("paind", 19),
    ],
    "boss": [("rise", 17), ("walk", 31), ("death", 9), ("attack", 23), ("shocka", 10), ("shockb", 6), ("shockc", 10)],
    "oldone": [("old", 46), ("shake", 21)],
    "v_axe": [("frame", 9)],
    "v_shot": [("frame", 8)],
    "v_shot2": [("frame", 8)],
    "v_nail": [("frame", 9)],
    "v_nail2": [("frame", 9)],
    "v_rock": [("frame", 8)],
    "v_rock2": [("frame", 7)],
    "v_light": [("frame", 5)],
    "s_light": [("frame", 19)],
    "w_spike": [("frame", 4)],
}


def frame_names(model: str) -> list[str]:
    """Names of a model's frames in order; one frame for what does not move."""
    return [f"{name}{i + 1}" for name, count in SEQUENCES.get(model, [("frame", 1)]) for i in range(count)]


def lengths(model: str) -> dict[str, int]:
    """Sequence -> frames."""
    return dict(SEQUENCES[model])


# Trails and spin, by the header's bits: rocket 1, grenade 2, blood 4, turning 8, green tracer 16, less blood 32, orange
# tracer 64, violet tracer 128.
FLAGS: dict[str, int] = {
    **dict.fromkeys(
        [
            "armor",
            "backpack",
            "suit",
            "invisibl",
            "invulner",
            "quaddama",
            "end1",
            "end2",
            "end3",
            "end4",
            "b_s_key",
            "b_g_key",
            "m_s_key",
            "m_g_key",
            "w_s_key",
            "w_g_key",
            "g_shot",
            "g_shot1",
            "g_nail",
            "g_nail2",
            "g_rock",
            "g_rock2",
            "g_light",
        ],
        8,
    ),
    **dict.fromkeys(
        [
            "gib1",
            "gib2",
            "gib3",
            "h_demon",
            "h_dog",
            "h_guard",
            "h_hellkn",
            "h_knight",
            "h_mega",
            "h_ogre",
            "h_player",
            "h_shal",
            "h_shams",
            "h_wizard",
            "h_zombie",
        ],
        4,
    ),
    "missile": 1,
    "lavaball": 1,
    "grenade": 2,
    "w_spike": 16,
    "zom_gib": 32,
    "k_spike": 64,
    "v_spike": 128,
}
SKINS: dict[str, int] = {"armor": 3}
COLORED = ["player", "h_player"]  # drawn in a player's colours: rows 1 and 6 of the palette are his shirt and trousers
STILL = [
    "bolt",
    "bolt2",
    "bolt3",
    "eyes",
    "flame",
    "flame0",
    "laser",
    "s_spike",
    "spike",
    "teleport",
]  # one frame, no flags
GROUPS: dict[str, list[int]] = {
    "flame": [6],
    "flame0": [6],
    "flame2": [7, 7],
    "laser": [5],
}  # poses of each frame that plays by itself

# The hull that a standing model fills: half its width and its height above the ground, units.
HULLS: dict[str, tuple[float, float]] = {
    **dict.fromkeys(["player", "soldier", "knight", "zombie", "wizard", "fish", "tarbaby", "enforcer"], (16.0, 56.0)),
    "hknight": (16.0, 64.0),
    **dict.fromkeys(["ogre", "demon", "shambler", "shalrath"], (32.0, 88.0)),
    "dog": (32.0, 64.0),
}


def every_model() -> list[str]:
    """All names that Quake's game code may ask for."""
    return sorted(set(SEQUENCES) | set(FLAGS) | set(STILL) | set(GROUPS))
