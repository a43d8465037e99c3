#include "base/log.h"
#include "csqc/hud_context.h"

namespace fb::csqc {
namespace {

constexpr std::string_view kFolder = "gfx/";
constexpr const char* kEndings[] = {".tga", ".png", ".lmp", ".pcx"};

// Where the ending of a file's name begins; its length if it has none.
std::size_t ending_of(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  return dot != name.npos && name.find('/', dot) == name.npos ? dot : name.size();
}

}  // namespace

const ui::Picture* Pictures::look_for(const std::string& name, bool in_wad) {
  const std::size_t ending = ending_of(name);
  const bool file = ending < name.size();
  const std::string lump = name.starts_with(kFolder) ? name.substr(kFolder.size()) : name;
  if ((in_wad || !file) && lump.find('/') == lump.npos) {
    if (const ui::Picture* found = atlas_.picture(lump, false)) return found;
  }
  if (name.find('/') == name.npos) return nullptr;  // to the atlas that is a lump
  if (file) {
    if (const ui::Picture* found = atlas_.picture(name, false)) return found;
  }
  for (const char* other : kEndings) {
    if (const ui::Picture* found = atlas_.picture(name.substr(0, ending) + other, false)) return found;
  }
  return nullptr;
}

const ui::Picture* Pictures::find(std::string_view name, bool in_wad) {
  const auto known = found_.find(name);
  if (known != found_.end() && (known->second || !in_wad)) return known->second;
  if (name.empty() || found_.size() >= kMostNames) return nullptr;
  const ui::Picture* picture = look_for(std::string(name), in_wad);
  if (!picture) log_warning("{}: the mod's status bar asks for this picture, which is missing or cannot be read", name);
  if (found_.size() + 1 == kMostNames)
    log_warning("The mod's status bar asks for more than {} pictures; no others are shown", kMostNames);
  return found_[std::string(name)] = picture;
}

bool Pictures::knows(std::string_view name) const {
  const auto known = found_.find(name);
  return known != found_.end() && known->second != nullptr;
}

}  // namespace fb::csqc
