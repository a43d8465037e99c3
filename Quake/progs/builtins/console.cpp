// The console: cvars, commands, what is printed, and what the engine can do.
#include "console/console.h"

#include <chrono>
#include <cstddef>
#include <memory>
#include <set>
#include <string>
#include <string_view>

#include "base/log.h"
#include "console/args.h"
#include "progs/builtins/kinds.h"
#include "progs/builtins/output.h"
#include "progs/vm.h"

namespace fb::progs {
namespace {

// Mods ask for other engines' cvars, some on every tick: each name that is not there is told of once, which, with a
// table a level, is once a level.
class MissingCvars {
 public:
  void tell(std::string_view name, const char* doing) {
    if (name.empty() || told_.size() > kMostNames || told_.contains(name)) return;
    told_.emplace(name);
    if (told_.size() > kMostNames)
      log_info("QuakeC asks for more cvars that are not there; no more of them are named.");
    else
      log_info("QuakeC {} \"{}\", a cvar that is not there (said once a level).", doing, name);
  }

 private:
  static constexpr std::size_t kMostNames = 64;
  std::set<std::string, con::NameLess> told_;
};

void add_cvar_builtins(BuiltinTable& table, con::Console* console) {
  const auto find = [console](Vm& vm) -> con::Cvar* {
    const std::string_view name = vm.parm_string(0);
    return console ? console->find_cvar(name) : nullptr;
  };
  const auto missing = std::make_shared<MissingCvars>();
  const auto read = [console, find, missing](Vm& vm) -> const con::Cvar* {
    const con::Cvar* cvar = find(vm);
    if (!cvar && console && !vm.failed()) missing->tell(vm.parm_string(0), "reads");
    return cvar;
  };
  table.set(45, "cvar", [read](Vm& vm) {
    const con::Cvar* cvar = read(vm);
    vm.return_float(cvar ? cvar->value() : 0.0f);
  });
  table.set(72, "cvar_set", [console, missing](Vm& vm) {
    const std::string name(vm.parm_string(0)), value(vm.parm_string(1));
    if (!console || vm.failed()) return;
    if (console->find_cvar(name))
      console->set(name, value);
    else
      missing->tell(name, "sets");
  });
  table.set(448, "cvar_string", [read](Vm& vm) {
    const con::Cvar* cvar = read(vm);
    vm.return_string(cvar ? std::string_view(cvar->string()) : std::string_view());
  });
  table.add_extension("DP_QC_CVAR_STRING");
  table.set(482, "cvar_defstring", [find](Vm& vm) {
    const con::Cvar* cvar = find(vm);
    vm.return_string(cvar ? std::string_view(cvar->default_string()) : std::string_view());
  });
  table.add_extension("DP_QC_CVAR_DEFSTRING");
  // Bits: 1 exists, 2 saved, 8 the engine's own, 16 has a description, 32 read only.
  table.set(495, "cvar_type", [find](Vm& vm) {
    const con::Cvar* cvar = find(vm);
    if (!cvar) return vm.return_float(0.0f);
    int type = 1;
    if (cvar->archived()) type |= 2;
    if (!(cvar->spec().flags & con::kCvarUser)) type |= 8;
    if (!cvar->spec().help.empty()) type |= 16;
    if (cvar->spec().flags & con::kCvarRom) type |= 32;
    vm.return_float(static_cast<float>(type));
  });
  table.add_extension("DP_QC_CVAR_TYPE");
  table.set(518, "cvar_description", [find](Vm& vm) {
    const con::Cvar* cvar = find(vm);
    vm.return_string(cvar ? std::string_view(cvar->spec().help) : std::string_view());
  });
  table.add_extension("DP_QC_CVAR_DESCRIPTION");
  table.set(93, "registercvar", [console](Vm& vm) {
    const std::string name(vm.parm_string(0)), value(vm.parm_string(1));
    const bool usable =
        !vm.failed() && console && !name.empty() && !console->find_cvar(name) && !console->has_command(name);
    if (usable) console->add_cvar(name, value, "made by the mod", con::kCvarUser);
    vm.return_float(usable ? 1.0f : 0.0f);
  });
  table.add_extension("DP_REGISTERCVAR");
}

}  // namespace

void add_console_builtins(BuiltinTable& table, const Services& services) {
  con::Console* const console = services.console;
  add_cvar_builtins(table, console);
  table.set(46, "localcmd", [console](Vm& vm) {
    const std::string text = vm.parm_text_from(0);
    if (console && !vm.failed()) console->append(text);
  });
  const auto print = output_of(services);
  const auto broadcast = services.broadcast ? services.broadcast : print;
  const con::Localization* const texts = localization_of(services);
  table.set(23, "bprint", [broadcast, texts](Vm& vm) { broadcast(message_text(vm, 0, texts)); });
  auto developer = services.developer_print;
  if (!developer) {
    developer = [print, console](std::string_view text) {
      const con::Cvar* cvar = console ? console->find_cvar("developer") : nullptr;
      if (cvar && cvar->on()) print(text);
    };
  }
  table.set(25, "dprint", [developer, texts](Vm& vm) { developer(message_text(vm, 0, texts)); });
  table.set(339, "print", [print](Vm& vm) { print(vm.parm_text_from(0)); });
  // 1 a command, 2 an alias, 3 a cvar, 0 nothing of the console.
  table.set(294, "checkcommand", [console](Vm& vm) {
    const std::string_view name = vm.parm_string(0);
    const float kind = !console                     ? 0.0f
                       : console->has_command(name) ? 1.0f
                       : console->has_alias(name)   ? 2.0f
                       : console->find_cvar(name)   ? 3.0f
                                                    : 0.0f;
    vm.return_float(kind);
  });
  table.add_extension("FTE_QC_CHECKCOMMAND");
  // Seconds of a clock that never stops, since the level began.
  table.set(519, "gettime", [start = std::chrono::steady_clock::now()](Vm& vm) {
    vm.return_float(std::chrono::duration<float>(std::chrono::steady_clock::now() - start).count());
  });
  table.set(99, "checkextension",
            [](Vm& vm) { vm.return_float(vm.builtins().has_extension(vm.parm_string(0)) ? 1.0f : 0.0f); });
  table.set(100, "builtin_find", [](Vm& vm) {
    const std::uint32_t number = vm.builtins().number_of(vm.parm_string(0));
    vm.return_float(BuiltinTable::is_named_only(number) ? 0.0f : static_cast<float>(number));
  });
  table.set_named("checkbuiltin", [](Vm& vm) { vm.return_float(vm.can_call(vm.parm_function(0)) ? 1.0f : 0.0f); });
}

}  // namespace fb::progs
