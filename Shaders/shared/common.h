// What lets a header be C++ and GLSL: names of types, qualifiers of functions, and the few functions whose names
// differ. Shared headers hold structs with std430 layout (only 4- and 16-byte members, sizes multiples of 16) and pure
// functions.
#ifndef FB_SHARED_COMMON_H
#define FB_SHARED_COMMON_H

#ifdef __cplusplus

#include <cmath>
#include <cstdint>
#include <cstring>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/packing.hpp>
#include <glm/trigonometric.hpp>

namespace fb::shared {
using uint = std::uint32_t;
using glm::clamp;
using glm::cross;
using glm::dot;
using glm::ivec2;
using glm::length;
using glm::mat3;
using glm::max;
using glm::min;
using glm::mix;
using glm::normalize;
using glm::packHalf2x16;
using glm::unpackHalf2x16;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using std::abs;
using std::cos;
using std::exp;
using std::exp2;
using std::floor;
using std::log;
using std::log2;
using std::sin;
using std::sqrt;
inline uint floatBitsToUint(float f) {
  uint u;
  std::memcpy(&u, &f, 4);
  return u;
}
inline float uintBitsToFloat(uint u) {
  float f;
  std::memcpy(&f, &u, 4);
  return f;
}
}  // namespace fb::shared

#define FB_NAMESPACE_BEGIN namespace fb::shared {
#define FB_NAMESPACE_END }
#define FB_FN inline
#define FB_INOUT(type, name) type& name
#define FB_OUT(type, name) type& name
#define FB_CONST inline constexpr

#else  // GLSL

#define FB_NAMESPACE_BEGIN
#define FB_NAMESPACE_END
#define FB_FN
#define FB_INOUT(type, name) inout type name
#define FB_OUT(type, name) out type name
#define FB_CONST const

#endif
#endif
