#include "scene/authored/authored_bytes.h"

#include <bit>
#include <span>
#include <type_traits>
#include <vector>

#include "base/hash.h"
#include "shared/gain_field.h"

namespace fb::scene {
namespace {

constexpr std::uint32_t kAuthoredVersion = 4;      // of how light is found: goes up with every change to it
constexpr std::uint32_t kMagic = 0x544c4246;       // FBLT
constexpr std::size_t kMostGainCells = 1u << 22u;  // of all ways

class Key {
 public:
  template <typename T>
  Key& add(const T& value) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
    key_ = hash_bytes(&value, sizeof value, key_);
    return *this;
  }
  Key& add(const vec3& v) { return add(v.x).add(v.y).add(v.z); }
  Key& add(const vec4& v) { return add(vec3(v)).add(v.w); }
  template <typename T>
  Key& add_all(const std::vector<T>& values) {
    static_assert(std::has_unique_object_representations_v<T>);
    return add_bytes(values.data(), values.size() * sizeof(T));
  }
  Key& add_bytes(const void* data, std::size_t size) {
    key_ = hash_bytes(data, size, hash_bytes(&size, sizeof size, key_));
    return *this;
  }
  std::uint64_t get() const { return key_; }

 private:
  std::uint64_t key_ = kAuthoredVersion;
};

void add_geometry(Key& key, const formats::Bsp& bsp) {
  key.add_bytes(bsp.vertices.data(), bsp.vertices.size() * sizeof(vec3)).add_all(bsp.edges).add_all(bsp.surfedges);
  for (const formats::BspPlane& p : bsp.planes) key.add(p.normal).add(p.distance);
  for (const formats::BspNode& n : bsp.nodes)
    key.add(n.plane).add(n.children[0]).add(n.children[1]).add(n.first_face).add(n.face_count);
  for (const formats::BspLeaf& l : bsp.leafs) key.add(l.contents).add(l.vis_offset);
  for (const formats::BspTexInfo& t : bsp.texinfos) key.add(t.axes[0]).add(t.axes[1]).add(t.texture).add(t.flags);
  for (const formats::BspFace& f : bsp.faces) {
    key.add(f.plane).add(f.back_side).add(f.first_surfedge).add(f.surfedge_count).add(f.texinfo).add(f.light_offset);
    key.add_bytes(f.styles.data(), f.styles.size());
  }
  for (const formats::BspModel& m : bsp.models) key.add(m.head_nodes[0]).add(m.first_face).add(m.face_count);
  for (const formats::BspTexture& t : bsp.textures) key.add_bytes(t.name.data(), t.name.size());
  key.add_all(bsp.visibility).add_all(bsp.lighting);
  for (const auto& [name, bytes] : bsp.bspx) key.add_bytes(name.data(), name.size()).add_all(bytes);
}

class Writer {
 public:
  template <typename T>
  Writer& put(const T& value) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
    bytes_.insert(bytes_.end(), bytes, bytes + sizeof value);
    return *this;
  }
  Writer& put(const vec3& v) { return put(v.x).put(v.y).put(v.z); }
  Bytes take() {
    put(hash_bytes(bytes_.data(), bytes_.size()));
    return std::move(bytes_);
  }

 private:
  Bytes bytes_;
};

vec3 read_vec3(ByteReader& in) {
  const float x = in.f32(), y = in.f32(), z = in.f32();
  return {x, y, z};
}
std::uint64_t read_u64(ByteReader& in) {
  const std::uint64_t low = in.u32(), high = in.u32();
  return low | high << 32u;
}
double read_f64(ByteReader& in) { return std::bit_cast<double>(read_u64(in)); }

}  // namespace

