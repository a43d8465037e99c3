// For tests: a client that plays demos frame by frame, and the moments of a demo that was played through.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/log.h"
#include "client/client.h"
#include "client/test_moment_hash.h"
#include "console/console.h"

namespace fb::cl::test {

constexpr double kFrame = 1.0 / 72.0;  // seconds

// A client, the files of its game, what it prints and tells to be heard.
struct DemoPlayer {
  explicit DemoPlayer(FileLoader loader) : library(loader), client(console, library, loader) {
    console.set("r_authored", "0");  // found on a thread, some frame or other
    log_listener = add_log_listener([this](LogLevel, std::string_view line) { log += std::string(line) + "\n"; });
    client.set_sound_listener([this](const scene::SoundEvent& event) { heard.push_back(event); });
  }
  ~DemoPlayer() { remove_log_listener(log_listener); }
  void run(const std::string& command) {
    console.append(command + "\n");
    console.execute();
  }
  double seconds() const { return client.demo_status() ? client.demo_status()->seconds : -1.0; }
  std::uint64_t hash() {
    client.build_snapshot(snapshot);
    return MomentHash().add(hash_of(client.session())).add(hash_of(snapshot)).value();
  }

  con::Console console;
  scene::ModelLibrary library;
  Client client;
  scene::FrameSnapshot snapshot;
  std::vector<scene::SoundEvent> heard;
  std::string log;
  int log_listener = 0;
};

// By time: what the first frame from this time on is, and what it is twenty frames later.
struct Moment {
  double seconds = 0.0;
  std::uint64_t then = 0, later = 0;
};

// Of a demo that is played in frames of 1/72 s, every `spacing` seconds.
inline std::vector<Moment> play_through(DemoPlayer& player, const std::string& demo, double spacing) {
  constexpr std::size_t kLater = 20;
  EXPECT_TRUE(player.client.start_demo(demo, DemoMode::kPlay).ok());
  std::vector<Moment> moments;
  std::vector<std::uint64_t> hashes;
  std::vector<std::pair<double, std::size_t>> begins;
  double wanted = 0.0;
  for (player.client.advance(kFrame); player.client.playing(); player.client.advance(kFrame)) {
    if (!player.client.active()) continue;
    while (player.seconds() >= wanted) {
      begins.emplace_back(wanted, hashes.size());
      wanted += spacing;
    }
    hashes.push_back(player.hash());
  }
  for (const auto& [seconds, frame] : begins)
    if (frame + kLater < hashes.size()) moments.push_back({seconds, hashes[frame], hashes[frame + kLater]});
  return moments;
}

inline void expect_moment(DemoPlayer& player, const Moment& moment, const std::string& how) {
  ASSERT_TRUE(player.client.seek_demo(moment.seconds)) << how;
  EXPECT_EQ(player.hash(), moment.then) << how << " to " << moment.seconds;
  for (int i = 0; i < 20; ++i) player.client.advance(kFrame);
  EXPECT_EQ(player.hash(), moment.later) << how << " to " << moment.seconds << ", and played on";
}

}  // namespace fb::cl::test
