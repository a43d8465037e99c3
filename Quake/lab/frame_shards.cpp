#include "lab/frame_shards.h"

#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <system_error>

#include "fs/file.h"
#include "fs/held_file.h"
#include "lab/json.h"
#include "lab/json_reader.h"

namespace fb::lab {
namespace {

constexpr const char* kShardFormat = "fullbright frames 1";

std::string shard_path(const std::string& folder) { return folder + "/frames.json"; }

Result<ShardOfFrames> read_shard(const std::string& folder) {
  const auto file = JsonFile::read(shard_path(folder));
  if (!file) return file.error();
  JsonReader reader(*file, file->json());
  if (reader.text("format") != kShardFormat) return Error{fmt::format("{}: these are no shard's frames", folder)};
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
  ShardOfFrames shard;
  shard.of = reader.text("of");
  shard.first = reader.whole("first", 0, kMost, 0);
  shard.last = reader.whole("last", 0, kMost, 0);
  shard.index = static_cast<std::uint32_t>(reader.whole("shard", 1, kMost, 1));
  shard.count = static_cast<std::uint32_t>(reader.whole("shards", 1, kMost, 1));
  if (auto status = reader.end(); !status) return status.error();
  return shard;
}

// Every shard's folder, by its index.
Result<std::map<std::uint32_t, std::string>> folders_by_shard(const std::vector<std::string>& folders,
                                                              std::optional<ShardOfFrames>& common) {
  std::map<std::uint32_t, std::string> by_index;
  for (const std::string& folder : folders) {
    const auto shard = read_shard(folder);
    if (!shard) return shard.error();
    if (!common) common = *shard;
    if (shard->of != common->of || shard->first != common->first || shard->last != common->last ||
        shard->count != common->count)
      return Error{
          fmt::format("{}: its frames are of {} ({} to {}, {} shards), those of {} of {} ({} to {}, {} shards)", folder,
                      shard->of, shard->first, shard->last, shard->count, folders.front(), common->of, common->first,
                      common->last, common->count)};
    const auto [there, fresh] = by_index.emplace(shard->index, folder);
    if (!fresh) return Error{fmt::format("shard {} is there twice: {} and {}", shard->index, there->second, folder)};
  }
  for (std::uint32_t index = 1; common && index <= common->count; ++index)
    if (!by_index.contains(index)) return Error{fmt::format("shard {} of {} is missing", index, common->count)};
  return by_index;
}

}  // namespace

std::pair<std::uint64_t, std::uint64_t> frames_of_shard(std::uint64_t first, std::uint64_t last, std::uint32_t index,
                                                        std::uint32_t count) {
  const std::uint64_t frames = last - first + 1;
  return {first + frames * (index - 1) / count, first + frames * index / count - 1};
}

void begin_shard(const std::string& folder) {
  std::error_code ignored;
  std::filesystem::remove(shard_path(folder), ignored);
}

Status tell_shard(const std::string& folder, const ShardOfFrames& shard) {
  const Json json{{"format", kShardFormat}, {"of", shard.of},       {"first", shard.first},
                  {"last", shard.last},     {"shard", shard.index}, {"shards", shard.count}};
  return fs::write_text_atomically(shard_path(folder), json_text(json));
}

Result<std::uint64_t> merge_frames(const std::vector<std::string>& folders, const std::string& to) {
  std::optional<ShardOfFrames> common;
  const auto by_index = folders_by_shard(folders, common);
  if (!by_index) return by_index.error();
  if (!common) return Error{"no folders to join"};
  std::error_code failed;
  if (std::filesystem::exists(to, failed)) return Error{fmt::format("{}: it is there already", to)};
  const std::string part = to + ".part";
  const auto held = fs::HeldFile::take_folder(part);
  if (!held) return held.error();
  for (const auto& left_over : std::filesystem::directory_iterator(part, failed))
    std::filesystem::remove_all(left_over.path(), failed);
  if (failed) return Error{fmt::format("{}: {}", part, failed.message())};
  std::uint64_t frames = 0;
  for (const auto& [index, folder] : *by_index) {
    const auto [first, last] = frames_of_shard(common->first, common->last, index, common->count);
    for (std::uint64_t frame = first; frame <= last; ++frame, ++frames) {
      bool found = false;
      for (const char* extension : {"png", "exr"}) {
        const std::string name = fmt::format("/frame_{:06}.{}", frame, extension);
        if (!std::filesystem::exists(folder + name)) continue;
        found = true;
        std::filesystem::copy_file(folder + name, part + name, failed);
        if (failed) return Error{fmt::format("{}{}: {}", part, name, failed.message())};
      }
      if (!found) return Error{fmt::format("{}: frame {} is missing", folder, frame)};
    }
  }
  std::filesystem::rename(part, to, failed);
  if (failed) return Error{fmt::format("{}: {}", to, failed.message())};
  return frames;
}

}  // namespace fb::lab
