// FLIP: the difference that a person sees who flips between two pictures; 0 for none, 1 at most, per pixel.
// LDR-FLIP: Andersson 2020. HDR-FLIP: Andersson 2021, which takes LDR-FLIP at several exposures and keeps each pixel's
// largest. Written from the papers; the pieces stand here by themselves so that each can be tested.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lab/picture.h"

namespace fb::lab::flip {

// What the papers assume: 0.7 m from a screen 0.7 m wide with 3840 pixels.
constexpr double kPixelsPerDegree = 67.0206432765823;

// Per pixel, row-major. Both pictures of one size; values are cut to [0, 1], linear.
std::vector<float> ldr_flip(const Picture& reference, const Picture& test, double pixels_per_degree = kPixelsPerDegree);

// In stops: from the one that brings the brightest luminance of the reference to 0.85 of the tone mapper's range to the
// one that brings its median there; one a stop, at least two (Andersson 2021, Section 3). Departure: a median of zero
// counts as 2^-16 of the maximum, where the paper has no answer.
struct Exposures {
  double start = 0, stop = 0;
  int count = 2;
  double at(int index) const { return start + (stop - start) * index / (count - 1); }
};
Exposures choose_exposures(const Picture& reference);
std::vector<float> hdr_flip(const Picture& reference, const Picture& test, const Exposures& exposures,
                            double pixels_per_degree = kPixelsPerDegree);

double mean_of(const std::vector<float>& map);  // pooling, as the papers compare pictures; 0 for an empty one

// --- the pieces ---

vec3 linear_to_ycxcz(const vec3& rgb);  // opponent colours, linear in XYZ: Y 0..100 for greys, Cx red-green, Cz
vec3 ycxcz_to_linear(const vec3& ycxcz);
vec3 linear_to_hunt_lab(const vec3& rgb);        // CIELAB (D65), a and b times L/100: Hunt's effect
float hyab(const vec3& lab1, const vec3& lab2);  // |dL| + |d(a,b)|
float redistribute(float hyab_difference);       // to [0, 1] (Andersson 2020, Section 4.1.3)
float aces(float radiance);                      // the tone mapper of Andersson 2021, to [0, 1]
float aces_inverse(float shown);

// Weights of a separable filter at offsets -r..r.
using Kernel = std::vector<float>;
// Contrast sensitivity in space (Andersson 2020, Table 1): an isotropic sum of Gaussians; each term is kernel x kernel,
// and all terms together sum to one. Channels: 0 achromatic, 1 red-green, 2 blue-yellow.
struct SensitivityTerm {
  float weight;
  Kernel kernel;  // sums to one
};
std::vector<SensitivityTerm> sensitivity(int channel, double pixels_per_degree);
// Edges (first derivative) and points (second) of the width of a feature, 0.082 degrees: `smooth` across sums to one,
// the positive and the negative weights of `detect` to 1 and -1.
struct FeatureKernels {
  Kernel smooth, edge, point;
};
FeatureKernels feature_kernels(double pixels_per_degree);

}  // namespace fb::lab::flip
