// Alias models (IDPO version 6): groups of frames and skins. After parsing every index is in range, there is at least
// one skin, frame, triangle and vertex, no group is empty, times are finite, positive and never decrease, and vectors
// are finite. Small faults are repaired and listed in `warnings`: a triangle of a vertex that does not exist is left
// out, and of a file that ends too early the frames that are whole are used.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "base/maths.h"
#include "base/result.h"
#include "formats/image.h"

namespace fb::formats {

// Bits of the header's flags: the trail that the model leaves (EF_*), and rotation.
enum MdlFlags : std::uint32_t {
  kMdlRocket = 1,
  kMdlGrenade = 2,
  kMdlGib = 4,
  kMdlRotate = 8,
  kMdlTracer = 16,
  kMdlZomGib = 32,
  kMdlTracer2 = 64,
  kMdlTracer3 = 128,
  kMdlHoley = 1u << 14,
};

constexpr int kMdlNormalCount = 162;

struct MdlVertex {
  std::uint8_t x, y, z, normal;  // position = byte * scale + origin; normal indexes Quake's table of 162
};
struct MdlSkin {  // a single skin, or a group that plays in a loop
  std::vector<IndexedImage> images;
  std::vector<float> end_times;  // seconds, one an image; empty for a single skin
};
struct MdlTriangle {
  bool faces_front;
  std::array<std::uint32_t, 3> vertices;
};
struct MdlTexCoord {
  bool on_seam;  // a triangle of the back side uses s + skin_width / 2
  std::int32_t s, t;
};
struct MdlFrame {  // a single pose, or a group that plays in a loop
  std::string name;
  std::uint32_t first_pose, pose_count;
  std::vector<float> end_times;  // seconds, one a pose; empty for a single pose
};
struct Mdl {
  vec3 scale, origin, eye_position;
  float bounding_radius = 0;
  int skin_width = 0, skin_height = 0;
  std::uint32_t flags = 0;
  std::int32_t sync_type = 0;  // 1: random start
  std::vector<MdlSkin> skins;
  std::vector<MdlTexCoord> tex_coords;  // one a vertex
  std::vector<MdlTriangle> triangles;
  std::vector<MdlFrame> frames;
  std::uint32_t vertex_count = 0, pose_count = 0;
  std::vector<MdlVertex> vertices;  // pose-major: [pose * vertex_count + vertex]
  std::vector<std::string>
      warnings;  // what was repaired: one sentence for each kind of fault, with file and first offset
};

// Refuses a bad file with file, offset and cause. Memory is bounded by a small multiple of data.size().
Result<Mdl> parse_mdl(ByteView data, std::string_view name);

}  // namespace fb::formats
