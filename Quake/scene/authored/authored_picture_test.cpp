// The author's picture of a room across which a lattice stands: holes of a texture named {... show what is behind.
#include "scene/authored/authored_picture.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "formats/test_bsp.h"
#include "scene/library/test_lit_room.h"
#include "scene/library/test_maps.h"

namespace fb::scene {
namespace {

constexpr float kAt = 300.0f;  // x

std::vector<vec3> picture_through(const std::string& texture_name) {
  test::MapBuilder map = test::lit_room();
  formats::BspTexture lattice = test::texture(texture_name, 100);
  for (std::size_t i = 0; i < lattice.indices.size(); i += 2) lattice.indices[i] = 255;  // every other column
  map.add_face({{kAt, 0, 0}, {kAt, 0, 512}, {kAt, 512, 512}, {kAt, 512, 0}}, vec3(-1, 0, 0),
               map.add_texture(std::move(lattice)));
  map.bsp.texinfos.back().axes = {vec4(0, 1.0f / 32, 0, 0), vec4(0, 0, 1.0f / 32, 0)};
  formats::BspNode node{};
  node.plane = map.bsp.faces.back().plane;
  node.first_face = 6;
  node.face_count = 1;
  node.children = {~1, ~1};
  formats::BspModel model = map.bsp.models[0];
  model.first_face = 6;
  model.face_count = 1;
  model.mins = vec3(kAt, 0, 0);
  model.maxs = vec3(kAt, 512, 512);
  model.head_nodes[0] = static_cast<std::int32_t>(map.bsp.nodes.size());
  map.bsp.nodes.push_back(node);
  map.bsp.models[0].face_count = 6;
  map.bsp.models.push_back(model);
  test::bake(map.bsp, [](const vec3&, const vec3&) { return 1.0f; });
  map.bsp.entities = R"({"classname" "worldspawn"}{"classname" "func_wall" "model" "*1"})";
  test::TestFiles files;
  files.add_palette();
  files.files["maps/a.bsp"] = formats::testing::write_bsp(map.bsp);
  ModelLibrary library(files.loader());
  const Status status = library.load_map("maps/a.bsp");
  EXPECT_TRUE(status.ok()) << (status.ok() ? "" : status.error().message);
  Camera camera;
  camera.position = vec3(100, 256, 256);
  camera.angles = vec3(0);
  camera.fov_x = 60.0f;
  return authored_picture(library.lit_map(), *library.assets(), library.map_sky(), *library.lightmaps(), camera, 16, 9,
                          {}, {});
}

TEST(AuthoredPicture, HolesShowWhatIsBehind) {
  const auto has = [](const std::vector<vec3>& picture, auto what) { return std::ranges::any_of(picture, what); };
  const auto glows = [](const vec3& c) { return c.x > 0.02f && c.z < 0.5f * c.x; };  // as index 255 is painted
  const auto wall = [](const vec3& c) { return c.x > 1e-4f && c.x == c.z; };         // the lattice has no light
  const auto see_through = picture_through("{lattice"), solid = picture_through("lattice");
  EXPECT_TRUE(has(see_through, wall));
  EXPECT_FALSE(has(see_through, glows));
  EXPECT_FALSE(has(solid, wall));
  EXPECT_TRUE(has(solid, glows)) << "255 is a colour elsewhere";
}

}  // namespace
}  // namespace fb::scene
