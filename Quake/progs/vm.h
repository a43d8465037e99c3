// The QuakeC virtual machine: one program, its globals, edicts and strings, for one level.
//
//   auto vm = Vm::create(program, std::move(builtins), {.max_edicts = 8192});
//   (*vm)->edicts().start_level(max_clients);
//   (*vm)->set(globals::self, id);
//   if (Status status = (*vm)->execute(edict.get(fields::think)); !status) ...   // QuakeC went wrong: end the level
//
// QuakeC's errors (a NULL function, too deep recursion, a loop without end, error()) come back as a Status of one
// sentence; where it happened and who called whom goes to the log and stays in backtrace(). Builtins may call execute()
// in turn: what fails there fails the QuakeC that called the builtin as well. What some other engine survives (a string
// or an entity that is none, ...) is a warning, and QuakeC goes on: Misc/docs/quakec.md has the list.
//
// A builtin that is not known is no error: it returns 0, "" or the world, and the first call of each is warned of.
//
// One thread uses a Vm.
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/result.h"
#include "progs/builtin_table.h"
#include "progs/edicts.h"
#include "progs/program.h"
#include "progs/strings.h"
#include "progs/system_defs.h"
#include "progs/value.h"

namespace fb::progs {

struct VmOptions {
  std::uint32_t max_edicts = 8192;
  // Statements that one call from the engine may take, as QuakeSpasm: behind that it is a loop without end.
  std::int64_t max_statements = 0x1000000;
  std::uint32_t max_depth = 1024;         // functions that called each other
  std::uint32_t max_local_words = 65536;  // what their locals take
  std::uint32_t max_nesting = 128;        // execute() from builtins from execute() ...
};

struct ProfileRow {
  FunctionId function;
  std::int64_t statements;
};

class Vm {
 public:
  static Result<std::unique_ptr<Vm>> create(std::shared_ptr<const Program> program, BuiltinTable builtins,
                                            const VmOptions& options = {});
  ~Vm();
  Vm(const Vm&) = delete;
  Vm& operator=(const Vm&) = delete;

  const Program& program() const { return *program_; }
  EdictStore& edicts() { return edicts_; }
  const EdictStore& edicts() const { return edicts_; }
  StringTable& strings() { return strings_; }
  const StringTable& strings() const { return strings_; }
  const BuiltinTable& builtins() const { return builtins_; }

  // Globals. An absent one is zero and stays so. Entity globals (self, other) are read as edicts are: what is no edict
  // is the world.
  template <typename T>
  T get(Global<T> global) const {
    if (!global) return T{};
    const T value = ValueTraits<T>::load(globals_.data() + global.offset);
    if constexpr (std::is_same_v<T, EdictId>) return edicts_.valid(value) ? value : EdictId::kWorld;
    return value;
  }
  template <typename T>
  void set(Global<T> global, std::type_identity_t<T> value) {
    if (global) ValueTraits<T>::store(globals_.data() + global.offset, value);
  }
  Edict edict(EdictId id) { return edicts_[id]; }
  Edict self() { return edicts_[get(globals::self)]; }
  // The text of a string value, "" for one that names no string.
  std::string_view text(StringId id) const { return strings_.text(id); }
  Word* globals_data() { return globals_.data(); }
  const Word* globals_data() const { return globals_.data(); }

  // The level's clock (Quake's sv.time), which decides when freed edicts may be used again. The global `time` is apart.
  double level_time = 0.0;
  // While a game runs QuakeC must not write to the world's fields; while a map is being spawned it may.
  bool protect_world = false;

  // Runs a function to its end. Parameters, if it has any, are set before by set_parm_*; what it returns is read after.
  Status execute(FunctionId function);
  // Between execute() and its end.
  bool running() const { return nesting_ > 0; }
  FunctionId current_function() const { return function_; }
  std::string_view function_name(FunctionId id) const;
  // Whether calling this does something: it has a body, or is a builtin that is known here and not idle.
  bool can_call(FunctionId id) const;

  void set_parm(int i, float value) { store_parm(i, value); }
  void set_parm(int i, const vec3& value) { store_parm(i, value); }
  void set_parm(int i, StringId value) { store_parm(i, value); }
  void set_parm(int i, EdictId value) { store_parm(i, value); }
  float returned_float() const { return as_float(globals_[kOfsReturn]); }
  EdictId returned_edict() const { return EdictId{globals_[kOfsReturn]}; }
  std::string_view returned_string() const { return text(static_cast<StringId>(globals_[kOfsReturn])); }

