#!/usr/bin/env python3
"""Prints what can be told of the sounds without ears: one line for each, to see what stands out of its category.

    python3 Misc/basegame/sounds/figures.py DIR [--only PATTERN]

DIR is what make.py wrote to. Columns: seconds; loudness (dB below full scale, loudest 200 ms, as kit/master.py says) and
how far that is from the category's; peak (dB); mean (parts of full scale); rise: milliseconds until half of the highest
level; half: seconds until half of the energy is over; the spectral centroid and the frequency below which 90 % of the
energy lies (Hz); for loops where they begin (s) and the step over the seam, in parts of the largest step elsewhere.
"""

from __future__ import annotations

import argparse
import fnmatch
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from formats import wav  # noqa: E402
from sounds.conventions import CATEGORIES, CONVENTIONS, Convention  # noqa: E402
from sounds.kit.master import loudness  # noqa: E402


def seam(sound: wav.Wav) -> float:
    """The step from a loop's last sample to its first, in parts of the largest step within it."""
    body = sound.samples[sound.loop :]
    return abs(body[0] - body[-1]) / max(np.max(np.abs(np.diff(body))), 1e-9)


def spectrum(x: np.ndarray, rate: int) -> tuple[float, float]:
    """Centroid of the magnitude weighted by power, and the frequency below which 90 % of the power lies; Hz."""
    power = np.abs(np.fft.rfft(x)) ** 2
    f = np.fft.rfftfreq(len(x), 1.0 / rate)
    total = max(np.sum(power), 1e-12)
    return float(np.sum(f * power) / total), float(f[np.searchsorted(np.cumsum(power), 0.9 * total)])


def envelope(x: np.ndarray, rate: int) -> np.ndarray:
    """RMS in windows of 5 ms."""
    n = rate // 200
    return np.sqrt(np.mean(np.resize(x, (max(1, len(x) // n), n)) ** 2, axis=1))


def line(convention: Convention, sound: wav.Wav) -> str:
    x, rate = sound.samples, sound.rate
    if not np.any(x):
        return f"{convention.name:20}{convention.category:10}{len(x) / rate:6.2f}   silent"
    level = loudness(x, rate)
    shape = envelope(x, rate)
    rise = 5.0 * float(np.argmax(shape > 0.5 * np.max(shape)))
    energy = np.cumsum(x * x)
    half = np.searchsorted(energy, 0.5 * energy[-1]) / rate
    centroid, most = spectrum(x, rate)
    out = f"{convention.name:20}{convention.category:10}{len(x) / rate:6.2f}{level:7.1f}{level - convention.loudness:+6.1f}"
    out += f"{20 * np.log10(np.max(np.abs(x))):6.1f}{np.mean(x):9.5f}{rise:6.0f}{half:6.2f}{centroid:7.0f}{most:7.0f}"
    if sound.loop is not None:
        out += f"  loop {sound.loop / rate:5.2f} seam {seam(sound):5.2f}"
    return out


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("folder", type=pathlib.Path, metavar="DIR")
    parser.add_argument("--only", default="*", metavar="PATTERN", help="shell pattern of names (without sound/ and .wav)")
    arguments = parser.parse_args()
    print(f"{'name':20}{'category':10}   sec   loud   off  peak     mean  rise  half  centr    90%")
    for category in CATEGORIES:
        for convention in CONVENTIONS.values():
            if convention.category == category and fnmatch.fnmatch(convention.name, arguments.only):
                path = arguments.folder / convention.path
                if not path.is_file():
                    print(f"figures.py: {path} is missing; make.py --out {arguments.folder} makes it", file=sys.stderr)
                    return 1
                print(line(convention, wav.from_bytes(path.read_bytes())))
    return 0


if __name__ == "__main__":
    sys.exit(main())
