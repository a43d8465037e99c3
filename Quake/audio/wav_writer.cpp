#include "audio/wav_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <system_error>
#include <utility>
#include <vector>

#include "base/log.h"
#include "fs/file.h"

namespace fb::audio {
namespace {

constexpr std::uint32_t kFrameSize = 4, kHeaderSize = 44;
constexpr const char* kPart = ".part";
constexpr std::uint64_t kMostBytes = 0xffffffffull - kHeaderSize;

using Header = std::array<std::uint8_t, kHeaderSize>;

void put(Header& header, std::size_t at, std::size_t count, std::uint32_t value) {
  for (std::size_t i = 0; i < count; ++i) header[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
}

Header make_header(std::uint32_t rate, std::uint32_t bytes) {
  Header header{};
  std::memcpy(&header[0], "RIFF", 4);
  put(header, 4, 4, bytes + kHeaderSize - 8);
  std::memcpy(&header[8], "WAVEfmt ", 8);
  put(header, 16, 4, 16);
  put(header, 20, 2, 1);  // PCM
  put(header, 22, 2, 2);  // channels
  put(header, 24, 4, rate);
  put(header, 28, 4, rate * kFrameSize);
  put(header, 32, 2, kFrameSize);
  put(header, 34, 2, 16);  // bits
  std::memcpy(&header[36], "data", 4);
  put(header, 40, 4, bytes);
  return header;
}

}  // namespace

Result<WavWriter> WavWriter::create(const std::filesystem::path& path, std::uint32_t rate) {
  auto target = fs::output_path(path);
  if (!target) return target.error();
  std::error_code ignored;
  std::filesystem::path grows = *target;
  const bool may_be_renamed =
      !std::filesystem::exists(grows, ignored) || std::filesystem::is_regular_file(grows, ignored);
  if (may_be_renamed && grows.extension() != kPart) grows += kPart;
  auto file = fs::HeldFile::take(grows);
  if (!file) return file.error();
  if (const Status status = file->cut(0); !status) return status.error();
  WavWriter writer(*std::move(file), *std::move(target), path.string(), rate);
  if (const Status status = writer.put_header(); !status) return status.error();
  return writer;
}

Status WavWriter::put_header() const {
  return file_.write_at(0, make_header(rate_, static_cast<std::uint32_t>(bytes_)));
}

Status WavWriter::write(std::span<const float> stereo) {
  std::vector<std::uint8_t> data;
  data.reserve(2 * stereo.size());
  for (const float value : stereo) {
    const auto sample = static_cast<std::uint16_t>(
        static_cast<std::int16_t>(std::clamp(std::rint(value * 32767.0f), -32768.0f, 32767.0f)));
    data.push_back(static_cast<std::uint8_t>(sample & 0xffu));
    data.push_back(static_cast<std::uint8_t>(sample >> 8u));
  }
  failed_ = true;
  if (bytes_ + data.size() > kMostBytes) return Error{fmt::format("{}: a wave file holds no more than 4 GiB", path_)};
  if (const Status status = file_.append(data); !status) return status;
  bytes_ += data.size();
  if (const Status status = put_header(); !status) return status;
  failed_ = false;
  return ok_status();
}

Status WavWriter::finish() {
  if (failed_) {  // in the middle of a frame, perhaps
    if (const Status status = file_.cut(kHeaderSize + bytes_); !status) return status;
    if (const Status status = put_header(); !status) return status;
  }
  if (file_.path() == target_) return ok_status();
  std::error_code failed;
  if (failed_ && std::filesystem::exists(target_, failed)) {
    log_info("What was recorded until then is {}; {} stays as it was.", file_.path().string(), path_);
    return ok_status();
  }
  file_.resemble(target_);
  if (const Status status = file_.flush(); !status) return status;
  std::filesystem::rename(file_.path(), target_, failed);
  if (failed) return Error{fmt::format("{}: cannot be written: {}", path_, failed.message())};
  fs::flush_path(target_.parent_path());
  return ok_status();
}

}  // namespace fb::audio
