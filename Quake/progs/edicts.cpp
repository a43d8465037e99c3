#include "progs/edicts.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "progs/system_defs.h"

namespace fb::progs {
namespace {

constexpr float kReuseDelay = 0.5f;               // seconds
constexpr float kLevelStart = 2.0f;               // seconds
constexpr std::uint64_t kMaxWords = 1ull << 31u;  // so that pointers of QuakeC fit a word

}  // namespace

Result<EdictStore> EdictStore::create(std::uint32_t words, std::uint32_t max_edicts) {
  FB_CHECK_LE(kSystemFields, words);
  const std::uint64_t total = std::uint64_t{words} * max_edicts;
  if (max_edicts == 0 || total > kMaxWords) {
    return Error{fmt::format("{} edicts of {} words each are more than the {} words that can be named", max_edicts,
                             words, kMaxWords)};
  }
  EdictStore store;
  // Zeroed memory of this size comes from the system page by page, as it is touched.
  store.words_.reset(static_cast<Word*>(std::calloc(total, sizeof(Word))));
  if (!store.words_) return Error{fmt::format("no memory for {} edicts of {} words each", max_edicts, words)};
  store.stride_ = words;
  store.max_ = max_edicts;
  store.info_.resize(max_edicts);
  store.free_bits_.resize((max_edicts + 63) / 64);
  store.start_level(0);
  return store;
}

void EdictStore::start_level(std::uint32_t clients) {
  FB_CHECK_LT(clients, max_);
  const std::uint32_t used = std::max(count_, clients + 1);
  std::fill_n(words_.get(), std::size_t{used} * stride_, Word{0});
  std::fill(info_.begin(), info_.end(), Info{});
  std::fill(free_bits_.begin(), free_bits_.end(), 0);
  reserved_ = clients;
  count_ = clients + 1;
}

void EdictStore::set_free(EdictId id, bool free, float time) {
  info_[index(id)] = {free, time};
  const std::uint64_t bit = 1ull << (index(id) % 64);
  std::uint64_t& bits = free_bits_[index(id) / 64];
  bits = free ? bits | bit : bits & ~bit;
}

void EdictStore::clear(EdictId id) {
  std::fill_n(words_.get() + std::size_t{index(id)} * stride_, stride_, Word{0});
  set_free(id, false, 0.0f);
  if (listener_) listener_->edict_cleared(id);
}

Result<EdictId> EdictStore::alloc(double time) {
  for (std::size_t block = 0; block < free_bits_.size() && block * 64 < count_; ++block) {
    for (std::uint64_t bits = free_bits_[block]; bits != 0; bits &= bits - 1) {
      const auto number = static_cast<std::uint32_t>(block * 64 + static_cast<unsigned>(std::countr_zero(bits)));
      const float freed = info_[number].free_time;
      if (freed < kLevelStart || time - static_cast<double>(freed) > static_cast<double>(kReuseDelay)) {
        clear(EdictId{number});
        return EdictId{number};
      }
    }
  }
  if (count_ >= max_) return Error{fmt::format("no free edicts: all {} (max_edicts) are in use", max_)};
  const EdictId id{count_++};
  clear(id);
  return id;
}

void EdictStore::free(EdictId id, double time) {
  FB_CHECK_LT(index(id), count_);
  if (index(id) <= reserved_ || is_free(id)) return;
  if (listener_) listener_->edict_freed(id);
  Edict edict = (*this)[id];
  edict.set(fields::model, StringId::kNull);
  for (const Field<float> field :
       {fields::takedamage, fields::modelindex, fields::colormap, fields::skin, fields::frame, fields::solid}) {
    edict.set(field, 0.0f);
  }
  edict.set(fields::origin, vec3(0.0f));
  edict.set(fields::angles, vec3(0.0f));
  edict.set(fields::nextthink, -1.0f);
  set_free(id, true, static_cast<float>(time));
}

Result<EdictId> EdictStore::revive(EdictId id) {
  if (index(id) >= max_) {
    return Error{fmt::format("edict {} is beyond the {} that max_edicts allows", index(id), max_)};
  }
  while (count_ <= index(id)) set_free(EdictId{count_++}, true, 0.0f);
  clear(id);
  return id;
}

}  // namespace fb::progs
