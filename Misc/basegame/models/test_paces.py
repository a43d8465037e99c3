"""Feet do not skate: what bears weight goes back under a body as fast as the rules move the body."""

from __future__ import annotations

import pathlib
import re
import sys
import unittest

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from formats.mdl import Mdl  # noqa: E402
from models.catalogue import MODELS  # noqa: E402
from models.conventions import lengths  # noqa: E402
from models.kit.steps import foot, roll, travelled  # noqa: E402
from models.paces import PACES  # noqa: E402

SOLE = 0.4  # units: what is no higher above a gait's lowest point touches the ground
SKATE = 0.15  # of the way that the body goes, on the mean of a gait


def contacts(model: Mdl, frames: list[int]) -> list[tuple[int, float]]:
    """For each frame of a loop in which some of the feet bear weight since the frame before: its number in the loop and
    how far they went back under the body (units)."""
    out = []
    ground = model.positions[frames][..., 2].min() + SOLE
    for n, (now, before) in enumerate(zip(frames, frames[-1:] + frames[:-1])):
        a, b = model.positions[before], model.positions[now]
        on = (a[:, 2] < ground) & (b[:, 2] < ground)
        if on.any():
            out.append((n, float(np.median(a[on, 0] - b[on, 0]))))
    return out


def skating(model: Mdl, frames: list[int], pace: list[float]) -> tuple[float, float, float]:
    """How far the body goes in the frames in which feet bear weight, how far the feet go back, and by how much they
    miss it, frame by frame (units)."""
    touched = contacts(model, frames)
    body = sum(pace[n] for n, _ in touched)
    return body, sum(back for _, back in touched), sum(abs(back - pace[n]) for n, back in touched)


def rule_steps(text: str, frames: dict[tuple[int, int], str]) -> dict[str, list[float]]:
    """Of a monster's QuakeC: sequence -> the units of each of its steps, for loops that walk or hunt.

    `frames` names the sequences by their first and last frame.
    """
    bodies = dict(re.findall(r"static void\(float step\) (\w+) = \{(.*?)\};", text, re.S))
    out = {}
    for first, last, name in re.findall(r"Anim_Loop\((\d+), (\d+), (\w+)\)", text):
        moved = re.search(r"\b(Patrol|Hunt)\((.*)\);", bodies.get(name, ""))
        sequence = frames.get((int(first), int(last)))
        if not moved or sequence is None:
            continue
        expression = moved[2].removeprefix("step, ") if moved[1] == "Patrol" else moved[2]
        out[sequence] = [_value(expression, step) for step in range(int(last) - int(first) + 1)]
    return out


def _value(expression: str, step: int) -> float:
    """A distance as ai_move.qc computes it: choices of lists."""
    expression = re.sub(r"'([^']*)'", lambda v: "[" + ",".join(v[1].split()) + "]", expression).replace("&&", "and")
    while "?" in expression:  # the last choice first: what stands right of it holds none
        expression = re.sub(r"(\([^()?]*\)) \? ((?:[^?:])*) : ([^?]*)$", r"(\2) if \1 else (\3)", expression)
    some = lambda n, *parts: float(np.concatenate([np.atleast_1d(p) for p in parts])[int(n) % sum(map(np.size, parts))])
    return float(eval(expression, {"step": step, **dict.fromkeys(("Of4", "Of6", "Of8", "Of12"), some)}))  # our own source


class Rules(unittest.TestCase):
    def test_paces_are_the_rules(self):
        for name, gaits in PACES.items():
            at, frames = 0, {}
            for sequence, count in lengths(name).items():
                frames[at, at + count - 1] = sequence
                at += count
            file = {"hknight": "hell_knight"}.get(name, name)
            found = rule_steps((HERE.parent / f"qc/monsters/{file}.qc").read_text(encoding="utf-8"), frames)
            with self.subTest(model=name):
                self.assertEqual(found, gaits)


class Steps(unittest.TestCase):
    def test_a_body_goes_by_its_paces(self):
        np.testing.assert_allclose(travelled([1, 2, 4], np.array([0, 1, 2, 3, 2.5, -1, 6])), [0, 2, 6, 7, 6.5, -1, 14])

    def test_a_foot_that_bears_weight_stands_still(self):
        pace = [3.0, 9, 1, 4, 0, 7, 2, 2]
        for cycles in (1, 2):
            f = foot(pace, 0.6, 0.2, cycles)
            for n in range(1, len(pace)):
                if f.down[n] and f.down[n - 1] and f.part[n] > f.part[n - 1]:
                    self.assertAlmostEqual(f.x[n] - f.x[n - 1], -pace[n])

    def test_a_foot_rolls_about_what_touches_the_ground(self):
        f = foot([5.0] * 16, 0.6)
        pitch, x, z = roll(f, 3.0, 4.2, 2.5, 1.0)
        for n in np.flatnonzero(f.down & (np.abs(pitch) > 1)):
            touch, a = (4.2 if pitch[n] > 0 else -2.5), np.radians(pitch[n])
            point = np.array([x[n] + touch * np.cos(a) - 3 * np.sin(a), z[n] - touch * np.sin(a) - 3 * np.cos(a)])
            np.testing.assert_allclose(point, [touch, -3.0], atol=1e-9)


class Feet(unittest.TestCase):
    def test_feet_do_not_skate(self):
        for name, gaits in PACES.items():
            model = MODELS[name]()
            names = [frame.name for frame in model.frames]
            for sequence, pace in gaits.items():
                first = names.index(f"{sequence}1")
                body, feet, missed = skating(model, list(range(first, first + len(pace))), pace)
                with self.subTest(gait=f"{name} {sequence}"):
                    self.assertGreater(body, 0.0, "no foot ever bears weight")
                    self.assertLess(missed, SKATE * body + 0.3, f"feet go {feet:.1f} units where the body goes {body:.1f}")


if __name__ == "__main__":
    unittest.main()
