// Edicts and globals as text and back: entity lumps of maps, saved games (QuakeSpasm's version 5), and what the console
// prints. The forms and the rules are Quake's (ED_ParseEdict, ED_Write and their like).
//
//   std::string_view text = lump;
//   while (auto token = take_token(text)) {                         // "{"
//     auto read = parse_edict(vm, id, text);                        // up to and with "}"
//     if (!read) return read.error();
//     if (read->empty) vm.edicts().mark_free(id);
//   }
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.h"
#include "progs/vm.h"

namespace fb::progs {

struct EdictText {
  bool empty = true;  // {} alone: Quake frees such an edict
  // Keys that the mod has no field for (as `alpha`, `sky`, `fog`, ...), in their order.
  std::vector<std::pair<std::string, std::string>> unknown;
};

// Reads pairs of key and value behind an opening brace, to and with the closing one, into the fields of an edict. Does
// not clear it before. Keys with a leading _ are the map makers' own; `angle` is a yaw for `angles`, `light` is
// `light_lev`. Fails where the text ends too early, and on values that name no function, field or edict.
Result<EdictText> parse_edict(Vm& vm, EdictId id, std::string_view& text);
// The same for globals. Unknown names are left out, with a line in the log.
Status parse_globals(Vm& vm, std::string_view& text);

// As saved: "{\n", the fields that are not all zero, "}\n". A free edict has none. `extra` are lines of the server's
// own, as "\"alpha\" \"0.500000\"\n", before the closing brace.
std::string write_edict(Vm& vm, EdictId id, std::string_view extra = {});
// Those that the compiler marked for it: floats, strings and entities.
std::string write_globals(const Vm& vm);

// One value at `words` (of words_of(type)), as saved games have it.
std::string saved_text(const Vm& vm, Type type, const Word* words);
// As the console has it: 'vectors' with one decimal, "entity 5", "walk()".
std::string printed_text(const Vm& vm, Type type, const Word* words);
// For the console's `edict`, and for errors: "EDICT 5:" and the fields that are not zero, a line each.
std::string print_edict(Vm& vm, EdictId id);

// Sets what `definition` names, at `words`, from text. For strings, \n is a newline. Fails as parse_edict does.
Status set_from_text(Vm& vm, const Definition& definition, Word* words, std::string_view text);

}  // namespace fb::progs
