// Maps made in code from boxes and ramps, with all of their hulls, for tests of the server.
//
//   MapBuilder map(vec3(-512, -512, 0), vec3(512, 512, 256));   // a room
//   map.box(vec3(0, -64, 0), vec3(64, 64, 16));                 // with a step in it
//   map.box(vec3(-512, -512, 0), vec3(-256, 512, 64), formats::kContentsWater);
//   const int lift = map.model(vec3(-32, -32, -8), vec3(32, 32, 0));   // "*1"
//   formats::Bsp bsp = map.build();
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/bsp.h"

namespace fb::sv::testing {

class MapBuilder {
 public:
  // Open from mins to maxs, solid everywhere else.
  MapBuilder(const vec3& mins, const vec3& maxs) : room_{mins, maxs} {}

  std::string entities = "{\n\"classname\" \"worldspawn\"\n}\n";

  // A later brush fills where an earlier one was.
  void box(const vec3& mins, const vec3& maxs, std::int32_t contents = formats::kContentsSolid) {
    brushes_.push_back({mins, maxs, contents, std::nullopt});
  }
  // The lower half of a box: rises along x, or with `down` falls.
  void ramp(const vec3& mins, const vec3& maxs, bool down = false) {
    const vec3 size = maxs - mins;
    const vec3 normal = glm::normalize(vec3(down ? size.z : -size.z, 0.0f, size.x));
    const vec3 on_plane = down ? vec3(maxs.x, 0.0f, mins.z) : vec3(mins.x, 0.0f, mins.z);
    brushes_.push_back({mins, maxs, formats::kContentsSolid, Plane{normal, glm::dot(normal, on_plane)}});
  }
  // A solid box as a model of its own; n of its name "*n".
  int model(const vec3& mins, const vec3& maxs) {
    models_.push_back({mins, maxs, formats::kContentsSolid, std::nullopt});
    return static_cast<int>(models_.size());
  }

  formats::Bsp build() const {
    formats::Bsp bsp;
    bsp.entities = entities;
    bsp.leafs.push_back({formats::kContentsSolid, -1, vec3(0.0f), vec3(0.0f), 0, 0, {}});
    std::vector<Brush> world = {{room_[0], room_[1], formats::kContentsEmpty, std::nullopt}};
    world.insert(world.end(), brushes_.begin(), brushes_.end());
    add_model(bsp, world, formats::kContentsSolid);
    for (const Brush& model : models_) add_model(bsp, {model}, formats::kContentsEmpty);
    return bsp;
  }

 private:
  struct Plane {
    vec3 normal;
    float distance;
  };
  struct Brush {
    vec3 mins, maxs;
    std::int32_t contents;
    std::optional<Plane> top;  // nothing of it is above
  };
  using Region = std::array<vec3, 2>;

  // A brush as it is for the origin of a box that moves: solid grows, the open room shrinks.
  static Brush grown(Brush brush, const vec3& box_mins, const vec3& box_maxs) {
    if (brush.contents == formats::kContentsEmpty) {
      brush.mins -= box_mins;
      brush.maxs -= box_maxs;
      return brush;
    }
    brush.mins -= box_maxs;
    brush.maxs -= box_mins;
    if (brush.top) {
      for (int axis = 0; axis < 3; ++axis) {
        const float n = brush.top->normal[axis];
        brush.top->distance -= n * (n > 0.0f ? box_mins : box_maxs)[axis];
      }
    }
    return brush;
  }

  // Cuts space along the brushes' sides until every piece is inside or outside of each brush's box.
  struct Tree {
    formats::Bsp& bsp;
    const std::vector<Brush>& brushes;
    std::int32_t outside;
    bool clip;  // clip nodes, not nodes

