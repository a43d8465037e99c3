// fullbright-lab film: estimators, settings and other engines' pictures beside each other, as a film.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <filesystem>
#include <numeric>
#include <optional>
#include <system_error>

#include "base/progress.h"
#include "host/film_caption.h"
#include "host/game/game_sound.h"
#include "host/lab/lab_stage.h"
#include "lab/bench/bench_view.h"
#include "lab/compare/metrics.h"
#include "lab/film/film_writer.h"
#include "lab/film/guided_frames.h"
#include "lab/reference/replicates.h"

namespace fb::host {
namespace {

constexpr int kTimedFrames = 5;          // of each lane, to find its samples
constexpr std::size_t kShownTimes = 15;  // frames whose median a caption shows: it can be read
constexpr int kMostFilmSamples = 4096;

struct FilmOptions {
  StageOptions stage;
  std::string spec, out;
  bool guided = false;
};

// A lane at work.
struct FilmLaneAtWork {
  render::RenderSettings settings;
  std::unique_ptr<render::Renderer> renderer;  // none: its pictures come from files
  std::optional<lab::GuidedFrames> guided;     // of an estimator of iterations
  std::vector<std::filesystem::path> files;
  std::deque<double> times;             // of the latest frames, milliseconds on the device
  double estimator_ms = 0, all_ms = 0;  // sums over the film
  std::optional<double> error;
  std::vector<std::uint32_t> picture;
};

struct Film {
  lab::FilmSpec spec;
  Stage stage;
  std::vector<FilmLaneAtWork> lanes;
};

double estimator_ms(const render::Renderer& renderer) {
  double sum = 0;
  for (const render::PassTime& pass : renderer.pass_times())
    if (pass.kind == render::PassKind::kEstimator) sum += pass.milliseconds;
  return sum;
}

double median_of(const std::deque<double>& times) { return lab::median({times.begin(), times.end()}); }

Status open_renderer(Film& film, FilmLaneAtWork& lane) {
  auto renderer = render::Renderer::create(*film.stage.device, lane.settings);
  if (!renderer) return renderer.error();
  lane.renderer = std::move(*renderer);
  lane.renderer->resize(film.spec.size.x, film.spec.size.y);
  return ok_status();
}

Status open_pictures(const lab::FilmSpec& spec, const lab::FilmLane& lane, FilmLaneAtWork& work) {
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator(lane.pictures, failed))
    if (entry.path().extension() == ".png") work.files.push_back(entry.path());
  if (failed) return Error{fmt::format("{}: {}", lane.pictures, failed.message())};
  std::sort(work.files.begin(), work.files.end());
  if (work.files.size() >= spec.frames()) return ok_status();
  return Error{
      fmt::format("{}: {} PNG files, the film has {} frames", lane.pictures, work.files.size(), spec.frames())};
}

Status load_picture(const lab::FilmSpec& spec, FilmLaneAtWork& lane, std::uint32_t frame) {
  const std::string path = lane.files[frame].string();
  const auto picture = lab::read_png_picture(path);
  if (!picture) return picture.error();
  if (picture->width != spec.size.x || picture->height != spec.size.y)
    return Error{fmt::format("{}: {}x{} pixels, the film's pictures have {}x{}", path, picture->width, picture->height,
                             spec.size.x, spec.size.y)};
  lane.picture.clear();
  for (const vec3& p : picture->pixels) {
    std::uint32_t value = 0;
    for (int c = 0; c < 3; ++c) value |= static_cast<std::uint32_t>(std::lround(255 * p[c])) << (8 * c);
    lane.picture.push_back(value);
  }
  return ok_status();
}

// Median time of the lane's estimator on this frame with `spp` samples.
double timed(FilmLaneAtWork& lane, scene::FrameSnapshot snapshot, int spp) {
  lane.settings.spp = spp;
  std::vector<double> times;
  for (int i = 0; i <= kTimedFrames; ++i, ++snapshot.frame) {
    lane.renderer->render(snapshot, nullptr, lane.settings);
    if (i > 0) times.push_back(estimator_ms(*lane.renderer));  // the first compiles
  }
  return lab::median(times);
}

// Samples of the other lanes with which their estimators take as long as the first lane's, on one frame.
Status match_times(Film& film, const scene::FrameSnapshot& snapshot, bool quiet) {
  FilmLaneAtWork& first = film.lanes.front();
  const int spp = first.settings.spp;
  for (std::size_t i = 1; i < film.lanes.size(); ++i) {
    FilmLaneAtWork& lane = film.lanes[i];
    if (!lane.renderer) continue;
    double goal = timed(first, snapshot, spp), own = timed(lane, snapshot, 1);
    if (!(goal > 0 && own > 0)) return Error{"\"equal\": \"time\": the device does not tell times"};
    int samples = 1;
    for (int step = 0; step < 2; ++step) {
      const double scaled = std::round(samples * goal / own);
      samples = static_cast<int>(std::clamp(scaled, 1.0, double{kMostFilmSamples}));
      own = timed(lane, snapshot, samples);
      goal = timed(first, snapshot, spp);
    }
    if (!quiet)
      fmt::print("{}: {} samples a pixel, {:.2f} ms; {}: {} samples, {:.2f} ms: {:.2f} times as long\n",
                 film.spec.lanes[i].name, samples, own, film.spec.lanes[0].name, spp, goal, own / goal);
    if (samples == 1 && own > 1.25 * goal)
      fmt::print("{} cannot be as fast: one sample a pixel is the least\n", film.spec.lanes[i].name);
  }
  first.settings.spp = spp;
  for (FilmLaneAtWork& lane : film.lanes)
    if (lane.renderer)
      if (auto status = open_renderer(film, lane); !status) return status;  // nothing is learnt yet
  return ok_status();
}

Result<lab::Reference> reference_of(Film& film, const scene::FrameSnapshot& snapshot) {
  render::RenderSettings settings = film.stage.settings;
  settings.estimator = film.spec.reference_estimator;
  settings.denoise = 0;
  settings.seed += 1000003;  // not that of the lanes
  return lab::render_replicates(*film.stage.renderer, settings, snapshot, film.spec.reference_samples, nullptr);
}

// `exposure`: at which the frame is shown; none: as the lane's settings say.
Status render_lane(FilmLaneAtWork& lane, const scene::FrameSnapshot& snapshot, std::optional<float> exposure,
                   const lab::Reference* reference) {
  render::RenderSettings settings = lane.settings;
  if (exposure) {
    settings.auto_exposure = 0;
    settings.exposure = *exposure;
  }
  if (lane.guided)
    lane.guided->render(*lane.renderer, settings, snapshot);
  else
    lane.renderer->render(snapshot, nullptr, settings);
  lane.times.push_back(lane.guided ? lane.guided->gpu_ms() : lane.renderer->gpu_milliseconds());
  if (lane.times.size() > kShownTimes) lane.times.pop_front();
  lane.estimator_ms += lane.guided ? lane.guided->estimator_ms() : estimator_ms(*lane.renderer);
  lane.all_ms += lane.times.back();
  lane.picture = lane.renderer->read().output();
  if (reference == nullptr) return ok_status();
  const lab::Picture linear = lab::picture_of(lane.renderer->read().denoised(), lane.renderer->render_size());
  if (!linear.same_size(reference->mean)) return Error{"\"reference_samples\": errors want r_scale 1"};
  lane.error = lab::measure(*reference, linear).rel_mse_corrected();
  return ok_status();
}

std::vector<std::string> caption_of(const lab::FilmLane& lane, const FilmLaneAtWork& work) {
  std::vector<std::string> lines{lane.name};
  if (!work.renderer) return lines;
  lines.push_back(fmt::format("{:.1f} ms, {} spp", median_of(work.times),
                              work.guided ? work.guided->samples() : static_cast<unsigned>(work.settings.spp)));
  if (work.error) lines.push_back(fmt::format("relMSE {:.3g}", *work.error));
  return lines;
}

Status open_lanes(Film& film, const FilmOptions& o) {
  StageOptions options = o.stage;
  options.scene = film.spec.scene;
  options.map = film.spec.map;
  options.demo = film.spec.demo;
  options.camera = film.spec.camera;
  options.fps = film.spec.fps;
  options.size = fmt::format("{}x{}", film.spec.size.x, film.spec.size.y);
  options.sets.insert(options.sets.begin(), film.spec.sets.begin(), film.spec.sets.end());
  if (film.spec.renders()) {
    if (auto status = unbiased_estimator(film.spec.reference_estimator, "\"reference_estimator\":"); !status)
      return status;
    if (auto status = open_stage(film.stage, options); !status) return status;
    film.stage.renderer->resize(film.spec.size.x, film.spec.size.y);
  }
  for (const lab::FilmLane& lane : film.spec.lanes) {
    FilmLaneAtWork& work = film.lanes.emplace_back();
    if (!lane.pictures.empty()) {
      if (auto status = open_pictures(film.spec, lane, work); !status) return status;
      continue;
    }
    std::vector<std::string> sets = lane.sets;
    if (o.guided) sets.insert(sets.begin(), "r_estimator=mir_nee");
    const auto configuration = configuration_of(film.stage.console(), {lane.name, sets}, lane.name);
    if (!configuration) return configuration.error();
    work.settings = render::as_in_game(configuration->settings, film.stage.device->is_software());
    work.settings.accumulate = 0;
    const render::TechniqueInfo* technique = render::find_technique(work.settings.estimator);
    if (technique != nullptr && technique->ends_iterations) {
      if (film.spec.equal_time)
        return Error{fmt::format("{}: \"equal\": \"time\": frames of {} are of one picture, whose time grows",
                                 lane.name, work.settings.estimator)};
      work.guided.emplace();
    }
    if (auto status = open_renderer(film, work); !status) return status;
  }
  return ok_status();
}

// Removes the sound's file when it has been used.
struct SoundFile {
  std::string path;
  ~SoundFile() {
    std::error_code ignored;
    if (!path.empty()) std::filesystem::remove(path, ignored);
  }
};

// The lanes with the one that sets the exposure of all before the others: the first that looks for lights, since rare
// samples of great weight rule the exposure that the others find.
std::vector<FilmLaneAtWork*> in_order(Film& film) {
  std::vector<FilmLaneAtWork*> lanes;
  for (FilmLaneAtWork& lane : film.lanes) lanes.push_back(&lane);
  const auto meters = std::ranges::find_if(lanes, [](const FilmLaneAtWork* lane) {
    const render::TechniqueInfo* technique = render::find_technique(lane->settings.estimator);
    return lane->renderer && technique != nullptr && technique->wants_lights;
  });
  if (meters != lanes.end()) std::rotate(lanes.begin(), meters, meters + 1);
  return lanes;
}

Status make_frames(Film& film, lab::FilmWriter& writer, GameSound* sound, bool quiet) {
  const lab::FilmSpec& spec = film.spec;
  ui::Atlas atlas;
  scene::FrameSnapshot snapshot;
  Progress progress("frame", spec.frames(), {.quiet = quiet});
  bool matched = !spec.equal_time;
  const std::vector<FilmLaneAtWork*> lanes = in_order(film);
  for (std::uint64_t frame = spec.renders() ? 0 : spec.first; frame <= spec.last; ++frame) {
    if (spec.renders()) {
      const auto more = film.stage.source->next(snapshot);
      if (!more) return more.error();
      if (!*more) return Error{fmt::format("there is no frame {}: the demo has {} frames at this rate", frame, frame)};
      if (sound != nullptr) {
        sound->update(true);
        if (auto status = sound->record(); !status) return status;
      }
      if (frame + spec.warmup < spec.first) continue;
    }
    if (!std::exchange(matched, true))
      if (auto status = match_times(film, snapshot, quiet); !status) return status;
    const bool shown = frame >= spec.first;
    const auto number = static_cast<std::uint32_t>(frame - spec.first);
    std::optional<lab::Reference> reference;
    if (shown && spec.reference_samples > 0 && spec.renders()) {
      auto made = reference_of(film, snapshot);
      if (!made) return made.error();
      reference = std::move(*made);
    }
    std::optional<float> exposure;
    for (FilmLaneAtWork* each : lanes) {
      FilmLaneAtWork& lane = *each;
      if (!shown && !lane.renderer) continue;
      const Status status = lane.renderer ? render_lane(lane, snapshot, exposure, reference ? &*reference : nullptr)
                                          : load_picture(spec, lane, number);
      if (!status) return status;
      if (lane.renderer && !exposure && !spec.own_exposure) exposure = lane.renderer->read().exposure();
    }
    if (!shown) continue;
    std::vector<std::vector<std::uint32_t>> pictures;
    for (const FilmLaneAtWork& lane : film.lanes) pictures.push_back(lane.picture);
    lab::FilmFrame picture = lab::compose(spec, pictures, number);
    for (std::size_t i = 0; i < film.lanes.size(); ++i)
      draw_caption(picture, atlas, lab::lane_columns(spec, i, number), caption_of(spec.lanes[i], film.lanes[i]));
    if (auto status = writer.add(picture); !status) return status;
    progress.update(number + 1);
  }
  return ok_status();
}

void say_times(const Film& film) {
  const double frames = film.spec.frames() + film.spec.warmup;
  for (std::size_t i = 0; i < film.lanes.size(); ++i)
    if (film.lanes[i].renderer)
      fmt::print("{}: {} samples a pixel, {:.2f} ms a frame on the device, of these {:.2f} the estimator's\n",
                 film.spec.lanes[i].name, film.lanes[i].settings.spp, film.lanes[i].all_ms / frames,
                 film.lanes[i].estimator_ms / frames);
}

int run_film(const FilmOptions& o) {
  auto spec = lab::read_film(o.spec);
  if (!spec) return fail(spec.error());
  Film film{std::move(*spec), {}, {}};
  lab::FilmOutput output{o.out, {}, film.spec.fps, film.spec.exr};
  if (!lab::is_film_file(o.out) && std::filesystem::path(o.out).has_extension())
    return fail(Error{fmt::format("--out {}: an .mp4 or .mkv file is wanted, or a folder", o.out)});
  if (lab::is_film_file(o.out) && !lab::has_ffmpeg()) {
    output.path = std::filesystem::path(o.out).replace_extension().string();
    fmt::print("ffmpeg is not here (Debian has it under that name): the frames become PNG files in {}\n", output.path);
  }
  if (auto status = open_lanes(film, o); !status) return fail(status.error());
  // Declared before what uses it, and so removed after.
  SoundFile sound_file;
  std::optional<GameSound> sound;
  if (film.spec.sound && film.stage.engine && !film.spec.demo.empty()) {
    output.sound = output.path + ".sound.part";
    GameOptions recording;
    recording.wav_capture = output.sound;
    sound.emplace(*film.stage.engine);
    if (auto status = sound->open(recording); !status) return fail(status.error());
    sound_file.path = output.sound;  // before it was open, it was perhaps another program's
  }
  auto writer = lab::open_film(output, lab::film_size(film.spec));
  if (!writer) return fail(writer.error());
  if (auto status = make_frames(film, **writer, sound ? &*sound : nullptr, o.stage.quiet); !status)
    return fail(status.error());
  if (sound)
    if (auto status = sound->finish(); !status) return fail(status.error());
  const auto written = (*writer)->finish();
  if (!written) return fail(written.error());
  if (!o.stage.quiet) {
    say_times(film);
    fmt::print("{}\n", *written);
  }
  return film.stage.device ? finish(film.stage) : 0;
}

}  // namespace

