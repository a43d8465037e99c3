// Parses wave files: one walk over the chunks, then the format, the samples and the loop.
#include "formats/wav.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace fb::formats {
namespace {

constexpr std::uint32_t tag(const char (&text)[5]) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])) << (8 * i);
  return value;
}

constexpr std::uint16_t kPcm = 1, kExtensible = 0xfffe;
constexpr std::size_t kCueSample = 4 + 20;  // of the first point: behind their number and five fields
constexpr std::size_t kExtensibleSize = 40, kSubformat = 24;

struct Chunk {
  std::size_t offset = 0;  // of its contents
  ByteView bytes;
  bool found() const { return offset != 0; }
};

struct Chunks {
  Chunk format, data, cue, list;  // the first of each; of lists the first behind the cue
  std::uint32_t missing = 0;      // bytes of the last chunk that the file does not hold
};

std::uint32_t word_at(ByteView bytes, std::size_t at) {
  ByteReader reader(bytes, {});
  reader.seek(at);
  return reader.u32();
}

// A file that was cut, or whose writer did not know the length beforehand: the last chunk is what there is of it.
Chunks find_chunks(ByteReader& reader) {
  Chunks chunks;
  while (reader.remaining() >= 8) {
    const std::uint32_t id = reader.u32();
    const std::uint32_t said = reader.u32();
    const std::size_t contents = reader.offset();
    const auto size = static_cast<std::uint32_t>(std::min<std::size_t>(said, reader.remaining()));
    const bool whole = size == said;
    if (!whole && id != tag("data")) break;
    if (!chunks.data.found()) chunks.missing = said - size;
    const Chunk chunk{contents, reader.bytes(size)};
    if (size % 2 != 0 && reader.remaining() > 0) reader.skip(1);
    if (id == tag("fmt ") && !chunks.format.found()) chunks.format = chunk;
    if (id == tag("data") && !chunks.data.found()) chunks.data = chunk;
    if (id == tag("cue ") && !chunks.cue.found()) chunks.cue = chunk;
    if (id == tag("LIST") && chunks.cue.found() && !chunks.list.found()) chunks.list = chunk;
  }
  return chunks;
}

// The length of the loop in samples, if the list has an ltxt of purpose "mark".
std::optional<std::uint32_t> marked_length(const Chunk& list) {
  ByteReader reader(list.bytes, {});
  if (reader.u32() != tag("adtl")) return std::nullopt;
  while (reader.remaining() >= 8) {
    const std::uint32_t id = reader.u32();
    const std::uint32_t size = reader.u32();
    const ByteView label = reader.bytes(std::min<std::size_t>(size, reader.remaining()));
    if (size % 2 != 0 && reader.remaining() > 0) reader.skip(1);
    if (id == tag("ltxt") && label.size() >= 12 && word_at(label, 8) == tag("mark")) return word_at(label, 4);
  }
  return std::nullopt;
}

Status read_format(const ByteReader& file, const Chunk& chunk, Wav& wav) {
  ByteReader reader(chunk.bytes, {});
  std::uint16_t format = reader.u16();
  wav.channels = reader.u16();
  wav.rate = reader.u32();
  reader.skip(6);
  wav.bits = reader.u16();
  const auto refuse = [&](const std::string& cause) -> Status { return file.error_at(chunk.offset, cause); };
  if (reader.failed()) return refuse("the format chunk is too short");
  if (format == kExtensible && chunk.bytes.size() >= kExtensibleSize)
    format = static_cast<std::uint16_t>(word_at(chunk.bytes, kSubformat) & 0xffffu);
  if (format != kPcm) return refuse(fmt::format("format {}; only uncompressed PCM (1) is played", format));
  if (wav.bits != 8 && wav.bits != 16) return refuse(fmt::format("{} bits; only 8 and 16 are played", wav.bits));
  if (wav.channels != 1 && wav.channels != 2)
    return refuse(fmt::format("{} channels; only 1 and 2 are played", wav.channels));
  if (wav.rate < kLowestRate || wav.rate > kHighestRate)
    return refuse(fmt::format("{} samples a second are not from {} to {}", wav.rate, kLowestRate, kHighestRate));
  return ok_status();
}

void read_samples(ByteView data, Wav& wav) {
  const auto channels = static_cast<std::size_t>(wav.channels);
  const std::size_t width = wav.bits == 8 ? 1 : 2;
  wav.samples.resize(data.size() / (width * channels));
  ByteReader reader(data, {});
  for (std::int16_t& sample : wav.samples) {
    int sum = 0;
    for (std::size_t c = 0; c < channels; ++c) sum += wav.bits == 8 ? (reader.u8() - 128) * 256 : reader.i16();
    sample = static_cast<std::int16_t>(sum / wav.channels);
  }
}

void read_loop(const Chunks& chunks, std::string_view name, Wav& wav) {
  if (chunks.cue.bytes.size() < kCueSample + 4 || word_at(chunks.cue.bytes, 0) == 0) return;
  const std::uint32_t start = word_at(chunks.cue.bytes, kCueSample);
  const std::size_t count = wav.samples.size();
  if (start >= count) {
    wav.flaw = fmt::format("{}: the loop begins at sample {} of {}; it is played once", name, start, count);
    return;
  }
  wav.loop_start = start;
  const std::optional<std::uint32_t> length = marked_length(chunks.list);
  if (!length || *length == 0) return;
  if (*length > count - start)
    wav.flaw = fmt::format("{}: the loop of {} samples from {} ends behind the last, {}; it ends there", name, *length,
                           start, count);
  else
    wav.samples.resize(start + *length);
}

}  // namespace

Result<Wav> parse_wav(ByteView data, std::string_view name) {
  ByteReader reader(data, name);
  const bool riff = reader.u32() == tag("RIFF");
  reader.skip(4);
  if (!riff || reader.u32() != tag("WAVE") || reader.failed()) return reader.error_at(0, "not a RIFF/WAVE file");
  const Chunks chunks = find_chunks(reader);
  if (!chunks.format.found()) return reader.error("there is no format chunk");
  if (!chunks.data.found()) return reader.error("there is no data chunk");
  Wav wav;
  if (const Status status = read_format(reader, chunks.format, wav); !status) return status.error();
  read_samples(chunks.data.bytes, wav);
  if (wav.samples.empty()) return reader.error_at(chunks.data.offset, "the data chunk holds no sample");
  if (chunks.missing != 0)
    wav.flaw =
        fmt::format("{}: the data chunk wants {} bytes more than the file has; it ends there", name, chunks.missing);
  read_loop(chunks, name, wav);
  return wav;
}

}  // namespace fb::formats
