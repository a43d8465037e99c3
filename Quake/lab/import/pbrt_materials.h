// Spectra, textures and materials of pbrt-v4 as colours, images and materials of ours.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "lab/import/pbrt_text.h"
#include "lab/import/scene_maker.h"

namespace fb::lab {

// A material, and how its texture lies on a shape.
struct PbrtMaterial {
  scene::Material material;
  vec2 uv_scale{1.0f}, uv_offset{0.0f};
  bool is_none = false;  // "interface": nothing is seen of it
};

class PbrtMaterials {
 public:
  PbrtMaterials(SceneMaker& maker, std::filesystem::path folder) : maker_(maker), folder_(std::move(folder)) {}

  // `Texture "NAME" "spectrum" "imagemap" ...`
  void add_texture(const PbrtDirective& texture);
  // `Material "KIND" ...` or `MakeNamedMaterial`, whose kind is its parameter `type`.
  PbrtMaterial material(const PbrtDirective& directive, const std::string& kind);
  // A colour of light: linear sRGB. Blackbodies have luminance 1.
  vec3 light(const PbrtDirective& directive, std::string_view name, const vec3& otherwise);

 private:
  struct Texture {
    vec3 color{1.0f};  // the whole of it, or a factor on the image
    std::optional<std::uint32_t> image;
    vec2 uv_scale{1.0f}, uv_offset{0.0f};
    bool clamped = false;
  };

  Texture image_map(const PbrtDirective& texture);
  // A parameter that is a colour, a number or a texture's name.
  Texture value(const PbrtDirective& directive, std::string_view name, const vec3& otherwise);
  std::optional<vec3> spectrum(const PbrtParameter& parameter, bool of_light);
  float roughness(const PbrtDirective& directive, const char* prefix);
  float index(const PbrtDirective& directive, const char* name);

  SceneMaker& maker_;
  std::filesystem::path folder_;
  std::map<std::string, Texture, std::less<>> textures_;
  std::map<std::string, std::optional<std::uint32_t>> images_;  // by file and coding
};

}  // namespace fb::lab