std::uint64_t authored_key(const LitMap& map, const Lightmaps& lightmaps) {
  Key key;
  add_geometry(key, map.bsp);
  key.add_bytes(lightmaps.samples().data(), lightmaps.samples().size());
  for (const LitSurface& s : map.surfaces)
    key.add(s.material).add(s.reflectance).add(s.radiance).add(s.style).add(s.fall_scale);
  for (const std::vector<EntityLight>* lamps : {&map.lamps, &map.darkening}) {
    key.add(lamps->size());
    for (const EntityLight& l : *lamps) {
      key.add(l.position).add(l.radius).add(l.power_color).add(l.style).add(l.axis);
      key.add(l.fall).add(l.fall_scale).add(l.full_cosine).add(l.least_cosine);
    }
  }
  for (const Sun& s : map.suns) key.add(s.direction).add(s.irradiance);
  key.add(map.sky).add(map.ambient);
  for (const Submodel& s : map.submodels) key.add(s.index).add(s.offset);
  return key.get();
}

Bytes authored_bytes(const AuthoredLight& light, std::uint64_t key) {
  Writer out;
  out.put(kMagic).put(key).put(static_cast<std::uint32_t>(light.emitters.all.size()));
  for (std::size_t i = 0; i < light.emitters.all.size(); ++i)
    out.put(light.fit.factors[i]).put(light.fit.shares[i]).put(light.emitters.all[i].fall_scale);
  out.put(light.fit.common).put(light.fit.stops_before).put(light.fit.stops_after);
  out.put(static_cast<std::uint64_t>(light.points)).put(light.seconds);
  const GainField& gains = light.gains;
  out.put(gains.origin).put(gains.side).put(gains.width).put(gains.depth).put(gains.height);
  out.put(static_cast<std::uint32_t>(gains.cells.size()));
  for (const std::uint32_t cell : gains.cells) out.put(cell);
  for (const std::uint32_t submodel : light.lit_through) out.put(submodel);
  return out.take();
}

std::optional<AuthoredLight> read_authored(ByteView bytes, std::uint64_t key, const LitMap& map) {
  if (bytes.size() < sizeof(std::uint64_t)) return std::nullopt;
  const ByteView whole = bytes.first(bytes.size() - sizeof(std::uint64_t));
  ByteReader sum(bytes.last(sizeof(std::uint64_t)), "kept light"), in(whole, "kept light");
  if (read_u64(sum) != hash_bytes(whole.data(), whole.size())) return std::nullopt;
  if (in.u32() != kMagic || read_u64(in) != key) return std::nullopt;
  AuthoredLight light;
  light.emitters = find_emitters(map);
  if (in.u32() != light.emitters.all.size()) return std::nullopt;
  for (Emitter& emitter : light.emitters.all) {
    light.fit.factors.push_back(read_vec3(in));
    light.fit.shares.push_back(in.f32());
    emitter.fall_scale = in.f32();
  }
  light.fit.common = read_vec3(in);
  light.fit.stops_before = read_f64(in);
  light.fit.stops_after = read_f64(in);
  light.points = static_cast<std::size_t>(read_u64(in));
  light.seconds = read_f64(in);
  GainField& gains = light.gains;
  gains.origin = read_vec3(in);
  gains.side = in.f32();
  gains.width = in.u32();
  gains.depth = in.u32();
  gains.height = in.u32();
  const std::uint32_t cells = in.u32();
  constexpr std::size_t kWord = sizeof(std::uint32_t);
  const std::size_t cell_bytes = std::size_t{cells} * kWord;
  if (in.failed() || cells > kMostGainCells || in.remaining() < cell_bytes || in.remaining() % kWord != 0)
    return std::nullopt;
  const double whole_box = static_cast<double>(gains.width) * gains.depth * gains.height * shared::kGainWays;
  if (static_cast<double>(cells) != whole_box) return std::nullopt;
  for (std::uint32_t i = 0; i < cells; ++i) gains.cells.push_back(in.u32());
  while (in.remaining() > 0) light.lit_through.push_back(in.u32());
  return light;
}

}  // namespace fb::scene
