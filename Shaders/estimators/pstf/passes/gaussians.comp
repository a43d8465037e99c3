// Teaches mixtures of Gaussians the frame's samples by one step of stepwise EM (Pantaleoni 2020, Section 2.6.1), in the
// cells that the fields' pass has just folded. Both ways to run it in parallel give the same sums but for rounding:
//
//   a lane of a Gaussian   takes the cell's samples in turns; the Gaussians' densities meet in shared memory (Eq. 18)
//   a lane of a sample     what is left of a sample at the frame's end is the exponential of a sum of logarithms over
//                          those after it (Eq. 19 to 21, which is printed without the logarithm), by prefix sums over
//                          the cell's places; then sums over these
//
// Responsibilities are of the mixture that the frame's paths drew from, so that no sample waits for another.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "estimators/pstf/pstf_gaussians.h"
#include "estimators/pstf/steps/cells.glsl"

layout(constant_id = kSpecLaneOfSample) const bool LANE_OF_SAMPLE = false;
layout(constant_id = kSpecGaussians) const uint COUNT = 8u;
FB_TECHNIQUE_ARRAY(kPstfGaussians, 16, , PstfGaussianArray, vec4, pstf_gaussians)
FB_TECHNIQUE_ARRAY(kPstfGaussianSums, 16, , PstfGaussianSumArray, vec4, pstf_gaussian_sums)
FB_TECHNIQUE_ARRAY(kPstfSamples, 4, , PstfSampleArray, uint, pstf_samples)

const uint kLanes = 64u, kCellsAtOnce = kLanes / kGaussianPlaces;
layout(local_size_x = 64) in;

shared float densities[2u * kLanes];
shared Gaussian mixtures[kCellsAtOnce * kMostGaussians];
shared float shares[kLanes * kMostGaussians];  // responsibilities
shared uint ranks[2u * kLanes];
shared float logarithms[2u * kLanes];
shared vec4 partial_a[kLanes], partial_b[kLanes];

Gaussian load_gaussian(uint at) {
  vec4 a = pstf_gaussians.at[2u * at], b = pstf_gaussians.at[2u * at + 1u];
  return Gaussian(a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w);
}
void store_gaussian(uint at, Gaussian g) {
  pstf_gaussians.at[2u * at] = vec4(g.scale, g.x, g.over_x, g.y);
  pstf_gaussians.at[2u * at + 1u] = vec4(g.over_y, g.slope, g.weight, g.seen);
}
GaussianSums load_sums(uint at) {
  return GaussianSums(pstf_gaussian_sums.at[2u * at], pstf_gaussian_sums.at[2u * at + 1u]);
}
void store_learnt(uint at, uint i, GaussianSums sums, float seen) {
  pstf_gaussian_sums.at[2u * at] = sums.a;
  pstf_gaussian_sums.at[2u * at + 1u] = sums.b;
  Gaussian g = learnt_gaussian(sums, i, COUNT);
  g.seen = seen;
  store_gaussian(at, g);
}

// A cell of the frame's list.
struct Learner {
  bool exists, fresh;  // fresh: it has just been given away
  uint slot;
  float seen;  // samples before
};
Learner learner(uint listed) {
  uint touched = pstf_sums.at[pstf_count_at(pstf.frame_number)];
  Learner l;
  l.exists = listed < touched;
  l.slot = l.exists ? pstf_sums.at[pstf_list_at() + listed] : 0u;
  uvec4 head = pstf_cells.at[l.slot * (kPstfCellWords / 4u)];
  float crowd = uintBitsToFloat(head.z), taught = uintBitsToFloat(head.w);
  l.fresh = l.exists && taught == 0.0;
  // As many samples as in this frame: there were none before, or what they taught has changed.
  l.seen = taught > crowd ? pstf_gaussians.at[2u * l.slot * COUNT + 1u].w : 0.0;
  return l;
}
// A cell's memory is limited to a window of frames, here as well.
float most_seen() { return pstf.pstf_window * float(kGaussianPlaces); }
float step_of(Learner l, uint rank) { return gaussian_step(min(l.seen + float(rank) + 1.0, most_seen())); }

void store_first(uint at, uint i) {
  store_gaussian(at, first_gaussian(i, COUNT));
  pstf_gaussian_sums.at[2u * at] = pstf_gaussian_sums.at[2u * at + 1u] = vec4(0.0);
}

