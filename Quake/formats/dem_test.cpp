// Demos: what was recorded is read back; first lines of all sorts; damage.
#include "formats/dem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <cmath>

#include "formats/test_corruption.h"
#include "formats/test_files.h"

namespace fb::formats {
namespace {

using ::testing::HasSubstr;
using testing::small_demo;

struct Played {
  std::vector<DemMessage> messages;
};
// Reads a whole demo: its messages, or the error that ended it.
Result<Played> play(ByteView data) {
  auto demo = DemReader::open(data, "demo1.dem");
  if (!demo) return demo.error();
  Played played;
  while (!demo->at_end()) {
    auto message = demo->next();
    if (!message) return message.error();
    played.messages.push_back(*message);
  }
  return played;
}
const testing::Attempt kAttempt =
    testing::attempt([](const Bytes& bytes) { return play(bytes); },
                     [](const Played& played) {
                       for (const DemMessage& message : played.messages) {
                         if (message.data.size() > kMaxDemMessage) return "a message's size";
                         const vec3& a = message.view_angles;
                         if (!std::isfinite(a.x) || !std::isfinite(a.y) || !std::isfinite(a.z)) return "angles";
                       }
                       return "";
                     });

Bytes text(std::string_view s) { return Bytes(s.begin(), s.end()); }

TEST(Dem, ReadsWhatWasRecorded) {
  const Bytes file = small_demo();
  auto demo = DemReader::open(file, "demo1.dem");
  ASSERT_TRUE(demo.ok());
  EXPECT_EQ(demo->cd_track(), -1);
  EXPECT_EQ(demo->offset(), 3u);
  const auto played = play(file);
  ASSERT_TRUE(played.ok());
  ASSERT_EQ(played->messages.size(), 3u);
  EXPECT_EQ(played->messages[1].view_angles, vec3(10.0f, -90.0f, 0.5f));
  EXPECT_EQ(played->messages[1].data.size(), 6u);
  EXPECT_EQ(played->messages[2].data[0], 2);
}

TEST(Dem, FirstLines) {
  const auto track = [](std::string_view line) {
    const Bytes file = text(line);
    const auto demo = DemReader::open(file, "demo1.dem");
    return demo.ok() ? std::to_string(demo->cd_track()) : demo.error().message;
  };
  EXPECT_EQ(track("0\n"), "0");
  EXPECT_EQ(track("11\n"), "11");
  EXPECT_EQ(track("-1\r\n"), "-1");
  EXPECT_EQ(track("2 \n"), "2");
  for (const auto* line : {"", "\n", "-\n", "2", "x\n", "12345678901234567890\n", "--1\n"}) {
    EXPECT_THAT(track(line), HasSubstr("demo1.dem: offset 0: no demo")) << line;
  }
}

// A demo that ends between two messages is a shorter demo; anywhere else it is cut.
TEST(Dem, RefusedWhenCut) {
  const Bytes file = small_demo();
  const std::array<std::size_t, 3> ends = {3, 3 + 17, 3 + 17 + 22};
  for (std::size_t length = 0; length < file.size(); ++length) {
    const Bytes cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(length));
    if (std::find(ends.begin(), ends.end(), length) != ends.end())
      EXPECT_TRUE(play(cut).ok());
    else
      testing::expect_refused(kAttempt, cut, "demo1.dem");
  }
}
TEST(Dem, SoundWhenDamaged) { testing::expect_sound_when_damaged(kAttempt, small_demo(), "demo1.dem"); }

TEST(Dem, MessageSizes) {
  Bytes file = text("-1\n");
  append_dem_message(file, vec3(0.0f), Bytes(kMaxDemMessage));
  EXPECT_TRUE(play(file).ok());
  append_dem_message(file, vec3(0.0f), Bytes(kMaxDemMessage + 1));
  EXPECT_THAT(play(file).error().message, HasSubstr("message of 65537 bytes is longer"));
}
TEST(Dem, AnglesThatAreNone) {
  Bytes file = text("-1\n");
  append_dem_message(file, vec3(std::numeric_limits<float>::quiet_NaN(), 3.0f, std::numeric_limits<float>::infinity()),
                     Bytes{});
  EXPECT_EQ(play(file)->messages[0].view_angles, vec3(0.0f, 3.0f, 0.0f));
}

}  // namespace
}  // namespace fb::formats
