// When a game of one player saves itself, after Ironwail's sv_autosave: when a level begins, soon after a secret has
// been found, and every sv_autosave_interval seconds of play, each time once the player is out of danger: stands or
// swims safely, has not been hurt and has not fired for a while. Loading, the player's own saves and autosaves begin
// the interval anew.
#pragma once

#include "console/console.h"
#include "server/simulation/level.h"

namespace fb::sv {

// sv_autosave, sv_autosave_interval and sv_autoload, unless the console has them.
void add_autosave_cvars(con::Console& console);

class Autosave {
 public:
  Autosave() = default;
  // A level has begun; from a save, which needs no other at once.
  explicit Autosave(bool loaded) : wants_first_(!loaded) {}

  // What is judged of a player, once a tick.
  struct Moment {
    double time = 0.0;  // the level's, seconds
    float health = 0.0f, armor = 0.0f;
    float secrets = 0.0f;  // found so far
    bool attacks = false;
    bool safe = false;  // stands or swims, and not in what burns
  };
  // Whether to save now. `interval`: seconds; 0: only at the beginning and for secrets.
  bool due(const Moment& moment, double interval);
  // The game has been saved, or could not be, which is not tried again every tick.
  void saved(double time);

 private:
  static constexpr double kCalm = 4.0, kCalmForSecret = 1.0;  // seconds since the last danger

  bool wants_first_ = false, wants_secret_ = false, began_ = false;
  double saved_ = 0.0, danger_ = 0.0;  // when
  Moment last_;
};

// The player of this edict now.
Autosave::Moment autosave_moment(Level& level, EdictId player);

}  // namespace fb::sv
