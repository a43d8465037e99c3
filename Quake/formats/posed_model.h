// Models of whole vertices in each pose, whose skins are files beside them: MD5 (a skeleton, .md5mesh and .md5anim,
// version 10, as in the re-release of 2021) and MD3 (vertex animation, version 15). Both come out as the same thing:
// every pose's positions. Blending two poses of a skinned vertex is blending its bones' matrices, which is what
// vkQuake and Ironwail do on the device. After parsing every index is in range, there is at least one surface, vertex,
// triangle and pose, and all numbers are finite.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "base/maths.h"
#include "base/result.h"

namespace fb::formats {

struct PosedSurface {
  std::string name;                                     // MD3's; empty in MD5
  std::string shader;                                   // the first skin that the file names; may be empty
  std::vector<std::array<std::uint32_t, 3>> triangles;  // of the model's vertices; clockwise as seen from outside
};

struct PosedModel {
  std::vector<PosedSurface> surfaces;
  std::uint32_t vertex_count = 0, pose_count = 0;
  std::vector<vec2> uv;                 // one a vertex; (0, 0) is the skin's upper left corner
  std::vector<vec3> positions;          // units, pose-major: [pose * vertex_count + vertex]
  std::vector<std::string> pose_names;  // one a pose; may be empty
};

// A model of more vertices over all poses is refused: 96 MiB.
constexpr std::size_t kMostPosedVertices = std::size_t{1} << 23u;

// `mesh` and `anim` are the files' texts, named for messages. Without `anim` there is one pose, as the mesh was bound.
// Refuses a bad file with its name, line and cause.
struct Md5Text {
  std::string_view text, name;
};
Result<PosedModel> parse_md5(const Md5Text& mesh, const std::optional<Md5Text>& anim);

// Refuses a bad file with its name, offset and cause. Tags are not read.
Result<PosedModel> parse_md3(ByteView data, std::string_view name);

}  // namespace fb::formats
