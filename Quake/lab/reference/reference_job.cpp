#include "lab/reference/reference_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <limits>
#include <set>
#include <system_error>
#include <utility>

#include "base/hash.h"
#include "base/progress.h"
#include "fs/file.h"
#include "lab/content_key.h"
#include "lab/image_io.h"
#include "lab/json.h"
#include "lab/json_reader.h"
#include "lab/reference/replicates.h"
#include "render/passes/frame_keys.h"
#include "render/techniques/radiance_hash.h"
#include "shared/packing.h"
#include "shared/rng.h"

namespace fb::lab {
namespace {

constexpr const char* kReferenceFormat = "fullbright reference 2";
constexpr std::uint32_t kBlockSeed = 0x5eed0000u, kWarmupSeed = 0x5eed8000u;

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// What a reference's blocks are of, for people and for whoever joins them.
struct ReferenceManifest {
  std::string key, view, program, estimator;
  std::uint32_t width = 0, height = 0, spp = 0, samples = 0;
  bool jitter = false;
};

std::string manifest_path(const std::string& folder) { return folder + "/manifest.json"; }

Status write_reference_manifest(const std::string& folder, const ReferenceManifest& m, const ReferenceError* error) {
  Json json{{"format", kReferenceFormat}, {"key", m.key},        {"view", m.view},     {"program", m.program},
            {"estimator", m.estimator},   {"width", m.width},    {"height", m.height}, {"jitter", m.jitter},
            {"wanted_samples", m.spp},    {"samples", m.samples}};
  if (error != nullptr) {
    json["mean_luminance"] = error->mean_luminance;
    json["relative_error"] = error->relative;
  }
  return fs::write_text_atomically(manifest_path(folder), json_text(json));
}

Result<ReferenceManifest> read_reference_manifest(const std::string& folder) {
  const auto file = JsonFile::read(manifest_path(folder));
  if (!file) return file.error();
  JsonReader reader(*file, file->json());
  if (reader.text("format") != kReferenceFormat)
    return Error{fmt::format("{}: these are no blocks of a reference", manifest_path(folder))};
  constexpr std::uint32_t kMost = std::numeric_limits<std::int32_t>::max();
  ReferenceManifest m;
  m.key = reader.text("key");
  m.view = reader.text("view");
  m.program = reader.text("program");
  m.estimator = reader.text("estimator");
  m.jitter = reader.boolean("jitter");
  m.width = static_cast<std::uint32_t>(reader.whole("width", 1, kMost, 1));
  m.height = static_cast<std::uint32_t>(reader.whole("height", 1, kMost, 1));
  m.spp = static_cast<std::uint32_t>(reader.whole("wanted_samples", 1, kMost, 1));
  m.samples = static_cast<std::uint32_t>(reader.whole("samples", 0, kMost, 0));
  reader.number("mean_luminance", 0, std::numeric_limits<double>::max(), 0);
  reader.number("relative_error", 0, std::numeric_limits<double>::max(), 0);
  if (auto status = reader.end(); !status) return status.error();
  return m;
}

std::string guides_path(const std::string& folder) { return folder + "/guides.exr"; }

// Albedo, shading normal and depth at the pixels' middles.
ExrImage render_guides(render::Renderer& renderer, const ReferenceSubject& subject) {
  render::RenderSettings settings = subject.settings;
  settings.jitter = settings.accumulate = 0;
  settings.spp = 1;
  renderer.resize(subject.width, subject.height);
  renderer.render(subject.snapshot, nullptr, settings);
  const auto gbuffer = renderer.read().gbuffer();
  std::vector<vec3> albedo(gbuffer.size());
  std::vector<float> normals[3], depth(gbuffer.size());
  for (auto& plane : normals) plane.resize(gbuffer.size());
  for (std::size_t i = 0; i < gbuffer.size(); ++i) {
    albedo[i] = vec3(gbuffer[i].albedo_roughness);
    const vec3 normal = shared::unpack_direction(gbuffer[i].shading_normal);
    for (int c = 0; c < 3; ++c) normals[c][i] = normal[c];
    depth[i] = gbuffer[i].motion.z;
  }
  ExrImage exr(subject.width, subject.height);
  exr.add_colors("albedo.", albedo);
  for (int c = 0; c < 3; ++c) exr.add_channel(std::string("normal.") + "XYZ"[c], std::move(normals[c]));
  exr.add_channel("Z", std::move(depth));
  return exr;
}

Status write_picture(const std::string& path, const Reference& reference, ExrImage picture, const ReferenceManifest& m,
                     const ReferenceError& error) {
  picture.add_colors("", reference.mean.pixels);
  if (!reference.variance.empty()) picture.add_colors("variance.", reference.variance);
  // What a comparison must do alike: where in a pixel its rays go.
  picture.set_text("fullbright.jitter", m.jitter ? "1" : "0");
  picture.set_text("fullbright.spp", fmt::format("{}", m.samples));
  picture.set_text("fullbright.estimator", m.estimator);
  picture.set_text("fullbright.view", m.view);
  picture.set_text("fullbright.program", m.program);
  picture.set_text("fullbright.key", m.key);
  picture.set_text("fullbright.relative_error", fmt::format("{:.6g}", error.relative));
  return write_exr(path, picture);
}

// The folder of blocks within a shard's: it has one.
Result<std::string> only_folder_in(const std::string& folder) {
  std::vector<std::string> found;
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failed))
    if (std::filesystem::exists(manifest_path(entry.path().string()))) found.push_back(entry.path().string());
  if (failed) return Error{fmt::format("{}: {}", folder, failed.message())};
  if (found.size() == 1) return found.front();
  return Error{fmt::format("{}: blocks of one reference are wanted, it has {}", folder,
                           found.empty() ? "none" : fmt::format("those of {}", found.size()))};
}

}  // namespace

