#include "lab/gltf/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "fs/file.h"
#include "lab/gltf/gltf_numbers.h"

namespace fb::lab {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

constexpr int kFloat = 5126;  // GL's number of the type

template <typename T>
std::span<const std::uint8_t> bytes_of(std::span<const T> values) {
  return {reinterpret_cast<const std::uint8_t*>(values.data()), values.size_bytes()};
}

void append_words(Bytes& out, std::initializer_list<std::uint32_t> words) {
  for (const std::uint32_t word : words)
    for (int shift = 0; shift < 32; shift += 8) out.push_back(static_cast<std::uint8_t>(word >> shift));
}

// Where the bytes of a .gltf file go: of two names, the one that the former file of its name does not refer to, so that
// this one has its own until its successor is there.
struct Binaries {
  std::filesystem::path next, former;  // `former` is empty where there is none
};

// Its name as a relative reference (RFC 3986, 2.1): other bytes than unreserved ones as %XX, whatever their encoding
// is.
std::string uri_of(const std::filesystem::path& file) {
  std::string uri;
  for (const char c : file.filename().string()) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (letter || std::string_view("-._~").find(c) != std::string_view::npos)
      uri += c;
    else
      uri += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return uri;
}

Binaries binaries_of(const std::filesystem::path& file) {
  std::filesystem::path first = file, second = file;
  first.replace_extension(".bin");
  second.replace_filename(file.stem().string() + "-2.bin");
  const auto text = fs::read_whole_file(file);
  const auto named = [&](const std::filesystem::path& binary) {
    return text && text->text().find(json_text(uri_of(binary), -1)) != std::string_view::npos;
  };
  if (named(first)) return {second, first};
  return {first, named(second) ? second : std::filesystem::path()};
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
    std::string text = json_text(root, -1);
    text.resize((text.size() + 3) & ~std::size_t{3}, ' ');
    Bytes whole;
    append_words(whole, {kGlbMagic, kGlbVersion, static_cast<std::uint32_t>(28 + text.size() + bytes_.size()),
                         static_cast<std::uint32_t>(text.size()), kJsonChunk});
    whole.insert(whole.end(), text.begin(), text.end());
    append_words(whole, {static_cast<std::uint32_t>(bytes_.size()), kBinaryChunk});
    whole.insert(whole.end(), bytes_.begin(), bytes_.end());
    return fs::write_file_atomically(file, whole);
  }
  const Binaries binaries = binaries_of(file);
  root["buffers"][0]["uri"] = uri_of(binaries.next);
  if (auto status = fs::write_file_atomically(binaries.next, bytes_); !status) return status;
  const std::string text = json_text(root, 1);
  if (auto status = fs::write_text_atomically(file, text); !status) return status;
  std::error_code ignored;
  if (!binaries.former.empty()) std::filesystem::remove(binaries.former, ignored);
  return ok_status();
}

}  // namespace fb::lab
