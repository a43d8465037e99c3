// Shared by the parts of the map parser: record sizes of each version, lumps as parts of the file, the list of repaired
// faults, and the tree check. Internal to formats.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "base/maths.h"
#include "formats/bsp.h"

namespace fb::formats::detail {

// A part of the file.
struct Lump {
  std::size_t offset = 0, size = 0;
  std::size_t end() const { return offset + size; }
};

// Repaired faults, one entry for each cause however often it occurs.
class Mendings {
 public:
  // `cause` must be a literal: the entry keeps a view of it.
  void add(std::size_t offset, std::string_view cause) {
    for (Entry& entry : entries_) {
      if (entry.cause == cause) {
        ++entry.count;
        return;
      }
    }
    entries_.push_back({cause, offset, 1});
  }
  std::vector<std::string> sentences(const ByteReader& file) const {
    std::vector<std::string> lines;
    for (const Entry& entry : entries_) {
      std::string line = file.error_at(entry.offset, entry.cause).message;
      if (entry.count > 1) line += " (and " + std::to_string(entry.count - 1) + " more)";
      lines.push_back(std::move(line));
    }
    return lines;
  }

 private:
  struct Entry {
    std::string_view cause;
    std::size_t offset, count;
  };
  std::vector<Entry> entries_;
};

// Differences of the versions: BSP29 and Quake 64's have 16-bit indices, BSP2 has float bounds.
struct Layout {
  bool wide_indices = false;
  bool float_bounds = false;

  std::size_t node_size() const { return float_bounds ? 44 : wide_indices ? 32 : 24; }
  std::size_t leaf_size() const { return float_bounds ? 44 : wide_indices ? 32 : 28; }
  std::size_t face_size() const { return wide_indices ? 28 : 20; }
  std::size_t clip_node_size() const { return wide_indices ? 12 : 8; }
  std::size_t edge_size() const { return wide_indices ? 8 : 4; }
  std::size_t mark_face_size() const { return wide_indices ? 4 : 2; }

  std::uint32_t index(ByteReader& reader) const { return wide_indices ? reader.u32() : reader.u16(); }
};

inline bool range_fits(std::uint64_t first, std::uint64_t count, std::uint64_t size) {
  return first <= size && count <= size - first;
}

inline vec3 read_vec3(ByteReader& reader) {
  vec3 v;
  v.x = reader.f32();
  v.y = reader.f32();
  v.z = reader.f32();
  return v;
}
inline bool is_finite(const vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// The bounds of a node, leaf or model: floats that are not finite become 0.
vec3 read_bound(ByteReader& reader, const Layout& layout, Mendings& mendings);
vec3 mended_vec3(ByteReader& reader, Mendings& mendings, std::string_view cause);

// Reads leafs at the reader's position. Visibility offsets outside visibility_size become -1.
Result<std::vector<BspLeaf>> read_leafs(ByteReader& reader, std::size_t count, const Layout& layout,
                                        std::size_t mark_face_count, std::size_t visibility_size, Mendings& mendings);

// Reads the texture lump; bad textures are returned as missing ones, textures without a name are called unnamedN.
std::vector<BspTexture> read_textures(const ByteReader& file, Lump lump, BspVersion version, Mendings& mendings);

// A Quake 64 map's samples of light, each 5 bits of red, 5 of green and 6 of blue from the top, as bytes.
Bytes light_of_quake64(ByteView samples);

// Reads the BSPX lumps after the map's own; an invalid directory is ignored.
std::vector<std::pair<std::string, Bytes>> read_bspx(const ByteReader& file, std::size_t maps_end, Mendings& mendings);

// Walks every binary tree in `children` (negative: not a node) without recursion. nullopt if there is no cycle, no path
// longer than kMaxBspDepth and, where shared_allowed is false, no node with two parents.
struct TreeFault {
  std::size_t node;
  const char* cause;
};
std::optional<TreeFault> find_tree_fault(const std::vector<std::array<std::int32_t, 2>>& children, bool shared_allowed);

}  // namespace fb::formats::detail
