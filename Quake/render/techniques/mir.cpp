// Multiple importance reweighting for path guiding (Fan 2025). Offline, in iterations (Technique::begin_iteration): the
// device traces and stores a frame's paths, the host reads them after each frame, learns distributions from them
// between iterations (guiding_trees.h), keeps those that brought light and weighs them when all distributions are known
// (path_store.h, reweighting.h). In play nothing is learnt: `mir` is pt, and `mir_nee` is nee without a memory.
// Layouts: Shaders/estimators/mir/.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <memory>
#include <numeric>
#include <optional>
#include <ratio>
#include <string>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/log.h"
#include "base/parallel.h"
#include "estimators/mir/mir.h"
#include "render/techniques/guiding_trees.h"
#include "render/techniques/iteration_memory.h"
#include "render/techniques/iteration_state.h"
#include "render/techniques/outlier_removal.h"
#include "render/techniques/path_store.h"
#include "render/techniques/path_technique.h"
#include "render/techniques/reweighting.h"
#include "render/techniques/seen_grid.h"
#include "render/techniques/technique_memory.h"
#include "shared/color.h"

namespace fb::render {
namespace {

constexpr ArrayRow kMirRows[]{FB_MIR_ARRAYS(FB_ARRAY_ROW)};
constexpr double kMegabyte = 1e6;
constexpr std::string_view kLooking = "mir_nee";

vec3 color_of(const vec4& v) { return {v.x, v.y, v.z}; }

// An array that the host writes, and shaders read.
struct HostArray {
  std::uint32_t binding;
  gpu::Buffer buffer{};
  template <typename T>
  void write(const TechniqueTools& tools, const std::vector<T>& items, const char* name) {
    const std::uint64_t bytes = std::max<std::uint64_t>(items.size() * sizeof(T), 16);
    if (!buffer || buffer.size() < bytes) {
      buffer = gpu::Buffer();
      tools.table.set_array(shared::kSetTechnique, binding, buffer);
      buffer = gpu::Buffer(tools.device, gpu::BufferUse::kStorage, bytes + bytes / 2, name);
      tools.table.set_array(shared::kSetTechnique, binding, buffer);
    }
    if (!items.empty()) gpu::upload_now(tools.device, buffer, std::span<const T>(items));
  }
};

class MirTechnique : public PathTechnique {
 public:
  MirTechnique(const TechniqueTools& tools, std::string_view name)
      : PathTechnique(name),
        tools_(tools),
        uniform_(tools.device, gpu::BufferUse::kUniform, sizeof(shared::MirConstants), "constants of mir"),
        memory_(tools.device, tools.table, kMirRows, "mir reset") {
    tools.table.set_uniform(shared::kSetTechnique, uniform_);
    if (name == kLooking) looks_.emplace(tools);
  }
  ~MirTechnique() override {
    for (const HostArray* array : {&tree_, &nodes_, &picture_})
      tools_.table.set_array(shared::kSetTechnique, array->binding, gpu::Buffer());
  }
  MirTechnique(const MirTechnique&) = delete;
  MirTechnique& operator=(const MirTechnique&) = delete;