std::uint64_t ReferenceSubject::key() const {
  const std::uint32_t how[] = {width, height, warmup, kSamplingVersion};
  const std::string_view format = kReferenceFormat;
  std::uint64_t key = hash_bytes(format.data(), format.size(), content_key(snapshot));
  key = hash_span(std::span<const std::uint32_t>(how), key);
  key ^= render::radiance_hash(settings.estimator);
  return render::settings_key(settings, key);
}

Result<ReferenceBlock> make_block(render::Renderer& renderer, const ReferenceSubject& subject, const BlockPlan& plan,
                                  const BlockFolder& folder, const std::function<void(std::uint32_t)>& progress) {
  if (auto kept = folder.read(plan)) return std::move(*kept);
  render::RenderSettings settings = subject.settings;
  const auto seed = static_cast<std::uint32_t>(settings.seed);
  renderer.resize(subject.width, subject.height);
  renderer.reset_learning();
  // What it has learnt from must not be drawn again: that would bias the mean.
  settings.seed = static_cast<int>(shared::hash_combine(seed, kWarmupSeed + plan.index));
  if (subject.warmup > 0) render_replicates(renderer, settings, subject.snapshot, subject.warmup, nullptr);
  settings.seed = static_cast<int>(shared::hash_combine(seed, kBlockSeed + plan.index));
  ReferenceBlock block{plan, render_replicates(renderer, settings, subject.snapshot, plan.samples, progress)};
  if (auto status = folder.keep(block); !status) return status.error();
  return block;
}

