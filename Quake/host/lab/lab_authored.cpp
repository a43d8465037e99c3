// fullbright-lab authored: maps as they are drawn beside what their authors saw.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <system_error>

#include "base/progress.h"
#include "fs/file.h"
#include "host/lab/lab_numbers.h"
#include "host/lab/lab_stage.h"
#include "lab/authored/authored_measure.h"
#include "lab/authored/authored_report.h"
#include "lab/image_io.h"
#include "lab/jobs.h"
#include "scene/authored/authored_map.h"
#include "scene/authored/authored_picture.h"
#include "scene/library/asset_builder.h"
#include "scene/library/lightmaps.h"
#include "shared/tone.h"
#include "world/entity_lump.h"

namespace fb::host {
namespace {

struct AuthoredOptions {
  StageOptions stage;
  std::uint32_t cameras = 12;
  bool table = false, fog = false;
};

constexpr float kShownField = 90.0f;        // degrees
constexpr std::uint32_t kSamplesAPass = 2;  // guiding learns between them

std::string row_of(const std::string& name, const lab::AuthoredDistance& d) {
  if (d.black) return fmt::format("{:28} black in both pictures", name);
  return fmt::format("{:28} {:+6.2f} {:6.2f} {:6.2f} {:6.2f}", name, d.median, d.spread, d.correlation, d.color);
}

// Own and author's picture side by side, as a display shows them.
Status write_pair(const std::string& path, const lab::Picture& own, const lab::Picture& authors) {
  std::vector<std::uint32_t> pixels;
  for (std::uint32_t y = 0; y < own.height; ++y)
    for (const lab::Picture* picture : {&own, &authors})
      for (std::uint32_t x = 0; x < own.width; ++x) {
        const vec3 c = glm::clamp(picture->pixels[std::size_t{y} * own.width + x], vec3(0.0f), vec3(1.0f));
        std::uint32_t word = 0xff000000u;
        for (int k = 0; k < 3; ++k)
          word |= static_cast<std::uint32_t>(shared::srgb_from_linear(c)[k] * 255.0f + 0.5f) << (8 * k);
        pixels.push_back(word);
      }
  return lab::write_png(path, 2 * own.width, own.height, pixels);
}

void print_table(const scene::AuthoredLight& light) {
  fmt::print("emitter; factor on its power, red green blue; share of the light, %\n");
  for (std::size_t i = 0; i < light.emitters.all.size(); ++i) {
    const vec3& f = light.fit.factors[i];
    fmt::print("{:48} {:9.4f} {:9.4f} {:9.4f} {:6.2f}\n", light.emitters.all[i].name, f.x, f.y, f.z,
               100.0f * light.fit.shares[i]);
  }
}

// The author's picture has the map alone: models go, torches among them, whose lamps stay.
void remove_models(scene::FrameSnapshot& snapshot) {
  std::erase_if(snapshot.instances, [&](const scene::Instance& i) {
    if (i.id == scene::kIdWorld || i.id >= scene::kIdDynamicLight) return false;
    return !snapshot.assets->meshes[i.mesh].name.starts_with('*');
  });
}

scene::AuthoredFog fog_of(const formats::Bsp& bsp) {
  scene::AuthoredFog fog;
  const auto entities = world::parse_entity_lump(bsp.entities, "the map's entities");
  if (!entities || entities->empty()) return fog;
  const auto numbers = world::parse_numbers(entities->front().text(entities->front().has("fog") ? "fog" : "_fog"), 4);
  if (numbers.empty()) return fog;
  const auto held = [](float x, float most) { return x > 0.0f ? std::min(x, most) : 0.0f; };
  fog.density = held(numbers[0], 640.0f);
  const std::string sky = entities->front().has("skyfog") ? "skyfog" : "_skyfog";
  fog.covers = held(entities->front().number(sky, fog.covers), 1.0f);
  fog.color = numbers.size() == 4 ? vec3(held(numbers[1], 1), held(numbers[2], 1), held(numbers[3], 1)) : vec3(0.3f);
  return fog;
}

// Where to look from. Says which of the map's own cameras do not count.
Result<std::vector<lab::MapCamera>> cameras_of(const formats::Bsp& bsp, const AuthoredOptions& options,
                                               const std::optional<scene::Camera>& asked) {
  const StageOptions& o = options.stage;
  if (asked) {
    if (!lab::in_open(bsp, asked->position))
      return Error{fmt::format("--camera {}: it is inside a wall, a door or lava, or outside the map", o.camera)};
    return std::vector<lab::MapCamera>{{"camera", asked->position, asked->angles}};
  }
  lab::MapCameras found = lab::map_cameras(bsp, options.cameras);
  if (!found.nowhere.empty())
    fmt::print("{} of the map's cameras have no origin of three numbers, and do not count: {}\n", found.nowhere.size(),
               fmt::join(found.nowhere, ", "));
  if (!found.closed.empty())
    fmt::print("{} of the map's cameras are inside a wall, a door or lava, or outside the map, and do not count: {}\n",
               found.closed.size(), fmt::join(found.closed, ", "));
  if (!found.open.empty()) return std::move(found.open);
  const bool none = found.closed.empty() && found.nowhere.empty();
  return Error{fmt::format(
      "{}: {}; --camera x,y,z,pitch,yaw,roll looks from where you like", o.map,
      none ? "it names no camera to look from: no start, no intermission, no teleport" : "none of its cameras counts")};
}

// What makes the comparison say less than it seems to; empty: nothing.
std::string doubt_of(const scene::Lightmaps& lightmaps) {
  constexpr double kMostlyBlack = 0.9;
  const double black = lightmaps.black_share();
  if (black < kMostlyBlack) return {};
  return fmt::format("{:.0f}% of the map's baked light is black: was it lit?", std::floor(100.0 * black));
}

struct Views {  // of one map
  const AuthoredOptions& options;
  Stage& stage;
  scene::FrameSnapshot snapshot;
  lab::AuthoredPage page;
  std::vector<lab::AuthoredDistance> distances;

