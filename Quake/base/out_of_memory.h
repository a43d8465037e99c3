// OutOfMemory: memory of the host or of a device has run out, or a device does not allow something so large. Allocating
// functions throw it (or its base, std::bad_alloc), so that the code in between only has to leave no half-made state.
// It is caught where something starts (a device, a renderer, a level), where a frame is drawn, where a console command
// is executed, and in the programs' main(); each prints one message.
#pragma once

#include <cstdint>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "base/result.h"

namespace fb {

class OutOfMemory : public std::bad_alloc {
 public:
  explicit OutOfMemory(std::string sentence) : sentence_(std::make_shared<const std::string>(std::move(sentence))) {}
  const char* what() const noexcept override { return sentence_->c_str(); }

 private:
  std::shared_ptr<const std::string> sentence_;  // copying an exception must not allocate
};

// The message for the user; std::bad_alloc has none of its own.
std::string sentence_of(const std::bad_alloc& failure);

// "4.0 GiB", "12.5 MiB", "300 bytes".
std::string memory_text(std::uint64_t bytes);

// Runs `work`, which returns a Result, and returns its result; running out of memory becomes an error like others.
template <typename Work>
auto within_memory(Work&& work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc& failure) {
    return Error{sentence_of(failure)};
  }
}

}  // namespace fb
