#include "audio/sample.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "audio/resampler.h"
#include "base/log.h"
#include "base/out_of_memory.h"

namespace fb::audio {
namespace {

constexpr std::uint64_t kMostFrames = std::uint64_t{1} << 26u;

std::int16_t to_sixteen_bits(float value, bool eight_bits) {
  const float step = eight_bits ? 256.0f : 1.0f;
  return static_cast<std::int16_t>(
      std::clamp(std::rint(value / step) * step, -32768.0f, eight_bits ? 32512.0f : 32767.0f));
}

std::uint64_t bytes_of(const Sample& sample) { return sample.frames.size() * sizeof(sample.frames[0]); }

}  // namespace

Result<SamplePtr> make_sample(const formats::Wav& wav, const std::string& name, const SampleFormat& format) {
  const std::uint64_t count = wav.samples.size();
  if (count * format.rate / wav.rate > kMostFrames)
    return Error{fmt::format("sound/{}: {} seconds are too long for a sound", name, count / wav.rate)};
  auto sample = std::make_shared<Sample>();
  sample->name = name;
  sample->bits = format.eight_bits ? 8 : wav.bits;
  sample->rate = wav.rate;
  const std::vector<float> samples(wav.samples.begin(), wav.samples.end());
  const std::vector<float> resampled =
      resample(samples, wav.rate, format.rate, format.quality, wav.loop_start.value_or(samples.size()), format.held);
  sample->frames.reserve(resampled.size());
  for (const float value : resampled) sample->frames.push_back(to_sixteen_bits(value, format.eight_bits));
  if (wav.loop_start) {
    const std::uint64_t start = std::uint64_t{*wav.loop_start} * format.rate / wav.rate;
    sample->loop_start = std::min<std::uint64_t>(start, sample->frames.size() - 1);
  }
  return SamplePtr(std::move(sample));
}

Result<SamplePtr> SampleCache::load_file(std::string_view name) const {
  const std::string path = "sound/" + std::string(name);
  const std::optional<FileData> data = files_ ? files_(path) : std::nullopt;
  if (!data) return Error{fmt::format("{} is missing", path)};
  return within_memory([&]() -> Result<SamplePtr> {
    const auto wav = formats::parse_wav({data->data(), data->size()}, path);
    if (!wav) return wav.error();
    if (!wav->flaw.empty()) log_warning("{}", wav->flaw);
    return make_sample(*wav, std::string(name), format_);
  });
}

SamplePtr SampleCache::load(std::string_view name) {
  if (const auto found = samples_.find(name); found != samples_.end()) return found->second;
  if (without_room_.contains(name)) return nullptr;
  auto made = load_file(name);
  if (!made) log_warning("{}", made.error().message);
  if (made && bytes_of(**made) > most_bytes_ - bytes_) {
    if (!std::exchange(said_full_, true))
      log_warning("sound/{}: not loaded, nor any other sound for which there is no room: {} hold {} of {} already",
                  name, samples_.size(), memory_text(bytes_), memory_text(most_bytes_));
    without_room_.emplace(name);
    return nullptr;
  }
  if (made) bytes_ += bytes_of(**made);
  return samples_.emplace(std::string(name), made ? std::move(*made) : nullptr).first->second;
}

void SampleCache::set_format(const SampleFormat& format) {
  if (format == format_) return;
  format_ = format;
  keep_only({});
}

void SampleCache::keep_only(const std::vector<std::string>& names) {
  without_room_.clear();
  said_full_ = false;
  std::vector<std::string> sorted = names;
  std::sort(sorted.begin(), sorted.end());
  for (auto it = samples_.begin(); it != samples_.end();) {
    if (std::binary_search(sorted.begin(), sorted.end(), it->first)) {
      ++it;
      continue;
    }
    if (it->second) {
      bytes_ -= bytes_of(*it->second);
      dropped_.push_back(std::move(it->second));
    }
    it = samples_.erase(it);
  }
}

// The count can only fall, since what was dropped is handed to nobody. The last decrement of the other thread comes
// before the one here, in one order of them all.
void SampleCache::collect() {
  std::erase_if(dropped_, [](const SamplePtr& sample) { return sample.use_count() == 1; });
}

}  // namespace fb::audio
