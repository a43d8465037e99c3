"""What fullbright-lab has written, for notebooks: suites' results as objects and numpy arrays, pictures as arrays.

    from fullbright_lab import exr, results
    suite = results.read("out/quick")
    mse = suite["cbox"].curve("mcpg", "running_mse")   # (runs, frames)
    planes, header = exr.read(Path("reference.exr"))   # {"R": (H, W) float32, ...}
"""
