// fullbright-lab still: one picture of so many samples, plain or guided (technique mir). Several runs of the program
// may make it: a guided one's state is kept after every iteration but the last.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "base/maths.h"
#include "base/result.h"
#include "lab/iterate/iterate_job.h"
#include "lab/iterate/schedule.h"
#include "render/renderer.h"
#include "render/techniques/iteration_memory.h"

namespace fb::lab {

struct StillJob {
  render::RenderSettings settings;  // of a guided one the estimator is mir
  uvec2 size{0, 0};                 // of the output
  std::uint32_t samples = 1;        // a pixel, to kMostScheduled
  bool guided = false;
  std::string resume;  // the state's file, of a guided one; empty: none
};
Schedule schedule_of(const StillJob& job);  // a plain picture is one iteration
// What is about to be done, for people: the technique, its bias and its schedule.
std::string still_text(const StillJob& job);

// What there is, bytes. `shared`: the device's memory is the host's (a software driver).
struct MemoryLimits {
  std::uint64_t host = 0, device = 0;
  bool shared = false;
};
// Fails with one sentence that says what is missing and what would take less.
Status memory_suffices(const StillJob& job, const render::IterationMemory& memory, const MemoryLimits& limits);
std::string memory_text(const render::IterationMemory& memory);

struct StillTold {
  // The state of so many samples a pixel was found; before the first frame.
  std::function<void(std::uint32_t samples)> resumed;
  // Samples a pixel that are done, and seconds for each of those of this run.
  std::function<void(std::uint32_t samples, double seconds)> sample;
  // After each iteration but the last, when its state is kept. False: the picture is given up here.
  std::function<bool(std::uint32_t iterations)> iteration;
};
// Fails where the state's file is damaged or of another picture. Where it cannot be written the picture goes on, with a
// warning. The file is left where it is; a picture that was given up has no pixels.
Result<IteratedPicture> render_still(render::Renderer& renderer, const StillJob& job,
                                     const scene::FrameSnapshot& snapshot, const StillTold& told);

}  // namespace fb::lab
