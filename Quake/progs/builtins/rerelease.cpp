// What the 2021 re-release's QuakeC calls beyond Quake's own. Its updates have named or numbered these anew, and other
// engines' numbers are in their way, so a program is understood by both: `centerprint` is #73 in Quake, #90 in the
// first update, and `ex_centerprint = #0` since the third, while #90 of others is `tracebox`. Numbers and names as in
// QuakeSpasm, vkQuake and Ironwail. As in these, bots, paths and drawings for debugging are not here.
#include <array>
#include <string>
#include <string_view>

#include "progs/builtins/kinds.h"
#include "progs/vm.h"

namespace fb::progs {
namespace {

constexpr std::uint32_t kBprint = 23, kSprint = 24, kCenterprint = 73, kFinaleFinished = 79, kLocalsound = 80;

struct Idle {
  std::string_view name;  // without its "ex_"
  std::uint32_t number;   // before the third update
};
constexpr std::array<Idle, 13> kIdle = {{
    {"draw_point", 81},
    {"draw_line", 82},
    {"draw_arrow", 83},
    {"draw_ray", 84},
    {"draw_circle", 85},
    {"draw_bounds", 86},
    {"draw_worldtext", 87},
    {"draw_sphere", 88},
    {"draw_cylinder", 89},
    {"CheckPlayerEXFlags", 90},  // 0: none of the player's wishes about changing weapons
    {"walkpathtogoal", 91},      // 0: there is no path
    {"bot_movetopoint", 92},     // 0: there is no way
    {"bot_followentity", 92},
}};

}  // namespace

void add_rerelease_builtins(BuiltinTable& table) {
  // 0: it has not finished; players end it by a button.
  table.set_idle(kFinaleFinished, "finaleFinished");
  for (const std::string_view name : {"ex_finaleFinished", "ex_finalefinished"})
    table.set_alias(0, name, kFinaleFinished);
  for (const Idle& idle : kIdle)
    table.set_alias(idle.number, idle.name, table.set_named_idle("ex_" + std::string(idle.name)));

  table.set_alias(0, "ex_bprint", kBprint);
  table.set_alias(91, "bprint", kBprint);
  table.set_alias(0, "ex_sprint", kSprint);
  table.set_alias(92, "sprint", kSprint);
  table.set_alias(0, "ex_centerprint", kCenterprint);
  table.set_alias(90, "centerprint", kCenterprint);
  table.set_alias(0, "ex_localsound", kLocalsound);
}

}  // namespace fb::progs
