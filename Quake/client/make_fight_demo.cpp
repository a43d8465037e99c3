// make_fight_demo FILE: writes a demo of a fight, from nothing but this source: monsters that run at the camera,
// rockets with their trails, explosions, blood, the weapon in view. LibreQuake's own demos fly through maps where
// nothing happens. It plays on LibreQuake's lqdm3; its models are Quake's by name.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "formats/dem.h"
#include "net/server_messages.h"

namespace {

using namespace fb;
namespace svc = net::svc;

constexpr double kStep = 0.05;  // seconds between messages
constexpr int kMessages = 80;
constexpr vec3 kPlayer{-1936, 720, -40};
constexpr float kPlayerYaw = 337;
constexpr int kEffectMuzzleFlash = 2;

enum Model : int { kWorld = 1, kPlayerModel, kRocketLauncher, kRocket, kOgre, kHellKnight, kWizard, kExplosionSprite };

// A place as the player sees it: units ahead, to the right, and above his feet's level.
struct Place {
  float ahead, right, up;
};
vec3 position(const Place& place) {
  const AxisVectors axes = angle_vectors({0, kPlayerYaw, 0});
  return kPlayer + axes.forward * place.ahead + axes.right * place.right + axes.up * place.up;
}

struct Monster {
  int entity, model;
  Place start;
  float speed;              // towards the player, units a second
  int first_frame, frames;  // of the run
};
constexpr std::array kMonsters{
    Monster{10, kOgre, {250, -70, 0}, 20, 25, 8},      Monster{11, kOgre, {330, 75, 0}, 25, 25, 8},
    Monster{12, kHellKnight, {180, 55, 0}, 15, 29, 8}, Monster{13, kHellKnight, {390, -10, 0}, 40, 29, 8},
    Monster{14, kWizard, {290, -90, 70}, 20, 15, 14},  Monster{15, kWizard, {340, 110, 90}, 20, 15, 14},
};

struct Shot {
  int entity;
  double launched, hits;  // seconds
  Place target;
};
constexpr std::array kShots{Shot{30, 0.3, 0.8, {320, 0, 20}}, Shot{31, 1.1, 1.7, {300, 80, 30}},
                            Shot{32, 1.9, 2.4, {270, -30, 20}}, Shot{33, 2.7, 3.3, {340, 10, 30}}};

svc::EntityUpdate placed(int entity, int model, const vec3& origin, const vec3& angles, int frame = 0,
                         int effects = 0) {
  svc::EntityUpdate u;
  u.bits = net::kUpdateModel | net::kUpdateOrigin1 | net::kUpdateOrigin2 | net::kUpdateOrigin3 | net::kUpdateAngle1 |
           net::kUpdateAngle2 | net::kUpdateAngle3 | net::kUpdateFrame | net::kUpdateEffects;
  u.entity = entity;
  u.model = model;
  u.origin = origin;
  u.angles = angles;
  u.frame = frame;
  u.effects = effects;
  return u;
}

void add_shot(std::vector<net::ServerMessage>& messages, const Shot& shot, double now) {
  const vec3 muzzle = position({24, 0, 10}), target = position(shot.target), way = target - muzzle;
  if (now >= shot.launched && now < shot.hits) {
    const auto part = static_cast<float>((now - shot.launched) / (shot.hits - shot.launched));
    const vec3 angles{0, degrees(std::atan2(way.y, way.x)), 0};
    messages.emplace_back(placed(shot.entity, kRocket, muzzle + way * part, angles));
  }
  if (now >= shot.hits && now < shot.hits + kStep) {
    svc::TempEntity explosion;
    explosion.type = net::TempEntityType::kExplosion;
    explosion.origin = target;
    messages.emplace_back(explosion);
    messages.emplace_back(svc::Particle{target, {4, 0, 8}, 40, 73});  // blood
  }
  // The sprite's six images at ten a second.
  const int image = static_cast<int>(std::floor((now - shot.hits) * 10));
  if (now >= shot.hits && image < 6)
    messages.emplace_back(placed(shot.entity, kExplosionSprite, target, vec3(0.0f), image));
}

std::vector<net::ServerMessage> moment(double now) {
  svc::ClientData player;
  player.health = 100;
  player.on_ground = true;
  player.weapon = kRocketLauncher;
  player.active_weapon = 32;
  player.ammo = 20;
  int effects = 0;
  for (const Shot& shot : kShots) {
    const double since = now - shot.launched;
    if (since < 0 || since > 0.6) continue;
    player.weapon_frame = 1 + static_cast<int>(since * 10);
    if (since < 0.1) effects = kEffectMuzzleFlash;
  }
  std::vector<net::ServerMessage> messages{svc::Time{static_cast<float>(1.0 + now)}, player};
  messages.emplace_back(placed(1, kPlayerModel, kPlayer, {0, kPlayerYaw, 0}, 0, effects));
  for (const Monster& m : kMonsters) {
    Place place = m.start;
    place.ahead -= m.speed * static_cast<float>(now);
    const int frame = m.first_frame + static_cast<int>(now * 10) % m.frames;
    messages.emplace_back(placed(m.entity, m.model, position(place), {0, kPlayerYaw - 180, 0}, frame));
  }
  for (const Shot& shot : kShots) add_shot(messages, shot, now);
  return messages;
}

void append(Bytes& demo, const std::vector<net::ServerMessage>& messages) {
  net::MessageWriter writer{net::Protocol{}};
  for (const net::ServerMessage& message : messages) net::write_server_message(writer, message);
  formats::append_dem_message(demo, {0, kPlayerYaw, 0}, writer.take());
}

Bytes make_demo() {
  Bytes demo{'-', '1', '\n'};
  svc::ServerInfo info;
  info.max_clients = 1;
  info.level_name = "A fight";
  info.models = {"maps/lqdm3.bsp", "progs/player.mdl",  "progs/v_rock2.mdl", "progs/missile.mdl",
                 "progs/ogre.mdl", "progs/hknight.mdl", "progs/wizard.mdl",  "progs/s_explod.spr"};
  info.sounds = {"misc/null.wav"};
  append(demo, {info, svc::SetView{1}, svc::SignonNum{1}});
  std::vector<net::ServerMessage> baselines;
  baselines.emplace_back(svc::SpawnBaseline{1, {}, false});
  for (const Monster& m : kMonsters) baselines.emplace_back(svc::SpawnBaseline{m.entity, {}, false});
  for (const Shot& shot : kShots) baselines.emplace_back(svc::SpawnBaseline{shot.entity, {}, false});
  baselines.emplace_back(svc::SignonNum{2});
  append(demo, baselines);
  append(demo, {svc::SignonNum{3}});
  for (int i = 0; i < kMessages; ++i) append(demo, moment(i * kStep));
  append(demo, {svc::Disconnect{}});
  return demo;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: make_fight_demo FILE.dem\n");
    return 2;
  }
  const Bytes demo = make_demo();
  std::ofstream file(argv[1], std::ios::binary);
  file.write(reinterpret_cast<const char*>(demo.data()), static_cast<std::streamsize>(demo.size()));
  if (!file.flush()) {
    fmt::print(stderr, "make_fight_demo: {} cannot be written\n", argv[1]);
    return 1;
  }
  return 0;
}
