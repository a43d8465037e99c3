#include "fs/zip_handle.h"

#include <fmt/format.h>

namespace fb::fs {
namespace {

constexpr std::uint64_t kBestDeflate = 1032;  // a deflated byte unpacks to at most this many

Error not_a_zip(const std::string& name, zip_error_t& failure) {
  Error error{fmt::format("{}: not a zip archive that can be read: {}", name, zip_error_strerror(&failure))};
  zip_error_fini(&failure);
  return error;
}

}  // namespace

Result<::zip*> open_zip(const std::filesystem::path& path, const std::string& name) {
  int code = 0;
  if (::zip* archive = zip_open(path.string().c_str(), ZIP_RDONLY, &code)) return archive;
  zip_error_t failure;
  zip_error_init_with_code(&failure, code);
  return not_a_zip(name, failure);
}

Result<::zip*> open_zip(const FileData& data, const std::string& name) {
  zip_error_t failure;
  zip_error_init(&failure);
  zip_source_t* source = zip_source_buffer_create(data.data(), data.size(), 0, &failure);
  ::zip* archive = source ? zip_open_from_source(source, ZIP_RDONLY, &failure) : nullptr;
  if (!archive) {
    if (source) zip_source_free(source);
    return not_a_zip(name, failure);
  }
  zip_error_fini(&failure);
  return archive;
}

std::string zip_fault(const zip_stat_t& stat, std::uint64_t archive_size, std::uint64_t most) {
  constexpr zip_uint64_t kNeeded = ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE | ZIP_STAT_COMP_METHOD;
  if ((stat.valid & kNeeded) != kNeeded) return "the archive does not say how it is packed";
  if ((stat.valid & ZIP_STAT_ENCRYPTION_METHOD) && stat.encryption_method != ZIP_EM_NONE) return "it is encrypted";
  if (stat.comp_method != ZIP_CM_STORE && stat.comp_method != ZIP_CM_DEFLATE)
    return fmt::format("it is packed by method {}; stored and deflated files are read", stat.comp_method);
  if (stat.comp_size > archive_size)
    return fmt::format("it claims {} packed bytes, and the archive has {}", stat.comp_size, archive_size);
  if (stat.size > most) return fmt::format("it claims {} bytes, of {} that are read", stat.size, most);
  const std::uint64_t holds = stat.comp_method == ZIP_CM_STORE ? stat.comp_size : kBestDeflate * stat.comp_size;
  if (stat.size > holds)
    return fmt::format("it claims {} bytes, and {} packed ones cannot hold them", stat.size, stat.comp_size);
  return {};
}

}  // namespace fb::fs
