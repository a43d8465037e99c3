// The manual's page of settings, from the rows that define them.
#include <fmt/format.h>

#include <string>

#include "console/cvar.h"
#include "render/passes/debug_views.h"
#include "render/passes/settings.h"

namespace fb::render {
namespace {

std::string text_of(int value) { return std::to_string(value); }
std::string text_of(float value) { return con::number_text(value); }

template <typename T>
void add_row(std::string& page, std::string_view cvar, T value, T low, T high, std::string_view help) {
  page += fmt::format("| `{}` | {} | {} to {} | {} |\n", cvar, text_of(value), text_of(low), text_of(high), help);
}

void begin_table(std::string& page, std::string_view title) {
  page += fmt::format("\n## {}\n\n| cvar | default | range | what it does |\n| --- | --- | --- | --- |\n", title);
}

}  // namespace

std::string settings_page() {
  std::string page =
      "# Settings of the renderer\n\n"
      "Written by `make settings-page` from `Shaders/shared/settings.h`, `Shaders/shared/debug_views.h` and the "
      "techniques' headers (`Shaders/estimators/`); a test holds them equal.\n"
      "A setting is a cvar of the game, and `--set NAME=VALUE` in the laboratory.\n";
#define FB_ROW(type, field, cvar, value, low, high, help) add_row<type>(page, cvar, value, low, high, help);
#define FB_GROUP(title, rows, X) \
  begin_table(page, title);      \
  rows(X)
  FB_SETTING_GROUPS(FB_GROUP, FB_ROW)
#undef FB_GROUP
#undef FB_ROW
  page +=
      "\n## Debug views\n\n`r_debug` takes a name or its number.\n\n| name | number | what it shows |\n| --- | --- | "
      "--- |\n";
  for (const DebugView& view : debug_views())
    page += fmt::format("| `{}` | {} | {} |\n", view.name, view.number, view.help);
  return page;
}

}  // namespace fb::render