void learn_by_gaussians(uint first_listed) {
  uint lane = gl_LocalInvocationIndex, i = lane % COUNT, first_lane = lane - i;
  Learner l = learner(first_listed + lane / COUNT);
  uint at = l.slot * COUNT + i, rank = 0u;
  Gaussian g = l.fresh ? first_gaussian(i, COUNT) : load_gaussian(at);
  GaussianSums sums = l.fresh ? no_sums() : load_sums(at);
  for (uint place = 0u; place < kGaussianPlaces; ++place) {
    uint word = l.exists ? pstf_samples.at[l.slot * kGaussianPlaces + place] : 0u, half_of = (place & 1u) * kLanes;
    vec2 p = word_place(word);
    float density = gaussian_density(g, p), all = 0.0;
    densities[half_of + lane] = density;
    barrier();
    for (uint k = 0u; k < COUNT; ++k) all += densities[half_of + first_lane + k];
    float step = step_of(l, rank);
    GaussianSums next =
        joined_sums(sums, 1.0 - step, sample_sums(p, word_weight(word), responsibility_of(density, all, COUNT), step));
    if (word != 0u) {
      sums = next;
      ++rank;
    }
  }
  barrier();
  if (!l.exists) return;
  for (uint place = i; place < kGaussianPlaces; place += COUNT) pstf_samples.at[l.slot * kGaussianPlaces + place] = 0u;
  if (l.fresh)
    store_first(at, i);
  else if (rank > 0u)
    store_learnt(at, i, sums, min(l.seen + float(rank), most_seen()));
}

void learn_by_samples(uint first_listed) {
  uint lane = gl_LocalInvocationIndex, cell = lane / kGaussianPlaces, place = lane % kGaussianPlaces;
  Learner l = learner(first_listed + cell);
  uint sample_at = l.slot * kGaussianPlaces + place, word = l.exists ? pstf_samples.at[sample_at] : 0u;
  vec2 p = word_place(word);

  // How many samples come before, then what is left of each.
  if (place < COUNT) mixtures[cell * kMostGaussians + place] = load_gaussian(l.slot * COUNT + place);
  ranks[lane] = word != 0u ? 1u : 0u;
  uint from = 0u;
  for (uint by = 1u; by < kGaussianPlaces; by *= 2u) {
    barrier();
    ranks[(kLanes - from) + lane] = ranks[from + lane] + (place >= by ? ranks[from + lane - by] : 0u);
    from = kLanes - from;
  }
  barrier();
  uint end = from + cell * kGaussianPlaces + kGaussianPlaces - 1u, rank = ranks[from + lane], samples = ranks[end];
  float step = step_of(l, max(rank, 1u) - 1u);
  logarithms[lane] = word != 0u ? log(1.0 - step) : 0.0;
  from = 0u;
  for (uint by = 1u; by < kGaussianPlaces; by *= 2u) {
    barrier();
    logarithms[(kLanes - from) + lane] = logarithms[from + lane] + (place >= by ? logarithms[from + lane - by] : 0.0);
    from = kLanes - from;
  }
  barrier();
  end = from + cell * kGaussianPlaces + kGaussianPlaces - 1u;
  float left = exp(logarithms[end] - logarithms[from + lane]), left_of_former = exp(logarithms[end]);

  // Responsibilities of all Gaussians for this lane's sample.
  float all = 0.0;
  for (uint k = 0u; k < COUNT; ++k) {
    float density = gaussian_density(mixtures[cell * kMostGaussians + k], p);
    shares[lane * kMostGaussians + k] = density;
    all += density;
  }
  for (uint k = 0u; k < COUNT; ++k)
    shares[lane * kMostGaussians + k] = responsibility_of(shares[lane * kMostGaussians + k], all, COUNT);
  // Of this sample, for a responsibility of 1: the others' are in proportion.
  GaussianSums own = sample_sums(p, word_weight(word), 1.0, step);
  partial_a[lane] = word != 0u ? own.a * left : vec4(0.0);
  partial_b[lane] = word != 0u ? own.b * left : vec4(0.0);
  barrier();

  // Sums over the samples: a Gaussian's lanes take some of them each, then join.
  uint lanes = kGaussianPlaces / COUNT, i = place / lanes, part = place % lanes;
  vec4 a = vec4(0.0), b = vec4(0.0);
  for (uint k = 0u; k < COUNT; ++k) {
    uint of = cell * kGaussianPlaces + part * COUNT + k;
    float share = shares[of * kMostGaussians + i];
    a += share * partial_a[of];
    b += vec4(share, share, 1.0, 1.0) * partial_b[of];
  }
  barrier();
  partial_a[lane] = a;
  partial_b[lane] = b;
  for (uint by = lanes / 2u; by > 0u; by /= 2u) {
    barrier();
    if (part < by) {
      partial_a[lane] += partial_a[lane + by];
      partial_b[lane] += partial_b[lane + by];
    }
  }
  if (l.exists) pstf_samples.at[sample_at] = 0u;
  uint at = l.slot * COUNT + i;
  if (l.exists && part == 0u && l.fresh) store_first(at, i);
  if (l.exists && part == 0u && !l.fresh && samples > 0u)
    store_learnt(at, i, joined_sums(load_sums(at), left_of_former, GaussianSums(partial_a[lane], partial_b[lane])),
                 min(l.seen + float(samples), most_seen()));
  barrier();
}

void main() {
  uint touched = pstf_sums.at[pstf_count_at(pstf.frame_number)];
  uint at_once = LANE_OF_SAMPLE ? kCellsAtOnce : kLanes / COUNT;
  for (uint first = gl_WorkGroupID.x * at_once; first < touched; first += gl_NumWorkGroups.x * at_once) {
    if (LANE_OF_SAMPLE)
      learn_by_samples(first);
    else
      learn_by_gaussians(first);
    barrier();
  }
}
