"""The spawn: tar that swallowed a sea mine. It rolls and leaps on its own weight, and goes off."""

from __future__ import annotations

import numpy as np

from formats.mdl import Mdl
from models.conventions import frame_names, lengths
from models.kit.cast import sequence_clips
from models.kit.figure import build
from models.kit.motion import Clip, cycle, joined, keyed
from models.kit.noise import fbm
from models.kit.paint import band, copper, glow, iron, layers, plain, rivets
from models.kit.shapes import Patch, ellipsoid, lathe, tube
from models.kit.skeleton import Posing, Skeleton
from models.kit.turn import euler

RADIUS = 13.0
GROUND = -24.0
REST = {"size": (1, 1, 1), "lift": (0,), "lean": (0, 0, 0), "roll": (0,), "swell": (1,)}
TAR = layers(
    plain("mauve", 0.28, 0.12, 5.0, 151, gloss=0.8), (lambda s: s.noise(4.0, 152, 3) > 0.66, plain("blue", 0.3, 0.12, 3.0, gloss=0.8))
)


def _patches() -> list[Patch]:
    centre = np.array([0.0, 0.0, GROUND + RADIUS])
    crack = lambda s: np.abs(s.noise(9.0, 153, 2) - 0.5) < 0.022
    blob = ellipsoid(
        centre,
        (RADIUS,) * 3,
        layers(
            TAR,
            (crack, glow("fire", 0.5, 0.4, 4.0)),
            (lambda s: (np.abs(s.z - centre[2]) < 1.1), layers(iron(0.4, 0.4), (rivets(26, 26, 0.24), copper(0.1)))),
        ),
        "core",
        9,
        14,
    )
    lumps = (fbm(blob.grid + 60.0, 8.0, 2, 154) - 0.5)[..., None] * 4.5
    away = blob.grid - centre
    blob.grid = blob.grid + away / np.linalg.norm(away, axis=-1, keepdims=True) * lumps * (
        np.abs(blob.grid[..., 2:] - centre[2]) > 1.5
    )
    out = [blob]
    for i in range(11):
        z = 1 - (2 * i + 1) / 11
        a = i * np.pi * (3 - 5**0.5)
        d = np.array([np.cos(a) * np.sqrt(1 - z * z), np.sin(a) * np.sqrt(1 - z * z), z])
        out.append(
            lathe(
                [
                    (RADIUS - 1.5, 2.6),
                    (RADIUS + 0.4, 2.2),
                    (RADIUS + 0.8, 1.2),
                    (RADIUS + 3.2, 1.0),
                    (RADIUS + 3.6, 0.6),
                ],
                layers(copper(0.4, 2.0, 155 + i), (band("v", 0.86, 1.1), glow("red_glow", 0.6, 0.2))),
                "core",
                centre,
                d,
                7,
                np.cross(d, (0.4, 0.3, 0.9)),
                caps=(None, 0.4),
                detail=0.7,
            )
        )
    drips = [
        tube(
            [
                centre + [np.cos(a) * 9, np.sin(a) * 9, -9],
                centre + [np.cos(a) * 14.5, np.sin(a) * 14.5, -11.8],
                centre + [np.cos(a) * 19, np.sin(a) * 19, -12.6],
            ],
            [2.6, 1.5, 0.4],
            TAR,
            "drips",
            6,
            up=(0, 0, 1),
            detail=0.6,
        )
        for a in np.radians([20, 95, 150, 215, 280, 330])
    ]
    return out + drips


def _pose(c: Clip) -> Posing:
    s = Skeleton(
        {"root": ("", (0, 0, 0)), "core": ("root", (0, 0, GROUND + RADIUS)), "drips": ("root", (0, 0, GROUND))}
    )
    p = Posing(s, len(c["lift"]))
    size, swell = c["size"], c["swell"]
    lean = euler(c["lean"])
    roll = euler(np.concatenate([c["roll"], np.zeros((p.frames, 2))], axis=1))
    stretch = lean * size[:, None, :] @ np.swapaxes(lean, -1, -2)
    height = RADIUS * size[:, 2] * swell[:, 0] + c["lift"][:, 0]
    p.place(
        "core",
        stretch @ roll * swell[:, :, None],
        np.stack([np.zeros(p.frames), np.zeros(p.frames), GROUND + height], axis=1),
    )
    grounded = np.clip(1.0 - c["lift"][:, 0] / 8.0, 0.12, 1.0)
    p.place(
        "drips",
        np.eye(3) * (grounded * size[:, 0])[:, None, None],
        np.stack([np.zeros(p.frames), np.zeros(p.frames), GROUND + c["lift"][:, 0]], axis=1),
    )
    return p


def _roll(count: int, turns: float, squash: float, hops: int) -> Clip:
    t = cycle(count)
    wave = np.sin(2 * np.pi * hops * t)
    size = np.stack([1 - 0.5 * squash * wave, 1 - 0.5 * squash * wave, 1 + squash * wave], axis=1)
    return {"size": size, "roll": (t * 360.0 * turns)[:, None], "lift": np.clip(wave, 0, 1)[:, None] * squash * 12.0}


def _clips() -> dict[str, Clip]:
    n = lengths("tarbaby")
    j, f = n["jump"], n["fly"]
    jump = keyed(
        j,
        {
            0: {"size": (1.12, 1.12, 0.8), "lift": 0},
            j * 0.35: {"size": (1.25, 1.25, 0.6), "lean": (14, 0, 0)},
            j * 0.65: {"size": (0.82, 0.82, 1.4), "lift": 3, "lean": (28, 0, 0)},
            j - 1: {"size": (0.9, 0.9, 1.2), "lift": 8, "lean": (34, 0, 0)},
        },
    )
    fly = keyed(
        f,
        {
            0: {"size": (1.0, 0.92, 1.08), "lift": 8.0, "roll": 0},
            1: {"size": (1.1, 0.96, 0.96), "roll": 90},
            2: {"size": (1.0, 0.92, 1.08), "roll": 180},
            3: {"size": (0.94, 0.96, 1.1), "roll": 270},
        },
    )
    return {
        "walk": _roll(n["walk"], 1.0, 0.1, 2),
        "run": _roll(n["run"], 2.0, 0.2, 3),
        "jump": jump,
        "fly": fly,
        "exp": {"swell": np.full((1, 1), 1.35), "lift": np.full((1, 1), 2.0)},
    }


def tarbaby() -> Mdl:
    return build(
        _patches(),
        _pose(joined(REST, sequence_clips("tarbaby", _clips()))),
        frame_names("tarbaby"),
        skin=(256, 160),
        floor=GROUND + 0.1,
    )


MODELS = {"tarbaby": tarbaby}
