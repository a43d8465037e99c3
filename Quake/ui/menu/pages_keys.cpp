// Keys: every command that a key is wanted for, with two columns of keys.
#include <algorithm>
#include <set>

#include "ui/menu/pages.h"
#include "ui/menu/rows.h"

namespace fb::ui::menu {
namespace {

struct Bound {
  const char *command, *label;  // without a command: a heading
};
constexpr Bound kBound[] = {{"", "Walking"},
                            {"+forward", "Walk forward"},
                            {"+back", "Walk back"},
                            {"+moveleft", "Step left"},
                            {"+moveright", "Step right"},
                            {"+jump", "Jump, swim up"},
                            {"+speed", "Run or walk"},
                            {"+moveup", "Swim up"},
                            {"+movedown", "Swim down"},
                            {"", "Looking"},
                            {"+left", "Turn left"},
                            {"+right", "Turn right"},
                            {"+lookup", "Look up"},
                            {"+lookdown", "Look down"},
                            {"centerview", "Look ahead"},
                            {"+mlook", "Mouse look"},
                            {"+klook", "Look by walking keys"},
                            {"+strafe", "Step by turning keys"},
                            {"", "Weapons"},
                            {"+attack", "Attack"},
                            {"impulse 10", "Next weapon"},
                            {"impulse 12", "Previous weapon"},
                            {"impulse 1", "Axe"},
                            {"impulse 2", "Shotgun"},
                            {"impulse 3", "Double shotgun"},
                            {"impulse 4", "Nailgun"},
                            {"impulse 5", "Super nailgun"},
                            {"impulse 6", "Grenades"},
                            {"impulse 7", "Rockets"},
                            {"impulse 8", "Lightning"},
                            {"", "The game"},
                            {"+showscores", "Scores"},
                            {"messagemode", "Talk to all"},
                            {"messagemode2", "Talk to the team"},
                            {"pause", "Pause"},
                            {"save quick", "Quick save"},
                            {"load quick", "Quick load"},
                            {"menu_save", "Save menu"},
                            {"menu_load", "Load menu"},
                            {"menu_options", "Options menu"},
                            {"screenshot", "Screenshot"},
                            {"toggleconsole", "Console"},
                            {"sizeup", "Larger picture"},
                            {"sizedown", "Smaller picture"}};

Row bound_row(const std::string& command, std::string label) {
  Row row;
  row.kind = Row::Kind::kBinding;
  row.label = std::move(label);
  row.bound = command;
  row.help = command + "\nENTER or click: set a key; DEL: remove; left and right: column";
  return row;
}

}  // namespace

Page keys_page(const Sources& sources) {
  Page page;
  page.title = "Keys";
  page.title_picture = "gfx/ttl_cstm.lmp";
  page.plaque = false;
  page.value_column = 0.52f;
  page.searchable = true;
  std::set<std::string> listed;
  for (const Bound& bound : kBound) {
    if (*bound.command == '\0') {
      page.rows.push_back(heading(bound.label));
    } else {
      page.rows.push_back(bound_row(bound.command, bound.label));
      listed.insert(bound.command);
    }
  }
  // What else is bound, by a mod's scripts or the player.
  bool first = true;
  for (const std::string& command : sources.bindings.bound_commands()) {
    if (!listed.insert(command).second) continue;
    if (std::exchange(first, false)) page.rows.push_back(heading("Others"));
    page.rows.push_back(bound_row(command, command));
  }
  return page;
}

}  // namespace fb::ui::menu
