// What zip.cpp and mod_archive.cpp share of libzip: archives are opened, and an entry's claims are judged before a byte
// of it is unpacked.
#pragma once

#include <zip.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "base/file_data.h"
#include "base/result.h"

namespace fb::fs {

// `name` is the archive's in errors. The caller ends it by zip_discard. The file must be a regular one.
Result<::zip*> open_zip(const std::filesystem::path& path, const std::string& name);
// The bytes must outlive it.
Result<::zip*> open_zip(const FileData& data, const std::string& name);

// Why a file of an archive of this size is not read: it is encrypted, packed by an unknown method, larger than `most`
// bytes, or claims what its packed bytes cannot hold. Empty if it is read.
std::string zip_fault(const zip_stat_t& stat, std::uint64_t archive_size, std::uint64_t most);

}  // namespace fb::fs