    std::int32_t build(const Region& region) {
      for (const Brush& brush : brushes) {
        if (!overlap(region, brush)) continue;
        for (int axis = 0; axis < 3; ++axis) {
          for (const float at : {brush.mins[axis], brush.maxs[axis]}) {
            if (at <= region[0][axis] || at >= region[1][axis]) continue;
            const std::int32_t node = add_node(axis, at);
            Region above = region, below = region;
            above[0][axis] = below[1][axis] = at;
            const std::int32_t front = build(above), back = build(below);
            set_children(node, front, back);
            return node;
          }
        }
      }
      return fill(region, brushes.size());
    }
    // What the last of the first `count` brushes that holds the region makes of it.
    std::int32_t fill(const Region& region, std::size_t count) {
      while (count > 0 && !overlap(region, brushes[count - 1])) --count;
      if (count == 0) return leaf(outside, region);
      const Brush& brush = brushes[count - 1];
      if (!brush.top) return leaf(brush.contents, region);
      const std::int32_t node = add_node(3, brush.top->distance, brush.top->normal);
      const std::int32_t front = fill(region, count - 1), back = leaf(brush.contents, region);
      set_children(node, front, back);
      return node;
    }
    static bool overlap(const Region& region, const Brush& brush) {
      for (int axis = 0; axis < 3; ++axis)
        if (region[0][axis] >= brush.maxs[axis] || region[1][axis] <= brush.mins[axis]) return false;
      return true;
    }
    std::int32_t leaf(std::int32_t contents, const Region& region) {
      if (clip) return contents;
      if (contents == formats::kContentsSolid) return ~0;
      bsp.leafs.push_back({contents, -1, region[0], region[1], 0, 0, {}});
      return ~static_cast<std::int32_t>(bsp.leafs.size() - 1);
    }
    std::int32_t add_node(int type, float distance, vec3 normal = vec3(0.0f)) {
      if (type < 3) normal[type] = 1.0f;
      const auto plane = static_cast<std::uint32_t>(bsp.planes.size());
      bsp.planes.push_back({normal, distance, type});
      if (clip) {
        bsp.clip_nodes.push_back({plane, {}});
        return static_cast<std::int32_t>(bsp.clip_nodes.size() - 1);
      }
      bsp.nodes.push_back({plane, {}, vec3(-kFar), vec3(kFar), 0, 0});
      return static_cast<std::int32_t>(bsp.nodes.size() - 1);
    }
    void set_children(std::int32_t node, std::int32_t front, std::int32_t back) {
      const auto i = static_cast<std::size_t>(node);
      (clip ? bsp.clip_nodes[i].children : bsp.nodes[i].children) = {front, back};
    }
  };

  static void add_model(formats::Bsp& bsp, const std::vector<Brush>& brushes, std::int32_t outside) {
    constexpr std::array<std::array<vec3, 2>, 3> kBoxes = {
        {{vec3(0.0f), vec3(0.0f)}, {vec3(-16, -16, -24), vec3(16, 16, 32)}, {vec3(-32, -32, -24), vec3(32, 32, 64)}}};
    formats::BspModel model{brushes[0].mins, brushes[0].maxs, vec3(0.0f), {}, 0, 0, 0};
    const std::size_t leafs_before = bsp.leafs.size();
    for (std::size_t hull = 0; hull < 3; ++hull) {
      std::vector<Brush> hull_brushes;
      for (const Brush& brush : brushes) {
        const bool blocks = brush.contents == formats::kContentsEmpty || brush.contents == formats::kContentsSolid;
        if (hull > 0 && !blocks) continue;  // there are no liquids for boxes
        hull_brushes.push_back(grown(brush, kBoxes[hull][0], kBoxes[hull][1]));
      }
      Tree tree{bsp, hull_brushes, outside, hull > 0};
      model.head_nodes[hull] = tree.build({vec3(-kFar), vec3(kFar)});
    }
    model.head_nodes[3] = formats::kContentsEmpty;
    if (bsp.models.empty()) model.visible_leafs = static_cast<std::uint32_t>(bsp.leafs.size() - leafs_before);
    bsp.models.push_back(model);
  }

  static constexpr float kFar = 8192.0f;
  Region room_;
  std::vector<Brush> brushes_, models_;
};

}  // namespace fb::sv::testing
