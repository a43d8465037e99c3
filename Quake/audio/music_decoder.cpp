#include "audio/music_decoder.h"

#include <fmt/format.h>
#include <sndfile.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <libopenmpt/libopenmpt.hpp>
#include <sstream>
#include <utility>
#include <vector>

#include "audio/ogg_flac.h"
#include "formats/wav.h"

namespace fb::audio {
namespace {

constexpr std::array<std::string_view, 10> kExtensions = {"ogg", "opus", "mp3", "flac", "wav",
                                                          "it",  "s3m",  "xm",  "mod",  "umx"};
constexpr std::size_t kFirstModule = 5;

bool is_module(std::string_view name) {
  const std::string_view extension = name.substr(std::min(name.rfind('.'), name.size() - 1) + 1);
  return std::find(kExtensions.begin() + kFirstModule, kExtensions.end(), extension) != kExtensions.end();
}

class SoundFileDecoder final : public MusicDecoder {
 public:
  static Result<std::unique_ptr<MusicDecoder>> open(FileData data, const std::string& name) {
    std::unique_ptr<SoundFileDecoder> decoder(new SoundFileDecoder(std::move(data)));
    SF_INFO info = {};
    decoder->file_ = sf_open_virtual(&kInput, SFM_READ, &info, decoder.get());
    if (!decoder->file_) return Error{fmt::format("{}: {}", name, sf_strerror(nullptr))};
    const int highest = static_cast<int>(formats::kHighestRate);
    if (info.channels < 1 || info.samplerate < static_cast<int>(formats::kLowestRate) || info.samplerate > highest)
      return Error{fmt::format("{}: {} channels of {} Hz cannot be played", name, info.channels, info.samplerate)};
    decoder->channels_ = static_cast<std::size_t>(info.channels);
    decoder->rate_ = static_cast<std::uint32_t>(info.samplerate);
    return std::unique_ptr<MusicDecoder>(std::move(decoder));
  }
  ~SoundFileDecoder() override {
    if (file_) sf_close(file_);
  }

  std::size_t read(std::span<float> stereo) override {
    if (channels_ == 2) return read_frames(stereo.data(), stereo.size() / 2);
    mixed_.resize(stereo.size() / 2 * channels_);
    const std::size_t frames = read_frames(mixed_.data(), stereo.size() / 2);
    for (std::size_t i = 0; i < frames; ++i) {
      stereo[2 * i] = mixed_[i * channels_];
      stereo[2 * i + 1] = mixed_[i * channels_ + (channels_ > 1 ? 1 : 0)];
    }
    return frames;
  }
  bool rewind() override { return sf_seek(file_, 0, SEEK_SET) == 0; }

 private:
  explicit SoundFileDecoder(FileData data) : data_(std::move(data)) {}

  std::size_t read_frames(float* to, std::size_t frames) {
    return static_cast<std::size_t>(
        std::max<sf_count_t>(0, sf_readf_float(file_, to, static_cast<sf_count_t>(frames))));
  }

  static SoundFileDecoder& self(void* user) { return *static_cast<SoundFileDecoder*>(user); }
  static sf_count_t length(void* user) { return static_cast<sf_count_t>(self(user).data_.size()); }
  static sf_count_t tell(void* user) { return static_cast<sf_count_t>(self(user).at_); }
  static sf_count_t seek(sf_count_t offset, int whence, void* user) {
    SoundFileDecoder& decoder = self(user);
    const sf_count_t from = whence == SEEK_CUR ? tell(user) : whence == SEEK_END ? length(user) : 0;
    decoder.at_ = static_cast<std::size_t>(std::clamp<sf_count_t>(from + offset, 0, length(user)));
    return tell(user);
  }
  static sf_count_t input(void* to, sf_count_t count, void* user) {
    SoundFileDecoder& decoder = self(user);
    const std::size_t bytes =
        std::min(static_cast<std::size_t>(std::max<sf_count_t>(count, 0)), decoder.data_.size() - decoder.at_);
    if (bytes > 0) std::memcpy(to, decoder.data_.data() + decoder.at_, bytes);
    decoder.at_ += bytes;
    return static_cast<sf_count_t>(bytes);
  }
  static sf_count_t output(const void*, sf_count_t, void*) { return 0; }
  static SF_VIRTUAL_IO kInput;

  FileData data_;
  std::size_t at_ = 0;
  SNDFILE* file_ = nullptr;
  std::size_t channels_ = 2;
  std::vector<float> mixed_;
};
SF_VIRTUAL_IO SoundFileDecoder::kInput = {&length, &seek, &input, &output, &tell};

class ModuleDecoder final : public MusicDecoder {
 public:
  ModuleDecoder(const FileData& data, std::uint32_t rate) : module_(data.data(), data.size(), remarks_) {
    rate_ = rate;
  }
  std::size_t read(std::span<float> stereo) override {
    return module_.read_interleaved_stereo(static_cast<std::int32_t>(rate_), stereo.size() / 2, stereo.data());
  }
  bool rewind() override {
    module_.set_position_seconds(0.0);
    return true;
  }

 private:
  std::ostringstream remarks_;  // the library would print them
  openmpt::module module_;
};

Result<std::unique_ptr<MusicDecoder>> open_sound_file(const FileData& data, const std::string& name) {
  if (auto flac = flac_of_ogg({data.data(), data.size()})) return SoundFileDecoder::open(*std::move(flac), name);
  return SoundFileDecoder::open(data, name);
}

Result<std::unique_ptr<MusicDecoder>> open_module(const FileData& data, const std::string& name, std::uint32_t rate) {
  try {
    return std::unique_ptr<MusicDecoder>(std::make_unique<ModuleDecoder>(data, rate));
  } catch (const openmpt::exception& failure) {
    return Error{fmt::format("{}: {}", name, failure.what())};
  }
}

}  // namespace

std::span<const std::string_view> music_extensions() { return kExtensions; }

Result<std::unique_ptr<MusicDecoder>> open_music(FileData data, const std::string& name, std::uint32_t rate) {
  const bool module_first = is_module(name);
  auto music = module_first ? open_module(data, name, rate) : open_sound_file(data, name);
  if (music) return music;
  auto other = module_first ? open_sound_file(data, name) : open_module(data, name, rate);
  return other ? std::move(other) : std::move(music);
}

}  // namespace fb::audio
