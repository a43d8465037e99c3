#include "server/mod_cvars.h"

namespace fb::sv {
namespace {

struct ModCvar {
  const char* name;
  const char* value;
  const char* help;
  unsigned flags = con::kCvarPlain;
};
constexpr const char* kForMods = "free for mods to use";
constexpr const char* kSavedForMods = "free for mods to use; saved in config.cfg";
constexpr ModCvar kModCvars[] = {
    {"fraglimit", "0", "frags that end a deathmatch level; 0: no limit"},
    {"timelimit", "0", "minutes after which a deathmatch level ends; 0: no limit"},
    {"samelevel", "0", "1: a deathmatch level is played again when it ends"},
    {"noexit", "0", "1: a level's exit kills the player who touches it; 2: except on the map start"},
    {"developer", "0", "1: print the mod's debugging messages (dprint)"},
    {"campaign", "0", "the re-release's flag for a campaign, which its mods read and set"},
    {"horde", "0", "the re-release's flag for horde mode, which its mods read and set"},
    {"sv_cheats", "0",
     "the re-release's flag for cheats, which its mods read; god, give and noclip do not need it, as in QuakeSpasm"},
    {"pr_checkextension", "1", "0: checkextension denies every QuakeC extension"},
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
    console.add_cvar("registered", registered ? "1" : "0", "1: registered version of Quake; 0: shareware",
                     con::kCvarRom);
}

}  // namespace fb::sv
