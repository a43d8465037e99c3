#include "server/clients/client_data.h"

#include "server/simulation/user.h"

namespace fb::sv {
namespace {

namespace fields = progs::fields;
using progs::to_int;

// Mods with a field items2 have their items 24 to 32 there; for others these are the runes, which are the game's.
std::int32_t items_of(Level& level, const Edict& player) {
  const auto items = static_cast<std::uint32_t>(to_int(player.get(fields::items)));
  const std::uint32_t more =
      level.optional.items2 ? static_cast<std::uint32_t>(to_int(player.get(level.optional.items2))) << 23u
                            : static_cast<std::uint32_t>(to_int(level.vm->get(progs::globals::serverflags))) << 28u;
  return static_cast<std::int32_t>(items | more);
}

// Quake's weapons fit a byte as they are; the mission packs' are told as the number of the lowest bit.
int active_weapon(const Edict& player, bool standard_quake) {
  const std::int32_t weapon = to_int(player.get(fields::weapon));
  if (standard_quake) return weapon & 0xff;
  return weapon == 0 ? 0 : std::countr_zero(static_cast<std::uint32_t>(weapon));
}

void write_damage(net::MessageWriter& writer, Level& level, Edict player) {
  const float take = player.get(fields::dmg_take), save = player.get(fields::dmg_save);
  if (take == 0.0f && save == 0.0f) return;
  const Edict by = level.edict(player.get(fields::dmg_inflictor));
  const vec3 from = by.get(fields::origin) + 0.5f * (by.get(fields::mins) + by.get(fields::maxs));
  net::write_server_message(writer, net::svc::Damage{to_int(save), to_int(take), from});
  player.set(fields::dmg_take, 0.0f);
  player.set(fields::dmg_save, 0.0f);
}

void write_fixed_angle(net::MessageWriter& writer, Edict player) {
  if (player.get(fields::fixangle) == 0.0f) return;
  net::write_server_message(writer, net::svc::SetAngle{player.get(fields::angles)});
  player.set(fields::fixangle, 0.0f);
}

}  // namespace

net::svc::ClientData client_data(Level& level, EdictId id, bool standard_quake) {
  const Edict player = level.edict(id);
  const auto whole = [&](progs::Field<float> field) { return to_int(player.get(field)); };
  net::svc::ClientData data;
  data.view_height = to_int(player.get(fields::view_ofs).z);
  data.ideal_pitch = whole(fields::idealpitch);
  const vec3 punch = player.get(fields::punchangle), velocity = player.get(fields::velocity);
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    data.punch[i] = to_int(punch[axis]);
    data.velocity[i] = to_int(velocity[axis] / 16.0f);
  }
  data.items = items_of(level, player);
  data.on_ground = player.has_flag(fields::flags, kFlagOnGround);
  data.in_water = player.get(fields::waterlevel) >= 2.0f;
  data.weapon_frame = whole(fields::weaponframe);
  data.armor = whole(fields::armorvalue);
  data.weapon = level.model_index(level.vm->text(player.get(fields::weaponmodel)));
  data.health = whole(fields::health);
  data.ammo = whole(fields::currentammo);
  data.ammo_counts = {whole(fields::ammo_shells), whole(fields::ammo_nails), whole(fields::ammo_rockets),
                      whole(fields::ammo_cells)};
  data.active_weapon = active_weapon(player, standard_quake);
  data.weapon_alpha = data.weapon == 0 ? net::kAlphaDefault : level.extra(id).alpha;  // FitzQuake: as the player's
  return data;
}

void write_client_data(net::MessageWriter& writer, Level& level, EdictId id, bool standard_quake) {
  const Edict player = level.edict(id);
  write_damage(writer, level, player);
  set_ideal_pitch(level, id);
  write_fixed_angle(writer, player);
  net::write_server_message(writer, client_data(level, id, standard_quake));
}

}  // namespace fb::sv