  // Draws and compares one, and prints its row.
  Status compare(const lab::MapCamera& camera) {
    const StageOptions& o = options.stage;
    const scene::ModelLibrary& library = stage.engine->library();
    snapshot.camera.position = camera.position;
    snapshot.camera.angles = camera.angles;
    snapshot.camera.fov_x = kShownField;
    snapshot.camera.fov_y = 0.0f;
    snapshot.prev_camera = snapshot.camera;
    snapshot.cut = true;
    stage.renderer->reset_learning();  // whatever else was looked at
    lab::RenderSummary summary;
    lab::render_samples(*stage.renderer, stage.settings, snapshot, o.spp, summary, nullptr, kSamplesAPass);
    const scene::AuthoredFog fog = options.fog ? fog_of(*library.map()) : scene::AuthoredFog();
    const lab::Picture own = lab::picture_of(stage.renderer->read().linear(), stage.size);
    const lab::Picture authors{stage.size.x, stage.size.y,
                               scene::authored_picture(library.lit_map(), *library.assets(), library.map_sky(),
                                                       *library.lightmaps(), snapshot.camera, stage.size.x,
                                                       stage.size.y, fog, stage.engine->client().light_style_values())};
    distances.push_back(lab::authored_distance(own, authors));
    fmt::print("{}\n", row_of(camera.name, distances.back()));
    page.rows.push_back({camera.name, camera.name + ".png", distances.back()});
    if (o.out.empty()) return ok_status();
    return write_pair(fmt::format("{}/{}.png", o.out, camera.name), own, authors);
  }

