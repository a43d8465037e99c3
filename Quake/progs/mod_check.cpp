#include "progs/mod_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "progs/system_defs.h"

namespace fb::progs {
namespace {

// Builtins whose first parameter names something that an engine has or has not.
constexpr std::uint32_t kCheckExtension = 99, kCvar = 45, kCvarString = 448, kCvarSet = 72, kRegisterCvar = 93;

bool is_call(Op op) { return op >= Op::kCall0 && op <= Op::kCall8; }
bool is_store(Op op) {
  return op == Op::kStoreF || op == Op::kStoreS || op == Op::kStoreV || op == Op::kStoreEnt || op == Op::kStoreFld ||
         op == Op::kStoreFnc;
}

class Reader {
 public:
  explicit Reader(const Program& program) : program_(program), written_(program.globals.size()) {
    for (const Statement& statement : program.statements) note_writes(statement);
    // Parameters are written as a function is entered. (Its other locals hold constants, too, from id's compiler.)
    for (const Function& function : program.functions) {
      if (function.is_builtin()) continue;
      std::uint32_t at = function.first_local;
      for (std::uint32_t parm = 0; parm < function.parm_count; ++parm)
        for (std::uint32_t word = 0; word < function.parm_sizes[parm]; ++word) written_[at++] = true;
    }
  }

  ModNeeds read() {
    for (std::size_t i = 0; i < program_.statements.size(); ++i) {
      const Statement& statement = program_.statements[i];
      // Also functions that are handed on: `self.think = remove`.
      if (const auto* function = builtin_at(statement.a, is_call(statement.op))) note_call(*function, i, statement.op);
    }
    for (const std::string& name : registered_) {
      needs_.cvars_read.erase(name);
      needs_.cvars_set.erase(name);
    }
    return std::move(needs_);
  }

 private:
  void note_writes(const Statement& statement) {
    const bool store = is_store(statement.op);
    if (!store && (op_info(statement.op).c != Operand::kGlobal || is_call(statement.op))) return;
    const std::uint32_t at = store ? statement.b : statement.c;
    const std::uint32_t words = writes_vector(statement.op) ? 3 : 1;
    for (std::uint32_t i = at; i < at + words && i < written_.size(); ++i) written_[i] = true;
  }
  static bool writes_vector(Op op) {
    return op == Op::kStoreV || op == Op::kAddV || op == Op::kSubV || op == Op::kMulFV || op == Op::kMulVF ||
           op == Op::kLoadV;
  }

  // The builtin that a constant of type function stands for; null if it stands for another one or is none.
  const Function* builtin_at(std::uint16_t global, bool called) const {
    if (global >= program_.global_count || written_[global]) return nullptr;
    if (!called) {
      const Definition* definition = program_.global_at(global);
      if (!definition || definition->type != Type::kFunction) return nullptr;
    }
    const Word id = program_.globals[global];
    if (id == 0 || id >= program_.functions.size()) return nullptr;
    const Function& function = program_.functions[id];
    return function.is_builtin() ? &function : nullptr;
  }

  void note_call(const Function& function, std::size_t statement, Op op) {
    const std::int64_t number = function.builtin_number();
    needs_.builtins.insert({number, std::string(function.name)});
    if (!is_call(op)) return;
    std::set<std::string>* names = number == kCheckExtension                  ? &needs_.extensions
                                   : number == kCvar || number == kCvarString ? &needs_.cvars_read
                                   : number == kCvarSet                       ? &needs_.cvars_set
                                   : number == kRegisterCvar                  ? &registered_
                                                                              : nullptr;
    if (!names) return;
    if (const auto name = first_parameter(statement); name && !name->empty()) names->emplace(*name);
  }

  // Where it is a constant string that is stored shortly before the call.
  std::optional<std::string_view> first_parameter(std::size_t call) const {
    constexpr std::size_t kFarthest = 32;
    for (std::size_t back = 1; back <= std::min(call, kFarthest); ++back) {
      const Statement& statement = program_.statements[call - back];
      if (is_call(statement.op) || statement.op == Op::kDone || statement.op == Op::kReturn) return std::nullopt;
      if (!is_store(statement.op) || statement.b != kOfsParm0) continue;
      if (written_[statement.a]) return std::nullopt;
      const Word offset = program_.globals[statement.a];
      if (offset >= program_.strings.size()) return std::nullopt;
      return std::string_view(program_.strings.data() + offset);
    }
    return std::nullopt;
  }

