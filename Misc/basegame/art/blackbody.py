"""The colour of what glows with heat: Planck's law as the CIE 1931 standard observer sees it, in linear sRGB.

Flames, filaments and slag shine nearly as black bodies do, so that a lamp whose colour lies off their curve (the
Planckian locus) looks painted: above it greenish, below it pink. The observer's colour-matching functions are the sums
of Gaussian lobes of Wyman, Sloan and Shirley 2013 (JCGT 2(2)), good to a hundredth.
"""

from __future__ import annotations

from functools import cache

import numpy as np

_WAVELENGTHS = np.arange(360.0, 831.0)  # nm
_C2 = 1.438777e7  # the second radiation constant, nm K

# For each of X, Y and Z: weight, middle, width below it and width above it (nm).
_LOBES: list[list[tuple[float, float, float, float]]] = [
    [(1.056, 599.8, 37.9, 31.0), (0.362, 442.0, 16.0, 26.7), (-0.065, 501.1, 20.4, 26.2)],
    [(0.821, 568.8, 46.9, 40.5), (0.286, 530.9, 16.3, 31.1)],
    [(1.217, 437.0, 11.8, 36.0), (0.681, 459.0, 26.0, 13.8)],
]
_SRGB_FROM_XYZ = np.array(  # IEC 61966-2-1
    [[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]]
)


def _observer() -> np.ndarray:
    """The colour-matching functions at _WAVELENGTHS, (3, n)."""

    def lobe(weight: float, middle: float, below: float, above: float) -> np.ndarray:
        away = _WAVELENGTHS - middle
        return weight * np.exp(-0.5 * (away / np.where(away < 0, below, above)) ** 2)

    return np.array([sum(lobe(*row) for row in lobes) for lobes in _LOBES])


_OBSERVER = _observer()


def xyz_of_heat(temperature: float) -> np.ndarray:
    """CIE XYZ, in any unit, of a black body of so many kelvin."""
    return _OBSERVER @ (_WAVELENGTHS**-5.0 / np.expm1(_C2 / (_WAVELENGTHS * temperature)))


def light_of(xyz: np.ndarray) -> np.ndarray:
    """Linear sRGB (3,) of that chromaticity, cut to the gamut, its greatest channel 1."""
    rgb = np.maximum(_SRGB_FROM_XYZ @ xyz, 0.0)
    return rgb / rgb.max()


def _uv(xyz: np.ndarray) -> np.ndarray:
    """CIE 1960 chromaticity of (..., 3), in which distances from the locus are given."""
    return np.stack([4.0 * xyz[..., 0], 6.0 * xyz[..., 1]], axis=-1) / (xyz @ [1.0, 15.0, 3.0])[..., None]


@cache
def _locus() -> tuple[np.ndarray, np.ndarray]:
    temperatures = np.geomspace(1000.0, 15000.0, 1000)
    return temperatures, _uv(np.array([xyz_of_heat(t) for t in temperatures]))


def off_the_locus(light: np.ndarray) -> tuple[float, float]:
    """Of linear sRGB (3,): its distance Duv from the Planckian locus in CIE 1960 uv, positive on the green side, and the
    temperature (kelvin) of the nearest black body. A lamp sold as white keeps within 0.006 (ANSI C78.377)."""
    temperatures, locus = _locus()
    away = _uv(np.linalg.inv(_SRGB_FROM_XYZ) @ np.asarray(light, float)) - locus
    nearest = int((away**2).sum(axis=1).argmin())
    return float(np.copysign(np.hypot(*away[nearest]), away[nearest, 1])), float(temperatures[nearest])
