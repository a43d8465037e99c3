#include "host/game/light_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/test_directory.h"

namespace fb::host {
namespace {

class LightStore : public testing::Test {
 protected:
  fs::FileSystem open() {
    directory.put("base/id1/default.cfg", "");
    fs::FsOptions options;
    options.base_dir = directory.file("base");
    options.base_dir_named = true;
    options.user_dir = directory.file("user");
    auto opened = fs::FileSystem::open(options);
    EXPECT_TRUE(opened.ok()) << opened.error().message;
    return *std::move(opened);
  }
  TestDirectory directory;
};

TEST_F(LightStore, KeepsWhatIsFoundInThePlayersFolder) {
  fs::FileSystem files = open();
  const scene::AuthoredStore store = light_store(files);
  EXPECT_FALSE(store.read(7));
  store.write(7, Bytes{1, 2, 3});
  store.write(8, Bytes{4});
  const auto kept = store.read(7);
  ASSERT_TRUE(kept);
  EXPECT_EQ(Bytes(kept->begin(), kept->end()), (Bytes{1, 2, 3}));
  EXPECT_TRUE(std::filesystem::exists(directory.file("user/id1/light/0000000000000008.fblight")));
}

TEST_F(LightStore, WithoutAPlaceNothingIsKeptAndNothingFails) {
  directory.put("user", "no folder");
  fs::FileSystem files = open();
  const scene::AuthoredStore store = light_store(files);
  store.write(7, Bytes{1});
  EXPECT_FALSE(store.read(7));
}

}  // namespace
}  // namespace fb::host
