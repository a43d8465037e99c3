// Step `learning` of paths that are guided and reuse: as mcpg's, and the sample that a pixel's reservoir of light of
// two reflections held in the former frame teaches a lobe of the first vertex (after ReSTIR PG, Zeng 2025, whose lobes
// learn of resampled paths).
#ifndef FB_RESTIR_GUIDED_LEARN
#define FB_RESTIR_GUIDED_LEARN
#include "estimators/mcpg/steps/learn.glsl"
#include "estimators/restir/steps/fresh.glsl"
#include "lib/former.glsl"

// The reservoir is that of the same pixel of the picture, whatever it showed: its sample is weighed anew here, and W,
// which may be another vertex's, only says how much a lobe learns.
void learn_besides(Vertex v, Guidance g, Path path, inout uint rng) {
  bool asks = restir.restir_teach != 0 && restir.former_indirect != kNoIndex && !IN_MEDIUM && path.depth == 0u &&
              path.own.reused.reuses && !g.last;
  if (!asks || guide.mc_paper != 0) return;
  IndirectReservoir r = FB_LOAD_INDIRECT(indirect_reservoirs, restir.former_indirect + lit_index(path.pixel));
  if (r.chosen.instance == kNoIndex || !(r.weight > 0.0)) return;
  r.chosen.instance = instance_now(r.chosen.instance);
  IndirectPoint p = indirect_point(r.chosen);
  IndirectWay w = indirect_way(domain_of(v, false), p);
  float score = reservoir_number(w.target * r.weight / 3.0);  // of three channels
  if (!(score > 0.0)) return;
  g.choice.state = kNoIndex;
  g.guided_pdf = mixture_pdf(g, w.direction, g.slot);
  scatter_eval(v.scatter, v.view, w.direction, g.bsdf_pdf);
  g.pdf = share_pdf(g, g.guided_pdf, g.bsdf_pdf);
  Transition t;
  if (bucket_transition(v, g, p.place, score, 0.0, rng, t))
    update_state(v, t, p.place, hit_velocity(p.second, p.place), false, score, 0.0, vertex_number(path));
}
#endif
