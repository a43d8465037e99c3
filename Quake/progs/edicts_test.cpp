#include "progs/edicts.h"

#include <gmock/gmock.h>

#include "progs/system_defs.h"

namespace fb::progs {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::uint32_t kWords = kSystemFields + 3;

EdictStore make_store(std::uint32_t max_edicts, std::uint32_t clients = 1) {
  auto store = EdictStore::create(kWords, max_edicts);
  EXPECT_TRUE(store.ok());
  store->start_level(clients);
  return std::move(store).value();
}

std::uint32_t alloc(EdictStore& store, double time) {
  const auto id = store.alloc(time);
  EXPECT_TRUE(id.ok()) << id.error().message;
  return id.ok() ? index(*id) : 0;
}

TEST(Edicts, ComeInOrderBehindTheClients) {
  EdictStore store = make_store(16, 4);
  EXPECT_EQ(store.count(), 5u);
  EXPECT_EQ(alloc(store, 10), 5u);
  EXPECT_EQ(alloc(store, 10), 6u);
  EXPECT_EQ(store.count(), 7u);
}

TEST(Edicts, AreNotUsedAgainForHalfASecond) {
  EdictStore store = make_store(16);
  for (int i = 0; i < 4; ++i) alloc(store, 10);
  store.free(EdictId{4}, 10.0);
  store.free(EdictId{3}, 10.25);
  EXPECT_EQ(alloc(store, 10.5), 6u);  // neither is old enough: exactly half a second is not more
  EXPECT_EQ(alloc(store, 10.6), 4u);  // the lower one is too young
  EXPECT_EQ(alloc(store, 10.76), 3u);
}

TEST(Edicts, AreUsedAgainAtOnceAsALevelBegins) {
  EdictStore store = make_store(16);
  for (int i = 0; i < 3; ++i) alloc(store, 1);
  store.free(EdictId{3}, 1.99);
  store.free(EdictId{2}, 2.0);
  EXPECT_EQ(alloc(store, 2.01), 3u);
  EXPECT_EQ(alloc(store, 2.01), 5u);
}

TEST(Edicts, RunOut) {
  EdictStore store = make_store(4);
  alloc(store, 10);
  alloc(store, 10);
  const auto id = store.alloc(10);
  ASSERT_FALSE(id.ok());
  EXPECT_THAT(id.error().message, HasSubstr("all 4 (max_edicts)"));
  store.free(EdictId{3}, 10);
  EXPECT_FALSE(store.alloc(10.4).ok());
  EXPECT_EQ(alloc(store, 11), 3u);
}

TEST(Edicts, ManyFreeOnesAreFoundInOrder) {
  EdictStore store = make_store(1000);
  for (int i = 2; i < 900; ++i) alloc(store, 1);
  for (const std::uint32_t i : {64u, 63u, 128u, 700u, 65u}) store.free(EdictId{i}, 1);
  std::vector<std::uint32_t> found;
  for (int i = 0; i < 6; ++i) found.push_back(alloc(store, 5));
  EXPECT_THAT(found, ElementsAre(63, 64, 65, 128, 700, 900));
}

TEST(Edicts, FreeingClearsWhatWouldStillAct) {
  EdictStore store = make_store(16);
  Edict edict = store[EdictId{alloc(store, 5)}];
  for (std::uint32_t i = 0; i < kWords; ++i) edict.words()[i] = as_word(7.0f);
  store.free(edict.id(), 5);
  EXPECT_TRUE(edict.is_free());
  EXPECT_EQ(edict.get(fields::model), StringId::kNull);
  for (const auto field :
       {fields::takedamage, fields::modelindex, fields::colormap, fields::skin, fields::frame, fields::solid}) {
    EXPECT_EQ(edict.get(field), 0.0f);
  }
  EXPECT_EQ(edict.get(fields::origin), vec3(0));
  EXPECT_EQ(edict.get(fields::angles), vec3(0));
  EXPECT_EQ(edict.get(fields::nextthink), -1.0f);
  EXPECT_EQ(edict.get(fields::health), 7.0f);  // the rest stays to be looked at
  EXPECT_EQ(alloc(store, 6), index(edict.id()));
  for (std::uint32_t i = 0; i < kWords; ++i) ASSERT_EQ(edict.words()[i], 0u) << i;
}

TEST(Edicts, TheWorldAndClientsStay) {
  EdictStore store = make_store(16, 2);
  for (std::uint32_t i = 0; i <= 2; ++i) {
    store[EdictId{i}].set(fields::takedamage, 1.0f);
    store.free(EdictId{i}, 5);
    EXPECT_FALSE(store.is_free(EdictId{i}));
    EXPECT_EQ(store[EdictId{i}].get(fields::takedamage), 1.0f);
  }
}

TEST(Edicts, EachHasItsOwnWords) {
  EdictStore store = make_store(16);
  Edict a = store[EdictId{alloc(store, 5)}], b = store[EdictId{alloc(store, 5)}];
  a.set(fields::health, 1.0f);
  b.set(fields::health, 2.0f);
  EXPECT_EQ(a.get(fields::health), 1.0f);
  EXPECT_EQ(b.words() - a.words(), static_cast<std::ptrdiff_t>(kWords));
}

TEST(Edicts, AbsentFieldsAndEntitiesThatAreNone) {
  EdictStore store = make_store(16);
  Edict edict = store[EdictId{1}];
  const Field<float> absent;
  edict.set(absent, 5.0f);
  EXPECT_EQ(edict.get(absent), 0.0f);
  EXPECT_EQ(edict.get_or(absent, 3.0f), 3.0f);
  edict.set(fields::enemy, EdictId{1});
  EXPECT_EQ(edict.get(fields::enemy), EdictId{1});
  edict.set(fields::enemy, EdictId{0xffffffff});
  EXPECT_EQ(edict.get(fields::enemy), EdictId::kWorld);
}

TEST(Edicts, Flags) {
  EdictStore store = make_store(16);
  Edict edict = store[EdictId{1}];
  edict.add_flag(fields::flags, 512);
  edict.add_flag(fields::flags, 8);
  edict.remove_flag(fields::flags, 8);
  EXPECT_EQ(edict.get(fields::flags), 512.0f);
  EXPECT_TRUE(edict.has_flag(fields::flags, 512));
  EXPECT_FALSE(edict.has_flag(fields::flags, 8));
}

TEST(Edicts, ComeBackByNumberFromASave) {
  EdictStore store = make_store(16);
  EXPECT_TRUE(store.revive(EdictId{5}).ok());
  EXPECT_EQ(store.count(), 6u);
  EXPECT_TRUE(store.is_free(EdictId{3}));
  EXPECT_FALSE(store.is_free(EdictId{5}));
  EXPECT_EQ(alloc(store, 100), 2u);
  const auto beyond = store.revive(EdictId{16});
  ASSERT_FALSE(beyond.ok());
  EXPECT_THAT(beyond.error().message, HasSubstr("edict 16 is beyond the 16"));
}

TEST(Edicts, ALevelBeginsClean) {
  EdictStore store = make_store(16);
  Edict edict = store[EdictId{alloc(store, 50)}];
  edict.set(fields::health, 5.0f);
  store.free(edict.id(), 50);
  store.start_level(1);
  EXPECT_EQ(store.count(), 2u);
  EXPECT_EQ(alloc(store, 1), 2u);
  EXPECT_EQ(store[EdictId{2}].get(fields::health), 0.0f);
}

TEST(Edicts, TheListenerHears) {
  struct Listener : EdictListener {
    void edict_cleared(EdictId id) override { add('+', id); }
    void edict_freed(EdictId id) override { add('-', id); }
    void add(char sign, EdictId id) { heard.append(1, sign).append(std::to_string(index(id))); }
    std::string heard;
  } listener;
  EdictStore store = make_store(16);
  store.set_listener(&listener);
  alloc(store, 1);
  alloc(store, 1);
  store.free(EdictId{2}, 1);
  store.free(EdictId{2}, 1);  // twice is once
  alloc(store, 1);
  EXPECT_EQ(listener.heard, "+2+3-2+2");
}

TEST(Edicts, TooManyAreRefused) {
  EXPECT_FALSE(EdictStore::create(kSystemFields, 0).ok());
  EXPECT_FALSE(EdictStore::create(65538, 1u << 20u).ok());
}

}  // namespace
}  // namespace fb::progs
