// The client at the console: its cvars, and the commands that colour the picture.
#include <fmt/format.h>

#include <algorithm>

#include "base/log.h"
#include "client/client_impl.h"
#include "client/session/fog_command.h"
#include "client/session/parse.h"
#include "console/console.h"

namespace fb::cl {
namespace {

// Other modules know some of these cvars, too: who comes first registers.
void ensure_cvar(con::Console& console, con::CvarSpec spec) {
  if (!console.find_cvar(spec.name)) console.add_cvar(std::move(spec));
}

// A number as a cvar's text: "0.02", "90".
std::string text_of(float value) { return fmt::format("{}", value); }

// Those that QuakeSpasm writes into its configuration, and lights of our own.
bool is_archived(std::string_view name) {
  constexpr std::array<std::string_view, 10> kArchived = {
      "fov",      "fov_adapt",   "r_lerpmodels", "r_lerpmove",  "r_particles", "r_viewmodel_quake",
      "viewsize", "r_entlights", "r_ambient",    "r_wateralpha"};
  return std::find(kArchived.begin(), kArchived.end(), name) != kArchived.end();
}

// Numbers that are 0 or 1. The others' ranges are whatever a number may be, as in QuakeSpasm.
bool is_switch(std::string_view name) { return name == "r_authored"; }

con::CvarSpec spec_of(const char* name, float value, const char* help) {
  con::CvarSpec spec{name, text_of(value), help, is_archived(name) ? con::kCvarArchive : con::kCvarPlain};
  if (is_switch(name)) {
    spec.min = 0.0f;
    spec.max = 1.0f;
    spec.integer = true;
  }
  return spec;
}

// What the last message told of, as it is shown.
void print_entities(const ClientState& state) {
  int count = 0;
  for (std::size_t i = 1; i < state.entities.size(); ++i) {
    const Entity& entity = state.entities[i];
    if (entity.model == 0 || entity.message_time != state.message_times[0]) continue;
    const auto model = static_cast<std::size_t>(entity.model);
    const std::string name = model < state.model_names.size() ? state.model_names[model] : "?";
    const vec3 &o = entity.origin, &a = entity.angles;
    log_info("{:3}: {}:{} ({} {} {}) [{} {} {}]", i, name, entity.frame, o.x, o.y, o.z, a.x, a.y, a.z);
    ++count;
  }
  log_info("{} entities", count);
}

}  // namespace

void Client::Impl::read_settings() {
  Settings& s = session.settings;
#define FB_READ(member, name, initial, help) s.member = console.cvar(name).value();
  FB_CLIENT_CVARS(FB_READ)
#undef FB_READ
  const std::string& list = console.cvar("r_nolerp_list").string();
  if (list != nolerp_list) {
    nolerp_list = list;
    s.nolerp_models = split_names(list);
  }
}

void Client::Impl::register_console() {
  if (!console.find_cvar("viewsize"))
    console.add_cvar(
        {"viewsize", "100",
         "up to 100: the picture's size in percent, with the whole status bar; 110: without the inventory; 120: none",
         con::kCvarArchive, 30.0f, 120.0f});
#define FB_REGISTER(member, name, value, help) ensure_cvar(console, spec_of(name, value, help));
  FB_CLIENT_CVARS(FB_REGISTER)
#undef FB_REGISTER
  ensure_cvar(console,
              {"r_nolerp_list", kNoLerpModels, "models whose animation is not interpolated, separated by commas"});

  console.add_command(
      "viewpos", "viewpos: where the player is and looks: (origin) pitch yaw roll", [this](const con::Args&) {
        const Entity* player = session.state.view_entity_state();
        if (!player) return log_info("viewpos: there is no player");
        const vec3 &at = player->origin, &looks = session.state.view_angles;
        log_info("Viewpos: ({:.0f} {:.0f} {:.0f}) {:.0f} {:.0f} {:.0f}", at.x, at.y, at.z, looks.x, looks.y, looks.z);
      });
  console.add_command("entities", "entities: list visible entities: number, model, frame, (origin), [angles]",
                      [this](const con::Args&) { print_entities(session.state); });
  if (!console.has_command("bf"))
    console.add_command("bf", "bf: flash the screen as for a pickup",
                        [this](const con::Args&) { bonus_flash(session.state); });
  if (!console.has_command("v_cshift"))
    console.add_command(
        "v_cshift", "v_cshift <red> <green> <blue> <percent>: set the picture's colour shift",
        [this](const con::Args& args) {
          set_empty_shift(session.state, {args.number(1), args.number(2), args.number(3)}, args.number(4));
        });
  if (!console.has_command("sky"))
    console.add_command("sky", "sky [name]: show a skybox; without a name, the map's own sky",
                        [this](const con::Args& args) {
                          session.state.skybox = args[1];
                          session.state.sky_changed = true;
                        });
  if (!console.has_command("fog"))
    console.add_command(
        "fog",
        "fog <density> [seconds], fog <red> <green> <blue> or fog <density> <red> <green> <blue> [seconds]: change the "
        "fog, at once or in this time; without numbers, say what it is. Further numbers, DarkPlaces', count for "
        "nothing",
        [this](const con::Args& args) {
          const Result<std::string> said = fog_command(session.state, args);
          if (!said.ok())
            log_warning("{}", said.error().message);
          else if (!said->empty())
            log_info("{}", *said);
        });
}

}  // namespace fb::cl
