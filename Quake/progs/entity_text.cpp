#include "progs/entity_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/log.h"
#include "progs/text_tokens.h"

namespace fb::progs {
namespace {

// Quake's ED_NewString: \n is a newline; of any other pair the backslash remains and the letter behind it goes.
std::string unescape(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\' && i + 1 < text.size()) {
      ++i;
      plain += text[i] == 'n' ? '\n' : '\\';
    } else {
      plain += text[i];
    }
  }
  return plain;
}

// What unescape() reads back as it was, here and in QuakeSpasm. There is no way to write a quote.
std::string escape(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\') escaped += '\\';
    escaped += c == '"' ? '\'' : c;
  }
  return escaped;
}

// Components of vectors have definitions of their own, origin_x beside origin; Quake tells them by the underscore, and
// so skips whatever else has one there.
bool is_component(std::string_view name) { return name.size() > 1 && name[name.size() - 2] == '_'; }

std::string_view field_name(const Vm& vm, Word offset) {
  const Definition* field = vm.program().field_at(offset);
  return field ? field->name : std::string_view();
}

// The fields of an edict that are worth a line.
template <typename Visit>
void each_field(const Program& program, const Word* words, const Visit& visit) {
  // The first definition belongs to the compiler.
  for (std::size_t i = 1; i < program.field_definitions.size(); ++i) {
    const Definition& field = program.field_definitions[i];
    if (field.name.empty() || is_component(field.name)) continue;
    const Word* const first = words + field.offset;
    if (std::all_of(first, first + words_of(field.type), [](Word word) { return word == 0; })) continue;
    visit(field, first);
  }
}

Error text_error(const Vm& vm, const Definition& definition, std::string_view what, std::string_view value) {
  return Error{
      fmt::format("{}: {} is set to {} \"{}\", which there is not", vm.program().file, definition.name, what, value)};
}

// A key and its value. nullopt at the closing brace.
Result<std::optional<std::pair<std::string, std::string>>> take_pair(std::string_view& text) {
  const auto key = take_token(text);
  if (!key) return Error{"text of an entity ends without a closing brace"};
  if (key->is('}')) return std::optional<std::pair<std::string, std::string>>();
  const auto value = take_token(text);
  if (!value) return Error{fmt::format("text of an entity ends behind key \"{}\"", key->text)};
  if (value->is('}')) return Error{fmt::format("key \"{}\" of an entity has no value", key->text)};
  std::string name = key->text;
  name.resize(name.find_last_not_of(' ') + 1);  // map editors leave blanks there
  return std::optional(std::pair(std::move(name), value->text));
}

}  // namespace

Status set_from_text(Vm& vm, const Definition& definition, Word* words, std::string_view text) {
  switch (definition.type) {
    case Type::kString: {
      const StringId id = vm.strings().allocate(unescape(text));
      if (id == StringId::kNull) return Error{fmt::format("{}: too many strings", vm.program().file)};
      *words = static_cast<Word>(id);
      break;
    }
    case Type::kFloat:
      *words = as_word(parse_float(text));
      break;
    case Type::kVector:
      ValueTraits<vec3>::store(words, parse_spaced_vector(text));
      break;
    case Type::kEntity: {
      const std::int32_t number = parse_int(text);
      if (number < 0 || static_cast<std::uint32_t>(number) >= vm.edicts().max()) {
        return text_error(vm, definition, "entity", text);
      }
      *words = static_cast<Word>(number);
      break;
    }
    case Type::kField: {
      const Definition* field = vm.program().find_field(text);
      // Worlds may name these without the mod knowing them.
      if (!field && (text == "fog" || text.starts_with("sky"))) break;
      if (!field) return text_error(vm, definition, "field", text);
      *words = field->offset;
      break;
    }
    case Type::kFunction: {
      const FunctionId function = vm.program().find_function(text);
      if (function == FunctionId::kNull) return text_error(vm, definition, "function", text);
      *words = index(function);
      break;
    }
    default:
      break;  // Quake has no text for them, and leaves them alone
  }
  return ok_status();
}