LabCommand add_film_command(CLI::App& app) {
  auto options = std::make_shared<FilmOptions>();
  StageOptions& stage = options->stage;
  CLI::App* film =
      app.add_subcommand("film",
                         "makes a film of estimators, settings and captured pictures beside each other, at "
                         "equal samples or equal time");
  film->add_option("SPEC", options->spec, "what it shows: a JSON file (Misc/docs/formats.md)")->required();
  film->add_option("--out", options->out, "an .mp4 or .mkv file, made by ffmpeg, or a new folder for pictures")
      ->required();
  film->add_option("--basedir", stage.basedir, "folder that holds id1 (default: the current folder, or the base game)");
  film->add_option("--game", stage.games, "a mod's folder beside id1; may be repeated");
  film->add_option("--set", stage.sets, "cvar=value, a setting of all lanes; may be repeated")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
  film->add_option("--device", stage.device,
                   "Vulkan device: part of its name, or its index in `fullbright -listdevices`");
  film->add_flag("--validation", stage.validation, "enable Vulkan's validation layers");
  film->add_flag(
      "--guided", options->guided,
      "lanes whose own set names no estimator are of mir_nee: while nothing moves, frames are iterations of one "
      "picture (multiple importance reweighting); biased, and without the denoiser");
  film->add_flag("--quiet", stage.quiet, "print no progress");
  return {film, [options] { return run_film(*options); }};
}

}  // namespace fb::host
