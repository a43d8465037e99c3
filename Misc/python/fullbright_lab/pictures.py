"""Pictures of a report: linear radiance as PNG, tone mapped alike, and errors in false colours."""

from __future__ import annotations

import base64
import io

import matplotlib
import numpy as np


def exposure(reference: np.ndarray) -> float:
    """Puts the reference's mean luminance at 0.18, middle grey."""
    luminance = reference @ np.array([0.2126, 0.7152, 0.0722], np.float32)
    return 0.18 / max(float(luminance.mean()), 1e-12)


def displayed(linear: np.ndarray, scale: float) -> np.ndarray:
    """(H, W, 3) bytes: scaled, x / (1 + x) (Reinhard 2002), sRGB."""
    value = np.nan_to_num(np.maximum(linear, 0.0) * scale)
    value = value / (1.0 + value)
    value = np.where(value <= 0.0031308, 12.92 * value, 1.055 * np.power(value, 1 / 2.4) - 0.055)
    return np.clip(255.0 * value + 0.5, 0, 255).astype(np.uint8)


def relative_error(test: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """(H, W): |x - r| / (r + 1% of the mean), mean over channels."""
    floor = 0.01 * float(reference.mean())
    return np.mean(np.abs(test - reference) / (reference + max(floor, 1e-12)), axis=-1)


def false_color(values: np.ndarray, top: float) -> np.ndarray:
    """(H, W, 3) bytes: 0 black, `top` and above white, by matplotlib's inferno."""
    colored = matplotlib.colormaps["inferno"](np.clip(np.nan_to_num(values) / top, 0, 1))
    return (255 * colored[..., :3] + 0.5).astype(np.uint8)


def data_uri(picture: np.ndarray) -> str:
    """PNG, as a URI that holds it."""
    data = io.BytesIO()
    matplotlib.image.imsave(data, picture, format="png")
    return "data:image/png;base64," + base64.b64encode(data.getvalue()).decode()