Result<EdictText> parse_edict(Vm& vm, EdictId id, std::string_view& text) {
  EdictText read;
  Edict edict = vm.edict(id);
  for (;;) {
    auto pair = take_pair(text);
    if (!pair) return pair.error();
    if (!*pair) return read;
    auto& [key, value] = **pair;
    read.empty = false;
    if (key == "angle") {
      key = "angles";
      value = fmt::format("0 {} 0", value);
    } else if (key == "light") {
      key = "light_lev";  // there is a model of the name
    }
    if (key.starts_with('_')) continue;
    if (const Definition* field = vm.program().find_field(key)) {
      if (Status status = set_from_text(vm, *field, edict.words() + field->offset, value); !status) {
        return status.error();
      }
    } else {
      read.unknown.emplace_back(std::move(key), std::move(value));
    }
  }
}

Status parse_globals(Vm& vm, std::string_view& text) {
  for (;;) {
    const auto pair = take_pair(text);
    if (!pair) return pair.error();
    if (!*pair) return ok_status();
    const auto& [key, value] = **pair;
    const Definition* global = vm.program().find_global(key);
    if (!global) {
      log_info("'{}' is not a global", key);
      continue;
    }
    if (Status status = set_from_text(vm, *global, vm.globals_data() + global->offset, value); !status) return status;
  }
}

std::string saved_text(const Vm& vm, Type type, const Word* words) {
  switch (type) {
    case Type::kString:
      return escape(vm.text(static_cast<StringId>(*words)));
    case Type::kFloat:
      return six_decimals(as_float(*words));
    case Type::kVector:
      return fmt::format("{} {} {}", six_decimals(as_float(words[0])), six_decimals(as_float(words[1])),
                         six_decimals(as_float(words[2])));
    case Type::kEntity:
      return std::to_string(*words);
    case Type::kField:
      return std::string(field_name(vm, *words));
    case Type::kFunction:
      return std::string(vm.function_name(FunctionId{*words}));
    case Type::kVoid:
      return "void";
    default:
      return fmt::format("bad type {}", static_cast<unsigned>(type));
  }
}

std::string printed_text(const Vm& vm, Type type, const Word* words) {
  switch (type) {
    case Type::kString:
      return std::string(vm.text(static_cast<StringId>(*words)));
    case Type::kFloat:
      return one_decimal(as_float(*words));
    case Type::kVector:
      return vector_text(ValueTraits<vec3>::load(words));
    case Type::kEntity:
      return fmt::format("entity {}", *words);
    case Type::kField:
      return fmt::format(".{}", field_name(vm, *words));
    case Type::kFunction:
      return fmt::format("{}()", vm.function_name(FunctionId{*words}));
    case Type::kPointer:
      return "pointer";
    case Type::kVoid:
      return "void";
    default:
      return fmt::format("bad type {}", static_cast<unsigned>(type));
  }
}

std::string write_edict(Vm& vm, EdictId id, std::string_view extra) {
  std::string text = "{\n";
  if (!vm.edicts().is_free(id)) {
    each_field(vm.program(), vm.edict(id).words(), [&](const Definition& field, const Word* words) {
      text += fmt::format("\"{}\" \"{}\"\n", field.name, saved_text(vm, field.type, words));
    });
    text += extra;
  }
  return text += "}\n";
}

std::string write_globals(const Vm& vm) {
  std::string text = "{\n";
  for (const Definition& global : vm.program().global_definitions) {
    const bool has_text = global.type == Type::kString || global.type == Type::kFloat || global.type == Type::kEntity;
    if (!global.saved || !has_text) continue;
    text += fmt::format("\"{}\" \"{}\"\n", global.name, saved_text(vm, global.type, vm.globals_data() + global.offset));
  }
  return text += "}\n";
}

std::string print_edict(Vm& vm, EdictId id) {
  if (vm.edicts().is_free(id)) return "FREE\n";
  std::string text = fmt::format("\nEDICT {}:\n", index(id));
  each_field(vm.program(), vm.edict(id).words(), [&](const Definition& field, const Word* words) {
    text += fmt::format("{:<15}{}\n", field.name, printed_text(vm, field.type, words));
  });
  return text;
}

}  // namespace fb::progs
