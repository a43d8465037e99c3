// OutOfMemory: there is no memory for something, of the host's or of a device's, or a device takes nothing so large.
// Who allocates throws it (or std::bad_alloc, which is its base), so that nothing between needs to care but for leaving
// no half-made state. Who catches it: what starts (a device, a renderer, a level), a frame's drawing, a command of the
// console, and the programs' main(), each with one sentence.
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

// What is to be told of it; std::bad_alloc has no sentence of its own.
std::string sentence_of(const std::bad_alloc& failure);

// "4.0 GiB", "12.5 MiB", "300 bytes".
std::string memory_text(std::uint64_t bytes);

// What `work` gives, a Result; memory that runs out in it is an error like others.
template <typename Work>
auto within_memory(Work&& work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc& failure) {
    return Error{sentence_of(failure)};
  }
}

}  // namespace fb