  void begin_iteration(std::uint32_t iteration, std::uint32_t samples) override {
    iterating_ = true;
    if (iteration > 0 && iteration == iteration_ && !seen_.empty()) return;  // it goes on
    iteration_ = iteration;
    if (iteration == 0)
      begin_anew();
    else if (!std::exchange(learnt_, false))
      learn();
    begins_ = true;
    frames_ = 0;
    planned_ = samples;
  }
  void prepare(const TechniqueFrame& frame) override {
    collect();
    settings_ = frame.settings;
    shown_ = frame.render;
    if (iterating_ && size_ != uvec2(0) && size_ != frame.render) change_size();
    if (iterating_) FB_CHECK(frame.lit == frame.render && settings_.spp == 1);
    if (std::exchange(begins_, false)) begin_pictures(frame.render);
    fit();
    memory_.begin_frame();
    if (looks_) looks_->begin_frame();
    shared::MirConstants constants{};
    copy_settings(settings_, constants);
    if (iterating_ && trees_.iterations() > 0) {
      constants.taught = 1;
      constants.cube_low = trees_.cube().low;
      constants.cube_inverse_width = trees_.cube().inverse_width;
      constants.levels = trees_.levels();
      constants.node_levels = trees_.node_levels();
      constants.leaves = static_cast<std::uint32_t>(trees_.places().size());
    }
    constants.stored = iterating_ ? static_cast<std::uint32_t>(vertices_) : 0;
    constants.paths = static_cast<std::uint32_t>(paths_);
    std::memcpy(uniform_.mapped(), &constants, sizeof(constants));
    if (iterating_) ++salt_;
  }
  void add_passes(const TechniquePasses& passes) override {
    memory_.add_reset(passes.list);
    if (looks_) looks_->add_reset(passes.list);  // and nothing is folded in: it stays without a memory
    PathTechnique::add_passes(passes);
    if (!iterating_) return;
    passes.list.dispatch("mir totals", PassKind::kEstimator, passes.shaders.get("mir_totals", passes.variant),
                         groups_over(passes.size, 8));
    pending_ = true;
  }
  void add_final_passes(const TechniquePasses& passes) override {
    memory_.add_reset(passes.list);
    const std::size_t pixels = std::size_t{shown_.x} * shown_.y;  // black, where no sample was seen in this size
    picture_.write(tools_, size_ == shown_ ? finished_picture() : std::vector<vec4>(pixels, vec4(0.0f)),
                   "the picture of all iterations");
    passes.list.dispatch("mir final", PassKind::kEstimator, passes.shaders.get("mir_final", passes.variant),
                         groups_over(passes.size, 8));
    if (iterating_) --salt_;  // it is no sample: those that follow are what they would have been
    iterating_ = false;
  }
  void forget() override {
    start_over();
    iterating_ = false;
  }
  void save_iterations(Bytes& state) override {
    FB_CHECK(iterating_ && !learnt_);
    learn();
    learnt_ = true;
    pictures_.save(state);
    put_array(state, seen_);
    put_array(state, shifted_);
    put_value(state, frames_seen_);
    samples_.save(state);
    put_value(state, salt_);
    put_value(state, let_go_);
    put_value(state, light_);
    put_value(state, host_ms_);
    trees_.save(state);
    store_.save(state);
  }
  Status resume_iterations(ByteReader& state) override {
    start_over();
    const bool whole =
        pictures_.load(state) && take_array(state, seen_) && seen_.size() == pictures_.counts().size() &&
        take_array(state, shifted_) && shifted_.size() == std::size_t{pictures_.size().x} * pictures_.size().y &&
        take_value(state, frames_seen_) && samples_.load(state, shifted_.size()) && take_value(state, salt_) &&
        take_value(state, let_go_) && take_value(state, light_) && take_value(state, host_ms_) && trees_.load(state) &&
        trees_.iterations() == seen_.size() + trees_.kept() &&
        store_.load(state, shifted_.size(), seen_.size(), frames_seen_) && state.remaining() == 0;
    if (!whole) {
      start_over();
      return state.error("the state of the iterations is damaged");
    }
    size_ = pictures_.size();
    iteration_ = static_cast<std::uint32_t>(seen_.size()) - 1;
    learnt_ = true;
    upload_trees();
    return ok_status();
  }
  std::uint32_t salt() const override { return salt_; }
  std::uint64_t bytes() const override {
    return memory_.bytes() + (looks_ ? looks_->bytes() : 0) + tree_.buffer.size() + nodes_.buffer.size() +
           picture_.buffer.size();
  }
  std::string report() const override {
    if (trees_.iterations() == 0) return "";
    return fmt::format(
        "{} paths stored, {:.1f} MB ({} let go of); {} leaves, distributions of {} iterations {:.1f} MB; densities of "
        "{} of {} vertices are others than they were drawn with; stored paths brought {:.3f}% of the light; {:.0f} ms "
        "on the host",
        store_.paths().size(), static_cast<double>(store_.bytes()) / kMegabyte, let_go_, trees_.firsts().size(),
        trees_.iterations(), static_cast<double>(trees_.bytes()) / kMegabyte, others_, vertices_weighed_,
        100 * light_ / std::max(pictures_.light(), 1e-30), host_ms_);
  }

 private:
  // Adds what it takes to host_ms_.
  class Clock {
   public:
    explicit Clock(double& sum) : sum_(sum), start_(std::chrono::steady_clock::now()) {}
    ~Clock() { sum_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count(); }
    Clock(const Clock&) = delete;
    Clock& operator=(const Clock&) = delete;

   private:
    double& sum_;
    std::chrono::steady_clock::time_point start_;
  };

