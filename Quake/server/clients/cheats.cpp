#include "server/clients/cheats.h"

#include <fmt/format.h>

#include <array>

#include "base/number.h"
#include "server/simulation/link.h"

namespace fb::sv {
namespace {

namespace fields = progs::fields;
using progs::to_int;

// Quake's items and weapons; the mission packs use some of the bits for other things.
constexpr std::int32_t kShotgun = 1, kSuperShotgun = 2, kNailgun = 4, kSuperNailgun = 8, kGrenadeLauncher = 16,
                       kRocketLauncher = 32, kLightning = 64;
constexpr double kFarthest = 1e6;  // units: as far as a map's vertices may be
constexpr double kMostGiven = 1e6;
constexpr std::array<std::int32_t, 3> kArmors = {8192, 16384, 32768};
constexpr std::int32_t kProximityGun = 1 << 16, kMjolnir = 1 << 7, kLaserCannon = 1 << 23;    // hipnotic
constexpr std::int32_t kLavaNailgun = 4096, kLavaSuperNailgun = 8192, kMultiGrenade = 16384,  // rogue
    kMultiRocket = 32768, kPlasmaGun = 65536;

// "god" turns it over, "god 1" and "god 0" say how it shall be.
bool wanted(const con::Args& args, bool is) { return args.size() > 1 ? args.number(1) != 0.0f : !is; }

std::string toggle_flag(const CheatCall& call, std::int32_t flag, const char* what) {
  Edict player = call.level.edict(call.player);
  const bool on = wanted(call.args, player.has_flag(fields::flags, flag));
  on ? player.add_flag(fields::flags, flag) : player.remove_flag(fields::flags, flag);
  return fmt::format("{} {}\n", what, on ? "ON" : "OFF");
}

std::string toggle_movement(const CheatCall& call, int movetype, const char* what) {
  Edict player = call.level.edict(call.player);
  const bool on = wanted(call.args, player.get(fields::movetype) == static_cast<float>(movetype));
  player.set(fields::movetype, static_cast<float>(on ? movetype : kMoveWalk));
  return fmt::format("{} {}\n", what, on ? "ON" : "OFF");
}

std::string god(const CheatCall& call) { return toggle_flag(call, kFlagGodMode, "godmode"); }
std::string notarget(const CheatCall& call) { return toggle_flag(call, kFlagNoTarget, "notarget"); }
std::string fly(const CheatCall& call) { return toggle_movement(call, kMoveFly, "flymode"); }
std::string noclip(const CheatCall& call) { return toggle_movement(call, kMoveNoClip, "noclip"); }

std::string setpos(const CheatCall& call) {
  const con::Args& args = call.args;
  Edict player = call.level.edict(call.player);
  if (args.size() != 4 && args.size() != 7) {
    const vec3 at = player.get(fields::origin), angles = player.get(fields::v_angle);
    return fmt::format("usage: setpos <x> <y> <z> [<pitch> <yaw> <roll>]\nnow: {} {} {} {} {} {}\n", to_int(at.x),
                       to_int(at.y), to_int(at.z), to_int(angles.x), to_int(angles.y), to_int(angles.z));
  }
  std::array<float, 6> numbers{};
  for (std::size_t i = 1; i < args.size(); ++i) {
    const auto number = number_in("setpos", args[i], -kFarthest, kFarthest);
    if (!number) return number.error().message + "\n";
    numbers[i - 1] = static_cast<float>(*number);
  }
  std::string said;
  if (player.get(fields::movetype) != static_cast<float>(kMoveNoClip)) {
    player.set(fields::movetype, static_cast<float>(kMoveNoClip));
    said = "noclip ON\n";
  }
  player.set(fields::velocity, vec3(0.0f));
  player.set(fields::origin, vec3(numbers[0], numbers[1], numbers[2]));
  if (args.size() == 7) {
    player.set(fields::angles, vec3(numbers[3], numbers[4], numbers[5]));
    player.set(fields::fixangle, 1.0f);
  }
  link_edict(call.level, call.player);
  return said;
}

// --- give ------------------------------------------------------------------------------------------------------------

bool is_rogue(Level& level) { return static_cast<bool>(level.vm->program().field<float>("ammo_lava_nails")); }

// Rogue keeps ammunition for its own weapons apart, in fields that nobody else has; what is shown is that of the weapon
// in hand.
void give_ammo(Level& level, Edict player, progs::Field<float> shown, const char* quakes, const char* rogues,
               bool rogues_own, float amount) {
  const progs::Program& program = level.vm->program();
  const auto kept = program.field<float>(rogues_own ? rogues : quakes);
  if (!kept) {
    if (!rogues_own) player.set(shown, amount);
    return;
  }
  player.set(kept, amount);
  const bool holds_rogues = player.get(fields::weapon) > static_cast<float>(kLightning);
  if (holds_rogues == rogues_own) player.set(shown, amount);
}

void give_armor(Edict player, int amount) {
  if (amount < 0) return;
  constexpr std::array<float, 3> kTypes = {0.3f, 0.6f, 0.8f};
  const std::size_t kind = amount > 150 ? 2 : amount > 100 ? 1 : 0;
  for (const std::int32_t armor : kArmors) player.remove_flag(fields::items, armor);
  player.add_flag(fields::items, kArmors[kind]);
  player.set(fields::armortype, kTypes[kind]);
  player.set(fields::armorvalue, static_cast<float>(amount));
}

// "give 7" is the rocket launcher: weapons by the keys that choose them.
void give_weapon(Edict player, std::string_view which, bool hipnotic) {
  if (hipnotic && which == "6a") return player.add_flag(fields::items, kProximityGun);
  if (hipnotic && which[0] == '9') return player.add_flag(fields::items, kLaserCannon);
  if (hipnotic && which[0] == '0') return player.add_flag(fields::items, kMjolnir);
  if (which[0] >= '2') player.add_flag(fields::items, kShotgun << (which[0] - '2'));
}

// So that the status bar is right at once.
void update_current_ammo(Level& level, Edict player) {
  const bool rogue = is_rogue(level);
  const auto show = [&](progs::Field<float> ammo) { player.set(fields::currentammo, player.get(ammo)); };
  switch (to_int(player.get(fields::weapon))) {
    case kShotgun:
    case kSuperShotgun:
      return show(fields::ammo_shells);
    case kNailgun:
    case kSuperNailgun:
    case kLavaSuperNailgun:
      return show(fields::ammo_nails);
    case kGrenadeLauncher:
    case kRocketLauncher:
    case kMultiGrenade:
    case kMultiRocket:
      return show(fields::ammo_rockets);
    case kLightning:
    case kLaserCannon:
    case kMjolnir:
      return show(fields::ammo_cells);
    case kLavaNailgun:  // Quake's axe
      if (rogue) show(fields::ammo_nails);
      return;
    case kPlasmaGun:  // hipnotic's proximity gun
      return show(rogue ? fields::ammo_cells : fields::ammo_rockets);
    default:
      return;
  }
}

std::string give(const CheatCall& call) {
  Level& level = call.level;
  Edict player = level.edict(call.player);
  const std::string& what = call.args[1];
  if (what.empty()) return "usage: give <what> [<how many>]\n";
  const auto number = number_in("give " + what, call.args.size() > 2 ? call.args[2] : "0", -kMostGiven, kMostGiven);
  if (!number) return number.error().message + "\n";
  const int count = static_cast<int>(*number);
  const auto amount = static_cast<float>(count);
  const auto ammo = [&](progs::Field<float> shown, const char* quakes, const char* rogues, bool rogues_own) {
    give_ammo(level, player, shown, quakes, rogues, rogues_own, amount);
  };
  switch (what[0]) {
    case 's':
      player.set(level.vm->program().field<float>("ammo_shells1"), amount);
      player.set(fields::ammo_shells, amount);
      break;
    case 'n':
    case 'l':
      ammo(fields::ammo_nails, "ammo_nails1", "ammo_lava_nails", what[0] == 'l');
      break;
    case 'r':
    case 'm':
      ammo(fields::ammo_rockets, "ammo_rockets1", "ammo_multi_rockets", what[0] == 'm');
      break;
    case 'c':
    case 'p':
      ammo(fields::ammo_cells, "ammo_cells1", "ammo_plasma", what[0] == 'p');
      break;
    case 'h':
      player.set(fields::health, amount);
      break;
    case 'a':
      give_armor(player, count);
      break;
    default:
      if (what[0] >= '0' && what[0] <= '9') give_weapon(player, what, call.mission_pack && !is_rogue(level));
  }
  update_current_ammo(level, player);
  return {};
}

struct Row {
  std::string_view name;
  Cheat cheat;
};
constexpr Row kCheats[] = {{"god", god},       {"notarget", notarget}, {"fly", fly},
                           {"noclip", noclip}, {"give", give},         {"setpos", setpos}};

}  // namespace

Cheat find_cheat(std::string_view name) {
  for (const Row& row : kCheats)
    if (con::same_name(row.name, name)) return row.cheat;
  return nullptr;
}

}  // namespace fb::sv