Result<ReferenceSummary> render_reference(FrameSource& source, render::Renderer& renderer,
                                          render::RenderSettings settings, const ReferenceJob& job) {
  if (job.spp < 2) return Error{"a reference wants two samples or more, whose scatter is its error"};
  ReferenceSubject subject{{}, std::move(settings), job.width, job.height, job.warmup};
  for (std::uint64_t frame = 0; frame <= job.frame; ++frame) {
    const auto more = source.next(subject.snapshot);
    if (!more) return more.error();
    if (!*more) return Error{fmt::format("there is no frame {}: the demo has {} frames at this rate", frame, frame)};
  }
  const auto folder = BlockFolder::open(job.blocks, subject.key(), {job.width, job.height});
  if (!folder) return folder.error();
  ReferenceManifest manifest{fmt::format("{:016x}", subject.key()),
                             job.view,
                             job.program,
                             subject.settings.estimator,
                             job.width,
                             job.height,
                             job.spp,
                             0,
                             subject.settings.jitter != 0};
  if (!folder->path().empty())
    if (auto status = write_reference_manifest(folder->path(), manifest, nullptr); !status) return status.error();

  const ExrImage guides = render_guides(renderer, subject);
  if (!folder->path().empty())
    if (auto status = write_exr(guides_path(folder->path()), guides); !status) return status.error();
  ReferenceSum sum;
  ReferenceSummary summary{0, 0, {}, folder->path()};
  const double begin = seconds_now();
  double per_sample = 0;
  Progress progress(job.seconds > 0 ? "second" : "sample",
                    job.seconds > 0 ? static_cast<std::uint64_t>(job.seconds) : job.spp, {.quiet = job.quiet});
  for (const BlockPlan& plan : plan_blocks(job.spp)) {
    if (job.shards > 1 && plan.index % job.shards != job.shard - 1) continue;
    const double started = seconds_now();
    if (job.seconds > 0 && sum.samples() > 0 && started - begin + per_sample * plan.samples > job.seconds) break;
    auto block = folder->read(plan);
    if (!block) {
      auto made = make_block(renderer, subject, plan, *folder, [&](std::uint32_t done) {
        progress.update(job.seconds > 0 ? static_cast<std::uint64_t>(seconds_now() - begin)
                                        : std::uint64_t{plan.first} + done);
      });
      if (!made) return made.error();
      block = std::move(*made);
      summary.made += plan.samples;
      per_sample = (seconds_now() - started) / plan.samples;
    }
    sum.add(*block);
    if (job.relative_error <= 0) continue;
    summary.error = error_of(sum.reference());
    if (summary.error.relative <= job.relative_error) break;
    const double factor = summary.error.relative / job.relative_error;
    progress.expect(static_cast<std::uint64_t>(std::min<double>(job.spp, sum.samples() * factor * factor)));
  }
  summary.samples = manifest.samples = sum.samples();
  if (sum.samples() > 0) summary.error = error_of(sum.reference());
  if (job.shards > 1) return summary;
  if (!folder->path().empty())
    if (auto status = write_reference_manifest(folder->path(), manifest, &summary.error); !status)
      return status.error();
  if (auto status = write_picture(job.out, sum.reference(), guides, manifest, summary.error); !status)
    return status.error();
  return summary;
}

Result<ReferenceSummary> merge_references(const std::vector<std::string>& folders, const std::string& out) {
  std::vector<std::string> paths;
  std::optional<ReferenceManifest> manifest;
  for (const std::string& folder : folders) {
    auto path = only_folder_in(folder);
    if (!path) return path.error();
    auto other = read_reference_manifest(*path);
    if (!other) return other.error();
    if (!manifest) manifest = *other;
    if (other->key != manifest->key)
      return Error{fmt::format("{}: its blocks are of {}, those of {} of {}", folder, other->view, folders.front(),
                               manifest->view == other->view ? "the same with other settings" : manifest->view)};
    if (other->spp != manifest->spp)
      return Error{fmt::format("{}: it is a part of {} samples, {} one of {}", folder, other->spp, folders.front(),
                               manifest->spp)};
    paths.push_back(std::move(*path));
  }
  if (!manifest) return Error{"no folders to join"};
  ReferenceSum sum;
  for (const BlockPlan& plan : plan_blocks(manifest->spp)) {
    std::optional<ReferenceBlock> block;
    std::string from;
    for (const std::string& path : paths) {
      auto found = BlockFolder::existing(path, {manifest->width, manifest->height}).read(plan);
      if (!found) continue;
      if (block) return Error{fmt::format("block {} is there twice: in {} and in {}", plan.index, from, path)};
      block = std::move(found);
      from = path;
    }
    if (!block)
      return Error{fmt::format("block {} (samples {} to {}) is missing: its shard is not done", plan.index, plan.first,
                               plan.first + plan.samples)};
    sum.add(*block);
  }
  auto guides = read_exr(guides_path(paths.front()));
  if (!guides) return guides.error();
  manifest->samples = sum.samples();
  const Reference reference = sum.reference();
  ReferenceSummary summary{sum.samples(), 0, error_of(reference), paths.front()};
  if (auto status = write_picture(out, reference, std::move(*guides), *manifest, summary.error); !status)
    return status.error();
  return summary;
}

}  // namespace fb::lab
