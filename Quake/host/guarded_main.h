// The outer part of both programs' main(): an exception that nothing else handled ends the program with one message and
// exit status 1.
#pragma once

#include <functional>

namespace fb::host {

int guarded_main(const char* program, const std::function<int()>& run);

}  // namespace fb::host