  IterationWeights weights() const { return static_cast<IterationWeights>(settings_.mir_weights); }
  // Of samples that count alike but for weights of their paths, all of which were kept for it.
  bool removes_outliers() const {
    return settings_.mir_outliers > 0 && samples_.count() == frames_seen_ &&
           (weighs_paths(weights()) || weights() == IterationWeights::kAccumulate);
  }
  bool decorrelated() const { return settings_.mir_decorrelated != 0; }
  // Of a frame of this iteration, from 0.
  bool teaches(std::uint32_t frame) const { return !decorrelated() || frame < planned_ - planned_ / 2; }
  bool is_seen(std::uint32_t frame) const { return !decorrelated() || !teaches(frame); }

  void start_over() {
    trees_.clear();
    taught_.clear();
    salt_ = 0;
    forget_picture();
  }
  // Of the former picture all but what directions it has learnt.
  void begin_anew() {
    if (!seen_.empty() && !learnt_) learn();
    trees_.keep_last();
    forget_picture();
  }
  void forget_picture() {
    store_.clear();
    samples_.clear();
    seen_.clear();
    shifted_.clear();
    size_ = uvec2(0);
    pending_ = begins_ = learnt_ = false;
    frames_seen_ = 0;
    let_go_ = vertices_weighed_ = others_ = 0;
    light_ = host_ms_ = 0;
  }
  // What is left of the iteration is the first of another picture.
  void change_size() {
    const std::uint32_t left = planned_ - std::min(frames_, planned_);
    start_over();
    begins_ = true;
    frames_ = 0;
    planned_ = left;
  }
  void begin_pictures(uvec2 size) {
    if (size_ == uvec2(0)) {
      size_ = size;
      pictures_.begin(size);
      shifted_.assign(std::size_t{size.x} * size.y, glm::dvec3(0.0));
    }
    pictures_.begin_iteration();
    seen_.push_back(decorrelated() ? planned_ / 2 : planned_);
  }
  std::size_t lights_per_vertex() const { return looks_ ? shared::kMirLightsLooked : shared::kMirLightsOfOne; }
  // Arrays of vertices hold as many paths as the device binds.
  void fit() {
    const std::size_t pixels = iterating_ ? std::size_t{size_.x} * size_.y : 0;
    vertices_ = static_cast<std::size_t>(std::max(settings_.bounces, 1));
    paths_ =
        std::min<std::size_t>(pixels, memory_.most_elements(shared::kMirLights) / (vertices_ * lights_per_vertex()));
    if (paths_ < pixels)
      log_warning("mir: the device has room for the paths of {} of {} pixels; the others are not weighed", paths_,
                  pixels);
    for (const std::uint32_t array : {shared::kMirPlaces, shared::kMirDirections, shared::kMirLinks})
      memory_.set_count(array, paths_ * vertices_);
    memory_.set_count(shared::kMirLights, paths_ * vertices_ * lights_per_vertex());
    memory_.set_count(shared::kMirEnds, paths_);
    memory_.set_count(shared::kMirTotals, pixels);
  }

  // What the last frame stored.
  void collect() {
    if (!std::exchange(pending_, false)) return;
    const Clock clock(host_ms_);
    const std::uint32_t frame = frames_++;
    const auto read = [&](std::uint32_t array, std::size_t count) {
      return gpu::read_now<vec4>(tools_.device, memory_.buffer(array), count);
    };
    if (is_seen(frame)) {
      const std::vector<vec4> totals = read(shared::kMirTotals, std::size_t{size_.x} * size_.y);
      pictures_.add(totals);
      if (removes_outliers()) samples_.add(totals);
      ++frames_seen_;
    }
    const bool keeps = is_seen(frame) && weighs_paths(weights()), learns = teaches(frame);
    if (!keeps && !learns) return;
    const auto ends = gpu::read_now<glm::uvec4>(tools_.device, memory_.buffer(shared::kMirEnds), paths_);
    const std::size_t count = paths_ * vertices_;
    const auto places = read(shared::kMirPlaces, count), directions = read(shared::kMirDirections, count),
               links = read(shared::kMirLinks, count), lights = read(shared::kMirLights, count * lights_per_vertex());
    const auto met = [&](std::size_t at) { return lights[at * lights_per_vertex()]; };
    const auto found = [&](std::size_t at) {
      return looks_ ? color_of(lights[at * lights_per_vertex() + 1]) : vec3(0);
    };
    const auto iteration = static_cast<std::uint32_t>(seen_.size()) - 1;
    std::vector<PathVertex> path;
    std::vector<LookedFor> looked;
    for (std::size_t i = 0; i < paths_; ++i) {
      const std::size_t first = i * vertices_, n = std::min<std::size_t>(ends[i].x, vertices_);
      if (learns) {
        // From the last vertex on: radiance that comes to each and was not looked for from it.
        vec3 incident(0.0f);
        for (std::size_t k = n; k-- > 0;) {
          const std::size_t next = first + k + 1;
          incident =
              color_of(met(first + k)) + (k + 1 < n ? color_of(links[next]) * incident + found(next) : vec3(0.0f));
          const float pdf = directions[first + k].w;
          if (!(pdf > 0) || taught_.size() >= kMostTaught) continue;
          const bool guided = links[first + k].w > 0;
          taught_.push_back({color_of(places[first + k]), color_of(directions[first + k]),
                             guided ? shared::luminance(incident) / pdf : 0.0f});
        }
      }
      if (!keeps) continue;
      path.clear();
      looked.clear();
      vec3 throughput(shared::uintBitsToFloat(ends[i].y));
      for (std::size_t k = 0; k < n; ++k) {
        const std::size_t at = first + k;
        if (looks_) {
          const vec4 &light = lights[at * lights_per_vertex() + 1], &way = lights[at * lights_per_vertex() + 2];
          looked.push_back(
              {static_cast<std::uint32_t>(k), throughput * color_of(light), color_of(way), way.w, light.w});
        }
        throughput *= color_of(links[at]);
        path.push_back({color_of(places[at]), places[at].w, color_of(directions[at]), links[at].w,
                        throughput * color_of(met(at)), directions[at].w, met(at).w});
      }
      light_ +=
          static_cast<double>(store_.add(static_cast<std::uint32_t>(i), iteration, frames_seen_ - 1, {path, looked}));
    }
    store_.shrink(static_cast<std::uint64_t>(settings_.mir_storage * kMegabyte),
                  [&](const PathStore::Path& gone) { let_go(gone); });
  }

