"""What flies: rockets, nails, bolts of lightning, flesh; and what burns where it stands. The front is +x."""

from __future__ import annotations

import functools

import numpy as np

from formats.mdl import GIB, GRENADE, ROCKET, TRACER, TRACER2, TRACER3, ZOMGIB, Frame, Mdl
from models.conventions import frame_names
from models.kit.figure import build
from models.kit.noise import fbm
from models.kit.paint import band, bone, copper, flesh, glow, iron, layers, leather, magma, plain, rib, rivets, steel, wax, where, wood
from models.kit.shapes import Patch, box, ellipsoid, flat_section, lathe, moved, torus, tube
from models.kit.skeleton import Posing, Skeleton
from models.kit.turn import euler

X = (1.0, 0.0, 0.0)
UP = (0.0, 0.0, 1.0)


def _one(patches: list[Patch], flags: int = 0, skin=(96, 64)) -> Mdl:
    return build(patches, None, ["frame1"], skin=skin, flags=flags)


def rough(patch: Patch, amount: float, size: float, seed: int) -> Patch:
    """The patch with its vertices pushed about by up to `amount` units; what coincides stays together."""
    push = np.stack([fbm(patch.grid + 30.0, size, 2, seed + k) for k in range(3)], axis=-1) - 0.5
    patch.grid = patch.grid + push * 2.0 * amount
    return patch


def missile() -> Mdl:
    body = lathe([(-9, 1.2), (-8.6, 1.8), (2.0, 2.0), (5.0, 1.7), (7.4, 0.8)], layers(iron(0.5, 0.15), (band("x", 1.6, 2.6), copper(0.1)), (band("x", 2.6, 9.0), plain("coral", 0.6, 0.06))), at=(0, 0, 0), axis=X, sides=9, caps=(0, 0.6))
    fins = [tube([(-9.6, 0, 0), (-4.0, 0, 0)], [(0.18, 3.6), (0.15, 1.9)], copper(0.4, 2.0), up=(0, np.cos(a), np.sin(a)), section=flat_section()) for a in np.radians([0, 90])]
    fire = lathe([(-13.0, 0.25), (-11.0, 0.8), (-9.0, 1.2)], glow("fire", 0.9, 0.2), axis=X, sides=6, caps=(0.8, 0))
    return _one([body, *fins, fire], ROCKET)


def grenade() -> Mdl:
    shell = lathe([(-4.4, 1.6), (-3.8, 2.8), (-1.6, 3.2), (1.6, 3.2), (3.8, 2.6), (4.4, 1.8)], layers(copper(0.4, 3.0), (rib("x", 2.0, 0.35), iron(0.3, 0.2)), (lambda s: (s.u * 8) % 1.0 < 0.1, iron(0.3, 0.2))), axis=X, sides=10, caps=(0.3, 0.2))
    fuse = lathe([(4.4, 1.0), (6.0, 0.9), (6.2, 0.5), (7.0, 0.5)], where(band("x", 6.1, 9.0), glow("fire", 0.8, 0.2), copper(0.0)), axis=X, sides=6, caps=(0, 0.5))
    lever = tube([(4.6, 0, 1.2), (3.0, 0, 3.4), (-2.6, 0, 3.9)], [(0.3, 0.6)] * 3, steel(0.7), sides=5, up=UP)
    return _one([shell, fuse, lever], GRENADE)


def nail(length: float = 10.0, big: float = 1.0) -> Mdl:
    shaft = lathe([(0, 1.0 * big), (0.7 * big, 1.0 * big), (0.9 * big, 0.5 * big), (length * 0.75, 0.5 * big)], where(band("v", 0.0, 0.25), copper(0.2), steel(0.72)), axis=X, sides=6, caps=(0, length * 0.25))
    return _one([shaft], skin=(48, 32))


def k_spike() -> Mdl:
    """A hell knight's blade of fire."""
    blade = tube([(0, 0, 0), (6, 0, 0), (16, 0, 0), (24, 0, 0)], [(0.4, 1.4), (0.7, 2.8), (0.5, 1.9), (0.2, 0.6)], glow("fire", 0.7, 0.5, 4.0), section=flat_section(), up=UP, caps=(1.0, 4.0))
    rib_ = tube([(-1, 0, 0), (12, 0, 0), (25, 0, 0)], [0.8, 1.0, 0.3], glow("fire", 0.98, 0.1), sides=5, up=UP)
    return _one([blade, rib_], TRACER2)


