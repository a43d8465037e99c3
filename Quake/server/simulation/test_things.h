// QuakeC that makes what moves in tests of physics: things with a box, pushers with a model of the map, a player.
// Behind kLevelSource (test_level.h).
#pragma once

namespace fb::sv::testing {

constexpr const char* kThingsSource = R"(
entity(float kind, vector org, vector corner, vector other_corner) make_box = {
  local entity e;
  e = spawn();
  e.movetype = kind;
  e.solid = SOLID_BBOX;
  setsize(e, corner, other_corner);
  setorigin(e, org);
  return e;
};
// As large as a player.
entity(float kind, vector org) make_man = { return make_box(kind, org, '-16 -16 -24', '16 16 32'); };
void(entity e) drop = { self = e; droptofloor(); self = world; };

void() say_blocked = { puts("blocked"); pute(self); pute(other); };
entity(string model, vector org) make_pusher = {
  local entity e;
  e = spawn();
  e.solid = SOLID_BSP;
  e.movetype = MOVETYPE_PUSH;
  setmodel(e, model);
  setorigin(e, org);
  e.nextthink = 1000;
  e.blocked = say_blocked;
  return e;
};

entity player;
void(vector org) make_player = {
  player = nextent(world);
  player.movetype = MOVETYPE_WALK;
  player.solid = SOLID_SLIDEBOX;
  player.health = 100;
  player.flags = FL_CLIENT;
  player.view_ofs = '0 0 22';
  setsize(player, '-16 -16 -24', '16 16 32');
  setorigin(player, org);
};
)";

}  // namespace fb::sv::testing
