#include "server/autosave.h"

#include "formats/bsp.h"
#include "server/simulation/constants.h"

namespace fb::sv {
namespace {

constexpr float kSwims = 2.0f;  // waterlevel: to the waist
constexpr float kMostInterval = 86400.0f;

}  // namespace

void add_autosave_cvars(con::Console& console) {
  if (console.find_cvar("sv_autosave")) return;
  console.add_cvar({"sv_autosave", "1",
                    "1: a game of one player in a window saves itself as autosave/MAP: when a level begins, after a "
                    "secret and every sv_autosave_interval seconds, out of danger",
                    con::kCvarArchive, 0.0f, 1.0f, true});
  console.add_cvar({"sv_autosave_interval", "30",
                    "seconds of play between autosaves; 0: only when a level begins and after secrets",
                    con::kCvarArchive, 0.0f, kMostInterval});
  console.add_cvar({"sv_autoload", "2",
                    "after death in a game of one player: 0 the level starts over, 1 the menu offers the level's last "
                    "save, 2 it is loaded",
                    con::kCvarArchive, 0.0f, 2.0f, true});
}

bool Autosave::due(const Moment& moment, double interval) {
  if (!began_) {
    began_ = true;
    saved_ = moment.time;
    danger_ = moment.time - kCalm;
    last_ = moment;
  }
  if (moment.health < last_.health || moment.armor < last_.armor || moment.attacks) danger_ = moment.time;
  wants_secret_ |= moment.secrets > last_.secrets;
  last_ = moment;
  if (!moment.safe) return false;
  const double calm = moment.time - danger_;
  if (wants_first_ && calm >= kCalm) return true;
  if (wants_secret_ && calm >= kCalmForSecret) return true;
  return interval > 0.0 && calm >= kCalm && moment.time - saved_ >= interval;
}

void Autosave::saved(double time) {
  saved_ = time;
  wants_first_ = wants_secret_ = false;
}

Autosave::Moment autosave_moment(Level& level, EdictId player) {
  const Edict edict = level.edict(player);
  const float contents = edict.get(fields::watertype);
  const bool burns = edict.get(fields::waterlevel) > 0.0f && (contents == static_cast<float>(formats::kContentsSlime) ||
                                                              contents == static_cast<float>(formats::kContentsLava));
  const bool stands = edict.has_flag(fields::flags, kFlagOnGround) || edict.get(fields::waterlevel) >= kSwims;
  Autosave::Moment moment;
  moment.time = level.time;
  moment.health = edict.get(fields::health);
  moment.armor = edict.get(fields::armorvalue);
  moment.secrets = level.vm->get(globals::found_secrets);
  moment.attacks = edict.get(fields::button0) != 0.0f;
  moment.safe = edict.get(fields::movetype) == static_cast<float>(kMoveWalk) && stands && !burns;
  return moment;
}

}  // namespace fb::sv
