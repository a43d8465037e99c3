#include "base/stop.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#ifdef __unix__
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>
#endif

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
    std::this_thread::sleep_for(std::chrono::duration<double>(kOneTelling));
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

#ifdef __unix__

TEST(StopDeathTest, WhateverIsMeantToEndAProgramEndsItInOrder) {
  const auto told = [](int signal) {
    stop_on_signals("quake", StopMode::kInSteps);
    std::raise(signal);
    std::exit(stop_wanted() ? exit_status_or_signal(0) : 1);
  };
  const rlimit no_cores{0, 0};  // SIGQUIT and SIGXCPU leave one
  setrlimit(RLIMIT_CORE, &no_cores);
  EXPECT_EXIT(told(SIGHUP), testing::KilledBySignal(SIGHUP), "^quake: stopped by SIGHUP\n$");
  EXPECT_EXIT(told(SIGQUIT), testing::KilledBySignal(SIGQUIT), "^quake: stopped by SIGQUIT\n$");
  EXPECT_EXIT(told(SIGXCPU), testing::KilledBySignal(SIGXCPU), "^quake: stopped by SIGXCPU\n$");
  EXPECT_EXIT(told(SIGALRM), testing::KilledBySignal(SIGALRM), "^quake: stopped by SIGALRM\n$");
  EXPECT_EXIT(told(SIGVTALRM), testing::KilledBySignal(SIGVTALRM), "^quake: stopped by SIGVTALRM\n$");
  EXPECT_EXIT(told(SIGPROF), testing::KilledBySignal(SIGPROF), "^quake: stopped by SIGPROF\n$");
  EXPECT_EXIT(told(SIGUSR1), testing::KilledBySignal(SIGUSR1), "^quake: stopped by SIGUSR1\n$");
  EXPECT_EXIT(told(SIGUSR2), testing::KilledBySignal(SIGUSR2), "^quake: stopped by SIGUSR2\n$");
}

// A terminal that closes, and `timeout`, say it twice within a moment.
TEST(StopDeathTest, TheSameTellingTwiceIsOne) {
  const auto told = [](int first, int second) {
    stop_on_signals("quake", StopMode::kInSteps);
    std::raise(first);
    std::raise(second);
    std::exit(stop_wanted() ? exit_status_or_signal(0) : 1);
  };
  EXPECT_EXIT(told(SIGHUP, SIGHUP), testing::KilledBySignal(SIGHUP), "^quake: stopped by SIGHUP\n$");
  EXPECT_EXIT(told(SIGTERM, SIGHUP), testing::KilledBySignal(SIGTERM), "^quake: stopped by SIGTERM\n$");
}

// The kernel repeats SIGXCPU each second; it does not mean more than the first.
TEST(StopDeathTest, MoreProcessorTimeIsTheSameTelling) {
  const auto told = [] {
    stop_on_signals("quake", StopMode::kInSteps);
    std::raise(SIGXCPU);
    std::this_thread::sleep_for(std::chrono::duration<double>(kOneTelling));
    std::raise(SIGXCPU);
    std::exit(stop_wanted() ? 0 : 1);
  };
  EXPECT_EXIT(told(), testing::ExitedWithCode(0), "^$");
}

TEST(StopDeathTest, ATerminalThatClosesUnderNohupEndsNothing) {
  const auto told = [] {
    std::signal(SIGHUP, SIG_IGN);
    stop_on_signals("quake", StopMode::kInSteps);
    std::raise(SIGHUP);
    std::exit(stop_wanted() ? 1 : 0);
  };
  EXPECT_EXIT(told(), testing::ExitedWithCode(0), "^$");
}

TEST(StopDeathTest, AnotherHandlerStays) {
  const auto told = [] {
    std::signal(SIGPROF, [](int) { std::_Exit(5); });
    stop_on_signals("quake", StopMode::kInSteps);
    std::raise(SIGPROF);
    std::exit(0);
  };
  EXPECT_EXIT(told(), testing::ExitedWithCode(5), "^$");
}

TEST(StopDeathTest, WhatCannotBeWrittenIsAnErrorOfTheWriteAlone) {
  const auto write_in_vain = [] {
    std::signal(SIGPIPE, SIG_DFL);
    std::signal(SIGXFSZ, SIG_DFL);
    stop_on_signals("quake", StopMode::kAtOnce);
    int ends[2];
    if (::pipe(ends) != 0) std::exit(1);
    ::close(ends[0]);
    if (::write(ends[1], "x", 1) != -1 || errno != EPIPE) std::exit(2);
    const auto path = std::filesystem::temp_directory_path() / ("fullbright_stop_test." + std::to_string(::getpid()));
    const int file = ::open(path.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
    std::filesystem::remove(path);
    const rlimit nothing{0, RLIM_INFINITY};
    if (file < 0 || setrlimit(RLIMIT_FSIZE, &nothing) != 0) std::exit(3);
    if (::write(file, "x", 1) != -1 || errno != EFBIG) std::exit(4);
    std::_Exit(0);
  };
  EXPECT_EXIT(write_in_vain(), testing::ExitedWithCode(0), "^$");
}

// What is started by the program dies by these signals as if started by a shell.
TEST(StopDeathTest, WhatThisProgramStartsHasTheDefaults) {
  const auto start = [] {
    std::signal(SIGPIPE, SIG_DFL);
    stop_on_signals("quake", StopMode::kInSteps);
    ::execlp("sh", "sh", "-c", "kill -PIPE $$; exit 3", static_cast<char*>(nullptr));
    std::_Exit(4);
  };
  EXPECT_EXIT(start(), testing::KilledBySignal(SIGPIPE), "^$");
}

#endif

}  // namespace
}  // namespace fb
