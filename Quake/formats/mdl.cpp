// Parses alias models: header, skins, texture coordinates, triangles, frames, in the order of the file. Each count is
// checked against the remaining bytes before memory is allocated for it.
#include "formats/mdl.h"

#include <algorithm>
#include <cmath>

#include "formats/group_times.h"

namespace fb::formats {
namespace {

constexpr std::uint32_t kMdlMagic = 0x4f504449u;  // "IDPO"
constexpr std::size_t kTexCoordSize = 12, kTriangleSize = 16, kVertexSize = 4;
constexpr std::size_t kPoseHeaderSize = 24;  // two corners and a name

class MdlParser {
 public:
  MdlParser(ByteView data, std::string_view name) : reader_(data, name) {}

  Result<Mdl> parse() {
    if (!read_header() || !read_skins() || !read_tex_coords() || !read_triangles() || !read_frames()) {
      return std::move(error_);
    }
    return std::move(mdl_);
  }

 private:
  bool refuse(std::size_t offset, std::string_view cause) {
    error_ = reader_.error_at(offset, cause);
    return false;
  }
  // One warning for each kind of fault; the caller's flag tells whether it was given.
  void mend(std::size_t offset, std::string_view cause, bool& said) {
    if (!said) mdl_.warnings.push_back(reader_.error_at(offset, cause).message);
    said = true;
  }
  bool holds(std::uint64_t count, std::uint64_t size_each) const { return count <= reader_.remaining() / size_each; }
  bool read_count(std::uint32_t& count, const char* what);
  bool read_vec3(vec3& v, const char* what);

  bool read_header();
  bool read_skins();
  bool read_skin_image(MdlSkin& skin);
  bool read_tex_coords();
  bool read_triangles();
  bool read_frames();
  bool read_frame();
  bool read_pose(std::string& name);
  void leave_rest_out(std::uint32_t whole);

  ByteReader reader_;
  Error error_;
  Mdl mdl_;
  std::uint32_t skin_count_ = 0, triangle_count_ = 0, frame_count_ = 0;
  bool said_times_ = false, said_normal_ = false, said_radius_ = false, said_vertex_ = false;
};

bool MdlParser::read_count(std::uint32_t& count, const char* what) {
  const std::size_t at = reader_.offset();
  const std::int32_t stored = reader_.i32();
  if (reader_.failed()) return refuse(at, "file ends inside the model's header");
  if (stored < 1) return refuse(at, "number of " + std::string(what) + " is " + std::to_string(stored));
  count = static_cast<std::uint32_t>(stored);
  return true;
}

bool MdlParser::read_vec3(vec3& v, const char* what) {
  const std::size_t at = reader_.offset();
  for (int axis = 0; axis < 3; ++axis) v[axis] = reader_.f32();
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(v[axis])) return refuse(at, std::string(what) + " is not finite");
  }
  return true;
}

bool MdlParser::read_header() {
  const std::uint32_t magic = reader_.u32();
  if (reader_.failed() || magic != kMdlMagic) return refuse(0, "no alias model: it does not begin with IDPO");
  const std::int32_t version = reader_.i32();
  if (reader_.failed() || version != 6)
    return refuse(4, "alias model has version " + std::to_string(version) + ", not 6");
  if (!read_vec3(mdl_.scale, "scale") || !read_vec3(mdl_.origin, "origin")) return false;
  const std::size_t radius_at = reader_.offset();
  mdl_.bounding_radius = reader_.f32();
  if (!std::isfinite(mdl_.bounding_radius)) {
    mend(radius_at, "bounding radius is not finite; taken as 0", said_radius_);
    mdl_.bounding_radius = 0.0f;
  }
  if (!read_vec3(mdl_.eye_position, "eye position")) return false;

  const std::size_t size_at = reader_.offset() + 4;
  std::uint32_t width = 0, height = 0;
  if (!read_count(skin_count_, "skins") || !read_count(width, "skin columns") || !read_count(height, "skin rows")) {
    return false;
  }
  if (width > kMaxImageSize || height > kMaxImageSize) {
    return refuse(size_at, "skins of " + std::to_string(width) + " by " + std::to_string(height) + " are too large");
  }
  mdl_.skin_width = static_cast<int>(width);
  mdl_.skin_height = static_cast<int>(height);
  if (!read_count(mdl_.vertex_count, "vertices") || !read_count(triangle_count_, "triangles") ||
      !read_count(frame_count_, "frames")) {
    return false;
  }
  mdl_.sync_type = reader_.i32();
  mdl_.flags = reader_.u32();
  reader_.f32();  // average triangle size: used by software renderers only
  if (reader_.failed()) return refuse(reader_.offset(), "file ends inside the model's header");
  return true;
}

bool MdlParser::read_skin_image(MdlSkin& skin) {
  const std::size_t at = reader_.offset();
  const std::size_t texels = static_cast<std::size_t>(mdl_.skin_width) * static_cast<std::size_t>(mdl_.skin_height);
  const ByteView view = reader_.bytes(texels);
  if (reader_.failed()) return refuse(at, "file ends inside a skin of " + std::to_string(texels) + " bytes");
  skin.images.push_back({mdl_.skin_width, mdl_.skin_height, {view.begin(), view.end()}});
  return true;
}

