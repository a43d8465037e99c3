// What a player sees: visibility, limits of protocols and messages, and what it is told of itself.
#include "server/clients/test_clients.h"

namespace fb::sv::testing {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Le;

class SendTest : public ClientsTest {
 protected:
  // Two rooms whose leafs see only each other's own side of x = 0.
  static std::shared_ptr<const formats::Bsp> two_rooms() {
    MapBuilder map(vec3(-1024, -1024, -64), vec3(1024, 1024, 512));
    map.box(vec3(-16, -1024, -64), vec3(16, 1024, 512));
    formats::Bsp bsp = map.build();
    parted(bsp);
    return std::make_shared<formats::Bsp>(std::move(bsp));
  }
  // A hall whose right side is full of water, whose surface at x = 0 was opaque to the compiler of its visibility.
  static std::shared_ptr<const formats::Bsp> beside_water() {
    MapBuilder map(vec3(-1024, -1024, -64), vec3(1024, 1024, 512));
    map.box(vec3(0, -1024, -64), vec3(1024, 1024, 512), formats::kContentsWater);
    formats::Bsp bsp = map.build();
    parted(bsp);
    const auto vertex = static_cast<std::uint32_t>(bsp.vertices.size());
    for (const vec3& at : {vec3(0, -900, -50), vec3(0, 900, -50), vec3(0, 900, 500)}) bsp.vertices.push_back(at);
    if (bsp.edges.empty()) bsp.edges.push_back({0, 0});
    formats::BspFace face{};
    face.first_surfedge = static_cast<std::uint32_t>(bsp.surfedges.size());
    face.surfedge_count = 3;
    for (std::uint32_t k = 0; k < 3; ++k) {
      bsp.surfedges.push_back(static_cast<std::int32_t>(bsp.edges.size()));
      bsp.edges.push_back({vertex + k, vertex + (k + 1) % 3});
    }
    face.plane = static_cast<std::uint32_t>(bsp.planes.size());
    bsp.planes.push_back({vec3(1, 0, 0), 0, 0});
    face.texinfo = static_cast<std::uint32_t>(bsp.texinfos.size());
    bsp.texinfos.emplace_back().texture = static_cast<std::uint32_t>(bsp.textures.size());
    bsp.textures.emplace_back().name = "*water";
    bsp.models[0].first_face = static_cast<std::uint32_t>(bsp.faces.size());
    bsp.models[0].face_count = 1;
    bsp.faces.push_back(face);
    return std::make_shared<formats::Bsp>(std::move(bsp));
  }

