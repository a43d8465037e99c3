#include "scene/in_code/scene_of_kinds.h"

#include <cmath>

#include "scene/in_code/code_scene_parts.h"
#include "scene/shapes.h"

namespace fb::scene {
namespace {

// 8 x 8 palette indices: `marked` where `is_marked`, else `plain`.
std::uint32_t add_pattern(Assets& assets, bool (*is_marked)(int x, int y), std::uint8_t marked, std::uint8_t plain) {
  Image image{"pattern", ImageEncoding::kPalette, 8, 8, {}};
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) image.texels.push_back(is_marked(x, y) ? marked : plain);
  assets.images.push_back(std::move(image));
  return static_cast<std::uint32_t>(assets.images.size() - 1);
}

bool in_middle(int x, int y) { return x > 1 && x < 5 && y > 2 && y < 6; }
bool in_check(int x, int y) { return ((x >> 1) + (y >> 1)) % 2 == 0; }

std::uint32_t add_luma(Assets& assets) {
  Image image{"luma", ImageEncoding::kSrgba, 4, 4, {}};
  for (int i = 0; i < 16; ++i) {
    const std::uint8_t c = i % 5 == 0 ? 230 : 0;
    image.texels.insert(image.texels.end(), {c, static_cast<std::uint8_t>(c / 2), 40, 255});
  }
  assets.images.push_back(std::move(image));
  return static_cast<std::uint32_t>(assets.images.size() - 1);
}

std::uint32_t add_textured(Assets& assets, const char* name, EmissionKind kind, const TextureSet& textures,
                           std::uint32_t flags = 0) {
  const std::uint32_t index = add_material(assets, name, vec3(0.8f), vec3(1.0f));
  assets.materials[index].emission_kind = kind;
  assets.materials[index].frames = {textures};
  assets.materials[index].flags = flags;
  return index;
}

// A tetrahedron that has opened wide in its second pose.
Mesh opening_body(std::uint32_t material) {
  Mesh mesh = make_tetrahedron();
  for (MeshTriangle& t : mesh.triangles) t.material = material;
  mesh.pose_count = 2;
  mesh.pose_scale = vec3(0.25f);
  mesh.pose_origin = vec3(-32.0f);
  for (const float size : {12.0f, 30.0f}) {
    for (const vec3& p : mesh.positions) {
      const vec3 at = (p * vec3(size, size, 20.0f) - mesh.pose_origin) / mesh.pose_scale;
      mesh.poses.push_back(make_pose_vertex(static_cast<std::uint8_t>(at.x), static_cast<std::uint8_t>(at.y),
                                            static_cast<std::uint8_t>(at.z), glm::normalize(p)));
    }
  }
  mesh.positions.clear();
  return mesh;
}

}  // namespace

