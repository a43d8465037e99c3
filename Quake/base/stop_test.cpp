#include "base/stop.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace fb {
namespace {

// Each in a process of its own, which is what a death test gives it.

TEST(StopDeathTest, ASignalIsAskedForAndEndsTheProgramWhenItIsInOrder) {
  const auto told = [](int signal) {
    stop_on_signals("quake", StopMode::kInSteps);
    if (stop_wanted()) std::exit(1);
    std::raise(signal);
    if (!stop_wanted()) std::exit(2);
    std::exit(exit_status_or_signal(0));
  };
  EXPECT_EXIT(told(SIGTERM), testing::KilledBySignal(SIGTERM), "^quake: stopped by SIGTERM\n$");
  EXPECT_EXIT(told(SIGINT), testing::KilledBySignal(SIGINT), "^quake: stopped by SIGINT\n$");
}

TEST(StopDeathTest, ASecondSignalEndsItAtOnce) {
  const auto told_twice = [] {
    stop_on_signals("quake", StopMode::kInSteps);
    std::raise(SIGTERM);
    std::raise(SIGINT);
    std::exit(0);
  };
  EXPECT_EXIT(told_twice(), testing::KilledBySignal(SIGINT), "^quake: stopped by SIGINT\n$");
}

TEST(StopDeathTest, WithNothingToPutInOrderTheFirstDoes) {
  const auto told = [] {
    stop_on_signals("quake", StopMode::kAtOnce);
    std::raise(SIGINT);
    std::exit(0);
  };
  EXPECT_EXIT(told(), testing::KilledBySignal(SIGINT), "^quake: stopped by SIGINT\n$");
}

TEST(StopDeathTest, TakenAsQuitItIsNoFailure) {
  const auto told = [] {
    stop_on_signals("quake", StopMode::kAsQuit);
    std::raise(SIGTERM);
    std::exit(stop_wanted() ? exit_status_or_signal(7) : 1);
  };
  EXPECT_EXIT(told(), testing::ExitedWithCode(7), "^$");
}

TEST(StopDeathTest, WhatWasIgnoredStaysIgnored) {
  const auto told = [] {
    std::signal(SIGINT, SIG_IGN);
    stop_on_signals("quake", StopMode::kInSteps);
    std::raise(SIGINT);
    std::exit(stop_wanted() ? 1 : 0);
  };
  EXPECT_EXIT(told(), testing::ExitedWithCode(0), "^$");
}

}  // namespace
}  // namespace fb
