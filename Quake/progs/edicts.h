// Edicts: the things of a level, each a block of words that QuakeC's fields name, plus whether it is free. What else
// the server knows of an edict (links, leafs, baseline) it keeps in arrays of its own, by EdictId.
//
//   auto id = store.alloc(time);                 // Result: all may be in use
//   Edict edict = store[*id];
//   edict.set(fields::origin, {0, 0, 24});
//   if (const auto alpha = program.field<float>("alpha")) edict.set(alpha, 0.5f);
//
// Edict 0 is the world, those up to reserved() the clients; they are never allocated or freed.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <type_traits>
#include <vector>

#include "base/check.h"
#include "base/result.h"
#include "progs/value.h"

namespace fb::progs {

class EdictStore;

// A view of one edict: cheap to copy, valid as long as the store.
class Edict {
 public:
  EdictId id() const { return id_; }
  bool is_world() const { return id_ == EdictId::kWorld; }
  bool is_free() const;
  // An absent field (a mod without `alpha`, say) is zero, and setting it does nothing. An entity field that holds
  // what is no edict reads as the world.
  template <typename T>
  T get(Field<T> field) const;
  template <typename T>
  void set(Field<T> field, std::type_identity_t<T> value) {
    if (field) ValueTraits<T>::store(words_ + field.offset, value);
  }
  float get_or(Field<float> field, float fallback) const { return field ? get(field) : fallback; }
  // Quake's bits in floats (flags, items, spawnflags, effects).
  bool has_flag(Field<float> field, std::int32_t bit) const { return (to_int(get(field)) & bit) != 0; }
  void add_flag(Field<float> field, std::int32_t bit) { set(field, static_cast<float>(to_int(get(field)) | bit)); }
  void remove_flag(Field<float> field, std::int32_t bit) { set(field, static_cast<float>(to_int(get(field)) & ~bit)); }

  Word* words() { return words_; }
  const Word* words() const { return words_; }

 private:
  friend class EdictStore;
  Edict(EdictStore& store, EdictId id, Word* words) : store_(&store), words_(words), id_(id) {}
  EdictStore* store_;
  Word* words_;
  EdictId id_;
};

// Told of what happens to edicts, for the server's own arrays.
class EdictListener {
 public:
  virtual ~EdictListener() = default;
  virtual void edict_cleared(EdictId) {}  // allocated, or about to be read from text: begins anew
  virtual void edict_freed(EdictId) {}    // before its fields change: unlink it
};

class EdictStore {
 public:
  // Memory for max_edicts of `words` each is reserved at once and used as edicts come. Fails where there is not so
  // much.
  static Result<EdictStore> create(std::uint32_t words, std::uint32_t max_edicts);

  void set_listener(EdictListener* listener) { listener_ = listener; }
  // As a level begins: the world and `clients` edicts, all zero, and no others.
  void start_level(std::uint32_t clients);

  std::uint32_t count() const { return count_; }  // in use or freed: ids below this are valid
  std::uint32_t max() const { return max_; }
  std::uint32_t reserved() const { return reserved_; }  // clients
  std::uint32_t words_per_edict() const { return stride_; }
  bool valid(EdictId id) const { return index(id) < count_; }
  bool is_free(EdictId id) const { return info_[index(id)].free; }
  // For ids that are valid; others are a fault of the program.
  Edict operator[](EdictId id) {
    FB_CHECK_LT(index(id), count_);
    return Edict(*this, id, words_.get() + std::size_t{index(id)} * stride_);
  }

  // Quake's ED_Alloc: the free edict of the lowest number that was freed more than half a second ago (so that clients
  // do not interpolate from what it was), or in the level's first two seconds; else a new one. All zero.
  Result<EdictId> alloc(double time);
  // Quake's ED_Free: what would still draw, think or touch is cleared, the rest stays until it is used again, as mods
  // look at what they removed. Reserved edicts and those that are free already stay as they are.
  void free(EdictId id, double time);

  // For loading a game: makes `id` an edict in use, all zero, and everything between count() and it a free one.
  // Fails for ids beyond max().
  Result<EdictId> revive(EdictId id);
  // Marks it free without clearing, as after reading an entity that is only {}.
  void mark_free(EdictId id) { set_free(id, true, 0.0f); }

  // For the virtual machine: all edicts, one behind the other.
  Word* words() { return words_.get(); }

 private:
  EdictStore() = default;
  struct Info {
    bool free = false;
    float free_time = 0.0f;  // seconds of the level
  };
  struct Release {
    void operator()(Word* words) const { std::free(words); }
  };
  void clear(EdictId id);
  void set_free(EdictId id, bool free, float time);

  std::unique_ptr<Word[], Release> words_;
  std::uint32_t stride_ = 0, max_ = 0, count_ = 0, reserved_ = 0;
  std::vector<Info> info_;
  std::vector<std::uint64_t> free_bits_;  // a bit an edict: what alloc() looks through
  EdictListener* listener_ = nullptr;
};

inline bool Edict::is_free() const { return store_->is_free(id_); }

template <typename T>
T Edict::get(Field<T> field) const {
  if (!field) return T{};
  const T value = ValueTraits<T>::load(words_ + field.offset);
  if constexpr (std::is_same_v<T, EdictId>) return store_->valid(value) ? value : EdictId::kWorld;
  return value;
}

}  // namespace fb::progs