FrameSnapshot light_of_every_kind() {
  auto assets = new_code_assets();
  const std::uint32_t base = add_pattern(*assets, in_check, 0x66, 0x98);
  const std::uint32_t glowing_base = add_pattern(*assets, in_middle, 0xf8, 0x98);
  const std::uint32_t holes = add_pattern(*assets, in_check, 0x9c, 255);
  const std::uint32_t clouds = add_pattern(*assets, in_middle, 0x67, 255);
  const std::uint32_t luma = add_luma(*assets);

  const std::uint32_t walls = add_material(*assets, "walls", vec3(0.6f));
  const std::uint32_t floor = add_material(*assets, "floor", vec3(0.5f, 0.4f, 0.3f));
  assets->materials[floor].specular = 0.04f;
  assets->materials[floor].roughness = 0.45f;
  const std::uint32_t sky = add_textured(*assets, "sky", EmissionKind::kSky, {.base = base});
  const std::uint32_t lava = add_textured(*assets, "*lava", EmissionKind::kLava, {.base = base}, kMaterialWarp);
  const std::uint32_t texels = add_textured(*assets, "texels", EmissionKind::kFullbright, {.base = glowing_base});
  const std::uint32_t luma_wall =
      add_textured(*assets, "luma", EmissionKind::kFullbright, {.base = base, .luma = luma});
  const std::uint32_t pane = add_textured(*assets, "*teleport", EmissionKind::kTeleport, {.base = base});
  const std::uint32_t sprite = add_textured(*assets, "sprite", EmissionKind::kSprite, {.base = holes},
                                            kMaterialAlphaTest | kMaterialClampTexture);
  const std::uint32_t body = add_material(*assets, "body", vec3(0.3f), vec3(0.5f, 1.5f, 2.5f));

  BlockGrid grid;
  grid.x = {-256, -192, -64, 64, 192, 256};
  grid.y = {-192, -60, 60, 192};
  grid.z = {0, 256};
  grid.air = [](const vec3&) { return true; };
  grid.material = [=](const vec3& p, const vec3& normal) {
    const bool middle = std::abs(p.y) < 60;
    if (normal.z < 0) return middle && std::abs(p.x) < 64 ? sky : walls;
    if (normal.z > 0) return p.y > 60 && p.x > 192 ? lava : floor;
    return walls;
  };
  Mesh room;
  add_carved(room, grid);
  Mesh pictures;
  add_quad(pictures, {-100, 191, 60}, {96, 0, 0}, {0, 0, 64}, texels, {2, 1});
  add_quad(pictures, {60, -191, 120}, {0, 0, 64}, {96, 0, 0}, luma_wall);
  Mesh glass;
  add_quad(glass, {250, -150, 40}, {0, 60, 0}, {0, 0, 110}, pane);
  Mesh flame;
  add_quad(flame, {0, -16, -16}, {0, 32, 0}, {0, 0, 32}, sprite);

  FrameSnapshot snapshot = still(assets, camera_at({-230, -20, 130}, {8, 3, 0}, 95.0f));
  const auto add = [&](std::uint32_t id, std::uint32_t mesh, const mat4x3& transform = mat4x3(1.0f)) -> Instance& {
    snapshot.instances.push_back(make_instance(id, mesh, transform));
    return snapshot.instances.back();
  };
  add(kIdWorld, add_finished(*assets, std::move(room), "room"));
  add(kIdEntity + 1, add_finished(*assets, std::move(glass), "pane")).alpha = 0.5f;
  add(kIdEntity + 2, add_finished(*assets, std::move(flame), "sprite"), placed({60, 80, 90}, vec3(1.0f)));
  const PoseBlend half_open{0, 1, 0.6f};
  Instance& posed =
      add(kIdEntity + 3, add_finished(*assets, opening_body(body), "body"), placed({20, -100, 50}, vec3(1, 1, 1.5f)));
  posed.pose = posed.prev_pose = half_open;
  const std::uint32_t sphere = add_sphere_mesh(*assets);
  Instance flash = glowing(kIdDynamicLight, sphere, body, {-120, 90, 60}, vec3(5.0f), vec3(20, 60, 15));
  flash.visibility = kSeenByIndirect;
  Instance mark = glowing(kIdEntity + 4, sphere, body, {-150, -60, 100}, vec3(4.0f), vec3(9.0f));
  mark.visibility = kSeenByCamera;
  snapshot.instances.push_back(flash);
  snapshot.instances.push_back(mark);
  add(kIdEntity + 5, add_finished(*assets, std::move(pictures), "pictures"));

  snapshot.sky.mode = SkyMode::kLayers;
  snapshot.sky.color = vec3(0.8f);
  snapshot.sky.solid = base;
  snapshot.sky.alpha = clouds;
  snapshot.sky.suns = {{glm::normalize(vec3(0.3f, 0.2f, 1.0f)), vec3(6, 5, 4), 4.0f},
                       {glm::normalize(vec3(0.36f, 0.2f, 1.0f)), vec3(1, 2, 3), 8.0f}};
  return snapshot;
}

}  // namespace fb::scene
