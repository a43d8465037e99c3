"""What burns: lightning, torches and flames."""

from __future__ import annotations

import functools

import numpy as np

from formats.mdl import Frame, Mdl
from models.conventions import frame_names
from models.kit.figure import build
from models.kit.paint import glow, plain, wood
from models.kit.shapes import Patch, ellipsoid, lathe, tube
from models.kit.skeleton import Posing, Skeleton
from models.kit.turn import euler

X = (1.0, 0.0, 0.0)
UP = (0.0, 0.0, 1.0)


def bolt(thick: float, forks: int, seed: int, ramp: str = "blue_glow") -> Mdl:
    """A piece of lightning, 30 units long, that fits to its next: it begins and ends on the axis."""
    random = np.random.default_rng(seed)

    def zigzag(start, end, steps: int, spread: float) -> np.ndarray:
        points = np.linspace(start, end, steps)
        points[1:-1, 1:] += random.uniform(-spread, spread, (steps - 2, 2))
        points[1:-1, 0] += random.uniform(-1.0, 1.0, steps - 2)
        return points

    main = zigzag((0, 0, 0), (31, 0, 0), 9, 2.2 * thick)
    out = [
        tube(main, [0.5 * thick, *[0.75 * thick] * 7, 0.5 * thick], glow(ramp, 0.9, 0.2), sides=4, up=UP, caps=(0, 0))
    ]
    for _ in range(forks):
        start = main[random.integers(1, 6)]
        away = random.uniform(-1, 1, 3) * [0, 5, 5] * thick + [9, 0, 0]
        out.append(
            tube(
                zigzag(start, start + away, 4, 0.9 * thick),
                [0.4 * thick, 0.35 * thick, 0.25 * thick, 0.08 * thick],
                glow(ramp, 0.6, 0.3),
                sides=4,
                up=UP,
                caps=(0, 0),
            )
        )
    return build(out, None, ["frame1"], skin=(64, 48))


def s_light() -> Mdl:
    """Lightning gathering between a shambler's hands: arcs around a ball that swells and bursts."""
    n = 19
    ball = ellipsoid((0, 0, 0), (3.0, 3.0, 3.0), glow("white_glow", 0.8, 0.3), "ball", 4, 8)
    arcs = []
    for i in range(6):
        a = i * np.pi / 3.0
        d = np.array([0.3 * (-1) ** i, np.cos(a), np.sin(a)])
        side = np.cross(d, (1.0, 0.2, 0.1))
        arcs.append(
            tube(
                [d * 2, d * 6 + side * 2.5, d * 10 - side * 2.0, d * 15 + side],
                [0.9, 0.7, 0.5, 0.1],
                glow("blue_glow", 0.8, 0.3),
                f"arc{i % 2}",
                sides=4,
                up=X,
            )
        )
    skeleton = Skeleton(
        {"root": ("", (0, 0, 0)), "ball": ("root", (0, 0, 0)), "arc0": ("root", (0, 0, 0)), "arc1": ("root", (0, 0, 0))}
    )
    posing = Posing(skeleton, n)
    t = np.arange(n) / (n - 1)
    grow = np.where(t < 0.8, 0.3 + 1.2 * t, 1.3 * (1 - t) / 0.2 + 0.2)
    centre = np.repeat([[6.0, -16.0, 30.0]], n, axis=0)
    spin = lambda rate, size: euler(np.stack([t * 70.0, np.zeros(n), t * rate], axis=1)) * (grow * size)[:, None, None]
    flicker = 0.8 + 0.4 * (np.arange(n) % 2)
    posing.place("ball", spin(0, 1.0), centre)
    posing.place("arc0", spin(400, flicker), centre)
    posing.place("arc1", spin(-520, 1.9 - flicker), centre)
    return build([ball, *arcs], posing, frame_names("s_light"), skin=(64, 48))


