// What both programs' main() have in common: what nobody else could deal with ends with one sentence and exit status 1.
#pragma once

#include <functional>

namespace fb::host {

int guarded_main(const char* program, const std::function<int()>& run);

}  // namespace fb::host
