// Steps `proposal`, `direct` and `control`: a vertex is split into what probes know, which is added without noise, and
// the rest.
#ifndef FB_DDGI_PROPOSAL
#define FB_DDGI_PROPOSAL
#include "estimators/ddgi/steps/cells.glsl"
#include "estimators/ddgi/steps/field.glsl"
#include "lib/frozen.glsl"
#include "lib/look_for_light.glsl"

struct Guidance {
  uint kind;
  float direct_share;  // how often a direction is drawn that sees what falls straight on the vertex
  float pdf;
  FrozenDirections around;  // what a probe says of the directions about the vertex
  bool controlled, guided;  // and what that is for
};

// The part of a vertex that directions are drawn of.
Vertex drawn_part(Vertex v, Guidance g) {
  if (FEATURE_SPECULAR && (g.kind == kCoat || g.kind == kMirrored)) v.scatter.bsdf = coat_of(v.scatter.bsdf);
  return v;
}
// And that lights are looked for at.
Vertex lit_part(Vertex v, Guidance g) {
  if (FEATURE_SPECULAR && g.kind == kCoat) v.scatter.bsdf = coat_of(v.scatter.bsdf);
  return v;
}
Turns turns_of(Guidance g) { return Turns(1.0, g.direct_share); }

void prepare(Vertex v, Field here, inout Path path, inout uint rng, out Guidance g) {
  g.direct_share = 1.0;
  g.pdf = 0.0;
  if (kPlus) {
    g.kind = here.known ? (has_coat(v) ? kCoat : kEnds) : kWhole;
  } else {
    g.kind = here.known ? kDirect : kWhole;
    if (here.known && has_coat(v)) {
      g.direct_share = 0.5;
      if (rng_uniform(rng) >= g.direct_share) g.kind = kMirrored;
    }
  }
  g.around = directions_about(v, here.probe, path.own.rng);
  g.controlled = ddgi.ddgi_control != 0 && g.around.luminance > 0.0;
  g.guided = ddgi.ddgi_guide > 0.0 && g.around.luminance > 0.0;
  path.own.kind = g.kind;
  path.own.entered = true;
  path.own.from = v.position;
}

Proposal propose(Vertex v, inout Guidance g, inout uint rng) {
  Proposal p;
  if (g.guided) {
    FrozenProposal q = propose_frozen(v, g.around, true, 1.0 - ddgi.ddgi_guide, rng);
    p = proposed(q.direction, q.f, q.pdf, q.flags);
  } else {
    p = propose_scattered(drawn_part(v, g), rng);
  }
  if (g.kind == kEnds) p.weight = vec3(0.0);
  if (g.kind == kMirrored) p.weight /= 1.0 - g.direct_share;
  g.pdf = p.pdf;
  return p;
}
float proposal_pdf(Vertex v, Guidance g, vec3 direction, float scatter_pdf) {
  return proposed_pdf(g.around, g.guided, 1.0 - ddgi.ddgi_guide, direction, scatter_pdf) * g.direct_share;
}

const bool kLooksForLight = true;

Direct look_for_light(Vertex v, inout Guidance g, inout Path path, inout uint rng) {
  path.own.pdf = g.pdf;
  Vertex lit = lit_part(v, g);
  Aim aim = aim_at_light(lit, turns_of(g), rng);
  if (g.kind == kEnds) aim.weight = 0.0;
  return light_of_aim(lit, aim, proposal_pdf(lit, g, aim.direction, aim.bsdf_pdf), rng);
}

float met_share(Vertex v, Segment way, Proposal p, vec3 emission, inout Path path) {
  if (path.own.kind == kMirrored) return 0.0;
  bool in_turns = path.own.kind == kDirect && has_coat(v);
  return met_share_of(v, way, p, emission, Turns(1.0, in_turns ? 0.5 : 1.0));
}

Direct last_light(Vertex v, inout Path path, inout uint rng) { return light_in_turns(v, rng); }

vec3 lambert_part(Vertex v) {
  return diffuse_reflectance(v.scatter.bsdf, max(dot(v.view, v.scatter.shading_normal), 0.0));
}

const bool kHasControl = true;

// A control variate (Section 5.1) is the Lambert part's reflection of light that is even within cells of the
// hemisphere.
vec3 control_mean(Vertex v, Guidance g, Field here) {
  if (g.controlled) return lambert_part(v) * g.around.mean;
  return g.kind == kWhole ? vec3(0.0) : g.kind == kEnds ? here.all : here.diffuse;
}
vec3 control_at(Vertex v, Guidance g, Field here, vec3 direction) {
  if (!g.controlled) return vec3(0.0);
  return lambert_part(v) * light_about(g.around, direction) *
         (max(dot(direction, v.scatter.shading_normal), 0.0) / kPiShared);
}
#endif
