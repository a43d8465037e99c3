#!/usr/bin/env python3
"""new_estimator.py's estimator, built beside the sources, draws, and has pt's mean.

usage: new_estimator_test.py BUILD

Only what the new folder and row change is compiled, with the commands of BUILD (a finished Ninja build): the shader's
variants, the table of techniques and the table of shaders. The laboratory is linked from these and BUILD's libraries.
"""
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

NAME = "toy_estimator"


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


def main() -> int:
    build = pathlib.Path(sys.argv[1]).resolve()
    source = pathlib.Path(__file__).resolve().parent.parent
    if not (build / "build.ninja").exists() or shutil.which("ninja") is None:
        print("skipped: this test needs a build by Ninja")
        return 77
    with tempfile.TemporaryDirectory() as scratch:
        root = pathlib.Path(scratch)
        (root / "Quake/render/techniques").mkdir(parents=True)
        shutil.copy(source / "Quake/render/techniques/techniques.cpp", root / "Quake/render/techniques")
        run(sys.executable, str(source / "Misc/new_estimator.py"), NAME, "--root", scratch, cwd=root)

        # The shader, in every variant; its folder is found before the sources' own.
        for variant in ("bound", "address", "query"):
            words = command_of(build, f"shaders/pt_{variant}.spv.h")
            words = replaced(words, "-o", str(root / f"{NAME}_{variant}.spv.h"))
            words = replaced(words, "--vn", f"{NAME}_{variant}_spv")
            words = replaced(words, "--depfile", str(root / "depfile"))
            words[-1] = str(root / f"Shaders/estimators/{NAME}/{NAME}.comp")
            run(*words, f"-I{root}/Shaders", cwd=build)
        table = (build / "shaders/compiled_shaders.spv.h").read_text()
        includes = "".join(f'#include "{NAME}_{v}.spv.h"\n' for v in ("bound", "address", "query"))
        row = f'    CompiledShader{{"{NAME}", {NAME}_bound_spv, {NAME}_address_spv, {NAME}_query_spv}},\n'
        table = table.replace("struct CompiledShader", includes + "\nstruct CompiledShader", 1)
        (root / "compiled_shaders.spv.h").write_text(table.replace("kCompiledShaders{\n", "kCompiledShaders{\n" + row, 1))

        objects = []
        for name, path in (("techniques/techniques", root / "Quake/render/techniques/techniques.cpp"),
                           ("passes/shader_code", source / "Quake/render/passes/shader_code.cpp")):
            words = command_of(build, f"Quake/render/CMakeFiles/fb_render.dir/{name}.cpp.o")
            words = [w for i, w in enumerate(words) if w != "-MD" and (i == 0 or words[i - 1] not in ("-MT", "-MF"))
                     and w not in ("-MT", "-MF")]
            objects.append(str(root / f"{pathlib.Path(name).name}.o"))
            words = replaced(replaced(words, "-o", objects[-1]), "-c", str(path))
            run(words[0], f"-I{root}", *words[1:], cwd=build)
        words = command_of(build, "fullbright-lab")
        lab = str(root / "fullbright-lab")
        words = replaced(words, "-o", lab)
        first_library = next(i for i, w in enumerate(words) if w.endswith("libfb_host.a"))
        run(*words[:first_library], *objects, *words[first_library:], cwd=build)

        assert NAME in run(lab, "estimators", cwd=root)
        hashes = re.findall(r"^\S*[0-9a-f]{16}\S*", run(
            lab, "render", "--quiet", "--scene", "kinds", "--estimator", NAME, "--size", "64x48", "--frames", "0:1",
            "--hash", "--out", str(root / "pictures"), cwd=root), re.MULTILINE)
        assert (root / "pictures/frame_000001.png").stat().st_size > 1000, hashes
        print(run(lab, "ztest", "--quiet", "--scene", "kinds", "--estimator", NAME, "--spp", "4", "--runs", "12", cwd=root))
        print(run(lab, "render", "--quiet", "--validation", "--scene", "kinds", "--estimator", NAME, "--size", "16x16",
                  cwd=root))
    return 0


if __name__ == "__main__":
    sys.exit(main())
