#include "lab/iterate/still_job.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <span>
#include <system_error>
#include <utility>

#include "base/hash.h"
#include "base/log.h"
#include "fs/temporary_file.h"
#include "lab/content_key.h"
#include "lab/reference/replicates.h"
#include "render/passes/frame_keys.h"
#include "render/techniques/iteration_state.h"
#include "render/techniques/radiance_hash.h"

namespace fb::lab {
namespace {

constexpr std::uint64_t kStateMagic = 0x31304c4c49545346;  // "FSTILL01"
constexpr double kStillMegabyte = 1e6;

// Before the state's bytes.
struct StateHeader {
  std::uint64_t magic = kStateMagic, key = 0;
  std::uint32_t iterations = 0, samples = 0;
  std::uint64_t bytes = 0, hash = 0;  // of what follows
};

double still_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::uint64_t still_key(const StillJob& job, const Schedule& schedule, const scene::FrameSnapshot& snapshot) {
  const std::uint32_t how[] = {job.size.x, job.size.y, kSamplingVersion};
  std::uint64_t key = hash_span(std::span<const std::uint32_t>(how), content_key(snapshot));
  key = hash_span(std::span<const std::uint32_t>(schedule), key);
  key ^= render::radiance_hash(job.settings.estimator);
  return render::settings_key(job.settings, key);
}

Status write_state(const std::string& path, StateHeader header, const Bytes& state) {
  header.bytes = state.size();
  header.hash = hash_span(std::span<const std::uint8_t>(state));
  Bytes first;
  render::put_value(first, header);
  auto file = fs::TemporaryFile::create(path);
  if (!file) return file.error();
  if (auto status = file->append(first); !status) return status;
  if (auto status = file->append(state); !status) return status;
  return file->commit(fs::Flush::kNow);
}

struct KeptState {
  FileData file;
  StateHeader header;
  ByteView bytes() const { return ByteView(file.data(), file.size()); }
  ByteView state() const { return bytes().subspan(sizeof(StateHeader)); }
};
// Nothing where there is no file.
Result<std::optional<KeptState>> read_state(const std::string& path, std::uint64_t key, const Schedule& schedule) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return std::optional<KeptState>();
  auto file = fs::read_whole_file(path);
  if (!file) return file.error();
  KeptState kept{std::move(*file), {}};
  const Error damaged{fmt::format("{}: it is damaged; without it the picture begins anew", path)};
  ByteReader reader(kept.bytes(), path);
  if (!render::take_value(reader, kept.header) || kept.header.magic != kStateMagic)
    return Error{fmt::format("{}: this is no state of a picture", path)};
  if (kept.header.bytes != reader.remaining() || kept.header.hash != hash_span(kept.state())) return damaged;
  if (kept.header.key != key)
    return Error{fmt::format("{}: it is of another picture (view, settings, size, samples or shaders)", path)};
  std::uint32_t samples = 0;
  for (std::size_t i = 0; i < kept.header.iterations && i < schedule.size(); ++i) samples += schedule[i];
  if (kept.header.iterations == 0 || kept.header.iterations >= schedule.size() || kept.header.samples != samples)
    return damaged;
  return std::optional(std::move(kept));
}

}  // namespace

Schedule schedule_of(const StillJob& job) { return job.guided ? schedule_of(job.samples) : Schedule{job.samples}; }

std::string still_text(const StillJob& job) {
  const std::string samples = fmt::format("{} sample{} a pixel", job.samples, job.samples == 1 ? "" : "s");
  if (!job.guided)
    return fmt::format("plain: {} by {}, {}", samples, job.settings.estimator,
                       render::find_technique(job.settings.estimator)->unbiased() ? "unbiased" : "biased");
  const bool halves = job.settings.mir_decorrelated != 0;
  return fmt::format("guided: {} by mir in iterations of {}, {}", samples, schedule_text(schedule_of(job)),
                     halves && job.settings.mir_weights == 0 ? "half of them seen; unbiased while all paths are stored"
                     : halves                                ? "half of them seen"
                                                             : "biased: less with more samples");
}

std::string memory_text(const render::IterationMemory& m) {
  const auto mb = [](std::uint64_t bytes) { return static_cast<double>(bytes) / kStillMegabyte; };
  return fmt::format(
      "memory at most: {:.1f} MB of the device, {:.1f} MB of the host (stored paths {:.1f}, distributions {:.1f}, what "
      "teaches {:.1f}, pictures {:.1f})",
      mb(m.device), mb(m.host()), mb(m.stored), mb(m.snapshots), mb(m.taught), mb(m.pictures));
}

Status memory_suffices(const StillJob& job, const render::IterationMemory& memory, const MemoryLimits& limits) {
  const std::uint64_t host = memory.host() + (limits.shared ? memory.device : 0);
  const bool lacks_host = host > limits.host;
  if (!lacks_host && (limits.shared || memory.device <= limits.device)) return ok_status();
  return Error{fmt::format(
      "--guided: up to {:.0f} MB of the {}'s memory are needed and it has {:.0f}: a smaller --size, fewer r_bounces "
      "({}) or a smaller r_mir_storage ({} MB) takes less",
      static_cast<double>(lacks_host ? host : memory.device) / kStillMegabyte, lacks_host ? "machine" : "device",
      static_cast<double>(lacks_host ? limits.host : limits.device) / kStillMegabyte, job.settings.bounces,
      job.settings.mir_storage)};
}

Result<IteratedPicture> render_still(render::Renderer& renderer, const StillJob& job,
                                     const scene::FrameSnapshot& snapshot, const StillTold& told) {
  const Schedule schedule = schedule_of(job);
  const std::uint64_t key = still_key(job, schedule, snapshot);
  std::optional<KeptState> kept;
  if (!job.resume.empty()) {
    auto found = read_state(job.resume, key, schedule);
    if (!found) return found.error();
    kept = std::move(*found);
  }
  renderer.resize(job.size.x, job.size.y);
  // Compiles shaders and uploads the scene, so that samples take the time that they take.
  render_iterations(renderer, job.settings, snapshot, {1}, nullptr);

  IterationBreaks breaks;
  std::uint32_t before = 0;
  if (kept) {
    before = kept->header.samples;
    if (auto status = renderer.resume_iterations(kept->state(), before); !status)
      return Error{fmt::format("{}: {}", job.resume, status.error().message)};
    breaks.first = kept->header.iterations;
    kept.reset();
    if (told.resumed) told.resumed(before);
  }
  breaks.ended = [&](std::uint32_t iterations, std::uint32_t samples) {
    if (!job.resume.empty()) {
      StateHeader header;
      header.key = key;
      header.iterations = iterations;
      header.samples = samples;
      if (auto status = write_state(job.resume, header, renderer.save_iterations()); !status)
        log_warning("{}; the picture goes on", status.error().message);
    }
    return !told.iteration || told.iteration(iterations);
  };
  const double start = still_seconds();
  const auto progress = [&](std::uint32_t samples) {
    if (told.sample) told.sample(samples, (still_seconds() - start) / (samples - before));
  };
  return render_iterations(renderer, job.settings, snapshot, schedule, progress, &breaks);
}

}  // namespace fb::lab