def w_spike() -> Mdl:
    """The wizard's spit: drops of venom that wobble."""
    drop = lathe([(0, 0.5), (3, 1.3), (7, 1.9), (10, 1.2)], glow("gold_glow", 0.75, 0.3), axis=X, sides=8, caps=(0.8, 1.2))
    rim = lathe([(1.5, 1.2), (4, 2.1), (7, 2.7), (9.5, 2.3)], plain("verdigris", 0.8, 0.2, 1.5), axis=X, sides=6, caps=(None, None))
    posing = Posing(Skeleton({"root": ("", (0, 0, 0))}), 4)
    size = np.array([[1, 1, 1], [1.1, 0.86, 1.1], [1, 1.05, 0.92], [0.92, 1.1, 1.0]])
    posing.place("root", euler(np.stack([np.zeros(4), np.zeros(4), np.arange(4) * 30.0], axis=1)) * size[:, None, :], np.zeros((4, 3)))
    return build([drop, rim], posing, frame_names("w_spike"), skin=(96, 64), flags=TRACER)


def star(radius: float, spikes: int, ramp: str, flags: int, crust: str = "mauve") -> Mdl:
    """A ball of thorns around a glowing core."""
    core = ellipsoid((0, 0, 0), (radius * 0.62,) * 3, layers(plain(crust, 0.35, 0.2, radius * 0.3), (lambda s: s.noise(radius * 0.4, 5, 2) > 0.55, glow(ramp, 0.7, 0.4))), rings=5, sides=9)
    out = [core]
    for i in range(spikes):
        # Points spread evenly over the sphere (Fibonacci).
        z = 1 - (2 * i + 1) / spikes
        a = i * np.pi * (3 - 5**0.5)
        d = np.array([np.cos(a) * np.sqrt(1 - z * z), np.sin(a) * np.sqrt(1 - z * z), z])
        out.append(tube([d * radius * 0.5, d * radius], [radius * 0.17, radius * 0.03], layers(plain(crust, 0.5, 0.1), (band("v", 0.55, 1.1), glow(ramp, 0.8, 0.2))), sides=5, up=np.cross(d, (0.3, 0.5, 0.8)), caps=(None, radius * 0.05), detail=0.6))
    return _one(out, flags, (128, 64))


def lavaball() -> Mdl:
    lump = rough(ellipsoid((0, 0, 0), (6.2, 6.2, 6.2), magma(0.8, 5.0), rings=7, sides=11), 1.4, 4.0, 7)
    return _one([lump], ROCKET, (96, 64))


def laser() -> Mdl:
    beam = lathe([(-9, 0.35), (-4, 0.9), (7, 0.9), (10, 0.4)], glow("red_glow", 0.85, 0.2), axis=X, sides=6, caps=(1.5, 1.5))
    posing = Posing(Skeleton({"root": ("", (0, 0, 0))}), 5)
    size = np.array([1.0, 1.12, 0.94, 1.08, 0.9])
    posing.place("root", euler(np.stack([np.zeros(5), np.zeros(5), np.arange(5) * 24.0], axis=1)) * np.stack([np.ones(5), size, size], axis=1)[:, None, :], np.zeros((5, 3)))
    return build([beam], posing, [Frame("frame1", list(range(5)))], skin=(48, 32))


def bolt(thick: float, forks: int, seed: int, ramp: str = "blue_glow") -> Mdl:
    """A piece of lightning, 30 units long, that fits to its next: it begins and ends on the axis."""
    random = np.random.default_rng(seed)

    def zigzag(start, end, steps: int, spread: float) -> np.ndarray:
        points = np.linspace(start, end, steps)
        points[1:-1, 1:] += random.uniform(-spread, spread, (steps - 2, 2))
        points[1:-1, 0] += random.uniform(-1.0, 1.0, steps - 2)
        return points

    main = zigzag((0, 0, 0), (31, 0, 0), 9, 2.2 * thick)
    out = [tube(main, [0.5 * thick, *[0.75 * thick] * 7, 0.5 * thick], glow(ramp, 0.9, 0.2), sides=4, up=UP, caps=(0, 0))]
    for _ in range(forks):
        start = main[random.integers(1, 6)]
        away = random.uniform(-1, 1, 3) * [0, 5, 5] * thick + [9, 0, 0]
        out.append(tube(zigzag(start, start + away, 4, 0.9 * thick), [0.4 * thick, 0.35 * thick, 0.25 * thick, 0.08 * thick], glow(ramp, 0.6, 0.3), sides=4, up=UP, caps=(0, 0)))
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
        arcs.append(tube([d * 2, d * 6 + side * 2.5, d * 10 - side * 2.0, d * 15 + side], [0.9, 0.7, 0.5, 0.1], glow("blue_glow", 0.8, 0.3), f"arc{i % 2}", sides=4, up=X))
    skeleton = Skeleton({"root": ("", (0, 0, 0)), "ball": ("root", (0, 0, 0)), "arc0": ("root", (0, 0, 0)), "arc1": ("root", (0, 0, 0))})
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


