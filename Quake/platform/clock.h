// Time for the frame loop. Does not use SDL, so that programs without a window can use it.
#pragma once

namespace fb::platform {

// Seconds since the program's first call; never goes back.
double now_seconds();

// Sleeps for about this time; zero or less returns at once.
void sleep_seconds(double seconds);

}  // namespace fb::platform
