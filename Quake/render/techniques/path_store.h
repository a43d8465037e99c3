// Paths that brought light, kept until the densities of all iterations are known, and the pictures of iterations that
// they are weighed in (Fan 2025, Sections 3.4 and 3.5).
//
// What a picture shows is the mean of all frames, which has light of every kind, and for each kept path the difference
// that its weight makes to that mean. So what is not stored counts as it does without weights, and paths that bring
// nothing are not stored. A path is weighed anew at each vertex that light was met from: the densities of the vertices
// before it are those of a path of its own.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/bytes.h"
#include "base/maths.h"
#include "render/techniques/guiding_trees.h"

namespace fb::render {

struct PathVertex {
  vec3 position;
  float scatter_pdf = 0;  // of the direction, by the vertex's own scattering alone
  vec3 direction;         // in which the path went on: not to be had from positions, since rays bend in water
  float guided = 0;       // 1: the distribution of the place had its share; 0: never has
  vec3 light;             // that the picture's pixel got from what was met there
  float pdf = 0;          // of the direction, as the device drew it
};

class PathStore {
 public:
  struct Path {
    std::uint32_t pixel, iteration, first, count;  // vertices
    float importance;                              // luminance of all its light
  };
  // From the first vertex to the last that met light; a path without light is not stored.
  void add(std::uint32_t pixel, std::uint32_t iteration, std::span<const PathVertex> vertices);
  // Lets the least important go, of those equally important the latest, until they fit; calls `gone` with each before.
  // What is kept is what a heap of this size would keep (Section 3.5).
  void shrink(std::uint64_t bytes, const std::function<void(const Path&)>& gone);
  void clear() { *this = PathStore(); }

  std::uint64_t bytes() const { return paths_.size() * sizeof(Path) + vertices_.size() * sizeof(PathVertex); }
  void save(Bytes& state) const;
  // False, and nothing stored: the bytes are not whole, or of other pixels or iterations.
  bool load(ByteReader& state, std::size_t pixels, std::size_t iterations);

  const std::vector<Path>& paths() const { return paths_; }
  std::span<const PathVertex> vertices(const Path& path) const { return {&vertices_[path.first], path.count}; }

 private:
  std::vector<Path> paths_;
  std::vector<PathVertex> vertices_;
};

// Density of a vertex's direction in iteration `k`, from 0, of which the first has no distribution but the vertex's own
// scattering. `defence`: the share of that in all others.
double vertex_density(const GuidingTrees& trees, std::uint32_t leaf, std::uint32_t k, const PathVertex& vertex,
                      float defence);

// Vertices whose density in their own iteration, asked anew, is off by more than kDensityError of what it was drawn
// with: next to none, where a direction lies on the edge of a distribution's part.
std::uint32_t other_densities(const GuidingTrees& trees, std::span<const PathVertex> vertices, std::uint32_t own,
                              float defence);
constexpr double kDensityError = 1e-4;

// Calls `each` for every vertex that met light with ln(p_k / p_own) of the path to it, for `iterations` iterations.
void for_each_ratio(const GuidingTrees& trees, std::span<const PathVertex> vertices, std::uint32_t own,
                    std::uint32_t iterations, float defence,
                    const std::function<void(const PathVertex&, std::span<const double>)>& each);

// How pictures of iterations are combined: r_mir_weights.
enum class IterationWeights { kBalance, kVarianceAware, kAccumulate, kLast, kInverseVariance, kPixelInverseVariance };
inline bool weighs_paths(IterationWeights w) { return w <= IterationWeights::kVarianceAware; }

// The frames that are seen, by iterations.
class IterationPictures {
 public:
  void begin(uvec2 size);                                        // and forgets all
  void begin_iteration();                                        // from 0
  void add(std::span<const vec4> frame);                         // radiance, row by row
  double samples() const;                                        // a pixel, of all iterations
  const std::vector<double>& counts() const { return counts_; }  // of each iteration

  void save(Bytes& state) const;
  bool load(ByteReader& state);  // false, and all forgotten: the bytes are not whole
  uvec2 size() const { return size_; }

  // Mean of iterations of these shares, which add up to one.
  std::vector<vec4> mean(const std::function<double(std::size_t iteration, std::size_t pixel)>& share) const;
  // Of a frame's pixel of an iteration, about its mean; negative where it had fewer than two frames.
  double variance(std::size_t iteration, std::size_t pixel) const;
  double second_moment(std::size_t iteration, std::size_t pixel) const;
  // variance_factor of each iteration about a pixel, over tiles of 16 x 16 of them: [tile * iterations + iteration].
  std::vector<double> variance_factors() const;
  std::size_t tile_of(std::size_t pixel) const;
  // The combination of whole pictures, for weights that are no path's.
  std::vector<vec4> combined(IterationWeights weights) const;

 private:
  uvec2 size_{0};
  std::vector<double> counts_;
  std::vector<std::vector<vec4>> sums_;  // of an iteration: radiance, and squares of its luminance
};

}  // namespace fb::render
