#include "host/game/file_commands.h"

#include <fmt/format.h>

#include <utility>

#include "base/log.h"
#include "fs/file.h"
#include "fs/path.h"
#include "host/game/map_list.h"
#include "host/game/mod_list.h"
#include "host/game/save_list.h"

namespace fb::host {
namespace {

// Without its colour, as QuakeSpasm writes it.
std::string dumped_line(std::string_view line) {
  std::string text;
  for (const char c : line) {
    const char plain = static_cast<char>(static_cast<unsigned char>(c) & 0x7fu);
    text += plain >= ' ' && plain < 0x7f ? plain : ' ';
  }
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

// Always a text file, so that it takes the place of no configuration.
Status dump_console(const con::Console& console, const fs::FileSystem& files, const con::Args& args) {
  std::string name = args.size() > 1 ? args[1] : "condump";
  if (!fs::ends_with_ignoring_case(name, ".txt")) name += ".txt";
  const auto path = files.write_path(name);
  if (!path) return path.error();
  std::string text;
  for (const con::ScrollLine& line : console.scrollback().latest(console.scrollback().size()))
    text += dumped_line(line.text) + '\n';
  const Status status = fs::write_text_atomically(*path, text);
  if (status) log_info("Dumped console text to {}.", path->string());
  return status;
}

void list_maps(const fs::FileSystem& files, const con::Args& args) {
  const std::vector<std::string> maps = playable_maps(files, args[1]);
  for (const std::string& name : maps) log_info("   {}", name);
  if (args.size() > 1)
    log_info("{} maps beginning with \"{}\"", maps.size(), args[1]);
  else
    log_info("{} maps", maps.size());
}

void show_mods(const fs::FileSystem& files) {
  const auto mods = list_mods(files);
  for (const ui::menu::ModEntry& mod : mods)
    log_info("   {}{}{}", mod.directory, mod.description.empty() ? "" : ": ", mod.description);
  log_info("{} game folders", mods.size());
}

// The names of files at the folder's top without their extension.
std::vector<std::string> names_of(const fs::FileSystem& files, std::string_view beginning, std::string_view extension) {
  std::vector<std::string> names;
  for (const fs::FoundFile& file : files.find(beginning, extension))
    names.push_back(file.name.substr(0, file.name.size() - extension.size()));
  return names;
}

}  // namespace

std::vector<std::string> playable_maps(const fs::FileSystem& files, std::string_view beginning) {
  constexpr std::string_view kFolder = "maps/", kExtension = ".bsp";
  std::vector<std::string> maps;
  for (const std::string& path : names_of(files, fmt::format("{}{}", kFolder, beginning), kExtension)) {
    std::string name = path.substr(kFolder.size());
    const auto summary = read_map_summary(files, name);
    if (!summary || summary->playable) maps.push_back(std::move(name));
  }
  return maps;
}

void register_file_commands(con::Console& console, const fs::FileSystem& files) {
  console.add_command("condump", "condump [file]: write the console's text into FILE.txt, or condump.txt",
                      [&](const con::Args& args) { console.fail_unless(dump_console(console, files, args)); });
  console.add_command("maps", "maps [beginning]: list the maps that can be played",
                      [&files](const con::Args& args) { list_maps(files, args); });
  console.add_command("mods", "mods: list the game folders; game <folder> plays one",
                      [&files](const con::Args&) { show_mods(files); });
}

void complete_file_names(con::Console& console, const fs::FileSystem& files) {
  const auto add = [&](std::initializer_list<const char*> commands, const con::ArgumentCompleter& completer) {
    for (const char* command : commands)
      if (console.has_command(command)) console.set_argument_completer(command, completer);
  };
  add({"map", "changelevel", "viewmap", "maps"},
      [&files](std::string_view typed) { return playable_maps(files, typed); });
  add({"playdemo", "timedemo", "capturedemo", "startdemos"},
      [&files](std::string_view typed) { return names_of(files, typed, ".dem"); });
  add({"exec"}, [&files](std::string_view typed) { return names_of(files, typed, ".cfg"); });
  add({"load", "save"}, [&files](std::string_view) {
    std::vector<std::string> names;
    for (const ui::menu::SaveEntry& save : list_saves(files))
      if (save.used) names.push_back(save.name);
    return names;
  });
  add({"game"}, [&files](std::string_view) {
    std::vector<std::string> names;
    for (const ui::menu::ModEntry& mod : list_mods(files)) names.push_back(mod.directory);
    return names;
  });
}

}  // namespace fb::host
