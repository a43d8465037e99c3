#!/usr/bin/env python3
"""`fullbright-lab compare` held to programs that share nothing with it: metrics_outside_test.py BUILD_DIR. SSIM and PSNR by
Debian's python3-skimage, the spectrum by numpy's FFT, MS-SSIM by scipy's Gaussian filter (skimage has none). Skipped,
saying so, where they are not installed."""

import json
import pathlib
import subprocess
import sys
import tempfile
import zlib
import struct

SKIPPED = 77
try:
    import numpy as np
    from scipy import ndimage
    from skimage import metrics
except ImportError as missing:
    print(f"skipped: {missing}; Debian has python3-skimage")
    sys.exit(SKIPPED)

BUILD = pathlib.Path(sys.argv[1]).resolve()
WEIGHTS = np.array([0.2126, 0.7152, 0.0722])


def write_png(path, values):
    height, width, _ = values.shape
    rows = b"".join(b"\0" + row.tobytes() for row in values)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def scene(width, height, seed):
    """A smooth picture, and one with noise, blur and another exposure."""
    random = np.random.default_rng(seed)
    y, x = np.mgrid[0:height, 0:width]
    base = 0.5 + 0.3 * np.sin(x / 9.0)[..., None] * np.cos(y[..., None] / (5.0 + np.arange(3)))
    base += ndimage.gaussian_filter(random.normal(0, 0.6, (height, width, 3)), (2, 2, 0))
    test = 0.9 * ndimage.gaussian_filter(base, (1, 1, 0)) + random.normal(0, 0.05, base.shape)
    return [np.round(255 * np.clip(image, 0, 1)).astype(np.uint8) for image in (base, test)]


def ms_ssim(a, b):
    product = 1
    for scale, weight in enumerate((0.0448, 0.2856, 0.3001, 0.2363, 0.1333)):
        if scale:
            a, b = (image[: image.shape[0] // 2 * 2, : image.shape[1] // 2 * 2] for image in (a, b))
            a, b = (image.reshape(image.shape[0] // 2, 2, image.shape[1] // 2, 2).mean((1, 3)) for image in (a, b))
        mean = lambda image: ndimage.gaussian_filter(image, 1.5, truncate=3.5)[5:-5, 5:-5]  # noqa: E731
        mean_a, mean_b = mean(a), mean(b)
        covariance = mean(a * b) - mean_a * mean_b
        factor = (2 * covariance + 9e-4) / (mean(a * a) - mean_a**2 + mean(b * b) - mean_b**2 + 9e-4)
        if scale == 4:
            factor = factor * (2 * mean_a * mean_b + 1e-4) / (mean_a**2 + mean_b**2 + 1e-4)
        product *= max(factor.mean(), 0) ** weight
    return product


def spectrum(error):
    height, width = error.shape
    power = np.abs(np.fft.fft2(error)) ** 2 / error.size
    frequency = np.hypot(np.fft.fftfreq(height)[:, None], np.fft.fftfreq(width)[None, :])
    some = frequency > 0
    bins = np.ceil(frequency * 64 - 1e-9).astype(int) - 1
    curve = [power[some & (bins == i)].mean() if (some & (bins == i)).any() else None for i in range(32)]
    return power[some & (frequency <= 0.125)].sum() / power[some].sum(), curve


def main():
    worst = {}

    def check(name, found, expected, tolerance):
        difference = abs(found - expected)
        worst[name] = max(worst.get(name, 0), difference)
        assert difference <= tolerance, f"{name}: {found} here, {expected} there"

    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        for width, height, seed in ((256, 192, 1), (177, 183, 2), (320, 180, 3)):
            reference, test = scene(width, height, seed)
            write_png(folder / "r.png", reference)
            write_png(folder / "t.png", test)
            said = subprocess.run([BUILD / "fullbright-lab", "compare", folder / "r.png", folder / "t.png", "--no-flip",
                                   "--json", "-"], capture_output=True, text=True, check=True, timeout=60)
            found = json.loads(said.stdout)["files"][0]
            r, t = reference / 255, test / 255
            # Pixels are floats here and doubles there: 1e-7 each.
            check("psnr", found["psnr"], metrics.peak_signal_noise_ratio(r, t, data_range=1), 1e-4)
            luma = [image @ WEIGHTS for image in (r, t)]
            theirs = metrics.structural_similarity(*luma, gaussian_weights=True, sigma=1.5, use_sample_covariance=False,
                                                   data_range=1)
            check("ssim", found["ssim"], theirs, 1e-5)
            check("ms_ssim", found["ms_ssim"], ms_ssim(*luma), 1e-5)
            share, curve = spectrum(luma[1] - luma[0])
            check("low_frequencies", found["low_frequencies"], share, 1e-5)
            for ours, expected in zip(found["error_spectrum"]["power"], curve):
                assert (ours is None) == (expected is None)
                if ours is not None:
                    check("error_spectrum", ours / expected, 1, 1e-4)
    print("largest differences:", ", ".join(f"{name} {value:.1e}" for name, value in worst.items()))


if __name__ == "__main__":
    main()
