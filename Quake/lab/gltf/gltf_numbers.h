// Numbers of glTF 2.0 files (Khronos, sections 3.8, 4.4; OpenGL's names of types and wraps), for those that are written
// and those that are read.
#pragma once

#include <cstdint>

namespace fb::lab {

constexpr std::uint32_t kGlbMagic = 0x46546c67, kGlbVersion = 2, kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;
constexpr int kClamp = 33071, kRepeat = 10497, kMirroredRepeat = 33648, kNearest = 9728, kTriangleList = 4;
constexpr float kMetresPerUnit = 0.0254f;  // a unit is an inch
constexpr float kLumenPerWatt = 683.0f;    // of KHR_lights_punctual's lux and candela

}  // namespace fb::lab
