// A glTF 2.0 document while it is made: its JSON, and the bytes of accessors and images that it refers to.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "base/maths.h"
#include "base/result.h"
#include "lab/json_reader.h"

namespace fb::lab {

class GltfDocument {
 public:
  explicit GltfDocument(const std::string& generator);

  // Indices of what was added.
  std::uint32_t add_vec2(std::span<const vec2> values);
  std::uint32_t add_vec3(std::span<const vec3> values);  // with the bounds that positions need
  std::uint32_t add_png(const std::string& name, const Bytes& png);
  std::uint32_t add(const char* list, Json item);
  void use_extension(const std::string& name);
  Json& root() { return root_; }

  // NAME.gltf and NAME.bin beside it (NAME-2.bin if a former NAME.gltf refers to NAME.bin, which then goes), or
  // NAME.glb, which holds both. Fails where a file cannot be written; the former ones stay then.
  Status write(const std::string& path) const;

 private:
  std::uint32_t add_view(std::span<const std::uint8_t> bytes);
  std::uint32_t add_accessor(std::span<const std::uint8_t> bytes, std::size_t count, const char* type, Json bounds);

  Json root_;
  Bytes bytes_;
};

}  // namespace fb::lab
