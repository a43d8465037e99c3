#!/usr/bin/env python3
"""Begins a new estimator: writes its folder, Shaders/estimators/NAME (shader, proposal, page), and its row in
Quake/render/techniques/techniques.cpp. What it writes builds, draws and is unbiased: change its proposal from there.

Every estimator that its row calls unbiased is held to pt's mean by lab_test (UnbiasedTest, suite Every).
"""
import argparse
import pathlib
import re
import sys

SHADER = """// Technique `{name}`: {description}. Unbiased for paths of at most frame.bounces
// reflections.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "lib/steps/one_path.glsl"
#include "lib/steps/no_field.glsl"
#include "estimators/{name}/propose.glsl"
#include "lib/steps/no_direct.glsl"
#include "lib/steps/no_learning.glsl"
#include "lib/steps/no_views.glsl"

#include "lib/paths_main.glsl"
"""

PROPOSE = """// Step `proposal` of `{name}`: half of the directions from the vertex's own scattering, half uniform over the hemisphere;
// each is weighted by the density of both together.
#include "lib/path_state.glsl"

struct Guidance {{
  uint none;
}};
void prepare(Vertex v, Field here, inout Path path, inout uint rng, out Guidance g) {{ g.none = 0u; }}

// Density of propose in any direction.
float proposal_pdf(Vertex v, Guidance g, vec3 direction) {{
  float scattered;
  scatter_eval(v.scatter, v.view, direction, scattered);
  float uniform_pdf = dot(direction, v.scatter.shading_normal) > 0.0 ? 1.0 / (2.0 * kPiShared) : 0.0;
  return 0.5 * (scattered + uniform_pdf);
}}

Proposal propose(Vertex v, inout Guidance g, inout uint rng) {{
  Proposal p;
  vec2 w = vec2(rng_uniform(rng), rng_uniform(rng));
  p.direction = scatter_sample(v.scatter, v.view, vec3(w, rng_uniform(rng))).direction;
  p.flags = 0u;
  vec2 u = vec2(rng_uniform(rng), rng_uniform(rng));
  if (rng_uniform(rng) < 0.5) {{
    float r = sqrt(max(1.0 - u.x * u.x, 0.0)), phi = 2.0 * kPiShared * u.y;
    p.direction = frame_about(v.scatter.shading_normal) * vec3(r * cos(phi), r * sin(phi), u.x);
  }}
  float scattered, pdf = proposal_pdf(v, g, p.direction);
  vec3 f = scatter_eval(v.scatter, v.view, p.direction, scattered);
  p.weight = pdf > 0.0 ? f / pdf : vec3(0.0);
  return p;
}}
"""

PAGE = """# `{name}`

{description}.

- **Bias:** none, for paths of at most `r_bounces` reflections: each direction's weight is `f cos / pdf` of the density that
  both ways of sampling have together.
- **Choose it:** `r_estimator {name}`; in the laboratory `--estimator {name}`.
- **Hold it to `pt`:** `build/fullbright-lab ztest --scene kinds --estimator {name}`.
- **Measure it:** `build/fullbright-lab bench --scene kinds --config pt --config {name}`.
"""

ROW = """      {{.name = "{name}",
       .description = "{description}; unbiased for paths of at most r_bounces reflections",
       .bias = Bias::kUnbiased,
       .make = make_path_technique}},
"""


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("name", help="lower case letters, digits and _: the folder, the shader and r_estimator's value")
    parser.add_argument("--description", default="the BSDF's directions and uniform ones, mixed",
                        help="one phrase, without a full stop")
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent,
                        help="the checkout (default: this one)")
    options = parser.parse_args()
    if not re.fullmatch(r"[a-z][a-z0-9_]{0,30}", options.name):
        print(f"new_estimator: '{options.name}' is no name: lower case letters, digits and _ after a letter, up to 31",
              file=sys.stderr)
        return 2
    folder = options.root / "Shaders" / "estimators" / options.name
    table = options.root / "Quake" / "render" / "techniques" / "techniques.cpp"
    rows = table.read_text()
    if folder.exists() or f'.name = "{options.name}"' in rows:
        print(f"new_estimator: there is an estimator {options.name} already", file=sys.stderr)
        return 2
    end = "  };\n  return list;"
    if rows.count(end) != 1:
        print(f"new_estimator: {table} has no list that ends as '}};' before 'return list;'", file=sys.stderr)
        return 1
    values = {"name": options.name, "description": options.description}
    folder.mkdir(parents=True)
    (folder / f"{options.name}.comp").write_text(SHADER.format(**values))
    (folder / "propose.glsl").write_text(PROPOSE.format(**values))
    (folder / "README.md").write_text(PAGE.format(**values))
    table.write_text(rows.replace(end, ROW.format(**values) + end))
    print(f"wrote {folder} and its row in {table}")
    print("next: build, then look at  build/fullbright-lab render --scene kinds --estimator " + options.name)
    return 0


if __name__ == "__main__":
    sys.exit(main())
