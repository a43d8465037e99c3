#include "progs/strings.h"

#include <algorithm>

#include "base/check.h"

namespace fb::progs {
namespace {

constexpr std::size_t kOverhead = 64;  // what keeping a string costs besides its text, about
constexpr std::size_t kMaxKept = 1u << 24u;

std::string_view cut(std::string_view text) {
  return text.substr(0, std::min(text.find('\0'), StringTable::kMaxLength));
}
StringId id_of_slot(std::size_t slot) {
  return StringId{static_cast<std::int32_t>(-1 - static_cast<std::int64_t>(slot))};
}

}  // namespace

StringTable::StringTable(const std::vector<char>& block)
    : block_(block.data()), block_size_(block.size()), temporaries_(kTemporaries) {
  FB_CHECK(!block.empty() && block.back() == 0);
}

const char* StringTable::engine_string(std::uint32_t slot) const {
  if (slot < kTemporaries) return temporaries_[slot].c_str();
  const std::size_t i = slot - kTemporaries;
  if (i >= kept_.size() || kept_[i].kind == Kind::kUnused) return nullptr;
  return kept_[i].text.c_str();
}

StringId StringTable::temporary(std::string_view text) {
  std::string copy(cut(text));  // first: it may be a view of what goes
  const auto drop_oldest = [&] {
    std::string& oldest = temporaries_[oldest_];
    temporary_bytes_ -= oldest.size();
    oldest = std::string();
    oldest_ = (oldest_ + 1) % kTemporaries;
    --temporaries_used_;
  };
  while (temporaries_used_ == kTemporaries ||
         (temporaries_used_ > 0 && temporary_bytes_ + copy.size() > kMaxTemporaryBytes)) {
    drop_oldest();
  }
  const std::size_t slot = newest_;
  newest_ = (newest_ + 1) % kTemporaries;
  ++temporaries_used_;
  temporary_bytes_ += copy.size();
  temporaries_[slot] = std::move(copy);
  return id_of_slot(slot);
}

StringId StringTable::keep(std::string_view text, Kind kind) {
  text = cut(text);
  const std::size_t cost = text.size() + kOverhead;
  if (kept_bytes_ + cost > kMaxBytes || (unused_.empty() && kept_.size() >= kMaxKept)) return StringId::kNull;
  kept_bytes_ += cost;
  Slot slot{kind, std::string(text)};
  if (unused_.empty()) {
    kept_.push_back(std::move(slot));
    return id_of_slot(kTemporaries + kept_.size() - 1);
  }
  const std::uint32_t i = unused_.back();
  unused_.pop_back();
  kept_[i] = std::move(slot);
  return id_of_slot(kTemporaries + i);
}

StringId StringTable::intern(std::string_view text) {
  std::string key(cut(text));
  if (const auto found = interned_.find(key); found != interned_.end()) return found->second;
  const StringId id = keep(key, Kind::kKept);
  if (id != StringId::kNull) interned_.emplace(std::move(key), id);
  return id;
}

StringId StringTable::allocate(std::string_view text) { return keep(text, Kind::kKept); }
StringId StringTable::zone(std::string_view text) { return keep(text, Kind::kZone); }

bool StringTable::unzone(StringId id) {
  const std::int64_t slot = -1 - static_cast<std::int64_t>(id);
  const std::int64_t i = slot - static_cast<std::int64_t>(kTemporaries);
  if (i < 0 || i >= static_cast<std::int64_t>(kept_.size())) return false;
  Slot& zone = kept_[static_cast<std::size_t>(i)];
  if (zone.kind != Kind::kZone) return false;
  kept_bytes_ -= zone.text.size() + kOverhead;
  zone = Slot();
  unused_.push_back(static_cast<std::uint32_t>(i));
  return true;
}

}  // namespace fb::progs
