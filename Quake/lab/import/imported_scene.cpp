#include "lab/import/imported_scene.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>

#include "lab/import/gltf_import.h"
#include "lab/import/pbrt_import.h"

namespace fb::lab {
namespace {

std::string extension_of(std::string_view name) {
  std::string extension = std::filesystem::path(name).extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

class ImportedSource : public FrameSource {
 public:
  explicit ImportedSource(scene::FrameSnapshot snapshot) : snapshot_(std::move(snapshot)) {}
  Result<bool> next(scene::FrameSnapshot& snapshot) override {
    snapshot = snapshot_;
    snapshot.frame = frame_++;
    return true;
  }

 private:
  scene::FrameSnapshot snapshot_;
  std::uint64_t frame_ = 0;
};

}  // namespace

bool is_imported_scene(std::string_view name) {
  const std::string extension = extension_of(name);
  return extension == ".gltf" || extension == ".glb" || extension == ".pbrt";
}

Result<ImportedScene> import_scene(const std::string& path) {
  return extension_of(path) == ".pbrt" ? import_pbrt(path) : import_gltf(path);
}

Result<std::unique_ptr<FrameSource>> imported_source(const std::string& path, std::vector<std::string>* left_out) {
  auto scene = import_scene(path);
  if (!scene) return scene.error();
  if (left_out != nullptr) *left_out = std::move(scene->left_out);
  return std::unique_ptr<FrameSource>(std::make_unique<ImportedSource>(std::move(scene->snapshot)));
}

}  // namespace fb::lab
