// How a program is told to end: SIGINT and SIGTERM. There is one handler, and three ways to obey it.
//
// kInSteps, for a game: the handler sets a flag, work that may last asks for it between its steps, and the program ends
// in its usual way, so that a recording is whole and other players hear of it. Work that does not come to a step's end
// in kGraceSeconds (a single frame may take minutes), and a second signal, end the program at once.
// kAsQuit, for a game in a window: the same as if its player had typed `quit`, however long that takes; a second signal
// ends it at once.
// kAtOnce, for work whose results are files that appear when they are whole: there is nothing to put in order.
//
// But for `quit` there is one sentence, and the program dies by the signal: shells see 128 + its number, and whoever
// started it sees the signal itself.
#pragma once

namespace fb {

enum class StopMode { kInSteps, kAsQuit, kAtOnce };
constexpr unsigned kGraceSeconds = 5;

// From now on. `program` is what the sentence begins with; the text must last. A signal that was ignored before, as a
// shell makes SIGINT for what it starts in the background, stays ignored.
void stop_on_signals(const char* program, StopMode mode);

// Whether the program was told to end.
bool stop_wanted();
// Tells it so, as the handler does; 0 takes it back.
void want_stop(int signal);
// Last in main(), with everything in order: dies by the signal that the program was told to end by, after the sentence;
// without one, or where it counts as `quit`, gives the status.
int exit_status_or_signal(int status);

}  // namespace fb
