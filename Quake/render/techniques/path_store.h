// Paths that brought light, kept until the densities of all iterations are known, and the pictures of iterations that
// they are weighed in (Fan 2025, Sections 3.4 and 3.5).
//
// What a picture shows is the mean of all frames, which has light of every kind, and for each kept path the difference
// that its weight makes to that mean. So what is not stored counts as it does without weights, and paths that bring
// nothing are not stored. A path is weighed anew at each vertex that light was met from, or that found light that it
// looked for: the densities of the vertices before it are those of a path of its own.
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
  float met_density = 0;  // of looking for light in this direction; 0: what was met there is not looked for
};
// Light that a vertex looked for and found.
struct LookedFor {
  std::uint32_t vertex = 0;
  vec3 light;  // as PathVertex::light
  vec3 direction;
  float scatter_pdf = 0;  // of the direction, by the vertex's own scattering alone
  float density = 0;      // of looking for light in it, the same in all iterations
};
struct StoredPath {
  std::span<const PathVertex> vertices;
  std::span<const LookedFor> looked;  // of vertices, in their order
};

class PathStore {
 public:
  struct Path {
    std::uint32_t pixel, iteration, frame;  // of all that are seen, from 0
    std::uint32_t first, count;             // vertices
    std::uint32_t first_looked, looked;     // light that was looked for
    float importance;                       // luminance of all its light
  };
  // From the first vertex to the last that met or found light; a path without light is not stored. Its importance.
  float add(std::uint32_t pixel, std::uint32_t iteration, std::uint32_t frame, const StoredPath& path);
  // Lets the least important go, of those equally important the latest, until they fit; calls `gone` with each before.
  // What is kept is what a heap of this size would keep (Section 3.5).
  void shrink(std::uint64_t bytes, const std::function<void(const Path&)>& gone);
  void clear() { *this = PathStore(); }

  std::uint64_t bytes() const {
    return paths_.size() * sizeof(Path) + vertices_.size() * sizeof(PathVertex) + looked_.size() * sizeof(LookedFor);
  }
  void save(Bytes& state) const;
  // False, and nothing stored: the bytes are not whole, or of other pixels, iterations or frames.
  bool load(ByteReader& state, std::size_t pixels, std::size_t iterations, std::size_t frames);

  const std::vector<Path>& paths() const { return paths_; }
  StoredPath stored(const Path& path) const {
    return {std::span(vertices_).subspan(path.first, path.count),
            std::span(looked_).subspan(path.first_looked, path.looked)};
  }

 private:
  std::vector<Path> paths_;
  std::vector<PathVertex> vertices_;
  std::vector<LookedFor> looked_;
};

// Density of a direction from a vertex in a leaf in iteration `k`, from 0, where it has a distribution
// (GuidingTrees::density_in); else the vertex's own scattering alone, whose density is `scatter_pdf`. `defence`: the
// share of that beside others.
double direction_density(const GuidingTrees& trees, std::uint32_t leaf, std::uint32_t k, const vec3& direction,
                         float scatter_pdf, float defence);

// Vertices whose density in their own iteration, asked anew, is off by more than kDensityError of what it was drawn
// with: next to none, where a direction lies on the edge of a distribution's part.
std::uint32_t other_densities(const GuidingTrees& trees, std::span<const PathVertex> vertices, std::uint32_t own,
                              float defence);
constexpr double kDensityError = 1e-4;

// Calls `each` for all light that a path met or found, with ln(p_k / p_own) of the path to it, for `iterations`
// iterations (end_log_ratio of its last direction).
void for_each_ratio(const GuidingTrees& trees, const StoredPath& path, std::uint32_t own, std::uint32_t iterations,
                    float defence, const std::function<void(const vec3& light, std::span<const double>)>& each);

// Calls `each` for all light that a path met or found with what it counts with where each vertex's direction is weighed
// by the balance heuristic of its own, and not the path: the product of their factors. Of paths of several directions
// these do not add up to one, whoever has taught the distributions: what weights of paths are compared with. `counts`:
// samples of each iteration, with the path's own above 0.
void for_each_vertex_factor(const GuidingTrees& trees, const StoredPath& path, std::uint32_t own,
                            std::span<const double> counts, float defence,
                            const std::function<void(const vec3& light, double factor)>& each);

// How pictures of iterations are combined: r_mir_weights.
enum class IterationWeights {
  kBalance,
  kVarianceAware,
  kAccumulate,
  kLast,
  kInverseVariance,
  kPixelInverseVariance,
  kVertices
};
inline bool weighs_paths(IterationWeights w) {
  return w <= IterationWeights::kVarianceAware || w == IterationWeights::kVertices;
}

// The frames that are seen, by iterations.
class IterationPictures {
 public:
  void begin(uvec2 size);                                        // and forgets all
  void begin_iteration();                                        // from 0
  void add(std::span<const vec4> frame);                         // radiance, row by row
  double samples() const;                                        // a pixel, of all iterations
  double light() const;                                          // luminance, summed over all pixels and samples
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