  // For builtins. i is 0 to 7; parameters that the caller left out hold what was there before: ask parm_count().
  int parm_count() const { return parm_count_; }
  float parm_float(int i) const { return as_float(parm_words(i)[0]); }
  std::int32_t parm_int(int i) const { return to_int(parm_float(i)); }
  vec3 parm_vector(int i) const { return ValueTraits<vec3>::load(parm_words(i)); }
  StringId parm_string_id(int i) const { return static_cast<StringId>(parm_words(i)[0]); }
  FunctionId parm_function(int i) const { return static_cast<FunctionId>(parm_words(i)[0]); }
  // Checked. A string that is none costs a warning and is "". The text is valid while its string is (progs/strings.h).
  std::string_view parm_string(int i);
  // What is no entity makes the call skip() and gives the world, which is not meant.
  EdictId parm_entity(int i);
  Edict parm_edict(int i) { return edicts_[parm_entity(i)]; }
  // A field of T: its offset and all of its words lie in an edict. Where they do not the call skips.
  template <typename T>
  Field<T> parm_field(int i) {
    return Field<T>{checked_field(i, words_of(ValueTraits<T>::kType))};
  }
  // The parameters from i on, one behind the other (Quake's PF_VarString).
  std::string parm_text_from(int i);

  void return_float(float value) { globals_[kOfsReturn] = as_word(value); }
  void return_vector(const vec3& value) { ValueTraits<vec3>::store(&globals_[kOfsReturn], value); }
  // As it is: for what QuakeC declares to return an int.
  void return_word(Word word) { globals_[kOfsReturn] = word; }
  void return_edict(EdictId id) { globals_[kOfsReturn] = index(id); }
  void return_string_id(StringId id) { globals_[kOfsReturn] = static_cast<Word>(id); }
  // As a temporary string.
  void return_string(std::string_view text) { return_string_id(strings_.temporary(text)); }

  // From a builtin that does more than a moment's work: it counts as this many statements.
  void charge(std::int64_t statements) { charge_ += statements; }
  // From a builtin: ends QuakeC with this sentence as the builtin returns. The first one counts.
  void fail(std::string_view cause);
  // What QuakeC got wrong and the game survives: a warning with its place, once for each statement.
  void warn(std::string_view cause);
  // From a builtin that cannot do what it is asked for: warns, and the call returns 0.
  void skip(std::string_view cause) {
    warn(cause);
    skipped_ = true;
  }
  // Whether the builtin that runs has nothing more to do.
  bool failed() const { return failed_ || skipped_; }

  const std::string& warning() const { return warning_; }  // the latest, be it told or not
  // Of the latest error, innermost first: "  ai.qc : walk, statement 1234 (CALL1)".
  const std::string& backtrace() const { return backtrace_; }
  // As it is now, for builtins that print one.
  std::string current_backtrace() const;
  // Prints every statement until the outermost function ends (Quake's traceon).
  void set_trace(bool on) { trace_ = on; }

  // Functions that took the most statements since this was asked last, at most `count` of them.
  std::vector<ProfileRow> take_profile(std::size_t count);
  std::int64_t statements_executed() const { return statements_executed_; }

 private:
  struct Frame {
    std::uint32_t statement;  // of the caller, its CALL
    FunctionId function;      // the caller
  };
  struct Run;  // vm_run.cpp: where the interpreter is

  Vm(std::shared_ptr<const Program> program, BuiltinTable builtins, const VmOptions& options, EdictStore edicts);

  const Word* parm_words(int i) const { return &globals_[kOfsParm0 + 3 * static_cast<std::uint32_t>(i)]; }
  template <typename T>
  void store_parm(int i, const T& value) {
    ValueTraits<T>::store(&globals_[kOfsParm0 + 3 * static_cast<std::uint32_t>(i)], value);
  }
  std::uint32_t checked_field(int i, std::uint32_t words);
  std::string parm_name(int i) const;
  std::string place() const;
  void resolve_builtins();

  void interpret(FunctionId function);
  template <bool kTrace>
  bool interpret_some(Run& run);
  bool enter(FunctionId function);
  std::uint32_t leave();
  void call_builtin(FunctionId function);
  void call_unknown(const Function& function);
  void print_statement(std::uint32_t statement) const;

  std::shared_ptr<const Program> program_;
  BuiltinTable builtins_;
  VmOptions options_;
  StringTable strings_;
  EdictStore edicts_;
  std::vector<Word> globals_;
  std::vector<const Builtin*> resolved_;  // by function; nullptr for those with a body and for unknown ones
  std::set<std::string> unknown_told_;    // builtins that the log has named

  std::vector<Frame> frames_;
  std::uint32_t depth_ = 0;
  std::vector<Word> locals_;  // of the functions that wait
  std::uint32_t locals_used_ = 0;
  std::uint32_t nesting_ = 0;
  FunctionId function_ = FunctionId::kNull;  // that runs now
  std::uint32_t statement_ = 0;              // that runs now, as of the last call or error
  int parm_count_ = 0;
  bool trace_ = false, failed_ = false, skipped_ = false;
  FunctionId builtin_ = FunctionId::kNull;  // that runs
  std::set<std::uint32_t> warned_of_;       // statements
  std::string cause_, backtrace_, warning_;
  std::vector<std::int64_t> profile_;  // statements by function
  std::int64_t statements_executed_ = 0;
  std::int64_t charge_ = 0;  // not counted yet
};

}  // namespace fb::progs
