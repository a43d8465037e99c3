// Sprites (IDSP version 1). After parsing there is at least one frame, no group is empty, times are finite, positive
// and never decrease, and images have at least one texel. Small faults are repaired and listed in `warnings`: of a file
// that ends too early the frames that are whole are used.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "base/result.h"
#include "formats/image.h"

namespace fb::formats {

enum class SpriteOrientation : std::int32_t {
  kParallelUpright = 0,
  kFacingUpright = 1,
  kParallel = 2,
  kOriented = 3,
  kParallelOriented = 4,
};

struct SprImage {
  std::int32_t origin_x, origin_y;  // of the top left corner, relative to the entity's origin; y up
  IndexedImage image;               // index 255 is transparent
};
struct SprFrame {  // a single image, or a group that plays in a loop
  std::vector<SprImage> images;
  std::vector<float> end_times;  // seconds; empty for a single image
};
struct Spr {
  SpriteOrientation orientation = SpriteOrientation::kParallel;
  float bounding_radius = 0;
  int max_width = 0, max_height = 0;
  float beam_length = 0;
  std::int32_t sync_type = 0;
  std::vector<SprFrame> frames;
  std::vector<std::string> warnings;  // what was repaired, with file and offset
};

// Refuses a bad file with file, offset and cause; an unknown orientation is read as kParallel. Memory is bounded by a
// small multiple of data.size().
Result<Spr> parse_spr(ByteView data, std::string_view name);

}  // namespace fb::formats
