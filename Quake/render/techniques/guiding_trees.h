// Distributions of directions by place, learnt from the paths of one iteration for the next (practical path guiding:
// Müller 2017, with the filters of Müller 2019). The distributions of all iterations are kept: a leaf of the spatial
// tree knows which it had in each of them, and its halves know the same when it is split, so that nothing is copied
// (Fan 2025, Section 3.4). The layout that shaders read, the draw and the density: estimators/mir/guiding_tree.h.
//
// Departures: directions are mapped with equal areas instead of by cylindrical coordinates; a density in 65535ths;
// the spatial filter moves a sample once, by chance, and the directional one spreads it over a square as wide as its
// leaf; the share of guided directions is the same everywhere and set.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/bytes.h"
#include "base/maths.h"
#include "estimators/mir/guiding_tree.h"

namespace fb::render {

// A vertex that a path left, and the radiance that came from there.
struct GuidingSample {
  vec3 position, direction;
  float weight = 0;  // luminance of that radiance over the direction's density; 0: counted, and nothing learnt
};

// A quadtree over the square of directions: of each node how much of the weight was in each quarter.
class DirectionalTree {
 public:
  struct Node {
    std::array<float, 4> weight{};
    std::array<std::uint32_t, 4> child{};  // 0: none
  };
  // Spreads a weight over the square that is as wide as the leaf about `place` and has it in the middle; what is beyond
  // the edges goes to the nearest within.
  void deposit(vec2 place, float weight, bool filtered);
  float total() const;
  // Of the same quarters, those with more than this share of the total split: 0 weight everywhere. A quarter without
  // children gives each of its own a quarter.
  DirectionalTree refined(float most_share) const;
  std::vector<shared::uvec4> packed() const;  // as shaders read it; total() > 0
  std::uint32_t levels() const;               // of nodes, 1 or more
  const std::vector<Node>& nodes() const { return nodes_; }
  // False: a child does not stand behind its node, or there is no node.
  bool set_nodes(std::vector<Node> nodes);

 private:
  std::vector<Node> nodes_{1};
};

struct GuidingOptions {
  float split = 4000;        // of vertices, times the root of an iteration's samples a pixel: more of them split a leaf
  float most_share = 0.01f;  // of a leaf's light in a quarter of the sphere's that does not split
  bool filtered = true;
};

// Of all iterations since clear().
class GuidingTrees {
 public:
  void clear() { *this = GuidingTrees(); }
  // The distributions of the next iteration, from the vertices of the last one, of so many samples a pixel. The cube is
  // about those of the first call. `seed`: of the filter's chance.
  void learn(std::span<const GuidingSample> samples, float samples_per_pixel, const GuidingOptions& options,
             std::uint64_t seed);

  std::uint32_t iterations() const { return iterations_; }  // that have distributions: those of learn()
  const shared::GuidingCube& cube() const { return cube_; }
  const std::vector<std::uint32_t>& places() const { return places_; }
  // Of the last iteration: a leaf's first node, or kUntaught, and the nodes.
  const std::vector<std::uint32_t>& firsts() const { return firsts_; }
  const std::vector<shared::uvec4>& nodes() const { return nodes_; }

  static constexpr std::uint32_t kMostHalvings = 10;    // of an axis: a 1024th of the cube's edge
  static constexpr std::uint32_t kMostNodeLevels = 12;  // 4^-12 of the sphere
  // Levels of the spatial tree, and of nodes of the last iteration's deepest directional one: rounds that reach all.
  std::uint32_t levels() const { return levels_; }
  std::uint32_t node_levels() const { return node_levels_; }

  std::uint32_t leaf(const vec3& position) const {  // 0 before the first learn()
    return places_.empty() ? 0 : shared::guiding_leaf(places_.data(), cube_, levels(), position);
  }
  // Density of a direction at places of a leaf, in the distributions of an earlier learn(), from 0; below 0: untaught.
  float density(std::uint32_t leaf, std::uint32_t iteration, const vec3& direction) const {
    const std::uint32_t first = history_[leaf][iteration];
    return first == shared::kUntaught ? -1.0f : shared::guiding_pdf(kept_.data(), first, kMostNodeLevels, direction);
  }
  // The same in iteration k of a picture, from 0, which has the distributions of the learn() before it: its first has
  // those that were kept, if any.
  float density_in(std::uint32_t leaf, std::uint32_t k, const vec3& direction) const {
    return k + kept_count_ == 0 ? -1.0f : density(leaf, k + kept_count_ - 1, direction);
  }
  // A new picture begins, whose first iteration has the last distributions: those before them are forgotten.
  void keep_last();
  std::uint32_t kept() const { return kept_count_; }  // 0 or 1
  // Host memory of all iterations' distributions.
  std::uint64_t bytes() const;

  void save(Bytes& state) const;
  // False, and nothing learnt: the bytes are not whole, or an index leads nowhere.
  bool load(ByteReader& state);

 private:
  void split(std::span<const GuidingSample> samples, float most);
  bool leads_somewhere() const;

  std::uint32_t iterations_ = 0, kept_count_ = 0, levels_ = 0, node_levels_ = 1;
  shared::GuidingCube cube_{};
  std::vector<std::uint32_t> places_;
  std::vector<vec3> lows_, widths_;                  // of leaves, in the unit cube
  std::vector<DirectionalTree> recorded_;            // of leaves: quarters into which the next samples are sorted
  std::vector<std::vector<std::uint32_t>> history_;  // of leaves: the first node in each iteration
  std::vector<shared::uvec4> kept_;                  // nodes of all iterations
  std::vector<std::uint32_t> firsts_;
  std::vector<shared::uvec4> nodes_;
};

}  // namespace fb::render
