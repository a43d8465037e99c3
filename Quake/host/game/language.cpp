#include "host/game/language.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "base/log.h"
#include "fs/path.h"
#include "fs/zip.h"

namespace fb::host {
namespace {

constexpr const char *kDefault = "english", *kArchive = "QuakeEX.kpf";

// What the environment says, as for other programs: "de_DE.UTF-8" is German.
std::string system_language() {
  constexpr std::array<std::pair<std::string_view, const char*>, 5> kKnown = {
      {{"en", "english"}, {"fr", "french"}, {"de", "german"}, {"it", "italian"}, {"es", "spanish"}}};
  for (const char* variable : {"LC_ALL", "LC_MESSAGES", "LANG"}) {
    const char* const value = std::getenv(variable);
    if (!value || !*value) continue;
    for (const auto& [code, language] : kKnown)
      if (std::string_view(value).substr(0, 2) == code) return language;
    break;
  }
  return kDefault;
}

// A language is a word: it becomes a part of a file's name.
bool is_word(std::string_view text) {
  return !text.empty() && text.size() < 64 && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

// True if there was such a file.
bool add(con::Localization& texts, const FileData& file, const std::string& name) {
  const auto added = texts.add({file.data(), file.size()}, name);
  if (!added)
    log_warning("{}", added.error().message);
  else
    log_debug("{}: {} texts", name, *added);
  return true;
}

// Null where there is none, or it cannot be read.
std::unique_ptr<fs::Zip> open_archive(const std::filesystem::path& folder) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(folder / kArchive, code)) return nullptr;
  auto archive = fs::Zip::open(folder / kArchive, kArchive);
  if (archive) return std::move(*archive);
  log_warning("{}", archive.error().message);
  return nullptr;
}

bool add_language(con::Localization& texts, const fs::FileSystem& files, const std::string& language) {
  const std::string name = fmt::format("localization/loc_{}.txt", language);
  bool found = false;
  for (const FileData& file : files.read_all(name)) found |= add(texts, file, name);
  for (const std::filesystem::path& folder : files.folders()) {
    std::error_code code;
    if (!std::filesystem::is_regular_file(folder / name, code)) continue;
    const auto file = fs::read_whole_file(folder / name);
    if (file)
      found |= add(texts, *file, name);
    else
      log_warning("{}", file.error().message);
  }
  for (const std::filesystem::path& folder : files.folders()) {
    const auto archive = open_archive(folder);
    const fs::PakEntry* entry = archive ? archive->find_ignoring_case(name) : nullptr;
    if (!entry) continue;
    const auto file = archive->read(*entry);
    if (file)
      found |= add(texts, *file, fmt::format("{}:{}", kArchive, name));
    else
      log_warning("{}", file.error().message);
  }
  return found;
}

void read_language(con::Localization& texts, const fs::FileSystem& files, const std::string& wanted) {
  texts.clear();
  const std::string language = wanted == "auto" ? system_language() : fs::lower_case(wanted);
  if (!is_word(language))
    log_warning("language \"{}\": a language is one word; texts are {}", wanted, kDefault);
  else if (!add_language(texts, files, language) && language != kDefault)
    log_warning("language {}: there is no localization/loc_{}.txt; texts are {}", language, language, kDefault);
  if (language != kDefault) add_language(texts, files, kDefault);
}

}  // namespace

void register_language(con::Console& console, const fs::FileSystem& files) {
  con::Cvar& language = console.add_cvar(
      {"language", kDefault,
       "of messages whose texts are in localization/loc_LANGUAGE.txt: english, french, german, italian, spanish; auto: "
       "the system's",
       con::kCvarArchive});
  language.add_listener([&](const con::Cvar& cvar) { read_language(console.localization(), files, cvar.string()); });
  read_language(console.localization(), files, language.string());
}

}  // namespace fb::host