bool MdlParser::read_skins() {
  if (!holds(skin_count_, 5)) {
    return refuse(reader_.offset(), "file is too short for " + std::to_string(skin_count_) + " skins");
  }
  for (std::uint32_t i = 0; i < skin_count_; ++i) {
    const std::size_t at = reader_.offset();
    const std::int32_t is_group = reader_.i32();
    MdlSkin& skin = mdl_.skins.emplace_back();
    std::uint32_t image_count = 1;
    if (is_group != 0) {
      image_count = reader_.u32();
      if (reader_.failed() || image_count < 1 || !holds(image_count, 5)) {
        return refuse(at, "group of " + std::to_string(image_count) + " skins is empty or runs past the file's end");
      }
      if (!detail::read_group_times(reader_, image_count, skin.end_times)) {
        mend(at, "group has a time that is not positive; taken as 0.1 s each", said_times_);
      }
    }
    for (std::uint32_t k = 0; k < image_count; ++k) {
      if (!read_skin_image(skin)) return false;
    }
  }
  return true;
}

bool MdlParser::read_tex_coords() {
  if (!holds(mdl_.vertex_count, kTexCoordSize)) {
    return refuse(reader_.offset(), "file is too short for " + std::to_string(mdl_.vertex_count) + " vertices");
  }
  mdl_.tex_coords.resize(mdl_.vertex_count);
  for (MdlTexCoord& coord : mdl_.tex_coords) {
    coord.on_seam = reader_.i32() != 0;
    coord.s = reader_.i32();
    coord.t = reader_.i32();
  }
  return true;
}

bool MdlParser::read_triangles() {
  if (!holds(triangle_count_, kTriangleSize)) {
    return refuse(reader_.offset(), "file is too short for " + std::to_string(triangle_count_) + " triangles");
  }
  const std::size_t first_at = reader_.offset();
  mdl_.triangles.reserve(triangle_count_);
  for (std::uint32_t i = 0; i < triangle_count_; ++i) {
    const std::size_t at = reader_.offset();
    MdlTriangle triangle{};
    triangle.faces_front = reader_.i32() != 0;
    for (std::uint32_t& vertex : triangle.vertices) vertex = reader_.u32();
    if (std::ranges::all_of(triangle.vertices, [&](std::uint32_t vertex) { return vertex < mdl_.vertex_count; }))
      mdl_.triangles.push_back(triangle);
    else
      mend(at, "triangle names a vertex beyond those there are; left out", said_vertex_);
  }
  if (mdl_.triangles.empty()) return refuse(first_at, "every triangle names a vertex beyond those there are");
  return true;
}

bool MdlParser::read_pose(std::string& name) {
  const std::size_t at = reader_.offset();
  reader_.skip(8);  // bounding box in bytes: follows from the vertices
  name = reader_.fixed_string(16);
  if (reader_.failed() || !holds(mdl_.vertex_count, kVertexSize)) return refuse(at, "file ends inside a frame");
  for (std::uint32_t i = 0; i < mdl_.vertex_count; ++i) {
    const std::size_t vertex_at = reader_.offset();
    MdlVertex vertex;
    vertex.x = reader_.u8();
    vertex.y = reader_.u8();
    vertex.z = reader_.u8();
    vertex.normal = reader_.u8();
    if (vertex.normal >= kMdlNormalCount) {
      mend(vertex_at, "vertex names a normal beyond the 162 there are; taken as the first", said_normal_);
      vertex.normal = 0;
    }
    mdl_.vertices.push_back(vertex);
  }
  ++mdl_.pose_count;
  return true;
}

bool MdlParser::read_frames() {
  const std::uint64_t frame_size = 4 + kPoseHeaderSize + kVertexSize * std::uint64_t{mdl_.vertex_count};
  const std::size_t likely = std::min<std::size_t>(frame_count_, reader_.remaining() / frame_size);
  mdl_.vertices.reserve(likely * mdl_.vertex_count);
  mdl_.frames.reserve(likely);
  for (std::uint32_t i = 0; i < frame_count_; ++i) {
    if (read_frame()) continue;
    if (i == 0) return false;
    leave_rest_out(i);
    break;
  }
  mdl_.vertices.shrink_to_fit();
  return true;
}

// Frames have no size of their own: where one is broken, nothing says where the next begins.
void MdlParser::leave_rest_out(std::uint32_t whole) {
  mdl_.frames.resize(whole);
  mdl_.pose_count = mdl_.frames.back().first_pose + mdl_.frames.back().pose_count;
  mdl_.vertices.resize(std::size_t{mdl_.pose_count} * mdl_.vertex_count);
  mdl_.warnings.push_back(error_.message + "; of " + std::to_string(frame_count_) + " frames the first " +
                          std::to_string(whole) + " are used");
}

bool MdlParser::read_frame() {
  const std::uint64_t pose_size = kPoseHeaderSize + kVertexSize * std::uint64_t{mdl_.vertex_count};
  const std::size_t at = reader_.offset();
  const std::int32_t is_group = reader_.i32();
  MdlFrame& frame = mdl_.frames.emplace_back();
  frame.first_pose = mdl_.pose_count;
  frame.pose_count = 1;
  if (is_group != 0) {
    frame.pose_count = reader_.u32();
    reader_.skip(8);  // bounding box of the group
    if (reader_.failed() || frame.pose_count < 1 || !holds(frame.pose_count, 4 + pose_size)) {
      return refuse(at,
                    "group of " + std::to_string(frame.pose_count) + " frames is empty or runs past the file's end");
    }
    if (!detail::read_group_times(reader_, frame.pose_count, frame.end_times)) {
      mend(at, "group has a time that is not positive; taken as 0.1 s each", said_times_);
    }
  }
  for (std::uint32_t k = 0; k < frame.pose_count; ++k) {
    std::string pose_name;
    if (!read_pose(pose_name)) return false;
    if (k == 0) frame.name = std::move(pose_name);
  }
  return true;
}

}  // namespace

Result<Mdl> parse_mdl(ByteView data, std::string_view name) { return MdlParser(data, name).parse(); }

}  // namespace fb::formats
