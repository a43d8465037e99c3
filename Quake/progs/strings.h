// The strings that QuakeC can name. A StringId >= 0 is an offset into the progs' own block (any offset: strings may
// share their ends); a negative one is a string of the engine:
//
//   temporary   what builtins return; a ring, so that the oldest make room. Never use one of these for long.
//   interned    one id for each text, until the level ends (Quake's PR_SetEngineString): precached names and the like
//   allocated   a new id each time, until the level ends (Quake's ED_NewString): values of entities from text
//   zone        until QuakeC gives it back (FTE_STRINGS: strzone, strunzone)
//
// An id from QuakeC may be anything: asking for one that names no string gives nullptr.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "progs/value.h"

namespace fb::progs {

class StringTable {
 public:
  static constexpr std::size_t kTemporaries = 4096;
  static constexpr std::size_t kMaxTemporaryBytes = 16u << 20u;  // of all together: the oldest become empty
  static constexpr std::size_t kMaxLength = 65535;               // of any string made here; what is longer is cut
  static constexpr std::size_t kMaxBytes = 256u << 20u;          // of all that are kept

  // `block` ends with a zero and must outlive the table (Program::strings).
  explicit StringTable(const std::vector<char>& block);

  // Zero-terminated, valid until the string goes; nullptr for an id that names none.
  const char* c_str(StringId id) const {
    const auto value = static_cast<std::int32_t>(id);
    if (value >= 0) return static_cast<std::size_t>(value) < block_size_ ? block_ + value : nullptr;
    return engine_string(static_cast<std::uint32_t>(-1 - value));
  }
  std::optional<std::string_view> find(StringId id) const {
    const char* text = c_str(id);
    return text ? std::optional<std::string_view>(text) : std::nullopt;
  }
  // For our own ids and for printing: empty for one that names none.
  std::string_view text(StringId id) const { return find(id).value_or(std::string_view()); }

  // A text ends at its first zero. kNull where kMaxBytes are used up.
  StringId temporary(std::string_view text);
  StringId intern(std::string_view text);
  StringId allocate(std::string_view text);
  StringId zone(std::string_view text);
  // Leaves alone what is no zone string, and says so by false.
  bool unzone(StringId id);

  std::size_t kept_bytes() const { return kept_bytes_; }
  std::size_t temporary_bytes() const { return temporary_bytes_; }

 private:
  enum class Kind : std::uint8_t { kUnused, kKept, kZone };
  struct Slot {
    Kind kind = Kind::kUnused;
    std::string text;
  };
  const char* engine_string(std::uint32_t slot) const;
  StringId keep(std::string_view text, Kind kind);

  const char* block_;
  std::size_t block_size_;
  // Slots 0 to kTemporaries - 1 are temporaries, used from the start; those behind are kept_.
  std::vector<std::string> temporaries_;
  std::size_t newest_ = 0, oldest_ = 0, temporaries_used_ = 0;  // of the ring
  std::size_t temporary_bytes_ = 0, kept_bytes_ = 0;
  std::deque<Slot> kept_;              // stays where it is: c_str()
  std::vector<std::uint32_t> unused_;  // of kept_
  std::unordered_map<std::string, StringId> interned_;
};

}  // namespace fb::progs
