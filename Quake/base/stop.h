// How signals end a program. All that are meant to end one (kEndingSignals in stop_posix.cpp: SIGHUP of a closed
// terminal, SIGINT, SIGTERM, SIGXCPU ...) go one way, which has three modes.
//
// kInSteps, for a game: the handler sets a flag, long work checks it between its steps, and the program ends in its
// usual way, so that a recording is complete and other players are told. If work does not finish a step within
// kGraceSeconds (a single frame may take minutes), or at a second signal, the program ends at once.
// kAsQuit, for a game in a window: the same as `quit` at the console, however long that takes; a second signal ends the
// program at once.
// kAtOnce, for work whose results are files that get their names when they are complete: nothing needs to be cleaned
// up.
//
// Except for `quit`, one message is printed and the program dies by the signal: a shell reports 128 plus its number,
// and the parent process sees the signal itself. A second signal is one that comes kOneTelling or more after the first:
// a terminal that closes sends SIGHUP itself and by its shell, `timeout` to the program and to its group.
//
// On Windows the console's control events take the place of signals (stop_windows.cpp): Ctrl+C and Ctrl+Break, the
// window's cross, log-off and shutdown. The program's status is that of programs which Ctrl+C has ended.
//
// SIGPIPE and SIGXFSZ end nothing: the write that they tell of fails, too, with EPIPE or EFBIG. Signals that tell of a
// fault in the program (SIGSEGV ...), and those that stop a job and let it go on, keep their default.
#pragma once

namespace fb {

enum class StopMode { kInSteps, kAsQuit, kAtOnce };
constexpr unsigned kGraceSeconds = 5;
constexpr double kOneTelling = 0.25;  // seconds

// Installs the handlers. `program` is the start of the message; the text must stay valid. A signal that was ignored
// before, as nohup ignores SIGHUP and a shell SIGINT for background processes, stays ignored; one that has another
// handler, a profiler's say, keeps it.
void stop_on_signals(const char* program, StopMode mode);
// The part of it that concerns SIGPIPE and SIGXFSZ. Programs that this one starts have their defaults again.
void survive_failed_writes();

// Whether the program was told to end.
bool stop_wanted();
// Requests it, as the handler does; 0 withdraws the request.
void want_stop(int signal);
// The last call of main(), after all cleanup. If a signal has ended the program, prints the message and dies by that
// signal; otherwise, or if the signal counts as `quit`, returns the status.
int exit_status_or_signal(int status);

}  // namespace fb
