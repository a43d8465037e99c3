// How SIGINT and SIGTERM end a program. There is one handler with three modes.
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
// and the parent process sees the signal itself.
#pragma once

namespace fb {

enum class StopMode { kInSteps, kAsQuit, kAtOnce };
constexpr unsigned kGraceSeconds = 5;

// Installs the handler. `program` is the start of the message; the text must stay valid. A signal that was
// ignored before, as a shell ignores SIGINT for background processes, stays ignored.
void stop_on_signals(const char* program, StopMode mode);

// Whether the program was told to end.
bool stop_wanted();
// Requests it, as the handler does; 0 withdraws the request.
void want_stop(int signal);
// The last call of main(), after all cleanup. If a signal has ended the program, prints the message and dies by that
// signal; otherwise, or if the signal counts as `quit`, returns the status.
int exit_status_or_signal(int status);

}  // namespace fb
