#include "net/message.h"

#include <algorithm>
#include <cmath>

namespace fb::net {
namespace {

// Floats are clamped to the range of 32-bit coordinates, so that sums and differences of received values stay finite.
constexpr float kFarthest = 134217728.0f;

// Nearest integer, halves away from zero, clamped to [low, high].
int round_to(double value, double low, double high) {
  return static_cast<int>(std::lround(std::clamp(value, low, high)));
}

}  // namespace

float MessageReader::f32() {
  const float value = bytes_.f32();
  if (std::isfinite(value)) return value;
  not_finite_ = true;
  return 0.0f;
}

float MessageReader::coord() {
  if (protocol.flags & kFloatCoord) return std::clamp(f32(), -kFarthest, kFarthest);
  if (protocol.flags & kInt32Coord) return static_cast<float>(i32()) / 16.0f;
  if (protocol.flags & kCoord24) {
    const int whole = i16();
    return static_cast<float>(whole + u8() * (1.0 / 255.0));
  }
  return static_cast<float>(i16()) / 8.0f;
}

float MessageReader::angle() {
  if (protocol.flags & kFloatAngle) return std::clamp(f32(), -kFarthest, kFarthest);
  if (protocol.flags & kShortAngle) return static_cast<float>(i16() * (360.0 / 65536.0));
  return static_cast<float>(i8() * (360.0 / 256.0));
}

float MessageReader::angle16() {
  if (protocol.flags & kFloatAngle) return std::clamp(f32(), -kFarthest, kFarthest);
  return static_cast<float>(i16() * (360.0 / 65536.0));
}

vec3 MessageReader::coords() {
  const float x = coord(), y = coord(), z = coord();
  return {x, y, z};
}

vec3 MessageReader::angles() {
  const float x = angle(), y = angle(), z = angle();
  return {x, y, z};
}

std::string MessageReader::string() {
  const ByteView rest = bytes_.data().subspan(bytes_.offset());
  const auto end = std::find(rest.begin(), rest.end(), std::uint8_t{0});
  const auto length = static_cast<std::size_t>(end - rest.begin());
  std::string text(reinterpret_cast<const char*>(rest.data()), length);
  bytes_.skip(length + 1);  // fails if the zero is missing
  return text;
}

void MessageWriter::coord(float v) {
  if (protocol.flags & kFloatCoord) {
    f32(v);
  } else if (protocol.flags & kInt32Coord) {
    i32(static_cast<std::int32_t>(std::llround(std::clamp(v * 16.0, -2147483648.0, 2147483647.0))));
  } else if (protocol.flags & kCoord24) {
    // The byte counts 255ths upwards from the next lower whole number, also for negative values.
    const double whole = std::clamp(std::floor(static_cast<double>(v)), -32768.0, 32767.0);
    i16(static_cast<int>(whole));
    u8(round_to((v - whole) * 255.0, 0.0, 255.0));
  } else {
    i16(round_to(v * 8.0, -32768.0, 32767.0));
  }
}

void MessageWriter::angle(float v) {
  if (protocol.flags & kFloatAngle)
    f32(v);
  else if (protocol.flags & kShortAngle)
    angle16(v);
  else
    u8(static_cast<int>(std::llround(v * (256.0 / 360.0)) & 255));
}

void MessageWriter::angle16(float v) {
  if (protocol.flags & kFloatAngle)
    f32(v);
  else
    u16(static_cast<int>(std::llround(v * (65536.0 / 360.0)) & 65535));
}

void MessageWriter::coords(const vec3& v) {
  coord(v.x);
  coord(v.y);
  coord(v.z);
}

void MessageWriter::angles(const vec3& v) {
  angle(v.x);
  angle(v.y);
  angle(v.z);
}

void MessageWriter::string(std::string_view text) {
  const std::string_view cut = text.substr(0, text.find('\0'));
  bytes_.insert(bytes_.end(), cut.begin(), cut.end());
  bytes_.push_back(0);
}

float decode_alpha(int alpha) { return alpha == kAlphaDefault ? 1.0f : static_cast<float>(alpha - 1) / 254.0f; }

int encode_alpha(float alpha) {
  if (alpha == 0.0f) return kAlphaDefault;
  return round_to(alpha * 254.0 + 1.0, 1.0, 255.0);
}

int encode_scale(float scale) {
  return scale > 0.0f ? static_cast<int>(std::min(scale * 16.0f, 255.0f)) : kScaleDefault;
}

}  // namespace fb::net
