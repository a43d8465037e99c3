// Technique: one way to estimate the light that a first vertex reflects; what r_estimator chooses. It has a shader that
// traces paths (Shaders/estimators/FOLDER/NAME.comp), other passes if it wants, and whatever it keeps from frame to
// frame (render/techniques/technique_memory.h), in a descriptor set and a uniform block of its own. techniques() lists
// them; a row registers one.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "base/maths.h"
#include "base/result.h"
#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "gpu/pipeline.h"
#include "render/passes/pass.h"
#include "render/passes/settings.h"
#include "render/passes/shader_set.h"
#include "scene/snapshot.h"
#include "shared/bindings.h"
#include "shared/debug_views.h"

namespace fb::render {

// What a technique is told of a frame, between submissions.
struct TechniqueFrame {
  const scene::FrameSnapshot& snapshot;
  const RenderSettings& settings;  // as Technique::adapt left them
  uvec2 render;                    // rendered pixels
  uvec2 lit;                       // blocks of which one pixel is lit: pixels at which light is sampled
  float pixel_tangent;             // tangent of the angle that a pixel subtends
  std::uint64_t number;            // of frames since the renderer was made
  bool cut;                        // nothing of the former frame is of use: there is none, or the view has jumped
  bool still;                      // the former frame's snapshot again: nothing has moved
  bool fog, turbid;                // paths begin in fog, too; in liquids or glass
  bool medium() const { return fog || turbid; }
};

// What it adds its passes from.
struct TechniquePasses {
  PassList& list;
  ShaderSet& shaders;
  Variant variant;  // what the scene needs; the technique adds its own constants
  bool show_view;   // the paths' pass draws the technique's debug view
  uvec2 size;
  AskedGroups medium;                    // of paths that begin in the medium
  std::int32_t bounces, medium_bounces;  // most reflections of paths from surfaces, from the medium
};

class Technique {
 public:
  virtual ~Technique() = default;
  // What the settings mean to it.
  virtual RenderSettings adapt(RenderSettings settings) const { return settings; }
  // Makes its buffers, fills its constants; called once a frame. May throw OutOfMemory: then the next call starts anew.
  virtual void prepare(const TechniqueFrame& frame) = 0;
  // Its passes, all of kind kEstimator: from the G-buffer to kBindRadiance. Called after prepare.
  virtual void add_passes(const TechniquePasses& passes) = 0;
  // Offline rendering in iterations (lab/iterate): called before prepare of the first frame of each, from 0 on, in
  // which frames take `samples` a pixel together. In play it is never called.
  virtual void begin_iteration(std::uint32_t /*iteration*/, std::uint32_t /*samples*/) {}
  // In the place of add_passes, in one more frame after the last iteration: the picture of all of them, from the
  // G-buffer to kBindRadiance, where TechniqueInfo says ends_iterations.
  virtual void add_final_passes(const TechniquePasses& /*passes*/) {}
  // Forgets at the next frame what it learnt.
  virtual void forget() {}
  // Mixed into the frame's random numbers; 0: they are the frame's own. Random numbers from which something was learnt
  // must not come again while it is remembered.
  virtual std::uint32_t salt() const { return 0; }
  // Device memory of what it learns, bytes.
  virtual std::uint64_t bytes() const { return 0; }
  // After the last frame of an iteration that is not the last: appends what a picture goes on from in another program.
  // Nothing: it cannot.
  virtual void save_iterations(Bytes& /*state*/) {}
  // As if the iterations that were saved had been rendered here, in pictures of the same size; fails where the bytes
  // are damaged, and has then learnt nothing. begin_iteration of the next one follows.
  virtual Status resume_iterations(ByteReader& state) { return state.error("no iterations can be resumed"); }
  // Of iterations: one line for people about what they have kept, empty if there is nothing to say.
  virtual std::string report() const { return ""; }
};

// What a technique is made with. The set kSetTechnique of the table is its own while it lives.
struct TechniqueTools {
  gpu::Device& device;
  gpu::BindingTable& table;
};

enum class Bias { kUnbiased, kBiased };  // of paths of at most r_bounces reflections

// How a technique's frames hang on each other, by which tests and references take their samples.
enum class Frames {
  kIndependent,  // not at all
  kLearning,     // what a frame samples is of densities that former frames taught: errors are uncorrelated
  kCorrelated    // a frame uses former frames' samples: only runs that begin with nothing are independent
};

struct TechniqueInfo {
  std::string_view name;  // of its folder and its shader, and what r_estimator says
  std::string_view description;
  Bias bias;
  std::unique_ptr<Technique> (*make)(const TechniqueTools& tools, std::string_view name);
  Frames frames = Frames::kIndependent;
  bool wants_lights = false;                   // the list of lights (kBindLights)
  bool wants_previous_gbuffer = false;         // kBindPreviousGBuffer
  std::uint32_t views = shared::kViewOfFrame;  // the debug views that it draws itself: their owner
  // The picture of offline iterations is made by its final passes; else it is the mean of all samples.
  bool ends_iterations = false;
  std::string_view stands_on{};  // another folder, whose passes it runs, too

  bool unbiased() const { return bias == Bias::kUnbiased; }
  bool learns() const { return frames != Frames::kIndependent; }  // keeps something from frame to frame
};
const std::vector<TechniqueInfo>& techniques();
// Null: there is none of that name.
const TechniqueInfo* find_technique(std::string_view name);

// Of techniques that keep nothing, for their rows.
std::unique_ptr<Technique> make_path_technique(const TechniqueTools& tools, std::string_view name);

using TechniqueSpecs = std::array<std::uint32_t, shared::kTechniqueSpecs>;
// Constants of the shaders that trace paths: from surfaces, those with which a smaller shader may stand in while theirs
// is made, and from the medium.
struct PathSpecs {
  TechniqueSpecs surfaces{};
  std::optional<TechniqueSpecs> meanwhile;
  TechniqueSpecs medium{};
  // Of a technique that learns: the number of parts in which a frame's paths from surfaces are traced, one after the
  // other, so that each part uses what those before it have learnt. With four they hold 1/8, 1/8, 1/4 and 1/2 of the
  // paths. A device that runs all paths of a part at once learns nothing within it.
  std::uint32_t parts = 1;
  std::function<void(gpu::Commands&)> between_parts{};  // if any
};
// The passes that trace paths, of a technique's shader: from surfaces and, where there is one, from the medium.
void add_paths_pass(const TechniquePasses& passes, std::string_view name, const PathSpecs& constants = {});

}  // namespace fb::render
