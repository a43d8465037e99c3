#include "lab/import/ply_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <system_error>
#include <vector>

#include "fs/file.h"

namespace fb::lab {
namespace {

enum class Coding : std::uint8_t { kText, kLittle, kBig };

struct Type {
  std::string_view name, other;
  std::size_t bytes;
  char kind;  // i, u, f
};
constexpr std::array kTypes{Type{"char", "int8", 1, 'i'},     Type{"uchar", "uint8", 1, 'u'},
                            Type{"short", "int16", 2, 'i'},   Type{"ushort", "uint16", 2, 'u'},
                            Type{"int", "int32", 4, 'i'},     Type{"uint", "uint32", 4, 'u'},
                            Type{"float", "float32", 4, 'f'}, Type{"double", "float64", 8, 'f'}};

const Type* type_of(std::string_view name) {
  const auto found = std::ranges::find_if(kTypes, [&](const Type& t) { return t.name == name || t.other == name; });
  return found == kTypes.end() ? nullptr : &*found;
}

struct Property {
  const Type* type = nullptr;
  const Type* count = nullptr;  // of a list's length; null: no list
  std::string_view name;
};
struct Part {
  std::string_view name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  PlyReader(std::string_view text, std::string path) : text_(text), path_(std::move(path)) {}

  Result<ImportedMesh> run() {
    if (auto status = header(); !status) return status.error();
    for (const Part& part : parts_) {
      if (part.name == "vertex") {
        if (auto status = vertices(part); !status) return status.error();
      } else {
        if (auto status = others(part); !status) return status.error();
      }
    }
    if (mesh_.indices.empty()) return error("it has no faces");
    if (!has_normals_) mesh_.normals.clear();
    if (!has_uvs_) mesh_.uvs.clear();
    return std::move(mesh_);
  }

 private:
  Error error(const std::string& what) const { return Error{path_ + ": " + what}; }

  // The words of the next line.
  std::vector<std::string_view> line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string_view rest = text_.substr(at_, end - at_);
    at_ = std::min(end + 1, text_.size());
    std::vector<std::string_view> words;
    while (true) {
      const std::size_t begin = rest.find_first_not_of(" \t\r");
      if (begin == std::string_view::npos) return words;
      rest.remove_prefix(begin);
      const std::size_t length = std::min(rest.find_first_of(" \t\r"), rest.size());
      words.push_back(rest.substr(0, length));
      rest.remove_prefix(length);
    }
  }

  Status header() {
    if (const auto words = line(); words.size() != 1 || words[0] != "ply") return error("it is no PLY file");
    bool has_format = false;
    while (at_ < text_.size()) {
      const auto words = line();
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") return has_format ? ok_status() : Status(error("it has no format"));
      if (words[0] == "format" && words.size() == 3) {
        has_format = true;
        if (words[1] == "ascii")
          coding_ = Coding::kText;
        else if (words[1] == "binary_little_endian" || words[1] == "binary_big_endian")
          coding_ = words[1] == "binary_big_endian" ? Coding::kBig : Coding::kLittle;
        else
          return error(fmt::format("its format {} is not known", words[1]));
      } else if (words[0] == "element" && words.size() == 3) {
        Part part{words[1], 0, {}};
        const auto [end, fault] = std::from_chars(words[2].data(), words[2].data() + words[2].size(), part.count);
        if (fault != std::errc() || end != words[2].data() + words[2].size())
          return error(fmt::format("an element's count is {}", words[2]));
        parts_.push_back(part);
      } else if (words[0] == "property" && words.size() == 3 && !parts_.empty() && type_of(words[1]) != nullptr) {
        parts_.back().properties.push_back({type_of(words[1]), nullptr, words[2]});
      } else if (words[0] == "property" && words.size() == 5 && !parts_.empty() && words[1] == "list" &&
                 type_of(words[2]) != nullptr && type_of(words[2])->kind != 'f' && type_of(words[3]) != nullptr) {
        parts_.back().properties.push_back({type_of(words[3]), type_of(words[2]), words[4]});
      } else {
        return error(fmt::format("a line of its header begins with {} and is not understood", words[0]));
      }
    }
    return error("its header has no end");
  }

