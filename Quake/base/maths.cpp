#include "base/maths.h"

#include <cmath>

namespace fb {

namespace {

// Sine and cosine of degrees with Quake's roundings, so that games stay equal to the last bit: the angle in radians is
// rounded to float, and so is the result, which is computed in double precision.
struct SineCosine {
  explicit SineCosine(float degrees) {
    const auto angle = static_cast<float>(static_cast<double>(degrees) * (3.14159265358979323846 * 2.0 / 360.0));
    sine = static_cast<float>(std::sin(static_cast<double>(angle)));
    cosine = static_cast<float>(std::cos(static_cast<double>(angle)));
  }
  float sine, cosine;
};

}  // namespace

AxisVectors angle_vectors(const vec3& a) {
  const SineCosine pitch(a.x), yaw(a.y), roll(a.z);
  const float sp = pitch.sine, cp = pitch.cosine, sy = yaw.sine, cy = yaw.cosine, sr = roll.sine, cr = roll.cosine;
  AxisVectors axes;
  axes.forward = {cp * cy, cp * sy, -sp};
  axes.right = {-sr * sp * cy + cr * sy, -sr * sp * sy - cr * cy, -sr * cp};
  axes.up = {cr * sp * cy + sr * sy, cr * sp * sy - sr * cy, cr * cp};
  return axes;
}

mat4x3 entity_transform(const vec3& origin, const vec3& angles, float scale) {
  const AxisVectors axes = angle_vectors(angles);
  return mat4x3(axes.forward * scale, -axes.right * scale, axes.up * scale, origin);
}

vec3 transform_point(const mat4x3& m, const vec3& p) { return m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3]; }
vec3 transform_vector(const mat4x3& m, const vec3& v) { return m[0] * v.x + m[1] * v.y + m[2] * v.z; }

mat4x3 inverse_affine(const mat4x3& m) {
  // Rows of the inverse are the cross products of the columns over the determinant.
  const vec3 bc = glm::cross(m[1], m[2]);
  const float determinant = glm::dot(m[0], bc);
  if (determinant == 0.0f || !std::isfinite(determinant)) return mat4x3(0.0f);
  const float s = 1.0f / determinant;
  const vec3 r0 = bc * s, r1 = glm::cross(m[2], m[0]) * s, r2 = glm::cross(m[0], m[1]) * s;
  mat4x3 inverse({r0.x, r1.x, r2.x}, {r0.y, r1.y, r2.y}, {r0.z, r1.z, r2.z}, vec3(0.0f));
  inverse[3] = -transform_vector(inverse, m[3]);
  return inverse;
}

float lerp_angle(float from, float to, float t) {
  float delta = std::fmod(to - from, 360.0f);
  if (delta > 180.0f) delta -= 360.0f;
  if (delta < -180.0f) delta += 360.0f;
  return from + delta * t;
}

Bounds transform_bounds(const mat4x3& m, const Bounds& b) {
  Bounds out;
  if (b.empty()) return out;
  const vec3 centre = 0.5f * (b.min + b.max), half = 0.5f * (b.max - b.min);
  const vec3 c = transform_point(m, centre);
  const vec3 h = glm::abs(m[0]) * half.x + glm::abs(m[1]) * half.y + glm::abs(m[2]) * half.z;
  out.min = c - h;
  out.max = c + h;
  return out;
}

}  // namespace fb
