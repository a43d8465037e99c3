#include "scene/library/sprite_mesh.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "scene/shapes.h"

namespace fb::scene {
namespace {

Mesh make_quad(const formats::SprImage& image, std::string name) {
  Mesh mesh;
  mesh.name = std::move(name);
  const auto left = static_cast<float>(image.origin_x), top = static_cast<float>(image.origin_y);
  const auto width = static_cast<float>(image.image.width), height = static_cast<float>(image.image.height);
  // From the lower left corner: along the columns, then up the rows; rows of texels run down.
  add_quad(mesh, {0, left, top - height}, {0, width, 0}, {0, 0, height}, 0);
  for (MeshTriangle& triangle : mesh.triangles)
    for (vec2& uv : triangle.uv) uv.y = 1.0f - uv.y;
  finish_mesh(mesh);
  return mesh;
}

}  // namespace

std::vector<Model::SpriteFrame> make_sprite_frames(AssetBuilder& builder, const formats::Spr& spr,
                                                   std::string_view name) {
  std::vector<Model::SpriteFrame> frames;
  for (std::size_t f = 0; f < spr.frames.size(); ++f) {
    Model::SpriteFrame frame;
    frame.end_times = spr.frames[f].end_times;
    for (std::size_t i = 0; i < spr.frames[f].images.size(); ++i) {
      const formats::SprImage& image = spr.frames[f].images[i];
      std::string image_name = fmt::format("{}_{}", name, f);
      if (spr.frames[f].images.size() > 1) image_name += fmt::format("_{}", i);
      Material material;
      material.name = image_name;
      material.emission_kind = EmissionKind::kSprite;
      material.emission = vec3(1.0f);
      material.flags = kMaterialAlphaTest | kMaterialClampTexture;
      TextureSet set = builder.replacement({image_name}, name);
      if (set.base == kNone)
        set.base = builder.add_image(
            {image_name, ImageEncoding::kPalette, image.image.width, image.image.height, image.image.indices});
      material.frames = {set};
      const std::uint32_t index = builder.add_material(std::move(material));
      if (i == 0) frame.material = index;
      frame.meshes.push_back(builder.add_mesh(make_quad(image, image_name)));
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

}  // namespace fb::scene
