#!/usr/bin/env python3
"""Checks the order of the modules: which may include and link which.

A module may use the modules in its row of MAY_INCLUDE and, through them, those that they may use. Tests, benchmarks and
fuzzers may also use every module that is built before theirs. Subfolders of a module have an order of their own
(SUBFOLDERS), and shaders have layers of their own. A library is one module's (FENCED): SDL is platform's, Dear ImGui the
panel's, libpng formats', libsndfile and libopenmpt audio's, OpenEXR, FFTW and the JSON library lab's, CLI11 host's; Vulkan's
headers are for gpu and modules above it, and Embree for benchmarks.

    Misc/check_layers.py [--root DIR]    prints each violation as file:line: sentence; exit status 1 if there is one
    Misc/check_layers.py --self-test     tests the checks themselves on a small tree that breaks every rule
"""

import argparse
import pathlib
import re
import sys
import tempfile

# In the order in which they are built.
MAY_INCLUDE = {
    "base": [],
    "fs": ["base"],
    "console": ["base", "fs"],
    "formats": ["base"],
    "world": ["formats", "base"],
    "net": ["console"],
    "progs": ["console"],
    "server": ["world", "progs", "net"],
    "scene": ["world"],
    "client": ["scene", "net"],
    "ui": ["client"],
    "csqc": ["ui", "progs"],
    "audio": ["scene", "fs", "console"],
    "gpu": ["base"],
    "render": ["gpu", "scene", "console"],
    "platform": ["base"],
    "panel": ["ui", "render", "platform"],
    "lab": ["client", "render"],
    "host": ["server", "csqc", "audio", "panel", "lab"],
}
ORDER = list(MAY_INCLUDE)
# A module's subfolders, from the bottom up: each may include itself and those before it. "" is the module's own folder.
# Tests may include all of them.
SUBFOLDERS = {
    "progs": ["", "builtins"],
    "server": ["simulation", "clients", "builtins", ""],
    "scene": ["", "library", "authored", "in_code"],
    "render": ["passes", "scene", "picture", "techniques", ""],
    "host": ["", "game", "lab"],
    "ui": ["", "menu"],
    "client": ["effects", "session", "input", "sources", ""],
    "lab": ["", "gltf", "import", "reference", "compare", "timedemo", "ztest", "bench", "iterate", "judge", "film", "suite", "authored"],
}
# Modules whose C++ code shares structs and pure functions with the shaders.
USES_SHARED = {"scene", "gpu", "render", "lab", "host"}
SHADER_LAYERS = {
    "shared": {"shared"},
    "lib": {"shared", "lib"},
    "estimators": {"shared", "lib", "estimators"},
    "passes": {"shared", "lib", "passes"},
    "tests": {"shared", "lib", "tests"},
}
# Third-party headers that only some modules may include: pattern, modules, whether benchmarks may, too.
FENCED = [
    (re.compile(r"^(SDL2/)?SDL\w*\.h"), {"platform"}, False),
    (re.compile(r"^vulkan/"), {"gpu", "render", "platform", "lab", "host"}, True),
    (re.compile(r"^embree"), set(), True),
    (re.compile(r"^imgui"), {"panel"}, False),
    (re.compile(r"^png(conf)?\.h"), {"formats"}, False),
    (re.compile(r"^sndfile\.h|^libopenmpt/"), {"audio"}, False),
    (re.compile(r"^(OpenEXR/|Imath/|Imf|Imath|half\.h$)"), {"lab"}, False),
    (re.compile(r"^fftw3"), {"lab"}, False),
    (re.compile(r"^nlohmann/"), {"lab"}, False),
    (re.compile(r"^CLI/|^CLI11"), {"host"}, False),
]
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')
TEST_FILE = re.compile(r"(_test|_bench|_fuzz|make_seed_corpus)\.(cpp|h)$|(^|/)(test|fuzz|bench)_[^/]*$")


def closure(module):
    reached, todo = {module}, [module]
    while todo:
        for below in MAY_INCLUDE[todo.pop()]:
            if below not in reached:
                reached.add(below)
                todo.append(below)
    return reached


CLOSURE = {module: closure(module) for module in MAY_INCLUDE}


def allowed_modules(module, is_test):
    allowed = set(CLOSURE[module])
    if is_test:
        allowed |= set(ORDER[: ORDER.index(module)])
    return allowed


def subfolder_of(parts):
    """The subfolder of a file whose path, from its module on, has these parts."""
    return "/".join(parts[1:-1])


def check_subfolders(name, module, is_test, targets):
    order = SUBFOLDERS.get(module, [""])
    own = subfolder_of(name.parts[1:])
    if own not in order:
        yield f"{name}:1: '{own}' is not a subfolder of {module}"
        return
    for number, target in targets:
        other = subfolder_of(target.split("/"))
        if other not in order:
            yield f"{name}:{number}: '{other}' is not a subfolder of {module}"
        elif not is_test and order.index(other) > order.index(own):
            yield f"{name}:{number}: {name.parent} must not include {target}, which is above it"


