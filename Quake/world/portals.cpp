#include "world/portals.h"

#include <array>
#include <cmath>
#include <utility>

namespace fb::world {
namespace {

using formats::Bsp;
using formats::BspNode;
using formats::BspPlane;
using Point = glm::dvec3;
using Polygon = std::vector<Point>;

constexpr double kOnPlane = 1e-3;   // units: nearer points count as on it
constexpr double kLeastArea = 0.1;  // units^2

struct HalfSpace {
  const BspPlane* plane;
  bool front;
};

double height_over(const BspPlane& plane, const Point& p) {
  return glm::dot(Point(plane.normal), p) - static_cast<double>(plane.distance);
}

// What of a convex polygon lies before a plane and behind it; of one that lies on it, neither has anything.
std::array<Polygon, 2> parts_of(const Polygon& polygon, const BspPlane& plane) {
  std::array<Polygon, 2> parts;
  bool before = false, behind = false;
  std::vector<double> heights;
  for (const Point& p : polygon) {
    heights.push_back(height_over(plane, p));
    before = before || heights.back() > kOnPlane;
    behind = behind || heights.back() < -kOnPlane;
  }
  if (!before || !behind) {
    if (before) parts[0] = polygon;
    if (behind) parts[1] = polygon;
    return parts;
  }
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t next = (i + 1) % polygon.size();
    const double a = heights[i], b = heights[next];
    if (a >= -kOnPlane) parts[0].push_back(polygon[i]);
    if (a <= kOnPlane) parts[1].push_back(polygon[i]);
    if ((a > kOnPlane && b < -kOnPlane) || (a < -kOnPlane && b > kOnPlane)) {
      const Point between = polygon[i] + (polygon[next] - polygon[i]) * (a / (a - b));
      parts[0].push_back(between);
      parts[1].push_back(between);
    }
  }
  return parts;
}

// A square on a plane that is larger than any map.
Polygon whole_plane(const BspPlane& plane) {
  constexpr double kFar = 2.0 * static_cast<double>(formats::kMaxBspCoordinate);
  const Point n = glm::normalize(Point(plane.normal));
  const Point u = glm::normalize(glm::cross(n, std::abs(n.z) < 0.7 ? Point(0, 0, 1) : Point(1, 0, 0)));
  const Point v = glm::cross(n, u), on = n * (static_cast<double>(plane.distance) / glm::length(Point(plane.normal)));
  return {on + (u + v) * kFar, on + (v - u) * kFar, on - (u + v) * kFar, on + (u - v) * kFar};
}

double area_of(const Polygon& polygon) {
  Point sum(0.0);
  for (std::size_t i = 2; i < polygon.size(); ++i)
    sum += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return 0.5 * glm::length(sum);
}

class Cutter {
 public:
  explicit Cutter(const Bsp& bsp) : bsp_(bsp) {}

  // Recursion in all functions is at most as deep as the tree: formats::kMaxBspDepth.
  void cut(std::int32_t at) {
    if (at < 0) return;
    const BspNode& node = bsp_.nodes[static_cast<std::size_t>(at)];
    const BspPlane& plane = bsp_.planes[node.plane];
    Polygon polygon = whole_plane(plane);
    for (const HalfSpace& side : around_) polygon = parts_of(polygon, *side.plane)[side.front ? 0 : 1];
    if (polygon.size() >= 3) {
      std::vector<Piece> in_front;
      sink(node.children[0], polygon, Point(plane.normal), in_front);
      for (const Piece& piece : in_front) {
        std::vector<Piece> both;
        sink(node.children[1], piece.polygon, -Point(plane.normal), both);
        for (const Piece& portal : both) add(piece.leaf, portal);
      }
    }
    for (const int child : {0, 1}) {
      around_.push_back({&plane, child == 0});
      cut(node.children[static_cast<std::size_t>(child)]);
      around_.pop_back();
    }
  }
  std::vector<Portal> take() { return std::move(portals_); }

 private:
  struct Piece {
    std::uint32_t leaf;
    Polygon polygon;
  };

  // The open leafs below a node that a polygon touches from the side to which `towards` points.
  void sink(std::int32_t at, const Polygon& polygon, const Point& towards, std::vector<Piece>& pieces) const {
    if (polygon.size() < 3 || area_of(polygon) < kLeastArea) return;
    if (at < 0) {
      const auto leaf = static_cast<std::uint32_t>(~at);
      if (leaf < bsp_.leafs.size() && is_open(bsp_.leafs[leaf])) pieces.push_back({leaf, polygon});
      return;
    }
    const BspNode& node = bsp_.nodes[static_cast<std::size_t>(at)];
    const BspPlane& plane = bsp_.planes[node.plane];
    const std::array<Polygon, 2> parts = parts_of(polygon, plane);
    if (parts[0].empty() && parts[1].empty()) {  // on the plane of another node: beside it, on one side
      sink(node.children[glm::dot(Point(plane.normal), towards) > 0 ? 0 : 1], polygon, towards, pieces);
      return;
    }
    sink(node.children[0], parts[0], towards, pieces);
    sink(node.children[1], parts[1], towards, pieces);
  }
  void add(std::uint32_t front, const Piece& piece) {
    Portal portal{front, piece.leaf, {}};
    for (const Point& p : piece.polygon) portal.bounds.add(vec3(p));
    portals_.push_back(portal);
  }

  const Bsp& bsp_;
  std::vector<HalfSpace> around_;  // of the nodes above
  std::vector<Portal> portals_;
};

}  // namespace

bool is_open(const formats::BspLeaf& leaf) {
  return leaf.contents != formats::kContentsSolid && leaf.contents != formats::kContentsSky;
}

std::vector<Portal> leaf_portals(const Bsp& bsp) {
  if (bsp.models.empty()) return {};
  Cutter cutter(bsp);
  cutter.cut(bsp.models[0].head_nodes[0]);
  return cutter.take();
}

}  // namespace fb::world
