// Vectors, matrices and Quake's angles. Quake's world: x east, y north, z up, units of about an inch; angles are
// (pitch, yaw, roll) in degrees, positive pitch looks down.
#pragma once

#define GLM_FORCE_XYZW_ONLY
#include <glm/mat3x3.hpp>
#include <glm/mat4x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <glm/geometric.hpp>
#include <glm/common.hpp>

namespace fb {

using glm::dvec3;
using glm::ivec2;
using glm::mat3;
using glm::mat4x3;  // column-major, four columns of vec3: x axis, y axis, z axis, origin
using glm::uvec2;
using glm::vec2;
using glm::vec3;
using glm::vec4;

constexpr float kPi = 3.14159265358979323846f;
constexpr float radians(float degrees) { return degrees * (kPi / 180.0f); }
constexpr float degrees(float radians) { return radians * (180.0f / kPi); }

struct AxisVectors {
  vec3 forward, right, up;
};
// Quake's AngleVectors.
AxisVectors angle_vectors(const vec3& pitch_yaw_roll);

// Object-to-world transform of an entity: columns forward, left (= -right), up, origin. Brush models rotate by Quake's
// angles as they are; for alias models pass the negated pitch (a quirk of Quake).
mat4x3 entity_transform(const vec3& origin, const vec3& pitch_yaw_roll, float scale = 1.0f);

vec3 transform_point(const mat4x3& m, const vec3& p);
vec3 transform_vector(const mat4x3& m, const vec3& v);
// Inverse of an affine transform; a singular one gives the zero matrix.
mat4x3 inverse_affine(const mat4x3& m);

// Interpolates two angles in degrees the short way round.
float lerp_angle(float from, float to, float t);

struct Bounds {
  vec3 min{1e30f};
  vec3 max{-1e30f};
  void add(const vec3& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
  void add(const Bounds& b) {
    min = glm::min(min, b.min);
    max = glm::max(max, b.max);
  }
  bool empty() const { return min.x > max.x; }
};
// Bounds of a transformed box.
Bounds transform_bounds(const mat4x3& m, const Bounds& b);

}  // namespace fb