  // What weights add to a path's light, times all samples.
  void shift(const PathStore::Path& path, const glm::dvec3& by) {
    shifted_[path.pixel] += by;
    if (removes_outliers()) samples_.shift(path.frame, path.pixel, by);
  }
  // Its share of the picture is that of the mixture of the iterations so far (Eq. 8).
  void let_go(const PathStore::Path& path) {
    ++let_go_;
    if (settings_.mir_partial == 0) return;
    for_each_ratio(trees_, store_.stored(path), path.iteration, static_cast<std::uint32_t>(seen_.size()),
                   settings_.mir_defence, [&](const vec3& light, std::span<const double> ratios) {
                     shift(path, glm::dvec3(light) * (partial_factor(ratios, seen_) - 1));
                   });
  }

  void learn() {
    collect();
    const Clock clock(host_ms_);
    // Fewer than were planned, where something moved.
    const std::uint32_t teachers = std::min(decorrelated() ? planned_ - planned_ / 2 : planned_, frames_);
    trees_.learn(taught_, static_cast<float>(teachers),
                 {settings_.mir_split, settings_.mir_share, settings_.mir_filter != 0},
                 static_cast<std::uint64_t>(settings_.seed) * 1024 + trees_.iterations());
    taught_.clear();
    upload_trees();
  }
  void upload_trees() {
    std::vector<std::uint32_t> words = trees_.places();
    words.insert(words.end(), trees_.firsts().begin(), trees_.firsts().end());
    tree_.write(tools_, words, "guiding: spatial tree");
    nodes_.write(tools_, trees_.nodes(), "guiding: directional trees");
  }