  // The next number; fails at the end of the file.
  bool number(const Type& type, double& value) {
    if (coding_ == Coding::kText) {
      while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos) ++at_;
      const char* const begin = text_.data() + at_;
      const auto [end, fault] = std::from_chars(begin, text_.data() + text_.size(), value);
      if (fault != std::errc()) return false;
      at_ += static_cast<std::size_t>(end - begin);
      return true;
    }
    if (text_.size() - at_ < type.bytes) return false;
    std::array<char, 8> bytes{};
    std::memcpy(bytes.data(), text_.data() + at_, type.bytes);
    at_ += type.bytes;
    if (coding_ == Coding::kBig) std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(type.bytes));
    static_assert(std::endian::native == std::endian::little);
    std::uint64_t bits = 0;
    std::memcpy(&bits, bytes.data(), sizeof bits);
    if (type.kind == 'f') {
      value = type.bytes == 4 ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)))
                              : std::bit_cast<double>(bits);
    } else if (type.kind == 'u') {
      value = static_cast<double>(bits);
    } else {
      const auto shift = static_cast<unsigned>(64 - 8 * type.bytes);
      value = static_cast<double>(static_cast<std::int64_t>(bits << shift) >> shift);
    }
    return true;
  }

  // How many elements there can be at most: none is shorter than a byte, so a count that lies costs nothing.
  bool may_hold(std::uint64_t count) const { return count <= text_.size() - at_; }

  Status vertices(const Part& part) {
    constexpr std::array<std::string_view, 12> kNames{"x", "y", "z", "nx", "ny",        "nz",
                                                      "u", "v", "s", "t",  "texture_u", "texture_v"};
    if (!may_hold(part.count)) return error("it ends within its vertices");
    std::vector<std::size_t> slots;
    for (const Property& p : part.properties) {
      const auto at = static_cast<std::size_t>(std::ranges::find(kNames, p.name) - kNames.begin());
      slots.push_back(at < 8 ? at : at < kNames.size() ? 6 + at % 2 : 8);
      if (p.count != nullptr) return error("its vertices have lists");
    }
    const auto has = [&](std::size_t slot) { return std::ranges::find(slots, slot) != slots.end(); };
    if (!has(0) || !has(1) || !has(2)) return error("its vertices have no positions");
    has_normals_ = has(3) && has(4) && has(5);
    has_uvs_ = has(6) && has(7);
    for (std::uint64_t i = 0; i < part.count; ++i) {
      std::array<float, 9> values{};
      for (std::size_t k = 0; k < slots.size(); ++k) {
        double value = 0;
        if (!number(*part.properties[k].type, value)) return error("it ends within its vertices");
        values[slots[k]] = static_cast<float>(value);
      }
      mesh_.positions.emplace_back(values[0], values[1], values[2]);
      mesh_.normals.emplace_back(values[3], values[4], values[5]);
      mesh_.uvs.emplace_back(values[6], values[7]);
    }
    return ok_status();
  }

  // Faces, and what is of no use here.
  Status others(const Part& part) {
    const bool faces = part.name == "face";
    if (part.properties.empty()) return ok_status();
    if (!may_hold(part.count)) return error(fmt::format("it ends within its elements {}", part.name));
    std::vector<std::uint32_t> corners;
    for (std::uint64_t i = 0; i < part.count; ++i)
      for (const Property& p : part.properties) {
        double count = 1, value = 0;
        if (p.count != nullptr && !number(*p.count, count)) return error("it ends within a list");
        if (!(count >= 0) || !may_hold(static_cast<std::uint64_t>(std::min(count, 1e18))))
          return error("it ends within a list");
        const bool wanted = faces && (p.name == "vertex_indices" || p.name == "vertex_index");
        corners.clear();
        for (std::uint64_t k = 0; k < static_cast<std::uint64_t>(count); ++k) {
          if (!number(*p.type, value)) return error(fmt::format("it ends within its elements {}", part.name));
          if (!wanted) continue;
          if (!(value >= 0 && value < 4294967295.0)) return error("a face has a corner that is no vertex");
          corners.push_back(static_cast<std::uint32_t>(value));
        }
        for (std::size_t k = 2; k < corners.size(); ++k)
          mesh_.indices.insert(mesh_.indices.end(), {corners[0], corners[k - 1], corners[k]});
      }
    return ok_status();
  }

  std::string_view text_;
  std::string path_;
  std::size_t at_ = 0;
  Coding coding_ = Coding::kText;
  std::vector<Part> parts_;
  ImportedMesh mesh_;
  bool has_normals_ = false, has_uvs_ = false;
};

}  // namespace

Result<ImportedMesh> read_ply(const std::string& path) {
  const auto file = fs::read_whole_file(path);
  if (!file) return file.error();
  return PlyReader(file->text(), path).run();
}

}  // namespace fb::lab
