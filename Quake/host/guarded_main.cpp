#include "host/guarded_main.h"

#include <cstdio>
#include <exception>
#include <new>

#include "base/out_of_memory.h"

namespace fb::host {
namespace {

// Must not allocate memory.
int end(const char* program, const char* why) {
  std::fprintf(stderr, "%s: %s\n", program, why);
  return 1;
}

}  // namespace

int guarded_main(const char* program, const std::function<int()>& run) {
  try {
    return run();
  } catch (const OutOfMemory& failure) {
    return end(program, failure.what());
  } catch (const std::bad_alloc&) {
    return end(program, "the system has no memory left for this program");
  } catch (const std::exception& failure) {  // for example a thread that could not be started, or a file system error
    return end(program, failure.what());
  }
}

}  // namespace fb::host