def includes(path):
    for number, line in enumerate(path.read_text(encoding="utf-8", errors="replace").splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1), match.group(2)


def check_cpp(root):
    for path in sorted((root / "Quake").rglob("*")):
        if path.suffix not in (".h", ".cpp"):
            continue
        name = path.relative_to(root)
        module = name.parts[1]
        if module not in MAY_INCLUDE:
            yield f"{name}:1: '{module}' is not a module of the design"
            continue
        is_test = bool(TEST_FILE.search(str(name)))
        allowed = allowed_modules(module, is_test)
        own = [(n, target) for n, quote, target in includes(path) if quote == '"' and target.startswith(module + "/")]
        yield from check_subfolders(name, module, is_test, own)
        for number, quote, target in includes(path):
            if quote == '"':
                first = target.split("/")[0]
                if ".." in target or "/" not in target:
                    generated = target.endswith(".spv.h") or target.endswith(".inc")
                    if not generated:
                        yield f'{name}:{number}: "{target}" names no module; write "{module}/..."'
                elif first == "shared":
                    if module not in USES_SHARED:
                        yield f"{name}:{number}: {module} knows no shader, so not {target}"
                elif first == "estimators":
                    if module != "render" or not target.endswith(".h"):
                        yield f"{name}:{number}: {module} must not include {target}, a technique's; render may, its headers"
                elif first not in MAY_INCLUDE:
                    yield f'{name}:{number}: "{target}" names no module'
                elif first not in allowed:
                    yield f"{name}:{number}: {module} must not include {target} (it may: {listed(allowed)})"
            for pattern, modules, benchmarks in FENCED:
                if pattern.match(target) and module not in modules and not (benchmarks and "bench" in path.name):
                    yield f"{name}:{number}: {target} is not for {module}"


def may_include(root, estimator):
    """A technique's folder may include that of its family, the first word of its name, and the one whose passes it runs, as its
    row says (TechniqueInfo::stands_on)."""
    row = root / "Quake/render/techniques" / f"{estimator}.cpp"
    stands_on = re.findall(r'\.stands_on = "(\w+)"', row.read_text(encoding="utf-8")) if row.exists() else []
    return (estimator, estimator.split("_")[0], *stands_on)


def check_shaders(root):
    for path in sorted((root / "Shaders").rglob("*")):
        if path.suffix not in (".h", ".glsl", ".comp", ".cpp"):
            continue
        name = path.relative_to(root)
        layer = name.parts[1]
        is_test = bool(TEST_FILE.search(str(name)))
        if layer not in SHADER_LAYERS:
            yield f"{name}:1: '{layer}' is not a layer of the shaders"
            continue
        for number, quote, target in includes(path):
            if quote != '"':
                continue
            first = target.split("/")[0] if "/" in target else layer
            if is_test and first == "base":
                continue
            if first not in SHADER_LAYERS[layer]:
                yield f"{name}:{number}: {layer} must not include {target}"
            elif name.parts[1:] == ("estimators", "techniques.h"):  # the list of their headers
                continue
            elif first == layer == "estimators" and "/" in target and target.split("/")[1] not in may_include(root, name.parts[2]):
                yield f"{name}:{number}: one estimator must not include another; what they share belongs in lib"


def check_links(root):
    keyword = re.compile(r"[A-Z_]{3,}$")
    for path in sorted((root / "Quake").rglob("CMakeLists.txt")):
        name = path.relative_to(root)
        if len(name.parts) < 3:
            continue
        module = name.parts[1]
        if module not in MAY_INCLUDE:
            yield f"{name}:1: '{module}' is not a module of the design"
            continue
        is_test = False
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            for word in re.findall(r"[\w:.$<>/{}-]+", line.split("#")[0]):
                if word in ("fb_module", "add_executable", "target_link_libraries"):
                    is_test = False
                elif keyword.match(word):
                    is_test = word.startswith(("TEST", "BENCHMARK", "FUZZ"))
                elif re.search(r"_(test|bench)$|^fuzz_|make_seed_corpus$", word):
                    is_test = True
                elif word.startswith("fb_") and word[3:] in MAY_INCLUDE:
                    if word[3:] not in allowed_modules(module, is_test):
                        yield f"{name}:{number}: {module} must not link {word}"


def listed(modules):
    return " ".join(module for module in ORDER if module in modules) or "nothing"


def check(root):
    return [*check_cpp(root), *check_shaders(root), *check_links(root)]


