#!/usr/bin/env python3
"""new_estimator.py's estimators, built beside the sources, draw, and have pt's mean: one of each kind of frames. A proposal
alone has independent ones; tables, probes and every other part that learns, learning ones; reservoirs correlated ones.

usage: new_estimator_test.py BUILD

Only what the new files and rows change is compiled, with the commands of BUILD (a finished Ninja build). The laboratory is
linked from that and BUILD's libraries, which know no new settings: parts `setting` and `view` are only compiled.
Names and the shape of what is written are new_estimator_files_test.py's.
"""
import json
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

PLAIN, WHOLE, REUSING, SEEN = "toy_estimator", "toy_whole", "toy_reusing", "toy_seen"
PARTS = {PLAIN: [], WHOLE: ["lights", "control", "record", "memory", "table", "probes", "pass", "final"], REUSING: ["reuse"], SEEN: ["all"]}
FRAMES = {PLAIN: None, WHOLE: "kLearning", REUSING: "kCorrelated", SEEN: "kCorrelated"}
DRAWN = (PLAIN, WHOLE, REUSING)


def run(*command: str, cwd: pathlib.Path) -> str:
    done = subprocess.run(command, cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode != 0:
        print(" ".join(command), done.stdout, sep="\n")
        sys.exit(f"new_estimator_test: exit status {done.returncode}")
    return done.stdout


def command_of(build: pathlib.Path, target: str) -> list[str]:
    """The command that makes a target, as words, without what stands before and after it in its line, and without ccache."""
    line = run("ninja", "-t", "commands", target, cwd=build).strip().splitlines()[-1]
    parts: list[list[str]] = [[]]
    for word in shlex.split(line):
        if word == "&&":
            parts.append([])
        else:
            parts[-1].append(word)
    words = next(part for part in parts if part and part[0] not in (":", "cd"))
    return words[1:] if words[0].endswith("ccache") else words


def replaced(words: list[str], option: str, value: str) -> list[str]:
    at = words.index(option)
    return words[:at + 1] + [value] + words[at + 2:]


def compile_shader(build: pathlib.Path, root: pathlib.Path, name: str, source: pathlib.Path, like: str, query: bool) -> str:
    """Every variant of a shader, with the commands of another; its row in the table of shaders."""
    variants = ("bound", "address", "query") if query else ("bound", "address")
    for variant in variants:
        words = command_of(build, f"shaders/{like}_{variant}.spv")
        words = replaced(words, "-o", str(root / f"{name}_{variant}.spv"))
        words = replaced(words, "--depfile", str(root / "depfile"))
        words = [word for word in words if word not in ("-Os",)]  # as good, and sooner
        words[-1] = str(source)
        run(*words[:-1], f"-I{root}/Shaders", words[-1], cwd=build)
    codes = [f"FB_CODE({name}_{variant})" for variant in variants]
    return f'      {{"{name}", {", ".join((codes + ["{}"])[:3])}}},\n'


def compile_table(build: pathlib.Path, root: pathlib.Path, rows: str) -> list[str]:
    """Objects of the table of shaders: BUILD's, and what was compiled here."""
    code, names = (build / "shaders/compiled_shaders.S").read_text(), ""
    for path in sorted(root.glob("*.spv")):
        code += f'code {path.stem}, "{path}"\n'
        names += f"FB_DECLARE_CODE({path.stem})\n"
    (root / "compiled_shaders.S").write_text(code)
    table = (build / "shaders/compiled_shaders.inc").read_text()
    table = table.replace("\ninline const", f"{names}\ninline const", 1).replace("table{\n", "table{\n" + rows, 1)
    (root / "compiled_shaders.inc").write_text(table)
    source = pathlib.Path(__file__).resolve().parent.parent / "Quake/render/passes/shader_code.cpp"
    compiler = command_of(build, "Quake/render/CMakeFiles/fb_render.dir/passes/shader_code.cpp.o")[0]
    run(compiler, "-c", str(root / "compiled_shaders.S"), "-o", str(root / "code.o"), cwd=root)
    return [str(root / "code.o"), compile_source(build, root, source, "passes/shader_code")]


def compile_source(build: pathlib.Path, root: pathlib.Path, path: pathlib.Path, like: str) -> str:
    """An object file of a source, with the command of another of its library; headers of `root` come first."""
    words = command_of(build, f"Quake/render/CMakeFiles/fb_render.dir/{like}.cpp.o")
    words = [w for i, w in enumerate(words) if w != "-MD" and (i == 0 or words[i - 1] not in ("-MT", "-MF")) and w not in ("-MT", "-MF")]
    out = str(root / f"{path.stem}.o")
    words = replaced(replaced(words, "-o", out), "-c", str(path))
    run(words[0], f"-I{root}", f"-I{root}/Shaders", *words[1:], cwd=build)
    return out


def write(source: pathlib.Path, root: pathlib.Path, name: str) -> None:
    run(sys.executable, str(source / "Misc/new_estimator.py"), name, *PARTS[name], "--root", str(root), cwd=root)


def begin(source: pathlib.Path, root: pathlib.Path) -> None:
    """What new_estimator.py reads and changes."""
    (root / "Quake/render/techniques").mkdir(parents=True)
    shutil.copy(source / "Quake/render/techniques/techniques.cpp", root / "Quake/render/techniques")
    shutil.copytree(source / "Shaders/estimators", root / "Shaders/estimators")
    (root / "Shaders/shared").mkdir()
    shutil.copy(source / "Shaders/shared/debug_views.h", root / "Shaders/shared")
    shutil.copy(source / "Shaders/CMakeLists.txt", root / "Shaders")
    shutil.copy(source / ".clang-format", root)


def compile_all(build: pathlib.Path, root: pathlib.Path, name: str) -> str:
    """Its shader and its passes; their rows."""
    folder = root / f"Shaders/estimators/{name}"
    rows = compile_shader(build, root, name, folder / f"{name}.comp", "pt", True)
    for path in sorted((folder / "passes").glob("*.comp")):
        traces = "INTERSECTOR_QUERY" in path.read_text()
        rows += compile_shader(build, root, f"{name}_{path.stem}", path, "pt" if traces else "fold_seen", traces)
    return rows


def check_frames(root: pathlib.Path, name: str) -> None:
    told = re.findall(r"\.frames = Frames::(\w+)", (root / f"Quake/render/techniques/{name}.cpp").read_text())
    assert told == ([FRAMES[name]] if FRAMES[name] else []), f"{name}: {told}"


def main() -> int:
    build = pathlib.Path(sys.argv[1]).resolve()
    source = pathlib.Path(__file__).resolve().parent.parent
    if not (build / "build.ninja").exists() or shutil.which("ninja") is None:
        print("skipped: this test needs a build by Ninja")
        return 77
    with tempfile.TemporaryDirectory() as scratch:
        root = pathlib.Path(scratch) / "drawn"
        begin(source, root)
        rows = ""
        for name in DRAWN:
            write(source, root, name)
            check_frames(root, name)
            rows += compile_all(build, root, name)
        host = root / "Quake/render/techniques"
        objects = [compile_source(build, root, host / f"{name}.cpp", "techniques/techniques") for name in (*DRAWN, "techniques")]
        objects += compile_table(build, root, rows)
        words = command_of(build, "fullbright-lab")
        lab = str(root / "fullbright-lab")
        words = replaced(words, "-o", lab)
        first_library = next(i for i, w in enumerate(words) if w.endswith("libfb_host.a"))
        run(*words[:first_library], *objects, *words[first_library:], cwd=build)

        listed = run(lab, "estimators", cwd=root)
        for name in DRAWN:
            assert name in listed, listed
            run(lab, "render", "--quiet", "--scene", "kinds", "--estimator", name, "--size", "64x48", "--frames", "0:1",
                "--out", str(root / name), cwd=root)
            assert (root / name / "frame_000001.png").stat().st_size > 1000
            print(run(lab, "ztest", "--quiet", "--scene", "kinds", "--estimator", name, "--spp", "4", "--runs", "12", cwd=root))
            print(run(lab, "render", "--quiet", "--validation", "--scene", "kinds", "--estimator", name, "--size", "16x16", cwd=root))

        # Offline its final pass makes the picture of what it remembers, which is the mean of as many samples as any other's.
        told = json.loads(run(lab, "iterate", "--quiet", "--scene", "cbox", "--size", "32x24", "--estimators", f"nee,{WHOLE}",
                              "--schedule", "doubling:6", "--reference-spp", "1024", "--reference-estimator", "nee", "--json", "-", cwd=root))
        nee, own = (configuration["mse_median_pixel"] for configuration in told["configurations"])
        print("a median pixel's square error after iterations:", nee, own)
        assert own < 8 * nee, "the final pass shows another picture"

        # Settings and views change what every file of the host includes.
        root = pathlib.Path(scratch) / "compiled"
        begin(source, root)
        write(source, root, SEEN)
        check_frames(root, SEEN)
        compile_all(build, root, SEEN)
        for path in (root / f"Quake/render/techniques/{SEEN}.cpp", root / "Quake/render/techniques/techniques.cpp",
                     source / "Quake/render/passes/settings.cpp", source / "Quake/render/passes/debug_views.cpp"):
            compile_source(build, root, path, "techniques/techniques")
    return 0


if __name__ == "__main__":
    sys.exit(main())
