// ModelLibrary on files made in code: maps with what stands beside them, what is missing or broken, skins in colours.
#include "scene/library/library.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

#include "base/log.h"
#include "formats/test_bsp.h"
#include "formats/test_models.h"
#include "scene/library/test_maps.h"
#include "scene/shapes.h"

namespace fb::scene {
namespace {

using testing::HasSubstr;

class LogLines {
 public:
  LogLines() {
    handle_ = add_log_listener([this](LogLevel, std::string_view line) { lines.emplace_back(line); });
  }
  ~LogLines() { remove_log_listener(handle_); }
  std::vector<std::string> lines;

 private:
  int handle_;
};

Bytes bytes_of(std::string_view text) { return Bytes(text.begin(), text.end()); }

// A floor of 64 x 64 with the given texture, and a water square as submodel 1.
Bytes map_bytes(const std::string& texture_name, const std::string& entities) {
  test::MapBuilder map;
  map.add_square(0, 0, 0, 64, map.add_texture(test::texture(texture_name, 230)));
  map.add_square(0, 0, 32, 64, map.add_texture(test::texture("*water", 12)));
  map.bsp.models[0].face_count = 1;
  map.bsp.models.push_back(map.bsp.models[0]);
  map.bsp.models[1].first_face = 1;
  map.bsp.models[1].mins = vec3(0, 0, 31);
  map.bsp.entities = entities;
  return formats::testing::write_bsp(map.bsp);
}

struct World : testing::Test {
  World() {
    files.add_palette();
    files.files["maps/a.bsp"] = map_bytes("floor",
                                          "{\"classname\" \"worldspawn\" \"_wateralpha\" \"0.5\" \"_sunlight\" \"128\"}"
                                          "{\"classname\" \"light\" \"origin\" \"32 32 64\"}");
    files.files["maps/b_item.bsp"] = map_bytes("floor", "");
  }
  test::TestFiles files;
};

// A map without baked light, whose texture's name speaks of metal.
TEST_F(World, GlossByNameIsTheBaseGamesAlone) {
  files.files["maps/m.bsp"] = map_bytes("metal", "");
  for (const bool own : {false, true}) {
    ModelLibrary library(files.loader());
    library.set_own_files([&](std::string_view) { return own; });
    ASSERT_TRUE(library.load_map("maps/m.bsp").ok());
    const Assets& assets = *library.assets();
    const auto metal = std::ranges::find(assets.materials, "metal", &Material::name);
    ASSERT_NE(metal, assets.materials.end());
    EXPECT_EQ(metal->specular > 0.0f, own);
    EXPECT_EQ(metal->roughness < 1.0f, own);
  }
}

TEST_F(World, MapAndSubmodels) {
  ModelLibrary library(files.loader());
  EXPECT_EQ(library.map(), nullptr);
  EXPECT_TRUE(library.map_entities().empty());
  EXPECT_EQ(library.model("*1").kind, ModelKind::kMissing);
  const Status status = library.load_map("maps/a.bsp");
  ASSERT_TRUE(status.ok()) << status.error().message;
  ASSERT_NE(library.map(), nullptr);
  const Model &world = library.model("maps/a.bsp"), &water = library.model("*1");
  ASSERT_EQ(world.kind, ModelKind::kBrush);
  ASSERT_EQ(water.kind, ModelKind::kBrush) << "known to be missing before the map came";
  const Assets& assets = *library.assets();
  EXPECT_EQ(assets.meshes[world.mesh].triangles.size(), 2u);
  EXPECT_EQ(water.mins, vec3(0, 0, 31));
  const Material& surface = assets.materials[assets.meshes[water.mesh].triangles[0].material];
  EXPECT_EQ(surface.name, "*water");
  EXPECT_FLOAT_EQ(surface.alpha, 0.5f);
  EXPECT_EQ(library.entity_lights().size(), 1u);
  EXPECT_EQ(library.map_sky().suns.size(), 1u);
  EXPECT_EQ(library.model("*2").kind, ModelKind::kMissing);
  EXPECT_EQ(library.model("*x").kind, ModelKind::kMissing);
  EXPECT_EQ(library.model("").kind, ModelKind::kMissing);

  const Model& item = library.model("maps/b_item.bsp");
  EXPECT_EQ(item.kind, ModelKind::kBrush);
  EXPECT_NE(item.mesh, world.mesh);
  EXPECT_EQ(library.map()->entities, library.map_entities());
}

TEST_F(World, ExternalEntitiesAndBrokenOnes) {
  files.files["maps/a.ent"] = bytes_of("\xef\xbb\xbf{classname worldspawn}\r\n{classname light}{classname light}");
  ModelLibrary library(files.loader());
  ASSERT_TRUE(library.load_map("maps/a.bsp").ok());
  EXPECT_EQ(library.entity_lights().size(), 2u);
  EXPECT_TRUE(library.map_sky().suns.empty());
  EXPECT_THAT(library.map_entities(), HasSubstr("light"));
  EXPECT_EQ(library.map_entities().front(), '{') << "without the byte order mark";

  const std::uint64_t generation = library.assets()->generation;
  files.files["maps/a.ent"] = bytes_of("{classname worldspawn");
  LogLines log;
  ASSERT_TRUE(library.load_map("maps/a.bsp").ok());
  EXPECT_TRUE(library.entity_lights().empty());
  EXPECT_THAT(log.lines, testing::Contains(HasSubstr("maps/a.ent")));
  EXPECT_NE(library.assets()->generation, generation) << "a second map renumbers";
}

TEST_F(World, EntitiesByChecksumComeFirst) {
  const auto parsed = formats::parse_bsp(files.files["maps/a.bsp"], "a");
  ASSERT_TRUE(parsed.ok());
  files.files["maps/a.ent"] = bytes_of("{classname worldspawn}{classname light}{classname light}");
  files.files[fmt::format("maps/a@{:04x}.ent", parsed->entities_crc)] = bytes_of("{classname worldspawn}");
  ModelLibrary library(files.loader());
  ASSERT_TRUE(library.load_map("maps/a.bsp").ok());
  EXPECT_TRUE(library.entity_lights().empty());
}

TEST_F(World, EntitiesFromAnEarlierGameDoNotCount) {
  files.files["maps/a.ent"] = bytes_of("{classname worldspawn}{classname light}{classname light}");
  for (const int rank_of_entities : {0, 1, 2}) {
    ModelLibrary library(files.loader(),
                         [&](std::string_view path) { return path.ends_with(".ent") ? rank_of_entities : 1; });
    ASSERT_TRUE(library.load_map("maps/a.bsp").ok());
    EXPECT_EQ(library.entity_lights().size(), rank_of_entities == 0 ? 1u : 2u);
  }
}

TEST_F(World, TheBaseGamesImagesDressItsOwnAlone) {
  files.files["progs/t.mdl"] = formats::testing::write_mdl(formats::testing::tetrahedron());
  files.add_tga("textures/floor.tga", 4, 4, {1, 2, 3});
  files.files["progs/t.mdl_0.png"] = bytes_of("the base game's, and hides the other if it counts");
  files.add_tga("progs/t.mdl_0.tga", 4, 4, {1, 2, 3});
  files.add_tga("progs/t.mdl_0_luma.tga", 4, 4, {1, 2, 3});
  const auto images_with = [&](const FileRank& rank) {
    ModelLibrary library(files.loader(), rank);
    EXPECT_TRUE(library.load_map("maps/a.bsp").ok());
    library.model("progs/t.mdl");
    std::vector<std::string> names;
    for (const Image& image : library.assets()->images)
      if (image.name.ends_with(".tga")) names.push_back(image.name);
    return names;
  };
  using testing::ElementsAre, testing::IsEmpty;
  const auto is_image = [](std::string_view path) { return path.ends_with(".tga") || path.ends_with(".png"); };
  EXPECT_THAT(images_with([&](std::string_view path) { return is_image(path) ? -1 : 0; }), IsEmpty());
  EXPECT_THAT(images_with([&](std::string_view path) { return path.ends_with(".png") ? -1 : 0; }),
              ElementsAre("textures/floor.tga", "progs/t.mdl_0.tga", "progs/t.mdl_0_luma.tga"));
  EXPECT_THAT(images_with([&](std::string_view path) { return is_image(path) ? 0 : 1; }),
              ElementsAre("textures/floor.tga"))
      << "from an earlier game they count: the broken one hides the other";
  files.files.erase("progs/t.mdl_0.png");
  EXPECT_THAT(images_with([](std::string_view) { return -1; }),
              ElementsAre("textures/floor.tga", "progs/t.mdl_0.tga", "progs/t.mdl_0_luma.tga"));
  EXPECT_THAT(images_with([&](std::string_view path) { return path == "progs/t.mdl" ? 0 : -1; }),
              ElementsAre("textures/floor.tga"));
}

TEST_F(World, FailureChangesNothing) {
  ModelLibrary library(files.loader());
  ASSERT_TRUE(library.load_map("maps/a.bsp").ok());
  const std::uint64_t generation = library.assets()->generation;
  files.files["maps/cut.bsp"] = Bytes(files.files["maps/a.bsp"].begin(), files.files["maps/a.bsp"].begin() + 200);
  for (const char* path : {"maps/absent.bsp", "maps/cut.bsp"}) {
    const Status status = library.load_map(path);
    ASSERT_FALSE(status.ok());
    EXPECT_THAT(status.error().message, HasSubstr(path));
    EXPECT_EQ(library.assets()->generation, generation);
    EXPECT_NE(library.map(), nullptr);
  }
}

TEST_F(World, MissingAndBrokenModelsAreToldOnce) {
  files.files["progs/bad.mdl"] = bytes_of("IDPO and nothing more");
  files.files["progs/bad.spr"] = bytes_of("IDSP");
  files.files["progs/empty.mdl"] = {};
  ModelLibrary library(files.loader());
  for (const char* name : {"progs/none.mdl", "progs/bad.mdl", "progs/bad.spr", "progs/empty.mdl"}) {
    LogLines log;
    for (int i = 0; i < 3; ++i) EXPECT_EQ(library.model(name).kind, ModelKind::kMissing);
    EXPECT_EQ(library.model(name).name, name);
    ASSERT_EQ(log.lines.size(), 1u) << name;
    EXPECT_THAT(log.lines[0], HasSubstr(name));
  }
}

TEST_F(World, NoLoaderAtAll) {
  ModelLibrary library(nullptr);
  EXPECT_FALSE(library.load_map("maps/a.bsp").ok());
  EXPECT_EQ(library.model("progs/x.mdl").kind, ModelKind::kMissing);
  EXPECT_EQ(library.map_sky().mode, SkyMode::kBlack);
}

TEST_F(World, ShapesAreMadeOnce) {
  ModelLibrary library(files.loader());
  const std::uint32_t sphere = library.sphere_mesh(), tetrahedron = library.tetrahedron_mesh();
  EXPECT_EQ(library.sphere_mesh(), sphere);
  EXPECT_EQ(library.tetrahedron_mesh(), tetrahedron);
  EXPECT_NE(sphere, tetrahedron);
  EXPECT_EQ(library.assets()->meshes[sphere].triangles.size(), 80u);
  EXPECT_EQ(library.particle_material(), library.particle_material());
  const auto& materials = library.assets()->materials;
  EXPECT_EQ(materials[library.particle_material()].emission_kind, EmissionKind::kParticle);
  EXPECT_EQ(materials[library.dynamic_light_material()].emission_kind, EmissionKind::kDynamicLight);
  EXPECT_EQ(materials[library.entity_light_material()].emission_kind, EmissionKind::kEntityLight);
  library.clear();
  EXPECT_TRUE(library.assets()->meshes.empty());
  EXPECT_EQ(library.sphere_mesh(), 0u);
}

TEST_F(World, SkinsInColors) {
  formats::Mdl mdl = formats::testing::tetrahedron();
  ASSERT_FALSE(mdl.skins.empty());
  std::vector<std::uint8_t>& skin = mdl.skins[0].images[0].indices;
  ASSERT_GE(skin.size(), 4u);
  skin[0] = 16;       // darkest of the shirt
  skin[1] = 96 + 15;  // brightest of the trousers
  skin[2] = 50;
  files.files["progs/player.mdl"] = formats::testing::write_mdl(mdl);
  ModelLibrary library(files.loader());
  const Model& player = library.model("progs/player.mdl");
  ASSERT_EQ(player.kind, ModelKind::kAlias);
  const auto texel = [&](std::uint32_t material, std::size_t i) {
    const Assets& assets = *library.assets();
    return assets.images[assets.materials[material].frames[0].base].texels[i];
  };
  const std::uint32_t colored = library.translated_skin(player, 0, 4, 13);
  EXPECT_EQ(texel(colored, 0), 4 * 16);
  EXPECT_EQ(texel(colored, 1), 13 * 16) << "rows from 8 on are the other way round";
  EXPECT_EQ(texel(colored, 2), 50);
  EXPECT_EQ(texel(player.skin_materials[0], 0), 16);
  EXPECT_EQ(library.translated_skin(player, 0, 4, 13), colored);
  EXPECT_NE(library.translated_skin(player, 0, 4, 12), colored);
  EXPECT_EQ(library.translated_skin(player, 0, 1, 6), player.skin_materials[0]) << "the painted colours";
  EXPECT_EQ(library.translated_skin(player, 99, 4, 13), colored) << "an unknown skin is the first";
  EXPECT_EQ(library.translated_skin(Model(), 0, 4, 13), kNone);
}

TEST(Poses, FollowTheirGroups) {
  Model model;
  model.frames = {{"stand", 0, 1, {}}, {"burn", 1, 3, {0.1f, 0.2f, 0.3f}}};
  EXPECT_EQ(pose_at(model, 0, 5.0), 0u);
  EXPECT_EQ(pose_at(model, 1, 0.05), 1u);
  EXPECT_EQ(pose_at(model, 1, 0.25), 3u);
  EXPECT_EQ(pose_at(model, 1, 0.35), 1u);
  EXPECT_EQ(pose_at(model, 7, 0.0), 0u) << "an unknown frame is the first";
  EXPECT_EQ(pose_at(Model(), 0, 0.0), 0u);
}

}  // namespace
}  // namespace fb::scene
