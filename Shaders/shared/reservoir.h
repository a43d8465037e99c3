// Weighted reservoirs for resampled importance sampling over pixels and frames (ReSTIR: Bitterli 2020; Wyman and
// Panteleev 2021; its generalisation: Lin 2022; in the notation of Wyman 2023). A reservoir selects one of a stream of
// samples, each with a chance in proportion to its resampling weight, and has W, an estimate of one over the density of
// the selected: f(sample) W estimates the integral of f. The sample itself is the technique's, which copies its own
// where an update says that the new one was selected.
//
//   candidates of one pdf   update_reservoir(r, target / pdf, target, 1, u) of each, finish_reservoir(r, 1 / number)
//   reservoirs              merge_reservoir of each with its MIS weight, finish_reservoir(r, 1)
//
// Unbiased if the MIS weights of all that could have brought a sample add up to 1 at it, if confidences do not depend
// on the samples, and if the canonical reservoir, which was made here, has a target above zero wherever f is not zero.
#ifndef FB_SHARED_RESERVOIR_H
#define FB_SHARED_RESERVOIR_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

// Weights and target values are 0 or within these; all else (negative, not a number, infinite, beyond) counts as 0, so
// that none reaches a sum. Targets from 1e-24 to 1e24 leave room for confidences and for 1 / pdf.
FB_CONST float kReservoirLeast = 1e-30f, kReservoirMost = 1e30f;
FB_CONST float kMostConfidence = 65504.0f;  // of a half; and 2^24 such sums are finite

FB_FN float reservoir_number(float x) { return x >= kReservoirLeast && x <= kReservoirMost ? x : 0.0f; }

struct Reservoir {
  float weight_sum;           // of resampling weights w_i
  float target;               // p-hat of the selected sample where the reservoir is; 0: none is selected
  float confidence;           // M, c in Lin 2022: candidates that it stands for, 0 to kMostConfidence
  float contribution_weight;  // W, 1 over the measure's unit; finish_reservoir sets it
};

FB_FN Reservoir empty_reservoir() {
  Reservoir r;
  r.weight_sum = r.target = r.confidence = r.contribution_weight = 0.0f;
  return r;
}

FB_FN float reservoir_confidence(float confidence) {
  return confidence > 0.0f ? min(confidence, kMostConfidence) : 0.0f;
}

// One more sample, of resampling weight `weight` and target value `target`, which stands for `confidence` candidates
// (Chao 1982; Bitterli 2020, Alg. 2). True: it is selected, with probability weight / sum of weights so far. A sample
// of weight or target 0 is never selected, but its confidence counts. u in [0, 1), its own for each sample; chances
// below its step are drawn as one step (2^-24 for rng_uniform).
FB_FN bool update_reservoir(FB_INOUT(Reservoir, r), float weight, float target, float confidence, float u) {
  target = reservoir_number(target);
  weight = target > 0.0f ? reservoir_number(weight) : 0.0f;
  r.weight_sum += weight;
  r.confidence = min(r.confidence + reservoir_confidence(confidence), kMostConfidence);
  bool selected = u * r.weight_sum < weight;
  if (selected) r.target = target;
  return selected;
}

// Another reservoir's selected sample, moved here by a shift mapping: w = m p-hat W |dT/dx| (Lin 2022). `mis`:
// its MIS weight; `target`: of the moved sample here; `jacobian`: measure here over measure there, 1 for a point that
// is kept, 0 where the shift does not exist.
FB_FN bool merge_reservoir(FB_INOUT(Reservoir, r), Reservoir other, float mis, float target, float jacobian, float u) {
  float moved = reservoir_number(other.contribution_weight) * jacobian;
  return update_reservoir(r, mis * target * moved, target, other.confidence, u);
}

// At most so many candidates, before it is merged: a history that stands for more would outweigh what is new, and what
// it shares with its neighbours would grow (Bitterli 2020, Section 5). Needs no correction.
FB_FN void cap_confidence(FB_INOUT(Reservoir, r), float most) {
  r.confidence = min(r.confidence, reservoir_confidence(most));
}

// W = share * sum of weights / p-hat (Bitterli 2020, Alg. 3; Lin 2022); 0 where nothing is selected. `share`: 1 where
// MIS weights were in the resampling weights; else what takes their place.
FB_FN void finish_reservoir(FB_INOUT(Reservoir, r), float share) {
  r.contribution_weight = r.target > 0.0f ? reservoir_number(r.weight_sum * share / r.target) : 0.0f;
}

// --- MIS weights ---
// Of the sample y of reservoir i, moved here. Those that ask for targets want p-hat_<-j(y): the target where reservoir
// j was made, of y moved there, times the inverse shift's Jacobian (measure there over measure here); 0 where y cannot
// be moved there (Lin 2022). For a weight that claims no bias it must be the very function that chose there: with a ray
// in it only if the ray is traced in the scene of then. All are 0 to 1, and 0 where nothing could have brought y.

