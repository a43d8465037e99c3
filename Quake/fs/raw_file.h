// The system's own calls for files that are read: raw_file_posix.cpp, raw_file_windows.cpp. Only files of
// this module use them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <system_error>

#include "base/file_data.h"

namespace fb::fs {

constexpr std::intptr_t kNoHandle = -1;

// Why the last call failed, in the system's words.
std::string last_failure();

struct OpenedFile {
  std::intptr_t handle = kNoHandle;  // kNoHandle: it could not be opened (last_failure())
  bool regular = false;
  std::uint64_t size = 0;  // bytes
};
// To be read. Others may write, rename or remove it meanwhile.
OpenedFile open_to_read(const std::filesystem::path& path);
void close_handle(std::intptr_t handle);
// Bytes, now; 0 if the system does not say.
std::uint64_t size_of(std::intptr_t handle);
// How many bytes were read, 0 at the file's end; nothing if it failed.
std::optional<std::size_t> read_some(std::intptr_t handle, std::uint64_t offset, std::span<std::uint8_t> into);
// A part of an open file, read by page when it is used. It outlives the handle. nullopt if the system cannot map it.
std::optional<FileData> map_part(std::intptr_t handle, std::uint64_t offset, std::size_t size);

// Renames a file; who has the one of that name open goes on reading it.
std::error_code rename_over(const std::filesystem::path& from, const std::filesystem::path& to);
// Each gets the other's name, and at no moment is there no file or folder of either. False where the system or its file
// system cannot do so.
bool exchange_names(const std::filesystem::path& one, const std::filesystem::path& other);

}  // namespace fb::fs
