// Motion on real models: the running monsters and the weapon of testdemos/fight.dem, where LibreQuake's data is.
#include <gtest/gtest.h>

#include <filesystem>

#include "base/librequake.h"
#include "client/client.h"
#include "console/console.h"
#include "fs/filesystem.h"
#include "lab/client_source.h"
#include "render/test_device.h"
#include "render/test_motion.h"

namespace fb::lab {
namespace {

using MotionTest = render::DeviceTest;

TEST_F(MotionTest, MonstersAndWeaponCarryTheirPoints) {
  if (const std::string lacks = librequake_lacks(); !lacks.empty()) GTEST_SKIP() << lacks;
  fs::FsOptions options;
  options.base_dir = librequake_folder();
  options.user_dir.emplace();
  auto files = fs::FileSystem::open(options);
  ASSERT_TRUE(files.ok()) << files.error().message;
  con::Console console;
  scene::ModelLibrary library(files->loader());
  cl::Client client(console, library, files->loader());
  ClientSourceOptions source_options;
  source_options.width = 320;
  source_options.height = 180;
  auto source = demo_source(client, "testdemos/fight.dem", source_options);
  ASSERT_TRUE(source.ok()) << source.error().message;

  render::RenderSettings settings;
  settings.bounces = 0;
  auto renderer = make_renderer(settings, 320, 180);
  ASSERT_NE(renderer, nullptr);
  scene::FrameSnapshot snapshot;
  std::map<std::uint32_t, int> total;
  for (int frame = 0; frame <= 96; ++frame) {
    auto more = (*source)->next(snapshot);
    ASSERT_TRUE(more.ok() && *more);
    if (frame < 60 || frame % 12 != 0) continue;  // the weapon kicks, the monsters run
    renderer->render(snapshot, nullptr, settings);
    const auto checked = render::test::check_motion(snapshot, *renderer, [](std::uint32_t id) {
      return id == scene::kIdViewModel || (id >= scene::kIdEntity + 10 && id <= scene::kIdEntity + 15);
    });
    for (const auto& [id, count] : checked) total[id] += count;
  }
  EXPECT_GT(total[scene::kIdViewModel], 1000);
  int monsters = 0;
  for (std::uint32_t id = scene::kIdEntity + 10; id <= scene::kIdEntity + 15; ++id) monsters += total[id];
  EXPECT_GT(monsters, 1000);
}

}  // namespace
}  // namespace fb::lab
