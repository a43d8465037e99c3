#include "base/stop.h"

#include <atomic>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <initializer_list>

#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

namespace fb {
namespace {

static_assert(std::atomic<int>::is_always_lock_free, "a handler may take no lock");
std::atomic<int> wanted_signal{0};  // 0: none
std::atomic<bool> told_once{false};
std::atomic<const char*> program_name{""};
std::atomic<StopMode> stop_mode{StopMode::kInSteps};

// The functions below may run in a signal handler: no memory allocation, no locks, no streams.

void write_text(const char* text) {
  const std::size_t size = std::strlen(text);
#ifdef _WIN32
  (void)_write(2, text, static_cast<unsigned>(size));
#else
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text, size);
#endif
}

bool at_terminal() {
#ifdef _WIN32
  return false;
#else
  return ::isatty(STDERR_FILENO) != 0;
#endif
}

[[noreturn]] void die_by(int signal) {
  if (at_terminal()) write_text("\n");  // after "^C", or an unfinished line
  write_text(program_name);
  write_text(signal == SIGINT ? ": stopped by SIGINT\n" : ": stopped by SIGTERM\n");
  std::signal(signal, SIG_DFL);
#ifndef _WIN32
  // The handler blocks its own signal.
  sigset_t held;
  sigemptyset(&held);
  sigaddset(&held, signal);
  ::pthread_sigmask(SIG_UNBLOCK, &held, nullptr);
#endif
  std::raise(signal);
  std::_Exit(128 + signal);
}

#ifndef _WIN32
void on_alarm(int) { die_by(wanted_signal != 0 ? wanted_signal.load() : SIGTERM); }
#endif

void on_signal(int signal) {
  if (stop_mode == StopMode::kAtOnce || told_once.exchange(true)) die_by(signal);
  wanted_signal = signal;
#ifndef _WIN32
  if (stop_mode == StopMode::kAsQuit) return;
  std::signal(SIGALRM, on_alarm);
  ::alarm(kGraceSeconds);
#endif
}

}  // namespace

void stop_on_signals(const char* program, StopMode mode) {
  program_name = program;
  stop_mode = mode;
  for (const int signal : {SIGINT, SIGTERM}) {
    if (std::signal(signal, on_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

bool stop_wanted() { return wanted_signal.load(std::memory_order_relaxed) != 0; }
void want_stop(int signal) { wanted_signal = signal; }

int exit_status_or_signal(int status) {
  if (const int signal = wanted_signal; signal != 0 && stop_mode != StopMode::kAsQuit) {
    std::fflush(nullptr);
    die_by(signal);
  }
  return status;
}

}  // namespace fb