// By confidence alone, m = c_i / sum of c: Bitterli 2020, Alg. 4, 1 / M. Biased: too dark where some target is zero.
FB_FN float mis_by_confidence(float confidence, float confidences) {
  return confidences > 0.0f ? min(reservoir_confidence(confidence) / confidences, 1.0f) : 0.0f;
}

// Counted, 1 / Z (Bitterli 2020, Alg. 6). No bias, and noise where the targets of reservoirs differ much. Resampling
// weights take the confidence for `mis`; then, of the selected sample, every reservoir that could have brought it
// counts: share = 1 / sum of counted_confidence.
FB_FN float counted_confidence(float confidence, float target) {
  return reservoir_number(target) > 0.0f ? reservoir_confidence(confidence) : 0.0f;
}
FB_FN float counted_share(float counted) { return counted > 0.0f ? 1.0f / counted : 0.0f; }

// Generalised balance heuristic, m = c_i p-hat_<-i(y) / sum over j of c_j p-hat_<-j(y) (Lin 2022, with
// confidences). No bias; n targets for each of n samples. The sum is of mis_score over all j, i among them.
FB_FN float mis_score(float confidence, float target) {
  return reservoir_number(reservoir_confidence(confidence) * reservoir_number(target));
}
FB_FN float mis_balance(float score, float scores) { return scores > 0.0f ? min(score / scores, 1.0f) : 0.0f; }

// Pairwise (Bitterli 2022; with confidences: Lin 2022, Wyman 2023): each of the others is held against the canonical
// reservoir alone, so that n samples need 2 n targets. No bias. `defensive`, 0 to 1, is the canonical sample's whatever
// the targets are: the course's is its share of all confidences, Bitterli's 0.
struct PairwiseMis {
  float canonical, others;  // confidences: of the canonical reservoir, and the sum of all others'
  float defensive;
};
FB_FN PairwiseMis pairwise_mis(float canonical, float others, float defensive) {
  PairwiseMis p;
  p.canonical = reservoir_confidence(canonical);
  p.others = max(others, 0.0f);
  p.defensive = p.others > 0.0f ? clamp(defensive, 0.0f, 1.0f) : 1.0f;
  return p;
}
FB_FN float defensive_share(float canonical, float others) {
  return mis_by_confidence(canonical, reservoir_confidence(canonical) + max(others, 0.0f));
}
// The share of the pair (i, canonical) in all, and what of it is i's at a sample with these targets.
FB_FN float pair_share(PairwiseMis p, float confidence) {
  return (1.0f - p.defensive) * mis_by_confidence(confidence, p.others);
}
FB_FN float pair_balance(PairwiseMis p, float target, float canonical_target) {
  float score = reservoir_number(p.others * reservoir_number(target));
  return mis_balance(score, score + mis_score(p.canonical, canonical_target));
}
// Of another's sample y. `target`: p-hat_<-i(y); `canonical_target`: p-hat of y here.
FB_FN float mis_pairwise(PairwiseMis p, float confidence, float target, float canonical_target) {
  return pair_share(p, confidence) * pair_balance(p, target, canonical_target);
}
// Of the canonical sample y: p.defensive and, for each of the others, this.
FB_FN float mis_pairwise_canonical(PairwiseMis p, float confidence, float target, float canonical_target) {
  return pair_share(p, confidence) * (1.0f - pair_balance(p, target, canonical_target));
}

// --- packing ---
// A finished reservoir in 8 bytes: W as it is; target in 8 bits of exponent and 8 of mantissa (to nearest, within
// 2^-9); confidence as a half: whole numbers to 2048 exactly, others within 2^-10. The sum of weights comes back as W
// times the packed target: what was unpacked is for merging, not for more updates. MIS weights that claim no bias must
// have targets that are all exact or all packed: p-hat_<-i from here and the others anew do not add up to 1 by 2^-9.
FB_FN uvec2 pack_reservoir(Reservoir r) {
  uint target = (floatBitsToUint(reservoir_number(r.target)) + 0x4000u) >> 15u;
  uint confidence = packHalf2x16(vec2(reservoir_confidence(r.confidence), 0.0f)) & 0xffffu;
  return uvec2(floatBitsToUint(reservoir_number(r.contribution_weight)), target << 16u | confidence);
}
FB_FN Reservoir unpack_reservoir(uvec2 packed_) {
  Reservoir r;
  r.contribution_weight = reservoir_number(uintBitsToFloat(packed_.x));
  r.target = reservoir_number(uintBitsToFloat((packed_.y >> 16u) << 15u));
  r.confidence = unpackHalf2x16(packed_.y & 0xffffu).x;
  r.weight_sum = reservoir_number(r.contribution_weight * r.target);
  return r;
}

FB_NAMESPACE_END
#endif
