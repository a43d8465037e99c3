// Parses MD3 models: a header, then surfaces that each name their own parts by offsets from their beginning.
#include <algorithm>
#include <cmath>
#include <utility>

#include "formats/posed_model.h"

namespace fb::formats {
namespace {

constexpr std::uint32_t kMd3Magic = 0x33504449u;  // "IDP3"
constexpr std::uint32_t kMd3Version = 15;
constexpr std::size_t kNameSize = 64, kFrameSize = 56, kFrameNameAt = 40, kFrameNameSize = 16;
constexpr std::size_t kMd3TriangleSize = 12, kUvSize = 8, kMd3VertexSize = 8;
constexpr float kUnit = 1.0f / 64.0f;  // of a vertex's whole numbers

class Md3Parser {
 public:
  Md3Parser(ByteView data, std::string_view name) : data_(data), name_(name) {}

  Result<PosedModel> parse() {
    ByteReader reader(data_, name_);
    const std::uint32_t magic = reader.u32(), version = reader.u32();
    if (reader.failed() || magic != kMd3Magic) return reader.error_at(0, "no MD3 model: it does not begin with IDP3");
    if (version != kMd3Version) return reader.error_at(4, "version " + std::to_string(version) + ", not 15");
    reader.skip(kNameSize + 4);
    const std::uint32_t frames = reader.u32();
    reader.skip(4);
    const std::uint32_t surfaces = reader.u32();
    reader.skip(4);
    const std::uint32_t frames_at = reader.u32();
    reader.skip(4);
    const std::uint32_t surfaces_at = reader.u32();
    if (reader.failed()) return reader.error_at(0, "the file ends inside the model's header");
    if (frames < 1 || surfaces < 1) return reader.error_at(0, "it has no frames or no surfaces");
    if (!read_frames(frames_at, frames)) return std::move(error_);
    std::size_t at = surfaces_at;
    for (std::uint32_t i = 0; i < surfaces; ++i)
      if (!read_surface(at)) return std::move(error_);
    return interleaved();
  }

 private:
  bool refuse(const ByteReader& reader, std::size_t offset, std::string_view cause) {
    error_ = reader.error_at(std::min(offset, reader.size()), cause);
    return false;
  }
  static bool holds(const ByteReader& reader, std::uint64_t count, std::size_t size) {
    return count <= reader.remaining() / size;
  }

  bool read_frames(std::size_t at, std::uint32_t count) {
    ByteReader reader(data_, name_);
    reader.seek(at);
    if (reader.failed() || !holds(reader, count, kFrameSize)) return refuse(reader, at, "the file ends in the frames");
    for (std::uint32_t i = 0; i < count; ++i) {
      reader.skip(kFrameNameAt);
      model_.pose_names.push_back(reader.fixed_string(kFrameNameSize));
    }
    model_.pose_count = count;
    return true;
  }

  // `at`: where it begins; moved to the next one.
  bool read_surface(std::size_t& at) {
    ByteReader reader(data_, name_);
    reader.seek(at);
    const std::uint32_t magic = reader.u32();
    PosedSurface surface;
    surface.name = reader.fixed_string(kNameSize);
    reader.skip(4);
    const std::uint32_t frames = reader.u32(), shaders = reader.u32(), vertices = reader.u32(),
                        triangles = reader.u32(), triangles_at = reader.u32(), shaders_at = reader.u32(),
                        uv_at = reader.u32(), vertices_at = reader.u32(), end = reader.u32();
    if (reader.failed() || magic != kMd3Magic) return refuse(reader, at, "a surface is wanted");
    if (frames != model_.pose_count) return refuse(reader, at, "a surface has not as many frames as the model");
    if (vertices < 1 || triangles < 1) return refuse(reader, at, "a surface has no vertices or no triangles");
    if (end < kNameSize || end > data_.size() - at) return refuse(reader, at, "a surface ends where the file does not");
    if ((std::uint64_t{model_.vertex_count} + vertices) * frames > kMostPosedVertices)
      return refuse(reader, at, "vertices of all frames are too many");
    if (shaders > 0) {
      reader.seek(at + shaders_at);
      surface.shader = reader.fixed_string(kNameSize);
      if (reader.failed()) return refuse(reader, at, "the file ends in a surface's skins");
    }
    if (!read_triangles(at + triangles_at, triangles, vertices, surface) || !read_uv(at + uv_at, vertices) ||
        !read_vertices(at + vertices_at, vertices))
      return false;
    model_.vertex_count += vertices;
    model_.surfaces.push_back(std::move(surface));
    at += end;
    return true;
  }

  bool read_triangles(std::size_t at, std::uint32_t count, std::uint32_t vertices, PosedSurface& surface) {
    ByteReader reader(data_, name_);
    reader.seek(at);
    if (reader.failed() || !holds(reader, count, kMd3TriangleSize))
      return refuse(reader, at, "the file ends in a surface's triangles");
    for (std::uint32_t i = 0; i < count; ++i) {
      std::array<std::uint32_t, 3> corners;
      for (std::uint32_t& corner : corners) {
        const std::uint32_t vertex = reader.u32();
        if (vertex >= vertices) return refuse(reader, at, "a triangle of a vertex that does not exist");
        corner = model_.vertex_count + vertex;
      }
      surface.triangles.push_back(corners);
    }
    return true;
  }

  bool read_uv(std::size_t at, std::uint32_t count) {
    ByteReader reader(data_, name_);
    reader.seek(at);
    if (reader.failed() || !holds(reader, count, kUvSize))
      return refuse(reader, at, "the file ends in a surface's texture coordinates");
    for (std::uint32_t i = 0; i < count; ++i) {
      const float u = reader.f32(), v = reader.f32();
      if (!std::isfinite(u) || !std::isfinite(v)) return refuse(reader, at, "a texture coordinate is not finite");
      model_.uv.emplace_back(u, v);
    }
    return true;
  }

  bool read_vertices(std::size_t at, std::uint32_t count) {
    ByteReader reader(data_, name_);
    reader.seek(at);
    if (reader.failed() || !holds(reader, std::uint64_t{count} * model_.pose_count, kMd3VertexSize))
      return refuse(reader, at, "the file ends in a surface's vertices");
    std::vector<vec3>& positions = by_surface_.emplace_back();
    positions.reserve(std::size_t{count} * model_.pose_count);
    for (std::uint64_t i = 0; i < std::uint64_t{count} * model_.pose_count; ++i) {
      const float x = reader.i16(), y = reader.i16(), z = reader.i16();
      reader.skip(2);  // a normal of eight bits an angle; they are made anew
      positions.push_back(kUnit * vec3(x, y, z));
    }
    return true;
  }

  // From frames by surface to whole poses.
  PosedModel interleaved() {
    model_.positions.reserve(std::size_t{model_.vertex_count} * model_.pose_count);
    for (std::uint32_t pose = 0; pose < model_.pose_count; ++pose) {
      for (const std::vector<vec3>& surface : by_surface_) {
        const auto count = static_cast<std::ptrdiff_t>(surface.size() / model_.pose_count);
        const auto from = surface.begin() + count * static_cast<std::ptrdiff_t>(pose);
        model_.positions.insert(model_.positions.end(), from, from + count);
      }
    }
    return std::move(model_);
  }

  ByteView data_;
  std::string_view name_;
  Error error_;
  PosedModel model_;
  std::vector<std::vector<vec3>> by_surface_;
};

}  // namespace

Result<PosedModel> parse_md3(ByteView data, std::string_view name) { return Md3Parser(data, name).parse(); }

}  // namespace fb::formats