 private:
  static void parted(formats::Bsp& bsp) {
    const std::size_t count = bsp.leafs.size() - 1;
    const auto is_left = [&](std::size_t leaf) { return bsp.leafs[leaf].maxs.x <= 0.0f; };
    for (std::size_t leaf = 1; leaf <= count; ++leaf) {
      bsp.leafs[leaf].vis_offset = static_cast<std::int32_t>(bsp.visibility.size());
      for (std::size_t first = 1; first <= count; first += 8) {
        std::uint8_t row = 0;
        for (std::size_t other = first; other < first + 8 && other <= count; ++other)
          if (is_left(other) == is_left(leaf)) row |= static_cast<std::uint8_t>(1u << (other - first));
        bsp.visibility.push_back(row);
        if (row == 0) bsp.visibility.push_back(1);
      }
    }
  }
};

TEST_F(SendTest, WhatCannotBeSeenIsNotSent) {
  bsp_ = two_rooms();
  start_game();
  const auto left = static_cast<int>(spawn({-500, 0, 0})), right = static_cast<int>(spawn({500, 0, 0}));
  FakeClient& player = join();
  place(1, {-200, 0, 0});
  frame();
  EXPECT_TRUE(player.updates.contains(left));
  EXPECT_FALSE(player.updates.contains(right));
  EXPECT_TRUE(player.updates.contains(1));
  place(1, {200, 0, 0});
  frame();
  EXPECT_FALSE(player.updates.contains(left));
  EXPECT_TRUE(player.updates.contains(right));
}

// sv_clearliquids: -1 is 1 for one player alone.
TEST_F(SendTest, WhatClearWaterShowsIsSentWhereItsSurfaceWasOpaque) {
  for (const int players : {1, 4}) {
    for (const int clear : {-1, 0, 1}) {
      bsp_ = beside_water();
      start_game("void() main = {};", players);
      console_.set("sv_clearliquids", std::to_string(clear));
      const auto diver = static_cast<int>(spawn({500, 0, 0}));
      FakeClient& player = join();
      place(1, {-200, 0, 0});
      frame();
      EXPECT_EQ(player.updates.contains(diver), clear < 0 ? players == 1 : clear == 1) << players << ' ' << clear;
    }
  }
}

TEST_F(SendTest, WhatHasNoModelIsNotSent) {
  start_game();
  const auto none = static_cast<int>(spawn({0, 0, 0}, 0.0f)), unnamed = static_cast<int>(spawn({0, 0, 0}));
  edict(static_cast<std::uint32_t>(unnamed)).set(fields::model, StringId::kNull);
  const std::uint32_t removed = spawn({0, 0, 0});
  level_->edicts().free(EdictId{removed}, level_->time);
  FakeClient& player = join();
  EXPECT_FALSE(player.updates.contains(none));
  EXPECT_FALSE(player.updates.contains(unnamed));
  EXPECT_FALSE(player.updates.contains(static_cast<int>(removed)));
}

TEST_F(SendTest, InvisibleThingsAreSentForTheirEffectsOnly) {
  start_game();
  const std::uint32_t id = spawn({0, 0, 0});
  const auto alpha = program_->field<float>("alpha");
  edict(id).set(alpha, -1.0f);
  FakeClient& player = join();
  EXPECT_FALSE(player.updates.contains(static_cast<int>(id)));
  edict(id).set(fields::effects, 64.0f);  // a light of the re-release alone: not this mod's
  frame();
  EXPECT_FALSE(player.updates.contains(static_cast<int>(id)));
  edict(id).set(fields::effects, 8.0f);
  frame();
  EXPECT_EQ(player.seen(static_cast<int>(id)).alpha, net::kAlphaZero);
}

TEST_F(SendTest, LightsOfTheReReleaseAreItsModsOwn) {
  start_game("float EF_QUADLIGHT = 16; float EF_PENTALIGHT = 32; void() main = {};");
  const std::uint32_t id = spawn({0, 0, 0});
  edict(id).set(fields::effects, 48.0f);
  FakeClient& player = join();
  EXPECT_EQ(player.seen(static_cast<int>(id)).effects, 48);
}

TEST_F(SendTest, ExtendedProtocolsShowWideNumbersAlphaAndScale) {
  for (const int protocol : {666, 999}) {
    start_game("void() main = {};", 1, protocol);
    for (int i = 0; i < 300; ++i) level_->models.push_back({fmt::format("progs/{}.mdl", i)});
    const std::uint32_t id = spawn({0, 0, 0}, 280.0f);
    edict(id).set(fields::frame, 300.0f);
    edict(id).set(program_->field<float>("alpha"), 0.5f);
    edict(id).set(program_->field<float>("scale"), 2.5f);
    level_->extra(EdictId{id}).send_interval = true;
    FakeClient& player = join();
    edict(id).set(fields::nextthink, static_cast<float>(level_->time) + 0.1f + 0.2f);
    frame();
    const net::EntityState seen = player.seen(static_cast<int>(id));
    EXPECT_EQ(seen.model, 280);
    EXPECT_EQ(seen.frame, 300);
    EXPECT_EQ(seen.alpha, net::encode_alpha(0.5f));
    EXPECT_EQ(seen.scale, 40);
    EXPECT_EQ(player.updates[static_cast<int>(id)].lerp_finish, 51);
    clients_.drop_all(now_);
    fakes_.clear();
  }
}

TEST_F(SendTest, Protocol15LeavesOutWhatItCannotNumber) {
  LogWatch log;
  start_game("void() main = {};", 1, 15);
  for (int i = 0; i < 300; ++i) {
    level_->models.push_back({fmt::format("progs/{}.mdl", i)});
    level_->sounds.push_back(fmt::format("{}.wav", i));
  }
  const auto high = static_cast<int>(spawn({0, 0, 0}, 280.0f)), low = static_cast<int>(spawn({0, 0, 0}));
  FakeClient& player = join();
  EXPECT_EQ(player.last<svc::ServerInfo>().models.size(), 255u);
  EXPECT_EQ(player.last<svc::ServerInfo>().sounds.size(), 255u);
  EXPECT_THAT(log.text(), HasSubstr("protocol 15 knows 255 models of the level's 303"));
  EXPECT_FALSE(player.updates.contains(high));
  EXPECT_TRUE(player.updates.contains(low));
  clients_.start_sound(EdictId{1}, 0, "299.wav", 1.0f, 1.0f);
  clients_.start_sound(EdictId{1}, 0, "100.wav", 1.0f, 1.0f);
  frame();
  ASSERT_EQ(player.all<svc::Sound>().size(), 1u);
  EXPECT_EQ(player.last<svc::Sound>().sound, 102);
}

TEST_F(SendTest, BaselinesAreWideWhereTheyMust) {
  start_game();
  for (int i = 0; i < 300; ++i) level_->models.push_back({fmt::format("progs/{}.mdl", i)});
  const std::uint32_t id = spawn({1, 2, 3}, 280.0f);
  edict(id).set(fields::model, level_->vm->strings().intern("progs/276.mdl"));
  clients_.begin_level(*level_);
  finish_level();
  FakeClient& player = join();
  EXPECT_EQ(player.baselines[static_cast<int>(id)].model, 280);
  EXPECT_EQ(player.updates[static_cast<int>(id)].bits & net::kUpdateModel, 0u);
  EXPECT_EQ(player.baselines[1].colormap, 1);
  EXPECT_EQ(player.baselines[1].model, 2);
}

// --- limits ----------------------------------------------------------------------------------------------------------

TEST_F(SendTest, AFullDatagramKeepsWhatIsNearAndWhatHappens) {
  LogWatch log;
  start_game();
  std::vector<int> near, far;
  for (int i = 0; i < 300; ++i) far.push_back(static_cast<int>(spawn({900, -900 + i, 0})));
  for (int i = 0; i < 20; ++i) near.push_back(static_cast<int>(spawn({20 + i, 0, 0})));
  FakeClient& player = join(true);
  for (int i = 0; i < 5; ++i) clients_.start_sound(EdictId{1}, i, "a.wav", 1.0f, 1.0f);
  frame();
  EXPECT_THAT(player.sizes, Each(Le(std::size_t{32000})));
  EXPECT_LE(player.datagram_size, net::kDatagramMtu);
  EXPECT_GT(player.datagram_size, net::kDatagramMtu - 50);
  EXPECT_TRUE(player.updates.contains(1));
  for (const int id : near) EXPECT_TRUE(player.updates.contains(id)) << id;
  EXPECT_LT(player.updates.size(), 200u);
  EXPECT_EQ(player.all<svc::Sound>().size(), 5u);
  EXPECT_THAT(log.text(), HasSubstr("sees more than a message of 1400 bytes holds"));
}

TEST_F(SendTest, TooManyEventsAreCutBetweenMessages) {
  start_game("void() main = {};", 1, 15);
  FakeClient& player = join(true);
  player.forget();
  for (int i = 0; i < 500; ++i) clients_.start_particle(vec3(static_cast<float>(i)), vec3(0.0f), 1, 2);
  frame();
  EXPECT_LE(player.datagram_size, 1024u);
  const auto particles = player.all<svc::Particle>();
  EXPECT_GT(particles.size(), 50u);
  EXPECT_EQ(particles.back().origin.x, static_cast<float>(particles.size() - 1));
}

TEST_F(SendTest, WithinTheProgramEverythingFits) {
  start_game();
  for (int i = 0; i < 2000; ++i) spawn({900, -900, 0});
  FakeClient& player = join();
  EXPECT_EQ(player.updates.size(), 2001u);
}

// --- of oneself ------------------------------------------------------------------------------------------------------

TEST_F(SendTest, ToldOfItself) {
  start_game();
  FakeClient& player = join();
  Edict self = edict(1);
  self.set(fields::velocity, vec3(320, -170, 15));
  self.set(fields::punchangle, vec3(-4, 0, 2));
  self.set(fields::view_ofs, vec3(0, 0, -8));
  self.set(fields::items, 4097.0f);
  self.set(fields::weapon, 64.0f);
  self.set(fields::weaponmodel, level_->vm->strings().intern("progs/box.mdl"));
  self.set(fields::weaponframe, 3.0f);
  self.set(fields::armorvalue, 260.0f);
  self.set(fields::currentammo, 300.0f);
  self.set(fields::ammo_shells, 1.0f);
  self.set(fields::ammo_cells, 999.0f);
  self.set(fields::waterlevel, 2.0f);
  self.add_flag(fields::flags, kFlagOnGround);
  level_->vm->set(globals::serverflags, 5.0f);
  frame();
  const auto data = player.last<svc::ClientData>();
  EXPECT_EQ(data.velocity, (std::array<int, 3>{20, -10, 0}));
  EXPECT_EQ(data.punch, (std::array<int, 3>{-4, 0, 2}));
  EXPECT_EQ(data.view_height, -8);
  EXPECT_EQ(static_cast<std::uint32_t>(data.items), 4097u | 5u << 28u);
  EXPECT_EQ(data.active_weapon, 64);
  EXPECT_EQ(data.weapon, 3);
  EXPECT_EQ(data.weapon_frame, 3);
  EXPECT_EQ(data.armor, 260);
  EXPECT_EQ(data.ammo, 300);
  EXPECT_EQ(data.ammo_counts, (std::array<int, 4>{1, 0, 0, 999}));
  EXPECT_TRUE(data.in_water);
  EXPECT_TRUE(data.on_ground);
  clients_.standard_quake = false;
  frame();
  EXPECT_EQ(player.last<svc::ClientData>().active_weapon, 6);
}

TEST_F(SendTest, MoreItemsInItems2) {
  start_game(".float items2; void() main = {};");
  FakeClient& player = join();
  edict(1).set(fields::items, 1.0f);
  edict(1).set(program_->field<float>("items2"), 3.0f);
  frame();
  EXPECT_EQ(player.last<svc::ClientData>().items, 1 | 3 << 23);
}

TEST_F(SendTest, DamageAndTurnedHeadsOnce) {
  start_game();
  FakeClient& player = join();
  player.forget();
  const std::uint32_t by = spawn({100, 0, 50});
  edict(1).set(fields::dmg_take, 30.0f);
  edict(1).set(fields::dmg_save, 5.0f);
  edict(1).set(fields::dmg_inflictor, EdictId{by});
  edict(1).set(fields::angles, vec3(0, 90, 0));
  edict(1).set(fields::fixangle, 1.0f);
  frame(3);
  EXPECT_EQ(player.all<svc::Damage>(), (std::vector<svc::Damage>{{5, 30, vec3(100, 0, 50)}}));
  EXPECT_EQ(player.all<svc::SetAngle>(), (std::vector<svc::SetAngle>{{vec3(0, 90, 0)}}));
  EXPECT_EQ(edict(1).get(fields::dmg_take), 0.0f);
}

TEST_F(SendTest, FragsReachAll) {
  start_game("void() main = {};", 2);
  FakeClient &first = join(), &second = join();
  first.forget();
  second.forget();
  edict(2).set(fields::frags, 3.0f);
  frame(3);
  EXPECT_EQ(first.all<svc::UpdateFrags>(), (std::vector<svc::UpdateFrags>{{1, 3}}));
  EXPECT_EQ(second.all<svc::UpdateFrags>(), (std::vector<svc::UpdateFrags>{{1, 3}}));
}

TEST_F(SendTest, MuzzleFlashesLastAFrame) {
  start_game();
  const std::uint32_t id = spawn({0, 0, 0});
  FakeClient& player = join();
  edict(id).set(fields::effects, 2.0f + 8.0f);
  frame();
  EXPECT_EQ(player.seen(static_cast<int>(id)).effects, 10);
  frame();
  EXPECT_EQ(player.seen(static_cast<int>(id)).effects, 8);
}

}  // namespace
}  // namespace fb::sv::testing
