#include "lab/import/gltf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "base/bytes.h"
#include "fs/file.h"
#include "lab/gltf/gltf_numbers.h"

namespace fb::lab {
namespace {

constexpr std::uint64_t kNoIndex = ~std::uint64_t{0};
// What may be required of whoever reads a scene.
constexpr std::array<std::string_view, 9> kKnown{"KHR_lights_punctual",        "KHR_materials_emissive_strength",
                                                 "KHR_materials_ior",          "KHR_materials_specular",
                                                 "KHR_materials_transmission", "KHR_materials_volume",
                                                 "KHR_mesh_quantization",      "KHR_materials_unlit",
                                                 "KHR_texture_transform"};

struct ComponentType {
  int number;  // OpenGL's
  std::size_t bytes;
  float most;  // of a normalised one
};
constexpr std::array kComponentTypes{ComponentType{5120, 1, 127},   ComponentType{5121, 1, 255},
                                     ComponentType{5122, 2, 32767}, ComponentType{5123, 2, 65535},
                                     ComponentType{5125, 4, 1},     ComponentType{5126, 4, 1}};

int components_of(std::string_view type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  return type == "VEC4" ? 4 : 0;
}

int hexadecimal(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

// RFC 3986, 2.1.
std::string without_escapes(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const int high = uri[i] == '%' && i + 2 < uri.size() ? hexadecimal(uri[i + 1]) : -1;
    const int low = high >= 0 ? hexadecimal(uri[i + 2]) : -1;
    text += low < 0 ? uri[i] : static_cast<char>(high * 16 + low);
    if (low >= 0) i += 2;
  }
  return text;
}

// RFC 4648, 4; what is none of its letters ends it.
Bytes from_base64(std::string_view text) {
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  Bytes out;
  std::uint32_t bits = 0, count = 0;
  for (const char c : text) {
    const std::size_t value = kLetters.find(c);
    if (value == std::string_view::npos) break;
    bits = bits << 6u | static_cast<std::uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    out.push_back(static_cast<std::uint8_t>(bits >> count));
  }
  return out;
}

struct Parts {
  std::string_view json;
  std::optional<FileData> binary;
};

Result<Parts> parts_of(const FileData& file, const std::string& path) {
  ByteReader reader({file.data(), file.size()}, path);
  if (file.size() < 12 || reader.u32() != kGlbMagic) return Parts{file.text(), {}};
  const std::uint32_t version = reader.u32();
  if (version != kGlbVersion) return Error{fmt::format("{}: it is glTF's version {}, and 2 is read", path, version)};
  reader.skip(4);
  Parts parts;
  while (reader.remaining() >= 8) {
    const std::uint32_t length = reader.u32(), kind = reader.u32();
    const ByteView chunk = reader.bytes(length);
    if (chunk.size() != length)
      return Error{fmt::format("{}: a part of {} bytes is cut off at the file's end", path, length)};
    if (kind == kJsonChunk && parts.json.empty())
      parts.json = {reinterpret_cast<const char*>(chunk.data()), chunk.size()};
    if (kind == kBinaryChunk && !parts.binary) parts.binary = FileData(chunk, std::make_shared<FileData>(file));
    reader.skip(std::min<std::size_t>((4 - length % 4) % 4, reader.remaining()));
  }
  return parts;
}

}  // namespace

struct GltfFile::Elements {
  ByteView bytes;  // from the first element on
  std::size_t count = 0, stride = 0;
  int components = 0;
  ComponentType type{};
  bool normalized = false;

  // Component `c` of element `i`.
  template <typename T>
  T read(std::size_t i, int c) const {
    T value;
    std::memcpy(&value, bytes.data() + i * stride + static_cast<std::size_t>(c) * type.bytes, sizeof value);
    return value;
  }
  float number(std::size_t i, int c) const {
    const float scale = normalized ? type.most : 1.0f;
    switch (type.number) {
      case 5120:
        return std::max(static_cast<float>(read<std::int8_t>(i, c)) / scale, normalized ? -1.0f : -128.0f);
      case 5121:
        return static_cast<float>(read<std::uint8_t>(i, c)) / scale;
      case 5122:
        return std::max(static_cast<float>(read<std::int16_t>(i, c)) / scale, normalized ? -1.0f : -32768.0f);
      case 5123:
        return static_cast<float>(read<std::uint16_t>(i, c)) / scale;
      case 5125:
        return static_cast<float>(read<std::uint32_t>(i, c));
      default:
        return read<float>(i, c);
    }
  }
};

Result<std::uint64_t> whole_member(const Json& object, const char* key, std::uint64_t otherwise) {
  const auto found = object.find(key);
  if (found == object.end()) return otherwise;
  if (found->is_number_unsigned()) return found->get<std::uint64_t>();
  return Error{fmt::format("{} is {}, and a whole number is wanted", key, json_text(*found, -1))};
}

float number_member(const Json& object, const char* key, float otherwise) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return otherwise;
  const double value = found->get<double>();
  return std::abs(value) < 1e30 ? static_cast<float>(value) : otherwise;
}

