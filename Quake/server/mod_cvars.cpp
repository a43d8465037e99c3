#include "server/mod_cvars.h"

namespace fb::sv {
namespace {

struct ModCvar {
  const char* name;
  const char* value;
  const char* help;
  unsigned flags = con::kCvarPlain;
};
constexpr const char* kForMods = "for mods to keep something in";
constexpr const char* kSavedForMods = "for mods to keep something in, also for the next time";
constexpr ModCvar kModCvars[] = {
    {"fraglimit", "0", "frags that end a level of deathmatch; 0: none do"},
    {"timelimit", "0", "minutes that end a level of deathmatch; 0: none do"},
    {"samelevel", "0", "1: levels of deathmatch are followed by themselves"},
    {"noexit", "0", "1: players cannot leave a level of deathmatch by its exit; 2: but for the start"},
    {"developer", "0", "1: shows what mods print for those who make them (dprint)"},
    {"campaign", "0", "1: a campaign of the re-release is played; its mods ask and set it"},
    {"horde", "0", "1: a horde map of the re-release is played; its mods ask and set it"},
    {"sv_cheats", "0", "for mods of the re-release that ask; god and the like need no leave, as in QuakeSpasm"},
    {"pr_checkextension", "1", "0: mods that ask this are not to use extensions of QuakeC"},
    {"gamecfg", "0", kForMods},
    {"temp1", "0", kForMods},
    {"scratch1", "0", kForMods},
    {"scratch2", "0", kForMods},
    {"scratch3", "0", kForMods},
    {"scratch4", "0", kForMods},
    {"savedgamecfg", "0", kSavedForMods, con::kCvarArchive},
    {"saved1", "0", kSavedForMods, con::kCvarArchive},
    {"saved2", "0", kSavedForMods, con::kCvarArchive},
    {"saved3", "0", kSavedForMods, con::kCvarArchive},
    {"saved4", "0", kSavedForMods, con::kCvarArchive},
};

}  // namespace

void add_mod_cvars(con::Console& console, bool registered) {
  for (const ModCvar& cvar : kModCvars)
    if (!console.find_cvar(cvar.name)) console.add_cvar(cvar.name, cvar.value, cvar.help, cvar.flags);
  if (!console.find_cvar("registered"))
    console.add_cvar("registered", registered ? "1" : "0", "whether this is the whole game", con::kCvarRom);
}

}  // namespace fb::sv