  // Of all that was seen so far; more may follow.
  std::vector<vec4> finished_picture() {
    const Clock clock(host_ms_);
    std::vector<vec4> picture = pictures_.combined(weights());
    const double samples = pictures_.samples();
    std::vector<glm::dvec3> shifted = shifted_;
    SingleSamples single = samples_;
    if (weighs_paths(weights()) && samples > 0) {
      const std::vector<glm::dvec3> shifts = shifts_of_paths(samples);
      for (std::size_t i = 0; i < shifts.size(); ++i) {
        const PathStore::Path& path = store_.paths()[i];
        shifted[path.pixel] += shifts[i];
        if (removes_outliers()) single.shift(path.frame, path.pixel, shifts[i]);
      }
      for (std::size_t i = 0; i < picture.size(); ++i) picture[i] += vec4(vec3(shifted[i] / samples), 0.0f);
    }
    if (removes_outliers() && single.count() > 0)
      return single.without_outliers(size_, static_cast<double>(settings_.mir_outliers));
    return picture;
  }
  // Of each stored path's light what its weight adds to the mean of all frames, times their number.
  std::vector<glm::dvec3> shifts_of_paths(double samples) {
    const std::vector<double>& counts = pictures_.counts();
    const auto iterations = static_cast<std::uint32_t>(counts.size());
    const bool aware = weights() == IterationWeights::kVarianceAware;
    const std::vector<double> factors = aware ? pictures_.variance_factors() : std::vector<double>();
    const auto& paths = store_.paths();
    std::vector<glm::dvec3> shifts(paths.size(), glm::dvec3(0.0));
    std::vector<std::uint32_t> others(paths.size());
    parallel_for(paths.size(), 64, [&](std::size_t i) {
      const std::span<const double> v =
          aware ? std::span(factors).subspan(pictures_.tile_of(paths[i].pixel) * iterations, iterations)
                : std::span<const double>();
      const StoredPath path = store_.stored(paths[i]);
      others[i] = other_densities(trees_, path.vertices, paths[i].iteration, settings_.mir_defence);
      if (weights() == IterationWeights::kVertices) {
        for_each_vertex_factor(
            trees_, path, paths[i].iteration, counts, settings_.mir_defence,
            [&](const vec3& light, double factor) { shifts[i] += glm::dvec3(light) * (samples * factor - 1); });
        return;
      }
      for_each_ratio(trees_, path, paths[i].iteration, iterations, settings_.mir_defence,
                     [&](const vec3& light, std::span<const double> ratios) {
                       const double factor = aware ? variance_aware_factor(ratios, counts, v, paths[i].iteration)
                                                   : balance_factor(ratios, counts);
                       shifts[i] += glm::dvec3(light) * (samples * factor - 1);
                     });
    });
    others_ = std::accumulate(others.begin(), others.end(), std::uint64_t{0});
    vertices_weighed_ = 0;
    for (const PathStore::Path& path : paths) vertices_weighed_ += path.count;
    return shifts;
  }

  TechniqueTools tools_;
  gpu::Buffer uniform_;
  TechniqueMemory memory_;
  std::optional<SeenGrid> looks_;  // of mir_nee: never taught, so that it knows nothing
  HostArray tree_{shared::kMirTree}, nodes_{shared::kMirNodes}, picture_{shared::kMirPicture};
  RenderSettings settings_;
  GuidingTrees trees_;
  PathStore store_;
  IterationPictures pictures_;
  SingleSamples samples_;  // that are seen, where outliers are removed
  std::uint32_t frames_seen_ = 0;
  std::vector<GuidingSample> taught_;        // of this iteration
  std::vector<double> seen_;                 // samples a pixel that are seen, of each iteration
  std::vector<glm::dvec3> shifted_;          // of pixels: light that weights added
  uvec2 size_{0}, shown_{0};                 // of the picture; of the frame
  std::size_t vertices_ = 1, paths_ = 0;     // that are stored, of a path; of a frame
  bool iterating_ = false, begins_ = false;  // with the next frame
  bool pending_ = false;                     // a frame's paths are on the device
  bool learnt_ = false;                      // from the last iteration, before the next one begins
  std::uint32_t iteration_ = 0;              // the number that this one was begun with
  std::uint32_t planned_ = 0, frames_ = 0;   // samples of this iteration; those collected
  std::uint32_t salt_ = 0;
  std::uint64_t let_go_ = 0, vertices_weighed_ = 0, others_ = 0;  // paths; vertices; those of them of other densities
  double light_ = 0;  // luminance of all paths that were stored, summed over pixels and samples
  double host_ms_ = 0;
};

std::unique_ptr<Technique> make_mir(const TechniqueTools& tools, std::string_view name) {
  return std::make_unique<MirTechnique>(tools, name);
}

}  // namespace

extern constinit const TechniqueInfo kMir{
    .name = "mir",
    .description =
        "offline, in iterations (fullbright-lab iterate): guided by what former iterations taught, and all paths of "
        "all "
        "iterations are weighed by all densities (multiple importance reweighting: Fan 2025); biased but for "
        "r_mir_decorrelated 1; in play it is pt",
    .bias = Bias::kBiased,
    .make = make_mir,
    .frames = Frames::kCorrelated,
    .ends_iterations = true};
extern constinit const TechniqueInfo kMirNee{
    .name = kLooking,
    .description =
        "as mir, and every vertex looks for one light, of the list or a sun, without a memory; biased but "
        "for r_mir_decorrelated 1; in play it is nee without a memory",
    .bias = Bias::kBiased,
    .make = make_mir,
    .frames = Frames::kCorrelated,
    .wants_lights = true,
    .ends_iterations = true};

}  // namespace fb::render
