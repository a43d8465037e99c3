// LibreQuake's maps for tests: the data, and QuakeC for what stands in them beside the rules of testdemos/rules.
#pragma once

#include <filesystem>

#include "base/librequake.h"
#include "fs/options.h"

namespace fb::sv::testing {

// For FileSystem::open.
inline fs::FsOptions game_data_options() {
  fs::FsOptions options;
  options.base_dir = librequake_folder();
  options.user_dir = "";
  return options;
}
inline std::string game_data_lacks() { return librequake_lacks("id1/pak1.pak"); }

// Monsters and items. What monsters do is the test's: monster_think, and first_delay(), seconds until they begin.
constexpr const char* kInhabitants = R"qc(
void() monster_start = {
  droptofloor();
  self.yaw_speed = 20;
  self.goalentity = world;
  self.think = monster_think;
  self.nextthink = time + 0.1;
};
void() monster = {
  self.solid = SOLID_SLIDEBOX;
  self.movetype = 4;
  self.takedamage = 2;
  self.health = 60;
  setmodel(self, "progs/player.mdl");
  setsize(self, '-16 -16 -24', '16 16 40');
  self.flags = self.flags | 32;
  self.think = monster_start;
  self.nextthink = time + 0.1 + first_delay();
};
void() monster_army = { monster(); };
void() monster_dog = { monster(); };
void() monster_enforcer = { monster(); };
void() monster_knight = { monster(); };
void() monster_hell_knight = { monster(); };
void() monster_ogre = { monster(); };
void() monster_zombie = { monster(); };
void() monster_wizard = { monster(); self.flags = self.flags | 1; };
void() monster_fish = { monster(); self.flags = self.flags | 2; };
void() monster_shambler = { monster(); };
void() monster_demon1 = { monster(); };
void() item_start = { self.movetype = MOVETYPE_TOSS; self.velocity = '0 0 0'; if (!droptofloor()) remove(self); };
void() item_touch = { if (other.flags & 32) { other.health = other.health + 10; remove(self); } };
void() item = {
  precache_model("maps/b_bh25.bsp");
  setmodel(self, "maps/b_bh25.bsp");
  self.solid = SOLID_TRIGGER;
  self.touch = item_touch;
  self.nextthink = time + 0.2;
  self.think = item_start;
};
void() item_health = { item(); };
void() item_shells = { item(); setsize(self, '0 0 0', '32 32 56'); };
void() item_spikes = { item(); };
void() item_rockets = { item(); };
void() item_armor1 = { item(); };
)qc";

}  // namespace fb::sv::testing
