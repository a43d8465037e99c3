// What a technique keeps on the device, as rows: TechniqueMemory makes the arrays, binds, zeroes, forgets and sums
// them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/maths.h"
#include "gpu/buffer.h"
#include "gpu/pipeline.h"
#include "render/passes/pass.h"

namespace fb::render {

// An array in the technique's set. What there is one element of says when it is made anew, with all others: a table's
// and the probes' count is the technique's to say (set_count), a pixel's is that of the pixels at which light is
// sampled.
struct ArrayRow {
  enum class Per { kTable, kPixel, kProbe };
  std::uint32_t binding;  // in kSetTechnique
  const char* name;       // for people: of what memory runs out
  Per per;
  std::uint32_t bytes;  // of an element
  bool former = false;  // the array has two halves that change places each frame: the former frame's is kept
};

// A row of a technique's header (FB_NAME_ARRAYS) as one.
#define FB_ARRAY_ROW(constant, binding, per, bytes, former, name) \
  {shared::constant, name, ArrayRow::Per::per,                    \
   [] {                                                           \
     using namespace shared;                                      \
     return bytes;                                                \
   }(),                                                           \
   former},

// No array is larger than what the device lets a shader bind (128 MiB on lavapipe): who chooses a table's size asks
// most_elements().
class TechniqueMemory {
 public:
  // `zeroed`: the name of the pass that zeroes the arrays. Rows stay where they are.
  TechniqueMemory(gpu::Device& device, gpu::BindingTable& table, std::span<const ArrayRow> rows, std::string zeroed);
  ~TechniqueMemory();
  TechniqueMemory(const TechniqueMemory&) = delete;
  TechniqueMemory& operator=(const TechniqueMemory&) = delete;

  // Of each half, with so many bytes after them.
  std::uint64_t most_elements(std::uint32_t binding, std::uint64_t extra = 0) const;
  // Elements of a table's or of probes' array, of each half. `extra` bytes follow them. A change forgets all arrays.
  void set_count(std::uint32_t binding, std::uint64_t count, std::uint64_t extra = 0);
  // Between submissions, after the counts: makes what has another size. `lit`: blocks of which one pixel is lit, a row
  // and their rows (TechniqueFrame::lit), for arrays of pixels; another shape forgets those, and all others. Throws
  // OutOfMemory: then the next call starts anew.
  void make(uvec2 lit = uvec2(0));
  // The same once a frame: and turns the halves. True: all arrays are zeroed in this frame.
  bool begin_frame(uvec2 lit = uvec2(0));
  // Before the passes that read them.
  void add_reset(PassList& list);
  // At the next frame.
  void forget() { forget_ = true; }

  // Where a half of `binding` begins, in elements: that of this frame, that of the former one.
  std::uint32_t now(std::uint32_t binding) const;
  std::uint32_t former(std::uint32_t binding) const;
  const gpu::Buffer& buffer(std::uint32_t binding) const { return of(binding).buffer; }
  std::uint64_t bytes() const;

 private:
  struct Array {
    const ArrayRow* row;
    std::uint64_t count = 0, extra = 0;
    gpu::Buffer buffer;
  };
  Array& of(std::uint32_t binding);
  const Array& of(std::uint32_t binding) const;
  static std::uint64_t bytes_of(const Array& array);

  gpu::Device& device_;
  gpu::BindingTable& table_;
  std::vector<Array> arrays_;
  std::string zeroed_;
  uvec2 lit_{0};
  std::uint32_t half_ = 0;
  bool forget_ = true, zero_ = false;
};

}  // namespace fb::render
