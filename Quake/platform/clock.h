// Time as the frame loop sees it. No part of SDL, so that it serves programs without a window.
#pragma once

namespace fb::platform {

// Seconds since the program's first call; never goes back.
double now_seconds();

// Sleeps for about so long; no time or less returns at once.
void sleep_seconds(double seconds);

}  // namespace fb::platform
