// A glTF 2.0 file that somebody else wrote: its JSON, its buffers and what accessors say of their bytes (Khronos, glTF
// 2.0, sections 3.6 and 4). Every index and length is checked.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/file_data.h"
#include "base/maths.h"
#include "base/result.h"
#include "formats/image.h"
#include "lab/json_reader.h"

namespace fb::lab {

class GltfFile {
 public:
  // A .gltf with its buffers beside it or within it, or a .glb. Fails where a file is missing or damaged, or needs an
  // extension that is not known here.
  static Result<GltfFile> read(const std::string& path);

  // The item `index` of a list of the document ("meshes", "nodes"); fails if there is none.
  Result<const Json*> item(const char* list, std::uint64_t index) const;
  const Json& root() const { return json_.json(); }
  const std::string& path() const { return json_.path(); }
  Error error(const std::string& what) const { return Error{path() + ": " + what}; }

  // An accessor's elements, whole numbers as they are or, where it says so, from -1 or 0 to 1. Fails unless it has
  // `components` each.
  Result<std::vector<float>> numbers(std::uint64_t accessor, int components) const;
  Result<std::vector<std::uint32_t>> indices(std::uint64_t accessor) const;
  // The image of a texture. JPEG is not read.
  Result<formats::RgbaImage> image(std::uint64_t index) const;

 private:
  struct Elements;
  Result<Elements> elements(std::uint64_t accessor) const;
  Result<ByteView> view(const Json& view) const;
  Result<FileData> resource(const std::string& uri) const;

  JsonFile json_;
  std::filesystem::path folder_;
  std::vector<FileData> buffers_;
};

// A member that is a whole number, or `otherwise` where it is missing; fails where it is something else.
Result<std::uint64_t> whole_member(const Json& object, const char* key, std::uint64_t otherwise);
// A member that is a finite number, or `otherwise`, whatever else it is.
float number_member(const Json& object, const char* key, float otherwise);
// A member that is a list of three or more finite numbers, or `otherwise`.
vec3 vector_member(const Json& object, const char* key, const vec3& otherwise);
// A member that is an object; null where there is none.
const Json* object_member(const Json& object, const char* key);

}  // namespace fb::lab
