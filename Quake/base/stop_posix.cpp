#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <iterator>

#include "base/stop.h"

namespace fb {
namespace {

static_assert(std::atomic<int>::is_always_lock_free && std::atomic<double>::is_always_lock_free,
              "a handler may take no lock");
std::atomic<int> wanted_signal{0};  // 0: none
std::atomic<bool> told_once{false};
std::atomic<double> told_at{0.0};  // seconds of the steady clock
std::atomic<const char*> program_name{""};
std::atomic<StopMode> stop_mode{StopMode::kInSteps};

struct EndingSignal {
  int number;
  const char* name;
};
// Every signal whose default ends a program, but for failed writes, faults and real-time signals. SIGALRM and its like
// come from timers that outlive exec, SIGUSR1 from batch systems whose time is nearly over.
constexpr EndingSignal kEndingSignals[] = {
    {SIGINT, "SIGINT"},       {SIGTERM, "SIGTERM"}, {SIGHUP, "SIGHUP"},       {SIGQUIT, "SIGQUIT"},
    {SIGXCPU, "SIGXCPU"},     {SIGALRM, "SIGALRM"}, {SIGVTALRM, "SIGVTALRM"}, {SIGPROF, "SIGPROF"},
    {SIGUSR1, "SIGUSR1"},     {SIGUSR2, "SIGUSR2"},
#ifdef SIGPWR
    {SIGPWR, "SIGPWR"},
#endif
#ifdef SIGIO
    {SIGIO, "SIGIO"},
#endif
#ifdef SIGSTKFLT
    {SIGSTKFLT, "SIGSTKFLT"},
#endif
};

// The functions below may run in a signal handler: no memory allocation, no locks, no streams.

void write_text(const char* text) {
  const std::size_t size = std::strlen(text);
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text, size);
}

bool at_terminal() { return ::isatty(STDERR_FILENO) != 0; }

double steady_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

const char* name_of(int signal) {
  const auto* const found = std::ranges::find(kEndingSignals, signal, &EndingSignal::number);
  return found == std::end(kEndingSignals) ? "a signal" : found->name;
}

[[noreturn]] void die_by(int signal) {
  if (at_terminal()) write_text("\n");  // after "^C", or an unfinished line
  write_text(program_name);
  write_text(": stopped by ");
  write_text(name_of(signal));
  write_text("\n");
  std::signal(signal, SIG_DFL);
  // The handler blocks its own signal.
  sigset_t held;
  sigemptyset(&held);
  sigaddset(&held, signal);
  ::pthread_sigmask(SIG_UNBLOCK, &held, nullptr);
  std::raise(signal);
  std::_Exit(128 + signal);
}

void on_grace_over(int) { die_by(wanted_signal != 0 ? wanted_signal.load() : SIGTERM); }
// The kernel repeats it each second.
void on_more_processor_time(int) {}
// No SIG_IGN: programs that this one starts would inherit that.
void on_failed_write(int) {}

void on_signal(int signal) {
  const int kept_errno = errno;
  const double now = steady_seconds();
  if (stop_mode == StopMode::kAtOnce) die_by(signal);
  if (told_once.exchange(true)) {
    if (now - told_at >= kOneTelling) die_by(signal);
    errno = kept_errno;
    return;
  }
  told_at = now;
  wanted_signal = signal;
  if (signal == SIGXCPU) std::signal(SIGXCPU, on_more_processor_time);
  if (stop_mode != StopMode::kAsQuit) {
    std::signal(SIGALRM, on_grace_over);
    ::alarm(kGraceSeconds);
  }
  errno = kept_errno;
}

// Where nobody else has decided.
void handle(int signal, void (*handler)(int)) {
  const auto before = std::signal(signal, handler);
  if (before != SIG_DFL && before != SIG_ERR && before != handler) std::signal(signal, before);
}

}  // namespace

void stop_on_signals(const char* program, StopMode mode) {
  program_name = program;
  stop_mode = mode;
  for (const EndingSignal& ending : kEndingSignals) handle(ending.number, on_signal);
  survive_failed_writes();
}

void survive_failed_writes() {
  for (const int signal : {SIGPIPE, SIGXFSZ}) handle(signal, on_failed_write);
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
