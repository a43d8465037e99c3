// Parses sprites: a header, then frames, each a single image or a timed group.
#include "formats/spr.h"

#include <cmath>
#include <optional>

#include "formats/group_times.h"

namespace fb::formats {
namespace {

constexpr std::uint32_t kSprMagic = 0x50534449u;  // "IDSP"
constexpr std::size_t kImageHeaderSize = 16;
constexpr std::uint8_t kClear = 255;

std::optional<Error> read_image(ByteReader& reader, SprFrame& frame, std::vector<std::string>& warnings) {
  const std::size_t at = reader.offset();
  SprImage image;
  image.origin_x = reader.i32();
  image.origin_y = reader.i32();
  const std::uint32_t width = reader.u32();
  const std::uint32_t height = reader.u32();
  if (reader.failed()) return reader.error_at(at, "file ends inside a frame's header");
  if (width > kMaxImageSize || height > kMaxImageSize) {
    return reader.error_at(at, "frame of " + std::to_string(width) + " by " + std::to_string(height) + " is too large");
  }
  if (width < 1 || height < 1) {  // nothing to see, and no texels follow
    if (warnings.empty()) warnings.push_back(reader.error_at(at, "frame without texels; taken as clear").message);
    image.image = {1, 1, {kClear}};
    frame.images.push_back(std::move(image));
    return std::nullopt;
  }
  const ByteView texels = reader.bytes(std::size_t{width} * height);
  if (reader.failed()) {
    return reader.error_at(at,
                           "file ends inside a frame of " + std::to_string(width) + " by " + std::to_string(height));
  }
  image.image = {static_cast<int>(width), static_cast<int>(height), {texels.begin(), texels.end()}};
  frame.images.push_back(std::move(image));
  return std::nullopt;
}

std::optional<Error> read_frame(ByteReader& reader, SprFrame& frame, std::vector<std::string>& warnings) {
  const std::size_t at = reader.offset();
  const std::int32_t is_group = reader.i32();
  std::uint32_t image_count = 1;
  if (is_group != 0) {
    image_count = reader.u32();
    if (reader.failed() || image_count < 1 || image_count > reader.remaining() / (4 + kImageHeaderSize)) {
      return reader.error_at(
          at, "group of " + std::to_string(image_count) + " images is empty or runs past the file's end");
    }
    if (!detail::read_group_times(reader, image_count, frame.end_times) && warnings.empty()) {
      warnings.push_back(reader.error_at(at, "group has a time that is not positive; taken as 0.1 s each").message);
    }
  }
  for (std::uint32_t k = 0; k < image_count; ++k) {
    if (auto error = read_image(reader, frame, warnings)) return error;
  }
  return std::nullopt;
}

}  // namespace

Result<Spr> parse_spr(ByteView data, std::string_view name) {
  ByteReader reader(data, name);
  const std::uint32_t magic = reader.u32();
  if (reader.failed() || magic != kSprMagic) return reader.error_at(0, "no sprite: it does not begin with IDSP");
  const std::int32_t version = reader.i32();
  const std::int32_t orientation = reader.i32();
  Spr spr;
  spr.bounding_radius = reader.f32();
  spr.max_width = reader.i32();
  spr.max_height = reader.i32();
  const std::size_t count_at = reader.offset();
  const std::uint32_t frame_count = reader.u32();
  spr.beam_length = reader.f32();
  spr.sync_type = reader.i32();
  if (reader.failed()) return reader.error("file ends inside the sprite's header");
  if (version != 1) return reader.error_at(4, "sprite has version " + std::to_string(version) + ", not 1");
  if (orientation >= 0 && orientation <= 4) spr.orientation = static_cast<SpriteOrientation>(orientation);
  if (!std::isfinite(spr.bounding_radius)) spr.bounding_radius = 0.0f;
  if (!std::isfinite(spr.beam_length)) spr.beam_length = 0.0f;
  if (frame_count < 1) return reader.error_at(count_at, "number of frames is zero");
  for (std::uint32_t i = 0; i < frame_count; ++i) {
    const auto error = read_frame(reader, spr.frames.emplace_back(), spr.warnings);
    if (!error) continue;
    if (i == 0) return *error;
    // Frames have no size of their own: where one is broken, nothing says where the next begins.
    spr.frames.pop_back();
    spr.warnings.push_back(error->message + "; of " + std::to_string(frame_count) + " frames the first " +
                           std::to_string(i) + " are used");
    break;
  }
  return spr;
}

}  // namespace fb::formats
