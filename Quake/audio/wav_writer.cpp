#include "audio/wav_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "fs/file.h"

namespace fb::audio {
namespace {

constexpr std::uint32_t kFrameSize = 4, kHeaderSize = 44;
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
  const auto there = fs::output_path(path);
  if (!there) return there.error();
  auto file = fs::HeldFile::take(*there);
  if (!file) return file.error();
  if (const Status status = file->cut(0); !status) return status.error();
  WavWriter writer(*std::move(file), path.string(), rate);
  if (const Status status = writer.put_header(0); !status) return status.error();
  return writer;
}

Status WavWriter::put_header(std::uint32_t bytes) { return file_.write_at(0, make_header(rate_, bytes)); }

Status WavWriter::write(std::span<const float> stereo) {
  std::vector<std::uint8_t> data;
  data.reserve(2 * stereo.size());
  for (const float value : stereo) {
    const auto sample = static_cast<std::uint16_t>(
        static_cast<std::int16_t>(std::clamp(std::rint(value * 32767.0f), -32768.0f, 32767.0f)));
    data.push_back(static_cast<std::uint8_t>(sample & 0xffu));
    data.push_back(static_cast<std::uint8_t>(sample >> 8u));
  }
  if (bytes_ + data.size() > kMostBytes) return Error{fmt::format("{}: a wave file holds no more than 4 GiB", path_)};
  if (const Status status = file_.append(data); !status) return status;
  bytes_ += data.size();
  return ok_status();
}

Status WavWriter::finish() { return put_header(static_cast<std::uint32_t>(bytes_)); }

}  // namespace fb::audio
