// Parses maps: the header, the fifteen lumps in an order in which each can be checked against those before it, then the
// trees. Formats as in the published specifications of Quake's BSP29 and of RMQ's 2PSB and BSP2; Quake 64's as
// QuakeSpasm reads it. Which faults are repaired instead of refused follows QuakeSpasm's behaviour.
#include "formats/bsp.h"

#include "base/text_mark.h"
#include "formats/bsp_detail.h"

namespace fb::formats {
namespace {

using detail::Layout;
using detail::Lump;
using detail::Mendings;
using detail::range_fits;
using detail::read_vec3;

enum LumpIndex {
  kEntities,
  kPlanes,
  kTextures,
  kVertices,
  kVisibility,
  kNodes,
  kTexInfos,
  kFaces,
  kLighting,
  kClipNodes,
  kLeafs,
  kMarkFaces,
  kEdges,
  kSurfedges,
  kModels,
  kLumpCount
};
constexpr std::array<const char*, kLumpCount> kLumpNames = {
    "entities", "planes",    "textures", "vertices",     "visibility", "nodes",     "texinfos", "faces",
    "lighting", "clipnodes", "leafs",    "marksurfaces", "edges",      "surfedges", "models"};

// A map is whole without these: a wall is plain, everything is seen from everywhere, no light is stored.
constexpr bool can_be_spared(std::size_t lump) { return lump == kTextures || lump == kVisibility || lump == kLighting; }

// CRC-16/CCITT as QuakeSpasm computes it for external entity files.
std::uint16_t crc16(ByteView data) {
  std::uint32_t crc = 0xffff;
  for (const std::uint8_t byte : data) {
    crc ^= static_cast<std::uint32_t>(byte) << 8u;
    for (int bit = 0; bit < 8; ++bit) crc = ((crc << 1u) ^ ((crc & 0x8000u) != 0 ? 0x1021u : 0u)) & 0xffffu;
  }
  return static_cast<std::uint16_t>(crc);
}

class BspParser {
 public:
  BspParser(ByteView data, std::string_view name) : reader_(data, name) {}

  Result<Bsp> parse() {
    const bool ok = read_header() && read_extensions() && read_entities() && read_planes() && read_vertices() &&
                    read_edges() && read_surfedges() && read_textures() && read_texinfos() && read_faces() &&
                    read_mark_faces() && read_leafs() && read_nodes() && read_clip_nodes() && read_models();
    if (!ok) return *error_;
    bsp_.warnings = mendings_.sentences(reader_);
    return std::move(bsp_);
  }

 private:
  bool refuse(std::size_t offset, std::string_view cause) {
    error_ = reader_.error_at(offset, cause);
    return false;
  }
  // Seeks to a lump of fixed-size records; the count is checked against the file by the lump's size.
  bool open(LumpIndex index, std::size_t record_size, std::size_t& count) {
    const Lump& lump = lumps_[index];
    if (lump.size % record_size != 0) {
      return refuse(lump.offset, std::string(kLumpNames[index]) + " lump has " + std::to_string(lump.size) +
                                     " bytes, which is no multiple of " + std::to_string(record_size));
    }
    reader_.seek(lump.offset);
    count = lump.size / record_size;
    return true;
  }
  ByteView lump_bytes(LumpIndex index) const {
    return reader_.data().subspan(lumps_[index].offset, lumps_[index].size);
  }

  bool read_header();
  bool read_extensions();
  bool read_entities();
  bool read_planes();
  bool read_vertices();
  bool read_edges();
  bool read_surfedges();
  bool read_textures();
  bool read_texinfos();
  bool read_faces();
  bool read_mark_faces();
  bool read_leafs();
  bool read_nodes();
  bool read_clip_nodes();
  bool read_models();
  std::int32_t read_node_child(std::size_t node_count);
  std::int32_t read_clip_child(std::size_t clip_node_count);
  template <typename Node>
  bool check_trees(const std::vector<Node>& nodes, LumpIndex lump, std::size_t record_size, bool shared_allowed);

