// The sound device, with SDL's driver that plays to nobody in real time.
#include "platform/audio_device.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <thread>

namespace fb::platform {
namespace {

TEST(AudioDevice, AsksForFramesAtThePaceOfRealTime) {
  ::setenv("SDL_AUDIODRIVER", "dummy", 1);
  std::atomic<std::size_t> frames{0}, calls{0};
  std::atomic<bool> own_thread{true};
  const auto caller = std::this_thread::get_id();
  auto device = AudioDevice::open(44100, [&](std::span<float> stereo) {
    frames += stereo.size() / 2;
    ++calls;
    if (std::this_thread::get_id() == caller) own_thread = false;
    std::ranges::fill(stereo, 0.0f);
  });
  ASSERT_TRUE(device.ok()) << device.error().message;
  EXPECT_EQ((*device)->driver(), "dummy");
  EXPECT_EQ((*device)->rate(), 44100u);
  EXPECT_EQ((*device)->period(), 1024u);
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  EXPECT_EQ(frames, 0u) << "it waits until it is told to play";
  const auto begin = std::chrono::steady_clock::now();
  (*device)->play();
  // A busy machine may be late: it must come, and not before its time.
  for (int i = 0; i < 2000 && frames < 44100 * 2 / 5; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const std::size_t played = frames;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_GE(played, 44100u * 2 / 5);
  EXPECT_LT(played, 1.1 * 44100 * seconds + 2 * 1024);
  EXPECT_TRUE(own_thread);
  device->reset();
  const std::size_t last = calls;
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  EXPECT_EQ(calls, last) << "a closed device asks no more";
}

TEST(AudioDevice, SaysWhatIsMissing) {
  ::setenv("SDL_AUDIODRIVER", "no such driver", 1);
  const auto device = AudioDevice::open(44100, [](std::span<float>) {});
  ASSERT_FALSE(device.ok());
  EXPECT_THAT(device.error().message, ::testing::HasSubstr("no sound device could be opened ("));
}

}  // namespace
}  // namespace fb::platform
