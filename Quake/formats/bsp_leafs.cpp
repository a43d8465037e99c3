// Parses leafs, of maps and of external .vis files, and the container of VisPatch: a sequence of records, each with a
// map's name (32 bytes), the size of what follows, then visibility and BSP29 leafs, each preceded by its size.
#include "formats/bsp_detail.h"

namespace fb::formats {
namespace detail {

vec3 mended_vec3(ByteReader& reader, Mendings& mendings, std::string_view cause) {
  const std::size_t at = reader.offset();
  const vec3 v = read_vec3(reader);
  if (is_finite(v)) return v;
  mendings.add(at, cause);
  return vec3(0.0f);
}

vec3 read_bound(ByteReader& reader, const Layout& layout, Mendings& mendings) {
  if (layout.float_bounds) return mended_vec3(reader, mendings, "box of a node or leaf is not finite; taken as 0");
  vec3 v;
  v.x = reader.i16();
  v.y = reader.i16();
  v.z = reader.i16();
  return v;
}

Result<std::vector<BspLeaf>> read_leafs(ByteReader& reader, std::size_t count, const Layout& layout,
                                        std::size_t mark_face_count, std::size_t visibility_size, Mendings& mendings) {
  std::vector<BspLeaf> leafs(count);
  for (BspLeaf& leaf : leafs) {
    const std::size_t at = reader.offset();
    leaf.contents = reader.i32();
    leaf.vis_offset = reader.i32();
    leaf.mins = read_bound(reader, layout, mendings);
    leaf.maxs = read_bound(reader, layout, mendings);
    leaf.first_mark_face = layout.index(reader);
    leaf.mark_face_count = layout.index(reader);
    for (std::uint8_t& level : leaf.ambient) level = reader.u8();

    if (leaf.contents >= 0 || leaf.contents < kContentsCurrentDown - 1) {
      mendings.add(at, "leaf has unknown contents; taken as empty");
      leaf.contents = kContentsEmpty;
    }
    if (leaf.vis_offset < 0 || static_cast<std::size_t>(leaf.vis_offset) >= visibility_size) {
      if (leaf.vis_offset != -1 && visibility_size != 0) {
        mendings.add(at, "leaf has its row outside the visibility lump; taken as seeing all");
      }
      leaf.vis_offset = -1;
    }
    if (leaf.mark_face_count == 0) leaf.first_mark_face = 0;
    if (!range_fits(leaf.first_mark_face, leaf.mark_face_count, mark_face_count)) {
      return reader.error_at(at,
                             "leaf names marksurfaces beyond the " + std::to_string(mark_face_count) + " there are");
    }
  }
  return leafs;
}

namespace {

bool same_name(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return lower(x) == lower(y); });
}

// Reads the record at the reader's position, which ends at `end`.
Result<std::optional<VisRecord>> read_record(ByteReader& reader, std::size_t end, const Bsp& bsp) {
  if (bsp.version != BspVersion::kBsp29 && bsp.version != BspVersion::kQuake64)
    return reader.error("visibility of a BSP29 map offered to one of another kind");
  const Layout layout;
  VisRecord record;

  const std::size_t visibility_at = reader.offset();
  const std::uint32_t visibility_size = reader.u32();
  if (reader.failed() || reader.offset() > end || visibility_size > end - reader.offset()) {
    return reader.error_at(visibility_at, "visibility runs past the end of its record");
  }
  const ByteView visibility = reader.bytes(visibility_size);
  record.visibility.assign(visibility.begin(), visibility.end());

  const std::size_t leafs_at = reader.offset();
  const std::uint32_t leafs_size = reader.u32();
  if (reader.failed() || reader.offset() > end || leafs_size > end - reader.offset()) {
    return reader.error_at(leafs_at, "leafs run past the end of their record");
  }
  if (leafs_size != bsp.leafs.size() * layout.leaf_size()) {
    return reader.error_at(leafs_at, "record has " + std::to_string(leafs_size) + " bytes of leafs, but the map has " +
                                         std::to_string(bsp.leafs.size()) + " leafs of 28 bytes");
  }
  Mendings mendings;  // the map itself reports the same faults
  auto leafs = read_leafs(reader, bsp.leafs.size(), layout, bsp.mark_faces.size(), visibility_size, mendings);
  if (!leafs) return leafs.error();
  record.leafs = std::move(*leafs);
  return std::optional<VisRecord>(std::move(record));
}

}  // namespace
}  // namespace detail

Result<std::optional<VisRecord>> parse_vis(ByteView data, std::string_view name, std::string_view map_name,
                                           const Bsp& bsp) {
  constexpr std::uint32_t kLeastRecord = 8;  // two sizes
  ByteReader reader(data, name);
  while (reader.remaining() > 0) {
    const std::size_t at = reader.offset();
    const std::string record_name = reader.fixed_string(32);
    const std::uint32_t size = reader.u32();
    if (reader.failed()) return reader.error_at(at, "file ends inside a record's header");
    if (size < kLeastRecord) {
      return reader.error_at(at, "record of " + std::to_string(size) + " bytes has no visibility and leafs");
    }
    if (size > reader.remaining()) {
      return reader.error_at(at, "record of " + std::to_string(size) + " bytes runs past the end of the file");
    }
    const std::size_t end = reader.offset() + size;
    if (detail::same_name(record_name, map_name)) return detail::read_record(reader, end, bsp);
    reader.seek(end);
  }
  return std::optional<VisRecord>();
}

}  // namespace fb::formats