vec3 vector_member(const Json& object, const char* key, const vec3& otherwise) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array() || found->size() < 3) return otherwise;
  vec3 out;
  for (int i = 0; i < 3; ++i) {
    const Json& part = (*found)[static_cast<std::size_t>(i)];
    if (!part.is_number() || !(std::abs(part.get<double>()) < 1e30)) return otherwise;
    out[i] = part.get<float>();
  }
  return out;
}

const Json* object_member(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_object() ? &*found : nullptr;
}

Result<GltfFile> GltfFile::read(const std::string& path) {
  auto file = fs::read_whole_file(path);
  if (!file) return file.error();
  auto parts = parts_of(*file, path);
  if (!parts) return parts.error();
  auto json = JsonFile::parse(parts->json, path);
  if (!json) return json.error();
  GltfFile gltf;
  gltf.json_ = std::move(*json);
  gltf.folder_ = std::filesystem::path(path).parent_path();
  if (!gltf.root().is_object() || object_member(gltf.root(), "asset") == nullptr)
    return gltf.error("it is no glTF: it has no asset");
  if (const auto required = gltf.root().find("extensionsRequired"); required != gltf.root().end())
    for (const Json& name : *required)
      if (!name.is_string() || std::ranges::find(kKnown, name.get<std::string>()) == kKnown.end())
        return gltf.error(fmt::format("it needs {}, which is not read", json_text(name, -1)));
  const auto buffers = gltf.root().find("buffers");
  for (std::size_t i = 0; buffers != gltf.root().end() && buffers->is_array() && i < buffers->size(); ++i) {
    const Json& buffer = (*buffers)[i];
    const auto uri = buffer.is_object() ? buffer.find("uri") : buffer.end();
    if (buffer.is_object() && uri != buffer.end() && uri->is_string()) {
      auto bytes = gltf.resource(uri->get<std::string>());
      if (!bytes) return bytes.error();
      gltf.buffers_.push_back(std::move(*bytes));
    } else if (i == 0 && parts->binary) {
      gltf.buffers_.push_back(*parts->binary);
    } else {
      return gltf.error(fmt::format("buffer {} has no bytes", i));
    }
  }
  return gltf;
}

Result<FileData> GltfFile::resource(const std::string& uri) const {
  if (uri.starts_with("data:")) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos || uri.find(";base64") > comma) return error("data in its text is no base64");
    return FileData(from_base64(std::string_view(uri).substr(comma + 1)));
  }
  const std::filesystem::path name = without_escapes(uri);
  if (name.is_absolute() || uri.find("://") != std::string::npos)
    return error(fmt::format("it names {}, and only files beside it are read", uri));
  auto file = fs::read_whole_file(folder_ / name);
  if (!file) return error("it names a file that cannot be read: " + file.error().message);
  return file;
}

Result<const Json*> GltfFile::item(const char* list, std::uint64_t index) const {
  const auto found = root().find(list);
  if (found == root().end() || !found->is_array() || index >= found->size() || !(*found)[index].is_object())
    return error(fmt::format("there are no {} with number {}", list, index));
  return &(*found)[index];
}

Result<ByteView> GltfFile::view(const Json& view) const {
  const auto buffer = whole_member(view, "buffer", kNoIndex), offset = whole_member(view, "byteOffset", 0),
             length = whole_member(view, "byteLength", 0);
  for (const auto* number : {&buffer, &offset, &length})
    if (!*number) return error("a view's " + number->error().message);
  if (*buffer >= buffers_.size()) return error(fmt::format("a view is of buffer {} of {}", *buffer, buffers_.size()));
  const FileData& data = buffers_[*buffer];
  if (*offset > data.size() || *length > data.size() - *offset)
    return error(fmt::format("a view of {} bytes from {} on leaves its buffer of {}", *length, *offset, data.size()));
  return ByteView(data.data() + *offset, *length);
}