  const Program& program_;
  std::vector<bool> written_;
  std::set<std::string> registered_;
  ModNeeds needs_;
};

bool has_body(const Program& program, std::string_view name) {
  const FunctionId id = program.find_function(name);
  return id != FunctionId::kNull && !program.functions[index(id)].is_builtin();
}

}  // namespace

ModNeeds needs_of(const Program& program) { return Reader(program).read(); }

std::vector<std::string> missing_here(const Program& program, const ModHost& host) {
  std::vector<std::string> sentences;
  const auto say = [&](const std::string& text) { sentences.push_back(program.file + " " + text); };
  const ModNeeds needs = needs_of(program);
  for (const std::string_view name : host.must_have)
    if (!has_body(program, name)) say(fmt::format("lacks the function {}, which is called here", name));
  for (const ModNeeds::Call& call : needs.builtins) {
    const std::uint32_t number = host.builtins.resolve(call.number, call.name);
    // Compilers may leave out the names of functions.
    const std::string what =
        builtin_label(call.number, call.name.empty() ? host.builtins.name_of(number) : std::string_view(call.name));
    if (number == 0)
      say(fmt::format("calls {}, which is not known here: a call does nothing and returns 0", what));
    else if (host.builtins.is_idle(number))
      say(fmt::format("calls {}, which does nothing here", what));
  }
  for (const std::string& name : needs.extensions)
    if (!host.builtins.has_extension(name))
      say(fmt::format("asks for the extension {}, and is told that it is not there", name));
  for (const std::string& name : needs.cvars_read)
    if (!host.has_cvar(name)) say(fmt::format("reads the cvar {}, which is not here: it reads 0", name));
  for (const std::string& name : needs.cvars_set)
    if (!host.has_cvar(name)) say(fmt::format("sets the cvar {}, which is not here", name));
  for (const std::string_view name : host.never_called)
    if (has_body(program, name)) say(fmt::format("has the function {}, which is never called here", name));
  return sentences;
}

std::vector<std::string_view> server_functions() {
  std::vector<std::string_view> names;
  for (const SystemDefinition& row : system_globals())
    if (row.type == Type::kFunction && std::string_view(row.name) != "main") names.emplace_back(row.name);
  return names;
}

std::vector<std::string_view> server_functions_of_other_engines() {
  return {"EndFrame",         "SV_RunClientCommand", "SV_PlayerPhysics",
          "SV_ChangeTeam",    "SV_AddDebugPolygons", "SV_ParseConnectionlessPacket",
          "SV_PausedTic",     "SV_Shutdown",         "SV_OnEntityNoSpawnFunction",
          "SpectatorConnect", "SpectatorDisconnect", "SpectatorThink",
          "RestoreGame",      "GameCommand",         "CheckRejectConnection",
          "ChatMessage"};
}

std::vector<std::string_view> client_functions_of_other_engines() {
  return {"CSQC_WorldLoaded",       "CSQC_UpdateView",       "CSQC_UpdateViewLoading", "CSQC_InputEvent",
          "CSQC_Input_Frame",       "CSQC_Parse_StuffCmd",   "CSQC_Parse_CenterPrint", "CSQC_Parse_Print",
          "CSQC_Parse_Event",       "CSQC_Parse_Damage",     "CSQC_Parse_SetAngles",   "CSQC_Parse_TempEntity",
          "CSQC_Ent_Update",        "CSQC_Ent_Spawn",        "CSQC_Ent_Remove",        "CSQC_Event",
          "CSQC_Event_Sound",       "CSQC_ServerSound",      "CSQC_LoadResource",      "CSQC_PlayerInfoChanged",
          "CSQC_ServerInfoChanged", "CSQC_RendererRestarted"};
}

}  // namespace fb::progs
