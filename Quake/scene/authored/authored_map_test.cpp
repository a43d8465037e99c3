#include "scene/authored/authored_map.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "base/log.h"
#include "formats/test_bsp.h"
#include "scene/library/test_maps.h"
#include "scene/library/test_lit_room.h"

namespace fb::scene {
namespace {

class AuthoredMapSequences : public testing::Test {
 protected:
  AuthoredMapSequences() {
    formats::Bsp bsp = test::lit_room().bsp;
    const EntityLight lamp = test::lit_lamp(vec3(256, 256, 300), 20000);
    test::bake(bsp, [&](const vec3& p, const vec3& n) { return test::lamp_light(lamp, p, n); });
    bsp.entities = R"({"classname" "worldspawn"}{"classname" "light" "origin" "256 256 300"})";
    files_.add_palette();
    files_.files["maps/a.bsp"] = formats::testing::write_bsp(bsp);
    handle_ = add_log_listener([this](LogLevel level, std::string_view line) {
      if (level == LogLevel::kWarning) warnings_.emplace_back(line);
    });
  }
  ~AuthoredMapSequences() override { remove_log_listener(handle_); }

  // Whether the map's light was found anew; what is kept stays for the next.
  bool finds() {
    ModelLibrary library([this](std::string_view path) { return files_.loader()(path); });
    EXPECT_TRUE(library.load_map("maps/a.bsp").ok());
    warnings_.clear();
    bool written = false;
    AuthoredMap map(library);
    map.set_store({[this](std::uint64_t key) {
                     const auto at = kept_.find(key);
                     return at != kept_.end() ? std::optional<FileData>(at->second) : std::nullopt;
                   },
                   [&](std::uint64_t key, const Bytes& bytes) {
                     kept_[key] = bytes;
                     written = true;
                   },
                   [](std::uint64_t) { return std::string("light/x"); }});
    map.wait();
    EXPECT_NE(map.light(), nullptr);
    return written;
  }

  test::TestFiles files_;
  std::map<std::uint64_t, Bytes> kept_;
  std::vector<std::string> warnings_;
  int handle_ = 0;
};

TEST_F(AuthoredMapSequences, WhatIsKeptIsUsedAndWhatIsDamagedIsToldAndFoundAnew) {
  EXPECT_TRUE(finds());
  EXPECT_TRUE(warnings_.empty());
  EXPECT_FALSE(finds()) << "it is kept";
  EXPECT_TRUE(warnings_.empty());
  ASSERT_EQ(kept_.size(), 1u);
  Bytes& bytes = kept_.begin()->second;
  bytes[bytes.size() / 2] ^= 1u;
  EXPECT_TRUE(finds());
  EXPECT_EQ(warnings_,
            std::vector<std::string>{"light/x: the light kept from an earlier run is damaged; it is found anew"});
  EXPECT_FALSE(finds()) << "whole again";
  bytes.clear();
  EXPECT_TRUE(finds());
  EXPECT_EQ(warnings_.size(), 1u);
}

}  // namespace
}  // namespace fb::scene