SELF_TEST = {  # file: (text, lines that break a rule)
    "Quake/base/a.h": ('#include <string>\n#include "fs/pak.h"\n#include "base/b.h"\n', [2]),
    "Quake/net/a.cpp": ('#include "net/a.h"\n#include "fs/pak.h"\n#include "world/w.h"\n#include "shared/rng.h"\n', [3, 4]),
    "Quake/net/a_test.cpp": ('#include "formats/dem.h"\n#include "client/c.h"\n', [2]),
    "Quake/render/a.cpp": ('#include <vulkan/vulkan.h>\n#include "shared/rng.h"\n#include "x.spv.h"\n#include "server/s.h"\n', [4]),
    "Quake/render/a_bench.cpp": ("#include <embree3/rtcore.h>\n", []),
    "Quake/render/b.cpp": ('#include <embree3/rtcore.h>\n#include "b.h"\n#include "../scene/b.h"\n', [1, 2, 3]),
    "Quake/render/c.cpp": ('#include "estimators/pt/pt.h"\n#include "estimators/pt/steps/a.glsl"\n', [2]),
    "Quake/lab/c.cpp": ('#include "estimators/pt/pt.h"\n', [1]),
    "Shaders/estimators/techniques.h": ('#include "estimators/pt/pt.h"\n#include "estimators/nee/nee.h"\n', []),
    "Quake/scene/a.h": ("#include <SDL.h>\n  #  include <vulkan/vulkan.h>\n", [1, 2]),
    "Quake/platform/a.cpp": ("#include <SDL2/SDL.h>\n", []),
    "Quake/fs/a.cpp": (
        "#include <png.h>\n#include <sndfile.h>\n#include <libopenmpt/libopenmpt.hpp>\n#include <OpenEXR/ImfHeader.h>\n"
        "#include <ImfHeader.h>\n#include <Imath/ImathVec.h>\n#include <fftw3.h>\n#include <nlohmann/json.hpp>\n"
        "#include <CLI/CLI.hpp>\n#include <half.hpp>\n",
        [1, 2, 3, 4, 5, 6, 7, 8, 9],
    ),
    "Quake/host/a.cpp": ("#include <CLI/CLI.hpp>\n#include <nlohmann/json.hpp>\n#include <png.h>\n", [2, 3]),
    "Quake/lab/a_test.cpp": ("#include <nlohmann/json.hpp>\n#include <fftw3.h>\n#include <sndfile.h>\n", [3]),
    "Quake/formats/a_test.cpp": ("#include <png.h>\n#include <OpenEXR/ImfHeader.h>\n", [2]),
    "Quake/audio/a_bench.cpp": ("#include <sndfile.h>\n#include <libopenmpt/libopenmpt.hpp>\n#include <fftw3.h>\n", [3]),
    "Quake/extra/a.cpp": ("", [1]),
    "Quake/server/server.cpp": ('#include "server/clients/c.h"\n#include "server/attic/a.h"\n', [2]),
    "Quake/server/clients/c.h": ('#include "server/simulation/s.h"\n#include "server/clients/d.h"\n', []),
    "Quake/server/simulation/s.cpp": ('#include "server/clients/c.h"\n#include "server/server.h"\n', [1, 2]),
    "Quake/server/simulation/s_test.cpp": ('#include "server/clients/c.h"\n', []),
    "Quake/server/attic/a.h": ("", [1]),
    "Quake/render/CMakeLists.txt": (
        "fb_module(render\n  LINKS fb_gpu fb_net fb_scene\n  PRIVATE_LINKS fb_client\n  TEST_LINKS fb_world fb_host)\n",
        [2, 3, 4],
    ),
    "Quake/scene/CMakeLists.txt": ("fb_module(scene SOURCES a.cpp\n  LINKS fb_world fb_render # fb_host\n)\n", [2]),
    "Shaders/shared/a.h": ('#include "shared/b.h"\n#include "lib/trace.glsl"\n', [2]),
    "Shaders/lib/a.glsl": ('#include "shared/b.h"\n#include "lib/b.glsl"\n#include "passes/c.glsl"\n', [3]),
    "Shaders/estimators/pt/pt.comp": ('#include "lib/a.glsl"\n#include "estimators/rival/r.glsl"\n', [2]),
    "Quake/render/techniques/rival_two.cpp": ('    .stands_on = "pt"};\n', []),
    "Shaders/estimators/rival_two/g.glsl": (
        '#include "estimators/pt/a.glsl"\n#include "estimators/rival/a.glsl"\n#include "estimators/nee/a.glsl"\n',
        [3],
    ),
    "Shaders/estimators/rival/m.glsl": ('#include "estimators/rival_two/g.glsl"\n', [1]),
    "Shaders/passes/a.comp": ('#include "lib/a.glsl"\n#include "estimators/pt/pt.comp"\n', [2]),
}


def self_test():
    expected = set()
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, (text, lines) in SELF_TEST.items():
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
            expected |= {f"{name}:{line}" for line in lines}
        found = {":".join(break_.split(":")[:2]) for break_ in check(root)}
    for name in sorted(expected - found):
        print(f"check_layers: self-test: {name} breaks a rule and was not found")
    for name in sorted(found - expected):
        print(f"check_layers: self-test: {name} breaks no rule and was reported")
    return expected == found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent)
    parser.add_argument("--self-test", action="store_true")
    arguments = parser.parse_args()
    if arguments.self_test:
        return 0 if self_test() else 1
    breaks = check(arguments.root)
    for break_ in breaks:
        print(break_)
    if not breaks:
        print("check_layers: every include and link follows the layers")
    return 1 if breaks else 0


if __name__ == "__main__":
    sys.exit(main())
