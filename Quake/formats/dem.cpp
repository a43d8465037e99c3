// Parses demos: a decimal number and a newline, then for each message its length, three angles and its bytes.
#include "formats/dem.h"

#include <cmath>
#include <cstring>

namespace fb::formats {
namespace {

constexpr int kMaxTrackDigits = 9;

template <typename T>
void append_value(Bytes& out, T value) {
  const std::size_t at = out.size();
  out.resize(at + sizeof(T));
  std::memcpy(out.data() + at, &value, sizeof(T));
}

}  // namespace

Result<DemReader> DemReader::open(ByteView data, std::string_view name) {
  ByteReader reader(data, name);
  const std::string_view cause = "no demo: its first line is not the number of a CD track";
  std::uint8_t c = reader.u8();
  const bool negative = c == '-';
  if (negative) c = reader.u8();
  int track = 0, digits = 0;
  for (; c >= '0' && c <= '9' && digits < kMaxTrackDigits; ++digits) {
    track = track * 10 + (c - '0');
    c = reader.u8();
  }
  while (c == ' ' || c == '\r') c = reader.u8();
  if (reader.failed() || digits == 0 || c != '\n') return reader.error_at(0, cause);
  DemReader demo(std::move(reader));
  demo.cd_track_ = negative ? -track : track;
  return demo;
}

Result<DemMessage> DemReader::next() {
  const std::size_t at = reader_.offset();
  const std::uint32_t size = reader_.u32();
  DemMessage message;
  for (int axis = 0; axis < 3; ++axis) {
    const float angle = reader_.f32();
    message.view_angles[axis] = std::isfinite(angle) ? angle : 0.0f;
  }
  if (reader_.failed()) return reader_.error_at(at, "demo ends inside a message's header");
  if (size > kMaxDemMessage) {
    return reader_.error_at(at, "message of " + std::to_string(size) + " bytes is longer than any may be");
  }
  message.data = reader_.bytes(size);
  if (reader_.failed()) {
    return reader_.error_at(at, "demo ends inside a message of " + std::to_string(size) + " bytes");
  }
  return message;
}

void append_dem_message(Bytes& out, const vec3& view_angles, ByteView data) {
  append_value(out, static_cast<std::uint32_t>(data.size()));
  for (int axis = 0; axis < 3; ++axis) append_value(out, view_angles[axis]);
  out.insert(out.end(), data.begin(), data.end());
}

}  // namespace fb::formats
