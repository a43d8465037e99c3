// Windows ends a console's programs by control events: Ctrl+C, Ctrl+Break, the window's cross, log-off, shutdown. Each
// calls the handler in a thread of its own, so that it may wait. By the last three the system ends the program as soon
// as the handler returns, and after some seconds anyway. There are no signals from other programs, and a failed write
// sends none.
#include <windows.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "base/stop.h"

namespace fb {
namespace {

std::atomic<int> wanted_signal{0};  // SIGINT, SIGBREAK or what want_stop() was told; 0: none
std::atomic<ULONGLONG> told_at{0};  // milliseconds since the system's start; 0: never
std::atomic<const char*> program_name{""};
std::atomic<StopMode> stop_mode{StopMode::kInSteps};

const char* name_of(int signal) {
  switch (signal) {
    case SIGINT:
      return "Ctrl+C";
    case SIGBREAK:
      return "Ctrl+Break, a closed console or the end of the session";
    case SIGTERM:
      return "SIGTERM";
    default:
      return "a signal";
  }
}

// With the status that the system gives to what Ctrl+C ends.
[[noreturn]] void die_by(int signal) {
  const char* const parts[] = {program_name, ": stopped by ", name_of(signal), "\r\n"};
  for (const char* part : parts) {
    DWORD written = 0;
    WriteFile(GetStdHandle(STD_ERROR_HANDLE), part, static_cast<DWORD>(std::strlen(part)), &written, nullptr);
  }
  TerminateProcess(GetCurrentProcess(), static_cast<UINT>(STATUS_CONTROL_C_EXIT));
  for (;;) Sleep(INFINITE);
}

BOOL WINAPI on_control(DWORD event) {
  const int signal = event == CTRL_C_EVENT ? SIGINT : SIGBREAK;
  if (stop_mode == StopMode::kAtOnce) die_by(signal);
  const ULONGLONG now = GetTickCount64();
  ULONGLONG before = 0;
  if (!told_at.compare_exchange_strong(before, now)) {
    if (static_cast<double>(now - before) >= 1000.0 * kOneTelling) die_by(signal);
    return TRUE;
  }
  wanted_signal = signal;
  // main() ends the program while this thread waits.
  const bool last_event = event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT;
  if (stop_mode != StopMode::kAsQuit || last_event) {
    Sleep(1000 * kGraceSeconds);
    die_by(signal);
  }
  return TRUE;
}

}  // namespace

void stop_on_signals(const char* program, StopMode mode) {
  program_name = program;
  stop_mode = mode;
  SetConsoleCtrlHandler(on_control, FALSE);  // once only
  SetConsoleCtrlHandler(on_control, TRUE);
}

void survive_failed_writes() {}

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
