// A map's space as probes of DDGI know it: where there is room for a probe, and from which leafs a point may ask it.
// Beyond the papers, whose probes stand in a grid alone. A point asks a probe if a way leads from one to the other
// through the openings (world/portals.h) of the probe's own surroundings, and the map's visibility lets the one leaf
// see the other: through a wall no way leads, however thin it is.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/maths.h"
#include "estimators/ddgi/ddgi.h"
#include "formats/bsp.h"

namespace fb::render {

class LeafGraph {
 public:
  explicit LeafGraph(std::shared_ptr<const formats::Bsp> bsp);

  // Open leafs, numbered from 1.
  std::uint32_t leafs() const { return static_cast<std::uint32_t>(leaf_of_open_.size()); }
  // The open leaf at a point; 0: what is solid, or sky.
  std::uint32_t at(const vec3& point) const;
  // The place nearest to the middle of a box that is open, of those by which `middle` is off by multiples of a third of
  // `room`, at most `room`, along each axis; nothing: the box is solid.
  std::optional<vec3> open_place(const vec3& middle, const vec3& room) const;
  // Sets the bits of open leafs (bit i of a row: leaf i) from which a probe at an open place may be asked: those to
  // which a way leads through openings that touch `within`, past the boxes of `doors`, and which the map's visibility
  // shows to the probe's leaf. `row`: row_words(), zero.
  void reached_from(const vec3& place, const Bounds& within, std::span<const Bounds> doors,
                    std::span<std::uint32_t> row) const;
  std::uint32_t row_words() const { return (leafs() + 32) / 32; }

  // Where a walk down the tree may begin for all points of a box, and the steps that it takes from there at most.
  struct Start {
    std::int32_t at = 0;  // node, or ~open leaf (~0: solid)
    std::uint32_t steps = 0;
  };
  Start start_in(const Bounds& box) const;

  // The tree as shaders have it (Shaders/estimators/ddgi/ddgi.h): two elements a node; children as Start::at.
  std::vector<shared::uvec4> nodes() const;

 private:
  std::uint32_t steps_in(std::int32_t at, const Bounds& box) const;
  std::int32_t child(const formats::BspNode& node, int side) const;

  std::shared_ptr<const formats::Bsp> bsp_;
  std::vector<std::uint32_t> open_of_leaf_;  // of Bsp::leafs; 0: not open
  std::vector<std::uint32_t> leaf_of_open_;  // of open leafs from 1 on
  struct Way {
    std::uint32_t to;  // open leaf
    Bounds bounds;
  };
  std::vector<std::uint32_t> first_way_;  // of open leafs, and an end
  std::vector<Way> ways_;
};

// Whether two boxes have a point in common.
bool boxes_meet(const Bounds& a, const Bounds& b);

}  // namespace fb::render