def flame_body(
    base: float, height: float, radius: float, poses: int, seed: int, bone_name: str = "root", tongues: int = 5
) -> tuple[list[Patch], np.ndarray]:
    """Tongues of fire, and by how much each of their rings moves in every pose (tongues, rings, poses, 3)."""
    random = np.random.default_rng(seed)
    patches, shifts = [], []
    t = 2 * np.pi * np.arange(poses) / poses
    for i in range(tongues):
        a = 2 * np.pi * i / max(tongues - 1, 1)
        off = np.array([np.cos(a), np.sin(a), 0]) * radius * (0.0 if i == 0 else 0.5)
        tall = height * (1.0 if i == 0 else random.uniform(0.5, 0.75))
        wide = radius * (0.75 if i == 0 else 0.42)
        shares = np.array([0.0, 0.18, 0.42, 0.68, 0.88])
        path = [off * (1 - 0.6 * s) + [0, 0, base + tall * s] for s in shares]
        colour = lambda s, lo=base, hi=base + tall: s.ramp(
            "fire",
            1.0 - 0.62 * np.clip((s.z - lo) / (hi - lo), 0, 1) ** 1.3 + 0.25 * (s.noise(radius * 0.6, seed) - 0.5),
        )
        patches.append(
            tube(
                path,
                [wide * w for w in (0.55, 1.0, 0.8, 0.42, 0.14)],
                colour,
                bone_name,
                sides=6,
                caps=(wide * 0.3, tall * 0.12),
            )
        )
        phase = random.uniform(0, 2 * np.pi, 3)
        rings = np.concatenate([[0.0], shares, [1.0]])
        sway = np.stack(
            [
                np.stack(
                    [np.sin(t - 4.0 * s + phase[k]) * radius * (0.42, 0.42, 0.5)[k] * s**1.3 for k in range(3)],
                    axis=1,
                )
                for s in rings
            ]
        )
        shifts.append(sway)
    return patches, shifts


def torch(
    base: float,
    height: float,
    radius: float,
    poses: int,
    groups: list[tuple[str, float]],
    holder: list[Patch],
    seed: int,
) -> Mdl:
    """A flame of `groups` (name, size), each a loop that plays by itself."""
    flames, shifts = flame_body(base, height, radius, poses, seed)
    model = build(holder + flames, None, ["x"], skin=(128, 96))
    fixed = build(holder, None, ["x"], skin=(128, 96)).positions.shape[1] if holder else 0
    rest = model.positions[0]
    all_positions, frames = [], []
    moves = _vertex_shifts(flames, shifts, poses)
    for index, (name, size) in enumerate(groups):
        for pose in range(poses):
            moved_ = rest.copy()
            moved_[fixed:] = ((rest[fixed:] + moves[pose]) - [0, 0, base]) * size + [0, 0, base]
            all_positions.append(moved_)
        frames.append(Frame(name, list(range(index * poses, (index + 1) * poses))))
    model.positions = np.array(all_positions)
    model.normals = np.repeat(model.normals, len(all_positions), axis=0)
    model.frames, model.random_start = frames, True
    return model


def _vertex_shifts(flames: list[Patch], shifts: list[np.ndarray], poses: int) -> np.ndarray:
    """(poses, V, 3) for the vertices that `build` keeps: of rings that are points only the middle one."""
    out = []
    for patch, sway in zip(flames, shifts):
        for ring, row in enumerate(patch.grid):
            count = 1 if np.ptp(row, axis=0).max() < 1e-6 else len(row)
            out += [sway[ring]] * count
    return np.swapaxes(np.array(out), 0, 1)


def flame() -> Mdl:
    """A torch on a wall: an iron cage on a haft, and its fire."""
    haft = tube([(0, 0, -13), (0, 0, 2)], [0.9, 1.3], wood(0.16, "brown"), sides=6, caps=(0.4, 0))
    cup = lathe(
        [(0, 1.4), (1.0, 2.4), (4.4, 3.2), (4.8, 2.9)],
        plain("slate", 0.12, 0.06, 2.0),
        at=(0, 0, 0),
        sides=8,
        caps=(0, None),
    )
    return torch(3.0, 19.0, 3.4, 6, [("flame", 1.0)], [haft, cup], 61)


def flame2() -> Mdl:
    """A fire without its bowl, small and large."""
    return torch(-11.0, 50.0, 8.0, 7, [("flame", 0.56), ("flameb", 1.0)], [], 67)


MODELS = {
    "bolt": functools.partial(bolt, 0.8, 2, 71),
    "bolt2": functools.partial(bolt, 1.0, 3, 72),
    "bolt3": functools.partial(bolt, 2.4, 4, 73, "white_glow"),
    "s_light": s_light,
    "flame": flame,
    "flame0": flame,
    "flame2": flame2,
}
