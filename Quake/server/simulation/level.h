// A level as the server simulates it: the map, the virtual machine with its edicts, and what the server keeps of each
// edict beside QuakeC's fields. Linking, physics, QuakeC's builtins and messages are functions on this; Server owns it.
//
// QuakeC can go wrong in any function that it is called in. run() then keeps the error: whoever runs QuakeC asks
// failed() before going on, and the server ends the level with that sentence.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/maths.h"
#include "base/result.h"
#include "base/rng.h"
#include "console/console.h"
#include "formats/bsp.h"
#include "net/server_messages.h"
#include "progs/autocvars.h"
#include "progs/vm.h"
#include "server/simulation/constants.h"
#include "world/area_nodes.h"
#include "world/hull.h"
#include "world/liquid_windows.h"
#include "world/pvs.h"

namespace fb::sv {

using progs::Edict;
using progs::EdictId;
using progs::FunctionId;
using progs::StringId;
namespace fields = progs::fields;
namespace globals = progs::globals;

// Cvars that the simulation reads each frame, under Quake's names. Registering twice gives the same.
struct Cvars {
  explicit Cvars(con::Console& console);
  const con::Cvar &gravity, &max_velocity, &friction, &edge_friction, &stop_speed, &max_speed, &accelerate, &no_step,
      &aim, &ideal_pitch_scale, &skill, &deathmatch, &coop, &teamplay, &nomonsters, &pausable, &max_edicts, &alt_noclip,
      &freeze_nonclients, &roll_angle, &roll_speed, &clear_liquids, &elevators;
};

// A model made of brushes: the world, "*1" and on of the level's map, or the first model of a .bsp of its own.
struct BrushModel {
  std::shared_ptr<const formats::Bsp> bsp;
  std::shared_ptr<const world::MapHulls> hulls;  // of `bsp`
  std::uint32_t index = 0;                       // of bsp->models
};

// A precached model.
struct LevelModel {
  std::string name;
  std::optional<BrushModel> brush = std::nullopt;  // its hulls are SOLID_BSP's; none: no brush model, or a broken one
  vec3 mins{0.0f}, maxs{0.0f};                     // what setmodel gives: level_files.h
};

// What the server keeps of an edict.
struct EdictExtra {
  world::TouchedLeafs leafs;  // of its box when it was linked last; none without a model
  net::EntityState baseline;
  int alpha = net::kAlphaDefault, scale = net::kScaleDefault;  // encoded
  bool send_interval = false;                                  // nextthink is not at a tenth: clients must be told
};

// Fields that not every mod has.
struct OptionalFields {
  explicit OptionalFields(const progs::Program& program);
  progs::Field<float> gravity;  // factor on sv_gravity; 0: 1
  progs::Field<float> alpha, scale;
  progs::Field<float> items2;
};

// What happens in the simulation that clients must hear of; the server turns it into messages.
class LevelEvents {
 public:
  virtual ~LevelEvents() = default;
  // channel 0 to 7; volume 0 to 1; attenuation 0 to 4. A sample that is not precached: a warning once, no sound.
  virtual void start_sound(EdictId source, int channel, std::string_view sample, float volume, float attenuation) = 0;
};

// Extensions that change how a level behaves. Only for mods that have asked for them (checkextension): others may rely
// on what QuakeSpasm does.
struct AskedExtensions {
  bool rotating_pushers =
      false;                   // DP_SV_ROTATINGBMODEL: avelocity turns pushers, and what is turned blocks as it looks
  bool skin_contents = false;  // FTE_ENT_SKIN_CONTENTS: skin_contents.h
};

class Level final : public progs::EdictListener {
 public:
  // `vm` has started its level (edicts of the world and the clients).
  Level(std::string map_name, std::shared_ptr<const formats::Bsp> bsp, std::unique_ptr<progs::Vm> vm,
        con::Console& console, LevelEvents& events, Rng& rng);
  ~Level() override;

  std::string map_name;  // "e1m1"
  std::shared_ptr<const formats::Bsp> bsp;
  std::shared_ptr<const world::MapHulls> hulls;
  world::LiquidWindows liquid_windows;  // sv_clearliquids
  world::AreaNodes areas;
  std::unique_ptr<progs::Vm> vm;
  progs::Autocvars autocvars;
  Cvars cvars;
  OptionalFields optional;
  AskedExtensions asked;
  const con::Localization& localization;
  LevelEvents& events;
  Rng& rng;  // the engine's, which QuakeC's random() draws from as well

  double time = 1.0;        // seconds, Quake's sv.time: levels begin at 1
  double frame_time = 0.1;  // of the frame that runs, Quake's host_frametime
  int max_clients = 1;
  bool loading = true;  // precaches are allowed
  bool paused = false;
  bool loaded = false;  // from a save: who begins finds its edict as it was saved, then the pause ends
  EdictId last_checked_client = EdictId::kWorld;  // checkclient
  double last_check_time = 0.0;

  // [0] is nothing, as numbers of precached things are from 1.
  std::vector<LevelModel> models = std::vector<LevelModel>(1);
  std::vector<std::string> sounds = std::vector<std::string>(1);
  std::size_t loaded_models = 0, loaded_sounds = 0;  // of both, those that spawning has brought; 0 while it lasts
  std::vector<std::string> light_styles = std::vector<std::string>(64);
  int model_index(std::string_view name) const;  // 0: not precached
  int sound_index(std::string_view name) const;
  // Says once a level what a mod gets wrong and QuakeC may repeat every frame.
  void warn_once(const std::string& sentence);

  progs::EdictStore& edicts() { return vm->edicts(); }
  Edict edict(EdictId id) { return vm->edict(id); }
  Edict world_edict() { return vm->edict(EdictId::kWorld); }
  // The level's name for players: the world's message, in their language.
  std::string_view title() const;
  EdictExtra& extra(EdictId id);  // grows with the edicts
  bool is_client(EdictId id) const { return index(id) >= 1 && index(id) <= static_cast<std::uint32_t>(max_clients); }

  // Calls QuakeC with self, other and time set. Null functions are no calls. False: it failed, now or before.
  bool run(FunctionId function, EdictId self, EdictId other = EdictId::kWorld);
  bool run_at(FunctionId function, EdictId self, EdictId other, double at);  // with another time, as thinks have
  bool failed() const { return error_.has_value(); }
  const std::optional<Error>& error() const { return error_; }
  void fail(std::string cause);

 private:
  void edict_cleared(EdictId id) override;
  void edict_freed(EdictId id) override;

  std::vector<EdictExtra> extra_;
  std::set<std::string> warnings_;
  std::optional<Error> error_;
};

}  // namespace fb::sv
