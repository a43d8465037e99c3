// What messages sound like, and from where it is heard.
#include "client/session/sounds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "client/session/test_session.h"
#include "formats/test_bsp.h"
#include "world/pvs.h"

namespace fb::cl {
namespace {

struct Listening : test::ToldSession {
  Listening() {
    sound_listener = [this](const scene::SoundEvent& event) { events.push_back(event); };
  }
  template <typename T>
  const T& last() {
    const T* event = events.empty() ? nullptr : std::get_if<T>(&events.back());
    EXPECT_TRUE(event) << "after " << events.size();
    static const T kNone;
    return event ? *event : kNone;
  }
  std::vector<scene::SoundEvent> events;
};

TEST(Sounds, OfEntities) {
  Listening session;
  session.tell({net::svc::Sound{7, 3, 1, 51, 128, vec3(8, 16, 24)}});
  const auto& start = session.last<scene::SoundStart>();
  EXPECT_EQ(start.name, "misc/null.wav");
  EXPECT_EQ(start.entity, 7);
  EXPECT_EQ(start.channel, 3);
  EXPECT_EQ(start.origin, vec3(8, 16, 24));
  EXPECT_FLOAT_EQ(start.volume, 0.2f);
  EXPECT_FLOAT_EQ(start.attenuation, 2.0f);
  session.tell({net::svc::StopSound{7, 3}});
  EXPECT_EQ(session.last<scene::SoundStop>().entity, 7);
  EXPECT_EQ(session.last<scene::SoundStop>().channel, 3);
  session.tell({net::svc::SpawnStaticSound{vec3(8, 0, 0), 1, 255, 192, false}});
  EXPECT_FLOAT_EQ(session.last<scene::SoundLoop>().attenuation, 3.0f);
  EXPECT_FLOAT_EQ(session.last<scene::SoundLoop>().volume, 1.0f);
  const std::size_t count = session.events.size();
  session.tell({net::svc::Sound{7, 3, 200, 255, 64, vec3(0.0f)}});
  EXPECT_EQ(session.events.size(), count) << "a sound that the level has not";
}

TEST(Sounds, OfLevelsMusicAndTalk) {
  Listening session;
  session.tell({net::svc::CdTrack{4, 4}});
  EXPECT_EQ(session.last<scene::SoundTrack>().track, 4);
  session.forced_track = 7;
  session.tell({net::svc::CdTrack{4, 4}});
  EXPECT_EQ(session.last<scene::SoundTrack>().track, 7) << "a demo's own track";
  session.tell({net::svc::Print{"\001player: hello\n"}});
  EXPECT_EQ(session.last<scene::SoundStart>().name, "misc/talk.wav");
  EXPECT_EQ(session.last<scene::SoundStart>().entity, 1);
  EXPECT_EQ(session.last<scene::SoundStart>().channel, scene::kAnyChannel);
  session.events.clear();
  session.tell({net::svc::Print{"hello\n"}});
  EXPECT_TRUE(session.events.empty());
  session.tell({test::server_info({})});
  EXPECT_EQ(session.last<scene::SoundLevel>().names, std::vector<std::string>{"misc/null.wav"});
}

TEST(Sounds, OfTempEntities) {
  Listening session;
  const auto sound_of = [&](net::TempEntityType type) {
    session.events.clear();
    net::svc::TempEntity message;
    message.type = type;
    message.origin = vec3(16, 0, 0);
    session.tell({message});
    return session.events.empty() ? std::string("none") : session.last<scene::SoundStart>().name;
  };
  EXPECT_EQ(sound_of(net::TempEntityType::kExplosion), "weapons/r_exp3.wav");
  EXPECT_EQ(sound_of(net::TempEntityType::kTarExplosion), "weapons/r_exp3.wav");
  EXPECT_EQ(sound_of(net::TempEntityType::kWizSpike), "wizard/hit.wav");
  EXPECT_EQ(sound_of(net::TempEntityType::kKnightSpike), "hknight/hit.wav");
  EXPECT_EQ(sound_of(net::TempEntityType::kGunshot), "none");
  EXPECT_EQ(sound_of(net::TempEntityType::kTeleport), "none");
  std::multiset<std::string> spikes;
  for (int i = 0; i < 1000; ++i) spikes.insert(sound_of(net::TempEntityType::kSpike));
  EXPECT_NEAR(static_cast<double>(spikes.count("weapons/tink1.wav")), 800, 50);
  EXPECT_NEAR(static_cast<double>(spikes.count("weapons/ric1.wav")), 50, 30);
  EXPECT_NEAR(static_cast<double>(spikes.count("weapons/ric3.wav")), 100, 40);
}

TEST(Sounds, AreHeardFromTheEyesAndTheirLeaf) {
  const Listening session;
  formats::Bsp map = formats::testing::box_room(formats::BspVersion::kBsp29);
  const std::uint32_t leaf = world::pvs_leaf(map, vec3(0.0f));
  map.leafs[leaf].ambient = {9, 8, 7, 6};
  map.leafs[leaf].contents = formats::kContentsWater;
  const scene::SoundScene heard = sound_scene(session, vec3(0.0f), vec3(0, 90, 0), &map);
  EXPECT_EQ(heard.entity, 1);
  EXPECT_EQ(heard.ambient, (std::array<std::uint8_t, 4>{9, 8, 7, 6}));
  EXPECT_TRUE(heard.underwater);
  EXPECT_NEAR(heard.right.x, 1.0f, 1e-6f) << "looking along y, x is to the right";
  map.leafs[leaf].contents = formats::kContentsEmpty;
  EXPECT_FALSE(sound_scene(session, vec3(0.0f), vec3(0.0f), &map).underwater);
  EXPECT_EQ(sound_scene(session, vec3(5.0f), vec3(0.0f), nullptr).right, vec3(0.0f)) << "no map, no direction";
}

}  // namespace
}  // namespace fb::cl