def gib(kind: int) -> Mdl:
    """A lump of coral flesh, a limb with its bone, or ribs."""
    if kind == 1:
        lump = rough(ellipsoid((0, 0, 3), (3.6, 5.4, 3.0), flesh(0.55), rings=5, sides=8), 1.2, 3.0, 3)
        return _one([lump, tube([(0, 3, 3), (1, 7, 4.5)], [0.9, 0.7], bone(0.85), sides=6)], GIB)
    if kind == 2:
        limb = rough(tube([(-9, -4, 0), (-4, 0, 1.5), (2, 1, 1.5), (7, 0, 0)], [3.0, 3.6, 2.8, 2.4], flesh(0.56, seed=17), sides=8, up=UP), 0.5, 3.0, 4)
        return _one([limb, tube([(7, 0, 0), (13, -1.5, 0)], [1.0, 0.9], bone(), sides=6, up=UP, caps=(0, 0.4)), tube([(-12, -6, 0), (-9, -4, 0)], [0.8, 1.0], bone(), sides=6, up=UP)], GIB)
    spine = tube([(-12, 0, 0), (-4, 0, 2), (4, 0, 2), (12, 0, 0)], [1.6, 2.0, 2.0, 1.5], layers(flesh(0.5), (rib("x", 3.0, 1.4), bone())), sides=7, up=UP)
    ribs = [tube([(x, 0, 2), (x + 1, side * 6, 3.5), (x + 1.5, side * 9, -1.5)], [0.9, 0.8, 0.35], bone(), sides=5, up=X) for x in (-7, -2, 3, 8) for side in (1, -1)]
    return _one([spine, *ribs], GIB)


def zom_gib() -> Mdl:
    return _one([rough(ellipsoid((0, 0, 0), (3.0, 2.2, 2.4), flesh(0.5, seed=23), rings=4, sides=7), 0.8, 2.0, 9)], ZOMGIB, (48, 32))


def eyes() -> Mdl:
    """What remains to see of one who cannot be seen."""
    out = [ellipsoid((1.0, y, 25.5), (1.3, 1.3, 1.3), layers(glow("white_glow", 0.5, 0.1), (lambda s, y=y: s.near((2.2, y, 25.5), 0.75), plain("blue", 0.4, 0.0))), rings=5, sides=9) for y in (2.0, -2.0)]
    return build(out, None, ["frame1"], skin=(64, 48))


def flame_body(base: float, height: float, radius: float, poses: int, seed: int, bone_name: str = "root", tongues: int = 5) -> tuple[list[Patch], np.ndarray]:
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
        colour = lambda s, lo=base, hi=base + tall: s.ramp("fire", 1.0 - 0.62 * np.clip((s.z - lo) / (hi - lo), 0, 1) ** 1.3 + 0.25 * (s.noise(radius * 0.6, seed) - 0.5))
        patches.append(tube(path, [wide * w for w in (0.55, 1.0, 0.8, 0.42, 0.14)], colour, bone_name, sides=6, caps=(wide * 0.3, tall * 0.12)))
        phase = random.uniform(0, 2 * np.pi, 3)
        rings = np.concatenate([[0.0], shares, [1.0]])
        sway = np.stack([np.stack([np.sin(t - 4.0 * s + phase[k]) * radius * (0.42, 0.42, 0.5)[k] * s**1.3 for k in range(3)], axis=1) for s in rings])
        shifts.append(sway)
    return patches, shifts


def torch(base: float, height: float, radius: float, poses: int, groups: list[tuple[str, float]], holder: list[Patch], seed: int) -> Mdl:
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
    cup = lathe([(0, 1.4), (1.0, 2.4), (4.4, 3.2), (4.8, 2.9)], plain("slate", 0.12, 0.06, 2.0), at=(0, 0, 0), sides=8, caps=(0, None))
    return torch(3.0, 19.0, 3.4, 6, [("flame", 1.0)], [haft, cup], 61)


def flame2() -> Mdl:
    """A fire without its bowl, small and large."""
    return torch(-11.0, 50.0, 8.0, 7, [("flame", 0.56), ("flameb", 1.0)], [], 67)


MODELS = {
    "missile": missile, "grenade": grenade, "spike": nail, "s_spike": functools.partial(nail, 11.0, 1.25), "k_spike": k_spike, "w_spike": w_spike,
    "v_spike": functools.partial(star, 6.0, 16, "red_glow", TRACER3), "teleport": functools.partial(star, 30.0, 24, "fire", 0, "slate"), "lavaball": lavaball, "laser": laser,
    "bolt": functools.partial(bolt, 0.8, 2, 71), "bolt2": functools.partial(bolt, 1.0, 3, 72), "bolt3": functools.partial(bolt, 2.4, 4, 73, "white_glow"), "s_light": s_light,
    "gib1": functools.partial(gib, 1), "gib2": functools.partial(gib, 2), "gib3": functools.partial(gib, 3), "zom_gib": zom_gib, "eyes": eyes,
    "flame": flame, "flame0": flame, "flame2": flame2,
}
