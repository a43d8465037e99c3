#include "lab/gltf/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <filesystem>

#include "fs/file.h"

namespace fb::lab {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

constexpr int kFloat = 5126;  // GL's number of the type
constexpr std::uint32_t kGlbMagic = 0x46546c67, kGlbVersion = 2, kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;

template <typename T>
std::span<const std::uint8_t> bytes_of(std::span<const T> values) {
  return {reinterpret_cast<const std::uint8_t*>(values.data()), values.size_bytes()};
}

void append_words(Bytes& out, std::initializer_list<std::uint32_t> words) {
  for (const std::uint32_t word : words)
    for (int shift = 0; shift < 32; shift += 8) out.push_back(static_cast<std::uint8_t>(word >> shift));
}

}  // namespace

GltfDocument::GltfDocument(const std::string& generator) {
  root_["asset"] = {{"version", "2.0"}, {"generator", generator}};
}

std::uint32_t GltfDocument::add(const char* list, Json item) {
  if (!root_.contains(list)) root_[list] = Json::array();
  root_[list].push_back(std::move(item));
  return static_cast<std::uint32_t>(root_[list].size()) - 1;
}

void GltfDocument::use_extension(const std::string& name) {
  Json& used = root_["extensionsUsed"];
  if (std::ranges::find(used, Json(name)) == used.end()) used.push_back(name);
}

std::uint32_t GltfDocument::add_view(std::span<const std::uint8_t> bytes) {
  const std::size_t offset = bytes_.size();
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  bytes_.resize((bytes_.size() + 3) & ~std::size_t{3});
  return add("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}});
}

std::uint32_t GltfDocument::add_accessor(std::span<const std::uint8_t> bytes, std::size_t count, const char* type,
                                         Json bounds) {
  Json accessor{{"bufferView", add_view(bytes)}, {"componentType", kFloat}, {"count", count}, {"type", type}};
  accessor.update(bounds);
  return add("accessors", std::move(accessor));
}

std::uint32_t GltfDocument::add_vec2(std::span<const vec2> values) {
  return add_accessor(bytes_of(values), values.size(), "VEC2", Json::object());
}

std::uint32_t GltfDocument::add_vec3(std::span<const vec3> values) {
  Bounds bounds;
  for (const vec3& value : values) bounds.add(value);
  const auto list = [](const vec3& v) { return Json{v.x, v.y, v.z}; };
  return add_accessor(bytes_of(values), values.size(), "VEC3", {{"min", list(bounds.min)}, {"max", list(bounds.max)}});
}

std::uint32_t GltfDocument::add_png(const std::string& name, const Bytes& png) {
  return add("images", {{"name", name}, {"mimeType", "image/png"}, {"bufferView", add_view(png)}});
}

Status GltfDocument::write(const std::string& path) const {
  const auto there = fs::output_path(path);
  if (!there) return there.error();
  const std::filesystem::path& file = *there;
  Json root = root_;
  root["buffers"] = {{{"byteLength", bytes_.size()}}};
  if (file.extension() == ".glb") {
    std::string text = root.dump();
    text.resize((text.size() + 3) & ~std::size_t{3}, ' ');
    Bytes whole;
    append_words(whole, {kGlbMagic, kGlbVersion, static_cast<std::uint32_t>(28 + text.size() + bytes_.size()),
                         static_cast<std::uint32_t>(text.size()), kJsonChunk});
    whole.insert(whole.end(), text.begin(), text.end());
    append_words(whole, {static_cast<std::uint32_t>(bytes_.size()), kBinaryChunk});
    whole.insert(whole.end(), bytes_.begin(), bytes_.end());
    return fs::write_file_atomically(file, whole);
  }
  std::filesystem::path binary = file;
  binary.replace_extension(".bin");
  root["buffers"][0]["uri"] = binary.filename().string();
  if (auto status = fs::write_file_atomically(binary, bytes_); !status) return status;
  const std::string text = root.dump(1) + "\n";
  return fs::write_text_atomically(file, text);
}

}  // namespace fb::lab
