// For tests: a client with the console, the files of a game and a clock, turned by hand.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "base/log.h"
#include "client/client.h"
#include "client/test_demo.h"
#include "console/console.h"

namespace fb::cl::test {

struct Game : testing::Test {
  Game() : files(game_files()), library(files.loader()), client(console, library, files.loader()) {
    listener = add_log_listener([this](LogLevel, std::string_view line) { log += std::string(line) + "\n"; });
    client.set_clock([this] { return now; });
  }
  ~Game() override { remove_log_listener(listener); }
  void put(const std::string& name, const DemoBuilder& demo) { files.files[name] = demo.bytes(); }
  // One turn of the host's loop; every frame takes a hundredth of a second.
  void frame(double seconds = 0.01) {
    now += 0.01;
    console.execute();
    client.advance(seconds);
  }
  const scene::Instance* find(std::uint32_t id) const {
    for (const auto& i : snapshot.instances)
      if (i.id == id) return &i;
    return nullptr;
  }
  scene::test::TestFiles files;
  con::Console console;
  scene::ModelLibrary library;
  Client client;
  scene::FrameSnapshot snapshot;
  std::string log;
  int listener = 0;
  double now = 100.0;
};

inline DemoBuilder walk(int moments) {
  DemoBuilder demo;
  for (int i = 0; i < moments; ++i) demo.moment(1.0f + 0.1f * static_cast<float>(i), 2.0f * static_cast<float>(i));
  return demo;
}

}  // namespace fb::cl::test