  // The row of all, and the page.
  Status sum_up(const scene::AuthoredLight* light) {
    const StageOptions& o = options.stage;
    page.mean = lab::mean_distance(distances);
    // Of medians and spreads the root of the mean square, which has no sign.
    if (!page.mean.black)
      fmt::print("{:28} {:6.2f} {:6.2f} {:6.2f} {:6.2f}\n", "all", page.mean.median, page.mean.spread,
                 page.mean.correlation, page.mean.color);
    if (const auto black = std::ranges::count(distances, true, &lab::AuthoredDistance::black); black > 0) {
      page.notes.push_back(
          fmt::format("{} of {} views are black in both pictures and do not count.", black, distances.size()));
      fmt::print("{}\n", page.notes.back());
    }
    if (o.out.empty()) return ok_status();
    if (light != nullptr)
      for (std::size_t i = 0; i < light->emitters.all.size(); ++i)
        page.emitters.push_back({light->emitters.all[i].name, light->fit.factors[i], light->fit.shares[i]});
    return fs::write_text_atomically(o.out + "/index.html", lab::authored_html(page));
  }
};

int run_authored(const AuthoredOptions& options, bool out_given) {
  StageOptions o = options.stage;
  if (o.map.empty())
    return fail(Error{"authored: it draws maps alone, by --map; demos and scenes have no baked light"});
  if (out_given && o.out.empty()) return fail(Error{"--out: the name of a folder is wanted"});
  if (const auto size = parse_size(o.size); size && (size->x < lab::kBlocksAcross || size->y < lab::kBlocksDown))
    return fail(
        Error{fmt::format("--size {}: pictures are compared in {} x {} blocks; they need as many pixels at least",
                          o.size, lab::kBlocksAcross, lab::kBlocksDown)});
  // Even light is a part of what authors saw. Figures repeat, and a view's are its own.
  o.sets.insert(o.sets.begin(), {"r_ambient=-1", "r_deterministic=1"});
  if (!options.fog) o.sets.insert(o.sets.begin(), "r_fog=0");
  Stage stage;
  if (auto status = open_stage(stage, o); !status) return fail(status.error());
  const scene::ModelLibrary& library = stage.engine->library();
  const auto lightmaps = library.lightmaps();
  if (lightmaps == nullptr || lightmaps->empty()) return fail(Error{o.map + ": it has no baked light"});
  const auto cameras = cameras_of(*library.map(), options, stage.camera);
  if (!cameras) return fail(cameras.error());
  if (!o.out.empty()) {
    std::error_code failed;
    std::filesystem::create_directories(o.out, failed);
    if (failed) return fail(Error{fmt::format("--out {}: {}", o.out, failed.message())});
  }
  stage.renderer->resize(stage.size.x, stage.size.y);
  Views views{options, stage, {}, {o.map + ": drawn, and as its author saw it", {}, {}, {}, {}}, {}};
  if (const auto more = stage.source->next(views.snapshot); !more) return fail(more.error());
  remove_models(views.snapshot);
  // With r_authored 0 nobody asks for the fit, which would be made then.
  const scene::AuthoredLight* light = nullptr;
  if (stage.engine->console().cvar("r_authored").on()) {
    light = stage.engine->client().authored().light();
  } else {
    views.page.notes.emplace_back(
        "r_authored 0: light is as the map's keys and textures say; nothing is fitted to its baked light.");
    fmt::print("{}\n", views.page.notes.back());
  }
  if (const std::string doubt = doubt_of(*lightmaps); !doubt.empty()) {
    views.page.notes.push_back(doubt);
    fmt::print("{}\n", doubt);
  }
  if (options.table && light != nullptr) print_table(*light);
  fmt::print("{:28} {:>6} {:>6} {:>6} {:>6}\n", "camera", "median", "spread", "corr.", "color");
  for (const lab::MapCamera& camera : *cameras)
    if (auto status = views.compare(camera); !status) return fail(status.error());
  if (auto status = views.sum_up(light); !status) return fail(status.error());
  if (views.page.mean.black) return fail(Error{o.map + ": all its views are black: nothing is compared"});
  return finish(stage);
}

}  // namespace

LabCommand add_authored_command(CLI::App& app) {
  auto options = std::make_shared<AuthoredOptions>();
  options->stage.size = "160x90";
  options->stage.estimator = "mcpg_nee";
  options->stage.spp = 64;
  CLI::App* authored = app.add_subcommand(
      "authored", "draws a map from its starts, intermissions and teleports, beside its textures in its baked light");
  add_stage_options(*authored, options->stage);
  add_number(*authored, "--cameras", options->cameras, 1u, 1000u,
             "at most so many, evenly chosen in the order of the map's entities");
  authored->add_flag("--fog", options->fog, "with the map's fog, here and there");
  authored->add_flag("--table", options->table, "print how strong each emitter is by the baked light");
  const CLI::Option* out = authored->add_option(
      "--out", options->stage.out, "folder for a page, index.html, and its pictures: drawn and authored side by side");
  return {authored, [options, out] { return run_authored(*options, out->count() > 0); }};
}

}  // namespace fb::host
