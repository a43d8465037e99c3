// LibreQuake's demos, from file to snapshot. Skipped where the data is absent.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "base/librequake.h"
#include "client/client.h"
#include "client/test_demo_player.h"
#include "console/console.h"
#include "fs/filesystem.h"

namespace fb::cl {
namespace {

struct DemoCase {
  const char* name;
  int protocol;
  int frames;  // what quakespasm 0.95.1's timedemo prints for it
};

class LibreQuakeDemo : public testing::TestWithParam<DemoCase> {
 protected:
  void SetUp() override {
    fs::FsOptions options;
    options.base_dir = librequake_folder();
    options.user_dir = "";
    if (const std::string lacks = librequake_lacks(); !lacks.empty()) GTEST_SKIP() << lacks;
    auto opened = fs::FileSystem::open(options);
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    files.emplace(std::move(*opened));
    loader = [this](std::string_view path) { return files->read(path); };
    library.emplace(loader);
    client.emplace(console, *library, loader);
  }
  std::optional<fs::FileSystem> files;
  FileLoader loader;
  con::Console console;
  std::optional<scene::ModelLibrary> library;
  std::optional<Client> client;
};

TEST_P(LibreQuakeDemo, PlaysToItsEndAndCountsAsQuakeSpasm) {
  const DemoCase& demo = GetParam();
  ASSERT_TRUE(client->start_demo(demo.name, DemoMode::kTime).ok());
  scene::FrameSnapshot snapshot;
  std::map<std::uint32_t, mat4x3> before;
  int snapshots = 0, with_world = 0, most = 0;
  while (client->playing()) {
    client->advance(0.0);
    if (!client->playing()) break;
    EXPECT_EQ(client->protocol(), demo.protocol);
    if (++snapshots % 3 == 0) continue;  // some frames are not drawn
    client->build_snapshot(snapshot);
    most = std::max(most, static_cast<int>(snapshot.instances.size()));
    std::map<std::uint32_t, mat4x3> now;
    for (const scene::Instance& i : snapshot.instances) {
      ASSERT_TRUE(now.emplace(i.id, i.transform).second) << "id " << i.id << " twice at " << client->time();
      ASSERT_LT(i.mesh, snapshot.assets->meshes.size());
      const scene::Mesh& mesh = snapshot.assets->meshes[i.mesh];
      if (mesh.posed()) {
        ASSERT_LT(i.pose.a, mesh.pose_count);
        ASSERT_LT(i.pose.b, mesh.pose_count);
        ASSERT_GE(i.pose.t, 0.0f);
        ASSERT_LE(i.pose.t, 1.0f);
      }
      ASSERT_TRUE(std::isfinite(i.transform[3].x) && std::isfinite(i.transform[0].x));
      if (i.flags & scene::kInstanceNew || i.id == scene::kIdWorld) continue;
      ASSERT_EQ(before.count(i.id), 1u);
      ASSERT_EQ(i.prev_transform, before[i.id]);
    }
    with_world += !snapshot.instances.empty() && snapshot.instances[0].id == scene::kIdWorld;
    before = std::move(now);
  }
  EXPECT_FALSE(client->last_error().has_value()) << client->last_error()->message;
  ASSERT_TRUE(client->last_time_demo().has_value());
  EXPECT_EQ(client->last_time_demo()->frames, demo.frames);
  EXPECT_GT(with_world, snapshots / 2);
  EXPECT_GT(most, 20);
}

INSTANTIATE_TEST_SUITE_P(All, LibreQuakeDemo,
                         testing::Values(DemoCase{"demo1", 15, 4527}, DemoCase{"demo2", 15, 4570},
                                         DemoCase{"demo3", 999, 1232}),
                         [](const auto& info) { return std::string(info.param.name); });

// Any second of any demo is reached wherever the demo stands, and is what playing on to it gives.
TEST_P(LibreQuakeDemo, EverySecondIsReached) {
  std::vector<test::Moment> moments;
  {
    test::DemoPlayer player(loader);
    moments = test::play_through(player, GetParam().name, 1.0);
  }
  ASSERT_GT(moments.size(), 25u);
  test::DemoPlayer player(loader);
  ASSERT_TRUE(player.client.start_demo(GetParam().name, DemoMode::kPlay).ok());
  player.client.advance(test::kFrame);
  const auto go_to = [&](const test::Moment& moment, const char* how) {
    ASSERT_TRUE(player.client.seek_demo(moment.seconds));
    EXPECT_EQ(player.hash(), moment.then) << how << " to " << moment.seconds;
  };
  go_to(moments.back(), "at once");
  for (auto m = moments.rbegin(); m != moments.rend(); ++m) go_to(*m, "backwards");
  for (std::size_t i = 0; i < moments.size(); ++i) go_to(moments[i * 7 % moments.size()], "to and fro");
}

}  // namespace
}  // namespace fb::cl
