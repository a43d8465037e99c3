// Damaged files through the library: whatever the parsers let pass must still make sound assets.
#include <gtest/gtest.h>

#include "base/log.h"
#include "formats/test_bsp.h"
#include "formats/test_corruption.h"
#include "formats/test_models.h"
#include "scene/library/library.h"
#include "scene/library/test_maps.h"
#include "scene/library/test_sound.h"

namespace fb::scene {
namespace {

using formats::testing::Outcome;

struct Damage : testing::Test {
  void SetUp() override { set_log_level(LogLevel::kError); }
  void TearDown() override { set_log_level(LogLevel::kInfo); }
};

constexpr const char* kMap = "maps/room.bsp";

Outcome load_as_map(const Bytes& bytes) {
  test::TestFiles files;
  files.files[kMap] = bytes;
  ModelLibrary library(files.loader());
  const Status status = library.load_map(kMap);
  if (!status.ok()) return {true, status.error().message};
  for (const EntityLight& light : library.entity_lights())
    if (!test::finite(light.position) || !test::finite(light.power_color)) return {false, "a light is not finite"};
  for (std::uint32_t i = 0; i < library.map()->models.size(); ++i)
    if (library.model("*" + std::to_string(i)).kind != ModelKind::kBrush) return {false, "a submodel"};
  return {false, test::broken(*library.assets())};
}

// Models never fail aloud: a refused one is missing.
Outcome load_as_model(const Bytes& bytes) {
  test::TestFiles files;
  files.files["model"] = bytes;
  ModelLibrary library(files.loader());
  const Model& model = library.model("model");
  if (model.kind == ModelKind::kMissing) return {true, "model: offset 0: refused, which a log line explains"};
  if (model.kind == ModelKind::kAlias)
    for (std::uint32_t frame = 0; frame < model.frames.size(); ++frame)
      for (double time : {0.0, 0.15, 1e6, -3.0})
        if (model.mesh != kNone && pose_at(model, frame, time) >= library.assets()->meshes[model.mesh].pose_count)
          return {false, "a pose"};
  return {false, test::broken(*library.assets())};
}

TEST_F(Damage, Maps) {
  test::MapBuilder map;
  map.add_square(0, 0, 0, 64, map.add_texture(test::texture("+0lamp", 230, 16, 16)));
  map.add_square(0, 0, 32, 64, map.add_texture(test::texture("*water", 12)), true);
  map.add_square(16, 0, 32, 64, 1, false);
  map.bsp.entities = "{classname worldspawn _sunlight 9}{classname light}{classname light _surface +0lamp}";
  formats::testing::expect_sound_when_damaged(load_as_map, formats::testing::write_bsp(map.bsp), kMap);
  formats::testing::expect_sound_when_damaged(
      load_as_map, formats::testing::write_bsp(formats::testing::box_room(formats::BspVersion::kBsp2)), kMap);
}

TEST_F(Damage, Models) {
  formats::Mdl mdl = formats::testing::tetrahedron();
  for (std::size_t i = 0; i < mdl.vertices.size(); ++i)  // give it a body
    mdl.vertices[i] = {static_cast<std::uint8_t>(i % 4 == 1 ? 200 : 0), static_cast<std::uint8_t>(i % 4 == 2 ? 200 : 0),
                       static_cast<std::uint8_t>(i % 4 == 3 ? 200 + i : 0), 0};
  formats::testing::expect_sound_when_damaged(load_as_model, formats::testing::write_mdl(mdl), "model");
  formats::testing::expect_sound_when_damaged(
      load_as_model, formats::testing::write_spr(formats::testing::small_sprite(formats::SpriteOrientation::kParallel)),
      "model");
}

}  // namespace
}  // namespace fb::scene
