#include "server/save_game.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "base/number.h"
#include "base/text_mark.h"
#include "progs/text_tokens.h"

namespace fb::sv {
namespace {

namespace fields = progs::fields;
namespace globals = progs::globals;

constexpr std::string_view kBlanks = " \t\r\n";

// Takes the next word off the front; empty at the end.
std::string_view take_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
  text.remove_prefix(word.size());
  return word;
}

// Takes the rest of the line off the front, without the blanks around it.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  return line.substr(0, line.find_last_not_of(kBlanks) + 1);
}

std::optional<double> take_number(std::string_view& text) { return parse_number(take_word(text)); }

Error cut_short(std::string_view name, std::string_view what) {
  return Error{fmt::format("{}: the saved game has no {}, or one that makes no sense", name, what)};
}

// Our own names for edicts' looks that the mod has no field for.
std::string extra_lines(const Level& level, const EdictExtra& extra) {
  std::string lines;
  if (!level.optional.alpha && extra.alpha != net::kAlphaDefault)
    lines += fmt::format("\"alpha\" \"{:f}\"\n", net::decode_alpha(extra.alpha));
  if (!level.optional.scale && extra.scale != net::kScaleDefault)
    lines += fmt::format("\"scale\" \"{:f}\"\n", net::decode_scale(extra.scale));
  return lines;
}

constexpr std::string_view kModelLine = "sv.model_precache", kSoundLine = "sv.sound_precache";

// What is no line of a precache is left out.
std::vector<SavedPrecache> parse_precaches(std::string_view text) {
  std::vector<SavedPrecache> precaches;
  const std::size_t comment = text.rfind("\n/*");
  if (comment == std::string_view::npos) return precaches;
  text.remove_prefix(comment + 3);
  while (!text.empty() && precaches.size() < 2 * net::kMaxPrecaches) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const std::string_view key = take_word(line);
    const auto number = take_number(line);
    const std::size_t begin = line.find('"'), end = line.rfind('"');
    if ((key != kModelLine && key != kSoundLine) || !number || begin == end) continue;
    precaches.push_back(
        {key == kModelLine, progs::to_int(*number), std::string(line.substr(begin + 1, end - begin - 1))});
  }
  return precaches;
}

std::string precache_lines(const Level& level) {
  std::string lines;
  const auto add = [&](std::string_view key, std::size_t number, const std::string& name) {
    if (name.find_first_of("\"\n*") == std::string::npos) lines += fmt::format("{} {} \"{}\"\n", key, number, name);
  };
  for (std::size_t i = level.loaded_models; i > 0 && i < level.models.size(); ++i)
    add(kModelLine, i, level.models[i].name);
  for (std::size_t i = level.loaded_sounds; i > 0 && i < level.sounds.size(); ++i) add(kSoundLine, i, level.sounds[i]);
  return lines.empty() ? lines : fmt::format("/*\n// precached while the level ran\n{}*/\n", lines);
}

}  // namespace

Result<SaveGame> parse_save(std::string_view text, std::string_view name) {
  SaveGame save;
  SaveHeader& header = save.header;
  text = without_byte_order_mark(text);
  const auto version = take_number(text);
  if (!version) return Error{fmt::format("{}: no saved game", name)};
  if (*version != kSaveVersion && *version != kRereleaseSaveVersion)
    return Error{fmt::format("{}: a saved game of version {}, not {} or {}", name, *version, kSaveVersion,
                             kRereleaseSaveVersion)};
  if (*version == kRereleaseSaveVersion) {
    take_line(text);
    header.game = take_line(text);
    header.comment = take_line(text);
    if (header.game.empty()) return cut_short(name, "game");
  } else {
    header.comment = take_word(text);
  }
  for (float& parm : header.spawn_parms) {
    const auto value = take_number(text);
    if (!value || !std::isfinite(static_cast<float>(*value))) return cut_short(name, "spawn parms");
    parm = static_cast<float>(*value);
  }
  const auto skill = take_number(text);
  if (!skill) return cut_short(name, "skill");
  header.skill = std::clamp(progs::to_int(static_cast<float>(*skill) + 0.1f), 0, 3);
  header.map = take_word(text);
  if (header.map.empty()) return cut_short(name, "map");
  const auto time = take_number(text);
  if (!time || *time < 0.0) return cut_short(name, "time");
  header.time = *time;
  for (int i = 0; i < net::kMaxLightStyles; ++i) {
    header.light_styles.emplace_back(take_word(text));
    if (header.light_styles.back().empty()) return cut_short(name, "light styles");
  }
  save.entities = text;
  save.precaches = parse_precaches(text);
  return save;
}

std::string save_comment(std::string_view level_name, int kills, int monsters) {
  std::string comment(level_name.substr(0, std::min<std::size_t>(level_name.find_first_of("\r\n"), 22)));
  comment.resize(22, ' ');
  comment += fmt::format("kills:{:3}/{:3}", kills, monsters);
  comment.resize(kSaveCommentLength, ' ');
  std::replace_if(
      comment.begin(), comment.end(), [](char c) { return kBlanks.find(c) != std::string_view::npos || c == '\0'; },
      '_');
  return comment;
}

std::string write_save(Level& level, const std::array<float, 16>& spawn_parms, int skill) {
  const progs::Vm& vm = *level.vm;
  const std::string_view title = level.title();
  std::string text = fmt::format(
      "{}\n{}\n", kSaveVersion,
      save_comment(title.empty() ? std::string_view(level.map_name) : title,
                   progs::to_int(vm.get(globals::killed_monsters)), progs::to_int(vm.get(globals::total_monsters))));
  for (const float parm : spawn_parms) text += fmt::format("{:f}\n", parm);
  text += fmt::format("{}\n{}\n{:f}\n", skill, level.map_name, level.time);
  for (const std::string& style : level.light_styles) {
    const bool is_word = !style.empty() && style.find_first_of(kBlanks) == std::string::npos;
    text += (is_word ? style : "m") + "\n";
  }
  text += progs::write_globals(vm);
  for (EdictId id{}; vm.edicts().valid(id); id = next(id))
    text += progs::write_edict(*level.vm, id, extra_lines(level, level.extra(id)));
  return text + precache_lines(level);
}

Status read_saved_entities(progs::Vm& vm, std::string_view text, std::string_view name, const EdictVisitor& placed) {
  const auto named = [&](const Error& error) { return Error{fmt::format("{}: {}", name, error.message)}; };
  bool is_globals = true;
  EdictId id{};
  while (const auto token = progs::take_token(text)) {
    if (!token->is('{')) return Error{fmt::format("{}: found {} where a {{ should be", name, token->text)};
    if (is_globals) {
      if (Status status = progs::parse_globals(vm, text); !status) return named(status.error());
      is_globals = false;
      continue;
    }
    if (const auto made = vm.edicts().revive(id); !made) return named(made.error());
    const auto read = progs::parse_edict(vm, id, text);
    if (!read) return named(read.error());
    // A player who has not begun has no fields, and is no free edict for that.
    if (read->empty && index(id) > vm.edicts().reserved()) vm.edicts().mark_free(id);
    if (placed) placed(id, *read);
    id = next(id);
  }
  if (index(id) <= vm.edicts().reserved()) return Error{fmt::format("{}: the saved game has no player", name)};
  for (; vm.edicts().valid(id); id = next(id)) vm.edicts().free(id, 0.0);
  return ok_status();
}

}  // namespace fb::sv