Result<GltfFile::Elements> GltfFile::elements(std::uint64_t index) const {
  const auto accessor = item("accessors", index);
  if (!accessor) return accessor.error();
  const Json& a = **accessor;
  if (a.contains("sparse")) return error("it has sparse accessors, which are not read");
  const auto view_index = whole_member(a, "bufferView", kNoIndex), offset = whole_member(a, "byteOffset", 0),
             count = whole_member(a, "count", 0), number = whole_member(a, "componentType", 0);
  for (const auto* part : {&view_index, &offset, &count, &number})
    if (!*part) return error("an accessor's " + part->error().message);
  const auto view_item = item("bufferViews", *view_index);
  if (!view_item) return view_item.error();
  const auto bytes = view(**view_item);
  if (!bytes) return bytes.error();
  const auto stride = whole_member(**view_item, "byteStride", 0);
  if (!stride) return error("a view's " + stride.error().message);

  Elements e;
  const auto type = a.find("type");
  e.components = type != a.end() && type->is_string() ? components_of(type->get<std::string>()) : 0;
  const auto known = std::ranges::find_if(
      kComponentTypes, [&](const ComponentType& t) { return static_cast<std::uint64_t>(t.number) == *number; });
  if (e.components == 0 || known == kComponentTypes.end())
    return error(fmt::format("accessor {} has a type that is not read", index));
  e.type = *known;
  const std::size_t size = static_cast<std::size_t>(e.components) * e.type.bytes;
  e.stride = *stride == 0 ? size : *stride;
  e.count = *count;
  const auto normalized = a.find("normalized");
  e.normalized = normalized != a.end() && normalized->is_boolean() && normalized->get<bool>();
  const std::size_t most = bytes->size() < size || *offset > bytes->size() - size || e.stride < size
                               ? 0
                               : (bytes->size() - size - *offset) / e.stride + 1;
  if (e.count > most) return error(fmt::format("accessor {} has {} elements, its view {}", index, e.count, most));
  if (e.count > 0) e.bytes = bytes->subspan(*offset);
  return e;
}

Result<std::vector<float>> GltfFile::numbers(std::uint64_t accessor, int components) const {
  const auto e = elements(accessor);
  if (!e) return e.error();
  if (e->components != components)
    return error(
        fmt::format("accessor {} has {} numbers an element, and {} are wanted", accessor, e->components, components));
  std::vector<float> out;
  out.reserve(e->count * static_cast<std::size_t>(components));
  for (std::size_t i = 0; i < e->count; ++i)
    for (int c = 0; c < components; ++c) out.push_back(e->number(i, c));
  return out;
}

Result<std::vector<std::uint32_t>> GltfFile::indices(std::uint64_t accessor) const {
  const auto e = elements(accessor);
  if (!e) return e.error();
  if (e->components != 1 || e->normalized ||
      (e->type.number != 5121 && e->type.number != 5123 && e->type.number != 5125))
    return error(fmt::format("accessor {} has no indices", accessor));
  std::vector<std::uint32_t> out;
  out.reserve(e->count);
  for (std::size_t i = 0; i < e->count; ++i)
    out.push_back(e->type.bytes == 1   ? e->read<std::uint8_t>(i, 0)
                  : e->type.bytes == 2 ? e->read<std::uint16_t>(i, 0)
                                       : e->read<std::uint32_t>(i, 0));
  return out;
}

Result<formats::RgbaImage> GltfFile::image(std::uint64_t index) const {
  const auto image = item("images", index);
  if (!image) return image.error();
  std::string name = fmt::format("image {}", index);
  FileData data;
  if (const auto uri = (*image)->find("uri"); uri != (*image)->end() && uri->is_string()) {
    auto bytes = resource(uri->get<std::string>());
    if (!bytes) return bytes.error();
    data = std::move(*bytes);
    if (!uri->get<std::string>().starts_with("data:")) name = uri->get<std::string>();
  } else {
    const auto view_index = whole_member(**image, "bufferView", kNoIndex);
    if (!view_index) return error("an image's " + view_index.error().message);
    const auto view_item = item("bufferViews", *view_index);
    if (!view_item) return view_item.error();
    const auto bytes = view(**view_item);
    if (!bytes) return bytes.error();
    data = FileData(Bytes(bytes->begin(), bytes->end()));
  }
  if (data.size() > 2 && data.data()[0] == 0xff && data.data()[1] == 0xd8)
    return error(name + " is JPEG, which is not read");
  return formats::parse_png({data.data(), data.size()}, path() + ": " + name);
}

}  // namespace fb::lab
