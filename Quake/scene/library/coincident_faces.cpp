#include "scene/library/coincident_faces.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace fb::scene {
namespace {

constexpr float kTolerance = 0.05f;  // units: what compilers' rounding leaves between coincident edges

using Polygon = std::vector<vec3>;

vec3 area_vector(const Polygon& polygon) {
  vec3 sum(0.0f);
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
    sum += glm::cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
  return 0.5f * sum;
}

// The part of a polygon where dot(direction, p) - offset has the given sign, and how far it reaches there.
Polygon clip(const Polygon& polygon, const vec3& direction, float offset, float sign, float& reach) {
  Polygon part;
  reach = 0.0f;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const vec3 &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const float dp = sign * (glm::dot(direction, p) - offset), dq = sign * (glm::dot(direction, q) - offset);
    reach = std::max(reach, dp);
    if (dp >= 0.0f) part.push_back(p);
    if ((dp > 0.0f && dq < 0.0f) || (dp < 0.0f && dq > 0.0f)) part.push_back(p + (q - p) * (dp / (dp - dq)));
  }
  return part;
}

struct Box {
  vec3 min, max;
  bool meets(const Box& other) const {
    for (int axis = 0; axis < 3; ++axis)
      if (min[axis] > other.max[axis] + kTolerance || other.min[axis] > max[axis] + kTolerance) return false;
    return true;
  }
};
Box box_of(const Polygon& polygon) {
  Box box{polygon[0], polygon[0]};
  for (const vec3& p : polygon) {
    box.min = glm::min(box.min, p);
    box.max = glm::max(box.max, p);
  }
  return box;
}

// What the covers leave of a face, as faces.
void add_uncovered(const MapFace& face, const std::vector<const MapFace*>& covers, std::vector<MapFace>& out) {
  std::vector<Polygon> parts{face.polygon};
  const Box box = box_of(face.polygon);
  for (const MapFace* cover : covers) {
    if (!box.meets(box_of(cover->polygon))) continue;
    const vec3 normal = area_vector(cover->polygon);
    std::vector<Polygon> left;
    for (const Polygon& part : parts)
      for (Polygon& piece : subtract_polygon(part, cover->polygon, normal, kTolerance))
        left.push_back(std::move(piece));
    parts = std::move(left);
    if (parts.empty()) return;
  }
  const double whole = polygon_area(face.polygon);
  double rest = 0.0;
  for (const Polygon& part : parts) rest += polygon_area(part);
  if (rest < 0.005 * whole) return;
  if (rest > 0.995 * whole) {
    out.push_back(face);
    return;
  }
  for (Polygon& part : parts) {
    MapFace piece = face;
    piece.polygon = std::move(part);
    out.push_back(std::move(piece));
  }
}

}  // namespace

double polygon_area(const Polygon& polygon) { return static_cast<double>(glm::length(area_vector(polygon))); }

std::vector<Polygon> subtract_polygon(const Polygon& a, const Polygon& b, const vec3& normal, float tolerance) {
  std::vector<Polygon> outside;
  Polygon rest = a;
  for (std::size_t k = 0; k < b.size(); ++k) {
    const vec3 edge = b[(k + 1) % b.size()] - b[k], out = glm::cross(edge, normal);
    const float length = glm::length(out);
    if (!(length > 0.0f)) continue;
    const vec3 direction = out / length;
    const float offset = glm::dot(direction, b[k]);
    float beyond = 0.0f, within = 0.0f;
    Polygon piece = clip(rest, direction, offset, 1.0f, beyond);
    Polygon inner = clip(rest, direction, offset, -1.0f, within);
    if (within <= tolerance) return {a};  // apart, or touching along an edge: nothing is cut
    if (beyond <= tolerance) continue;
    if (piece.size() >= 3) outside.push_back(std::move(piece));
    rest = std::move(inner);
    if (rest.size() < 3) break;
  }
  return outside;
}

std::vector<MapFace> without_coincident(std::vector<MapFace> faces) {
  struct Sides {
    std::vector<const MapFace*> of[2];
    double area[2] = {0.0, 0.0};
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Sides> surfaces;
  for (const MapFace& face : faces) {
    Sides& sides = surfaces[{face.plane, face.texture}];
    const std::size_t side = face.back_side ? 1 : 0;
    sides.of[side].push_back(&face);
    sides.area[side] += polygon_area(face.polygon);
  }
  std::vector<MapFace> result;
  for (const auto& [key, sides] : surfaces) {
    const std::size_t main = sides.area[1] > sides.area[0] ? 1 : 0;
    for (const MapFace* face : sides.of[main]) result.push_back(*face);
    for (const MapFace* face : sides.of[1 - main]) add_uncovered(*face, sides.of[main], result);
  }
  return result;
}

}  // namespace fb::scene
