// Rays through a map's tree of nodes that say which face they meet: what a light tool traces, on the host.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "formats/bsp.h"
#include "scene/library/light_sources.h"

namespace fb::scene {

class MapRays {
 public:
  // The map must outlive this. `submodels` are met as well, where they stand when the map begins.
  explicit MapRays(const formats::Bsp& bsp, std::vector<Submodel> submodels = {});

  struct Hit {
    std::uint32_t face;  // Bsp::faces
    vec3 point;          // where the map has the face
    vec3 offset;         // of where it stands
  };
  // The first face that the line from `start` to `end` meets from its front. Water and slime let it through
  // unless `liquids`, as does what tools alone see. Nothing where it ends in the open, or in something solid whose face
  // is not there.
  std::optional<Hit> first_face(const vec3& start, const vec3& end, bool liquids = false) const;
  // Whether nothing solid stands between two points.
  bool is_clear(const vec3& start, const vec3& end) const;

  bool is_sky(std::uint32_t face) const { return kinds_[face] == kSky; }
  // The unit normal of a face's front.
  vec3 normal(std::uint32_t face) const;

 private:
  enum Kind : std::uint8_t { kOpaque, kSky, kLiquid, kUnseen };
  struct Piece {
    std::int32_t node;
    float from, to;
    std::int32_t crossed;  // node whose plane is at `from`, -1 at the start
  };
  struct Meeting {
    std::uint32_t face;
    float fraction;
  };
  std::optional<Meeting> first_of(std::uint32_t model, const vec3& start, const vec3& end, bool liquids) const;
  bool may_meet(const formats::BspModel& model, const vec3& start, const vec3& end) const;
  std::optional<std::uint32_t> face_at(std::int32_t node, const vec3& point, const vec3& along, bool liquids) const;
  bool contains(std::uint32_t face, const vec3& point) const;

  const formats::Bsp& bsp_;
  std::vector<Submodel> submodels_;
  // A face's corners in the two axes of its plane that show it largest.
  struct Polygon {
    std::uint32_t first = 0, count = 0;  // corners_
    int u = 0, v = 1;
    vec3 normal{0.0f};
  };
  std::vector<Kind> kinds_;        // of faces
  std::vector<Bounds> bounds_;     // likewise
  std::vector<Polygon> polygons_;  // likewise
  std::vector<vec2> corners_;
};

}  // namespace fb::scene