  ByteReader reader_;
  Layout layout_;
  std::size_t light_samples_ = 0;
  std::array<Lump, kLumpCount> lumps_;
  Mendings mendings_;
  std::optional<Error> error_;
  Bsp bsp_;
};

bool BspParser::read_header() {
  const std::uint32_t version = reader_.u32();
  if (reader_.failed()) return refuse(0, "file is too short for a map");
  switch (version) {
    case 29:
      bsp_.version = BspVersion::kBsp29;
      break;
    case 0x32505342u:  // "BSP2"
      bsp_.version = BspVersion::kBsp2;
      layout_ = {true, true};
      break;
    case 0x42535032u:  // "2PSB"
      bsp_.version = BspVersion::k2Psb;
      layout_ = {true, false};
      break;
    case 0x51363420u:  // " 46Q", the number that spells "Q64 "
      bsp_.version = BspVersion::kQuake64;
      break;
    default:
      return refuse(0, "map version " + std::to_string(version) + " is none of 29, BSP2, 2PSB, Quake 64's");
  }
  for (std::size_t i = 0; i < kLumpCount; ++i) {
    const std::size_t entry = reader_.offset();
    const std::uint32_t offset = reader_.u32();
    const std::uint32_t size = reader_.u32();
    if (reader_.failed()) return refuse(entry, "file ends inside the map's header");
    if (size == 0) continue;  // empty lumps may point anywhere
    if (!range_fits(offset, size, reader_.size())) {
      if (can_be_spared(i)) {
        mendings_.add(entry, "a lump of textures, visibility or light lies outside the file; left out");
        continue;
      }
      return refuse(entry, std::string(kLumpNames[i]) + " lump (" + std::to_string(size) + " bytes at " +
                               std::to_string(offset) + ") lies outside the file of " + std::to_string(reader_.size()) +
                               " bytes");
    }
    lumps_[i] = {offset, size};
  }
  return true;
}

bool BspParser::read_extensions() {
  std::size_t maps_end = 4 + 8 * kLumpCount;
  for (const Lump& lump : lumps_) maps_end = std::max(maps_end, lump.end());
  bsp_.bspx = detail::read_bspx(reader_, maps_end, mendings_);
  if (bsp_.version == BspVersion::kQuake64) {
    if (lumps_[kLighting].size > 0)
      bsp_.bspx.emplace_back("RGBLIGHTING", detail::light_of_quake64(lump_bytes(kLighting)));
  } else {
    const ByteView lighting = lump_bytes(kLighting);
    bsp_.lighting.assign(lighting.begin(), lighting.end());
  }
  // Coloured light may come without the grey lump: its samples are three bytes each.
  light_samples_ = bsp_.lighting.size();
  for (const auto& [name, bytes] : bsp_.bspx) {
    if (name == "RGBLIGHTING") light_samples_ = std::max(light_samples_, bytes.size() / 3);
  }
  return true;
}

bool BspParser::read_entities() {
  const ByteView text = lump_bytes(kEntities);
  if (const Status fits = check_entity_text(text.size(), reader_.name() + ": entities lump"); !fits) {
    error_ = fits.error();
    return false;
  }
  if (!text.empty()) bsp_.entities_crc = crc16(text.first(text.size() - 1));
  const std::string_view plain = without_byte_order_mark({reinterpret_cast<const char*>(text.data()), text.size()});
  bsp_.entities = plain.substr(0, plain.find('\0'));
  return true;
}

bool BspParser::read_planes() {
  std::size_t count = 0;
  if (!open(kPlanes, 20, count)) return false;
  bsp_.planes.resize(count);
  for (BspPlane& plane : bsp_.planes) {
    const std::size_t at = reader_.offset();
    plane.normal = read_vec3(reader_);
    plane.distance = reader_.f32();
    plane.type = reader_.i32();
    if (!detail::is_finite(plane.normal) || !std::isfinite(plane.distance)) {
      return refuse(at, "plane has a number that is not finite");
    }
    if (plane.type < 0 || plane.type > 5) {
      mendings_.add(at, "plane has an unknown type; taken as not axial");
      plane.type = 3;
    }
  }
  return true;
}

bool BspParser::read_vertices() {
  std::size_t count = 0;
  if (!open(kVertices, 12, count)) return false;
  bsp_.vertices.resize(count);
  for (vec3& vertex : bsp_.vertices) {
    const std::size_t at = reader_.offset();
    vertex = read_vec3(reader_);
    for (int axis = 0; axis < 3; ++axis) {
      if (!(std::abs(vertex[axis]) <= kMaxBspCoordinate)) return refuse(at, "vertex is not finite, or too far away");
    }
  }
  return true;
}

bool BspParser::read_edges() {
  std::size_t count = 0;
  if (!open(kEdges, layout_.edge_size(), count)) return false;
  bsp_.edges.resize(count);
  for (auto& edge : bsp_.edges) {
    const std::size_t at = reader_.offset();
    edge = {layout_.index(reader_), layout_.index(reader_)};
    if (std::max(edge[0], edge[1]) >= bsp_.vertices.size()) {
      return refuse(at, "edge names vertex " + std::to_string(std::max(edge[0], edge[1])) + " of " +
                            std::to_string(bsp_.vertices.size()));
    }
  }
  return true;
}

bool BspParser::read_surfedges() {
  std::size_t count = 0;
  if (!open(kSurfedges, 4, count)) return false;
  bsp_.surfedges.resize(count);
  for (std::int32_t& surfedge : bsp_.surfedges) {
    const std::size_t at = reader_.offset();
    surfedge = reader_.i32();
    if (std::abs(std::int64_t{surfedge}) >= static_cast<std::int64_t>(bsp_.edges.size())) {
      return refuse(at, "surfedge names edge " + std::to_string(surfedge) + " of " + std::to_string(bsp_.edges.size()));
    }
  }
  return true;
}

bool BspParser::read_textures() {
  bsp_.textures = detail::read_textures(reader_, lumps_[kTextures], bsp_.version, mendings_);
  return true;
}

bool BspParser::read_texinfos() {
  std::size_t count = 0;
  if (!open(kTexInfos, 40, count)) return false;
  bsp_.texinfos.resize(count);
  for (BspTexInfo& info : bsp_.texinfos) {
    const std::size_t at = reader_.offset();
    for (vec4& axis : info.axes) {
      for (int k = 0; k < 4; ++k) axis[k] = reader_.f32();
      for (int k = 0; k < 4; ++k) {
        if (std::isfinite(axis[k])) continue;
        mendings_.add(at, "texinfo has a number that is not finite; its axis is taken as 0");
        axis = vec4(0.0f);
      }
    }
    info.texture = reader_.u32();
    info.flags = reader_.u32();
    if (info.texture >= bsp_.textures.size()) {
      if (info.texture != kNoTexture) mendings_.add(at, "texinfo names a texture that does not exist; taken as none");
      info.texture = kNoTexture;
    }
  }
  return true;
}

bool BspParser::read_faces() {
  std::size_t count = 0;
  if (!open(kFaces, layout_.face_size(), count)) return false;
  bsp_.faces.resize(count);
  for (BspFace& face : bsp_.faces) {
    const std::size_t at = reader_.offset();
    face.plane = layout_.index(reader_);
    face.back_side = layout_.index(reader_) != 0;
    face.first_surfedge = reader_.u32();
    face.surfedge_count = layout_.index(reader_);
    face.texinfo = layout_.index(reader_);
    for (std::uint8_t& style : face.styles) style = reader_.u8();
    face.light_offset = reader_.i32();
    // Quake 64's counts bytes, of which a sample has two.
    if (bsp_.version == BspVersion::kQuake64 && face.light_offset > 0) face.light_offset /= 2;
    if (face.plane >= bsp_.planes.size()) {
      return refuse(at, "face names plane " + std::to_string(face.plane) + " of " + std::to_string(bsp_.planes.size()));
    }
    if (face.surfedge_count == 0) face.first_surfedge = 0;
    if (!range_fits(face.first_surfedge, face.surfedge_count, bsp_.surfedges.size())) {
      return refuse(at, "face names surfedges beyond the " + std::to_string(bsp_.surfedges.size()) + " there are");
    }
    if (face.surfedge_count < 3) mendings_.add(at, "face has fewer than three edges");
    if (face.texinfo >= bsp_.texinfos.size()) {
      return refuse(
          at, "face names texinfo " + std::to_string(face.texinfo) + " of " + std::to_string(bsp_.texinfos.size()));
    }
    if (face.light_offset < 0 || static_cast<std::size_t>(face.light_offset) >= light_samples_) {
      // Maps without light may still have the offsets of a lump that was removed.
      if (face.light_offset != -1 && light_samples_ != 0) {
        mendings_.add(at, "face has its light outside the lighting lump; taken as none");
      }
      face.light_offset = -1;
    }
  }
  return true;
}

bool BspParser::read_mark_faces() {
  std::size_t count = 0;
  if (!open(kMarkFaces, layout_.mark_face_size(), count)) return false;
  bsp_.mark_faces.resize(count);
  for (std::uint32_t& face : bsp_.mark_faces) {
    const std::size_t at = reader_.offset();
    face = layout_.index(reader_);
    if (face >= bsp_.faces.size()) {
      return refuse(at, "marksurface names face " + std::to_string(face) + " of " + std::to_string(bsp_.faces.size()));
    }
  }
  return true;
}

bool BspParser::read_leafs() {
  std::size_t count = 0;
  if (!open(kLeafs, layout_.leaf_size(), count)) return false;
  if (count == 0) return refuse(4 + kLeafs * 8, "map has no leafs");
  const ByteView visibility = lump_bytes(kVisibility);
  bsp_.visibility.assign(visibility.begin(), visibility.end());
  auto leafs = detail::read_leafs(reader_, count, layout_, bsp_.mark_faces.size(), bsp_.visibility.size(), mendings_);
  if (!leafs) {
    error_ = leafs.error();
    return false;
  }
  bsp_.leafs = std::move(*leafs);
  return true;
}

// BSP29 counts nodes up from 0 and leafs down from 65535, so that together they share 16 bits.
std::int32_t BspParser::read_node_child(std::size_t node_count) {
  const std::size_t at = reader_.offset();
  const std::uint32_t stored = layout_.index(reader_);
  if (stored < node_count) return static_cast<std::int32_t>(stored);
  const std::uint32_t leaf = (layout_.wide_indices ? 0xffffffffu : 0xffffu) - stored;
  if (leaf < bsp_.leafs.size()) return ~static_cast<std::int32_t>(leaf);
  mendings_.add(at, "node names a child that does not exist; taken as the solid leaf 0");
  return ~0;
}

bool BspParser::read_nodes() {
  std::size_t count = 0;
  if (!open(kNodes, layout_.node_size(), count)) return false;
  bsp_.nodes.resize(count);
  for (BspNode& node : bsp_.nodes) {
    const std::size_t at = reader_.offset();
    node.plane = reader_.u32();
    node.children[0] = read_node_child(count);
    node.children[1] = read_node_child(count);
    node.mins = detail::read_bound(reader_, layout_, mendings_);
    node.maxs = detail::read_bound(reader_, layout_, mendings_);
    node.first_face = layout_.index(reader_);
    node.face_count = layout_.index(reader_);
    if (node.plane >= bsp_.planes.size()) {
      return refuse(at, "node names plane " + std::to_string(node.plane) + " of " + std::to_string(bsp_.planes.size()));
    }
    if (node.face_count == 0) node.first_face = 0;
    if (!range_fits(node.first_face, node.face_count, bsp_.faces.size())) {
      return refuse(at, "node names faces beyond the " + std::to_string(bsp_.faces.size()) + " there are");
    }
  }
  return check_trees(bsp_.nodes, kNodes, layout_.node_size(), false);
}

// BSP29 clip nodes past 32767 look negative: like QuakeSpasm, takes an index that is no clip node as contents, counted
// down from 65536.
std::int32_t BspParser::read_clip_child(std::size_t clip_node_count) {
  const std::size_t at = reader_.offset();
  const std::uint32_t stored = layout_.index(reader_);
  if (stored < clip_node_count) return static_cast<std::int32_t>(stored);
  const auto contents =
      static_cast<std::int32_t>(layout_.wide_indices ? stored : stored | 0xffff0000u);  // sign of the 16-bit value
  if (contents >= 0) {
    mendings_.add(at, "clip node names a child that does not exist; taken as solid");
    return kContentsSolid;
  }
  if (contents < kContentsCurrentDown - 1) {
    mendings_.add(at, "clip node has unknown contents; taken as empty");
    return kContentsEmpty;
  }
  return contents;
}

bool BspParser::read_clip_nodes() {
  std::size_t count = 0;
  if (!open(kClipNodes, layout_.clip_node_size(), count)) return false;
  bsp_.clip_nodes.resize(count);
  for (BspClipNode& node : bsp_.clip_nodes) {
    const std::size_t at = reader_.offset();
    node.plane = reader_.u32();
    node.children[0] = read_clip_child(count);
    node.children[1] = read_clip_child(count);
    if (node.plane >= bsp_.planes.size()) {
      return refuse(
          at, "clip node names plane " + std::to_string(node.plane) + " of " + std::to_string(bsp_.planes.size()));
    }
  }
  // Compilers may merge equal clip nodes, so a child with several parents is fine here.
  return check_trees(bsp_.clip_nodes, kClipNodes, layout_.clip_node_size(), true);
}

template <typename Node>
bool BspParser::check_trees(const std::vector<Node>& nodes, LumpIndex lump, std::size_t record_size,
                            bool shared_allowed) {
  std::vector<std::array<std::int32_t, 2>> children;
  children.reserve(nodes.size());
  for (const Node& node : nodes) children.push_back(node.children);
  const auto fault = detail::find_tree_fault(children, shared_allowed);
  if (!fault) return true;
  return refuse(lumps_[lump].offset + fault->node * record_size,
                std::string(fault->cause) + " in the " + kLumpNames[lump] + " lump");
}

bool BspParser::read_models() {
  std::size_t count = 0;
  if (!open(kModels, 64, count)) return false;
  if (count == 0) return refuse(4 + kModels * 8, "map has no world model");
  bsp_.models.resize(count);
  for (BspModel& model : bsp_.models) {
    const std::size_t at = reader_.offset();
    constexpr std::string_view kNotFinite = "model has bounds or origin that are not finite; taken as 0";
    model.mins = detail::mended_vec3(reader_, mendings_, kNotFinite);
    model.maxs = detail::mended_vec3(reader_, mendings_, kNotFinite);
    model.origin = detail::mended_vec3(reader_, mendings_, kNotFinite);
    for (std::int32_t& head : model.head_nodes) head = reader_.i32();
    model.visible_leafs = reader_.u32();
    model.first_face = reader_.u32();
    model.face_count = reader_.u32();

    const std::int32_t root = model.head_nodes[0];
    if (root >= 0 ? static_cast<std::size_t>(root) >= bsp_.nodes.size()
                  : static_cast<std::size_t>(~root) >= bsp_.leafs.size()) {
      return refuse(at, "model names head node " + std::to_string(root) + " of " + std::to_string(bsp_.nodes.size()));
    }
    for (std::size_t hull = 1; hull < 4; ++hull) {
      std::int32_t& head = model.head_nodes[hull];
      if (head < 0 ? head >= kContentsCurrentDown - 1 : static_cast<std::size_t>(head) < bsp_.clip_nodes.size()) {
        continue;
      }
      // Hull 3 is never used, and maps built without clip nodes still point at the first one.
      if (hull < 3) mendings_.add(at, "model names a clip node that does not exist; its hull is taken as empty");
      head = kContentsEmpty;
    }
    if (model.visible_leafs >= bsp_.leafs.size()) {
      mendings_.add(at, "model counts more visible leafs than there are; taken as all");
      model.visible_leafs = static_cast<std::uint32_t>(bsp_.leafs.size() - 1);
    }
    if (model.face_count == 0) model.first_face = 0;
    if (!range_fits(model.first_face, model.face_count, bsp_.faces.size())) {
      return refuse(at, "model names faces beyond the " + std::to_string(bsp_.faces.size()) + " there are");
    }
  }
  return true;
}

}  // namespace

Status check_entity_text(std::size_t size, std::string_view name) {
  if (size <= kMostEntityText) return ok_status();
  return Error{std::string(name) + ": " + std::to_string(size) + " bytes of entities; at most " +
               std::to_string(kMostEntityText) + " are taken"};
}

Result<Bsp> parse_bsp(ByteView data, std::string_view name) { return BspParser(data, name).parse(); }

}  // namespace fb::formats
