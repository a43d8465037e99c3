#!/usr/bin/env python3
"""bench_game.py FOLDER: prints two results of `make bench` (Google Benchmark's progs.json and server.json in FOLDER):
QuakeC instructions a second, and the time of a server's tick with 500 monsters."""
import json
import math
import pathlib
import sys


def runs(folder, name):
    path = pathlib.Path(folder, f"{name}.json")
    if not path.exists() or not path.stat().st_size:
        return {}
    found = json.loads(path.read_text())["benchmarks"]
    return {run["name"]: run for run in found if not run.get("error_occurred") and run.get("run_type") != "aggregate"}


def quakec_line(rates):
    """The geometric mean over the kinds of code, the slowest and the fastest."""
    mean = math.exp(sum(math.log(rate) for rate in rates.values()) / len(rates))
    slowest, fastest = min(rates, key=rates.get), max(rates, key=rates.get)
    return (f"QuakeC: {mean / 1e6:.0f} million instructions a second "
            f"({slowest} {rates[slowest] / 1e6:.0f}, {fastest} {rates[fastest] / 1e6:.0f})")


def main():
    folder = sys.argv[1]
    rates = {name.split("/")[-1]: run["items_per_second"] for name, run in runs(folder, "progs").items()
             if "items_per_second" in run}
    if rates:
        print(quakec_line(rates))
    tick = runs(folder, "server").get("tick")
    if tick:
        print(f"a server's tick with 500 monsters that walk, turn and look: {tick['cpu_time']:.2f} ms of CPU time, "
              f"{tick['real_time']:.2f} ms of time ({tick['statements']:.0f} QuakeC instructions)")


if __name__ == "__main__":
    main()
