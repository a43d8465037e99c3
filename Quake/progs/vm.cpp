#include "progs/vm.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/log.h"

namespace fb::progs {
namespace {

constexpr std::size_t kMostUnknown = 64;  // builtins that a level's log names

}  // namespace

Result<std::unique_ptr<Vm>> Vm::create(std::shared_ptr<const Program> program, BuiltinTable builtins,
                                       const VmOptions& options) {
  auto edicts = EdictStore::create(program->field_words, options.max_edicts);
  if (!edicts) return Error{program->file + ": " + edicts.error().message};
  return std::unique_ptr<Vm>(new Vm(std::move(program), std::move(builtins), options, std::move(edicts).value()));
}

Vm::Vm(std::shared_ptr<const Program> program, BuiltinTable builtins, const VmOptions& options, EdictStore edicts)
    : program_(std::move(program)),
      builtins_(std::move(builtins)),
      options_(options),
      strings_(program_->strings),
      edicts_(std::move(edicts)),
      globals_(program_->globals),
      frames_(options.max_depth),
      locals_(options.max_local_words),
      profile_(program_->functions.size()) {
  resolve_builtins();
}

Vm::~Vm() = default;

void Vm::resolve_builtins() {
  resolved_.resize(program_->functions.size());
  for (std::size_t i = 1; i < resolved_.size(); ++i) {
    const Function& function = program_->functions[i];
    if (function.is_builtin())
      resolved_[i] = builtins_.find(builtins_.resolve(function.builtin_number(), function.name));
  }
}

std::string_view Vm::function_name(FunctionId id) const {
  return index(id) < program_->functions.size() ? program_->functions[index(id)].name : std::string_view();
}

bool Vm::can_call(FunctionId id) const {
  if (id == FunctionId::kNull || index(id) >= program_->functions.size()) return false;
  const Function& function = program_->functions[index(id)];
  if (!function.is_builtin()) return true;
  return resolved_[index(id)] && !builtins_.is_idle(builtins_.resolve(function.builtin_number(), function.name));
}

Status Vm::execute(FunctionId function) {
  if (nesting_ == 0) {
    failed_ = skipped_ = false;
    trace_ = false;
  }
  // A builtin that goes on although something failed gets the same answer again.
  if (!failed_) {
    if (function == FunctionId::kNull || index(function) >= program_->functions.size()) {
      fail(fmt::format("the engine was to call function {}, which is none", index(function)));
    } else if (nesting_ >= options_.max_nesting) {
      fail(fmt::format("functions and builtins call each other {} deep", nesting_));
    } else {
      ++nesting_;
      interpret(function);
      --nesting_;
    }
  }
  if (failed_) return Error{cause_};
  return ok_status();
}

void Vm::call_builtin(FunctionId id) {
  const Builtin* builtin = resolved_[index(id)];
  if (!builtin) return call_unknown(program_->functions[index(id)]);
  const bool outer_skipped = std::exchange(skipped_, false);
  const FunctionId outer = std::exchange(builtin_, id);
  (*builtin)(*this);
  if (skipped_) std::fill_n(&globals_[kOfsReturn], 3, Word{0});
  skipped_ = outer_skipped;
  builtin_ = outer;
}

// QuakeSpasm ends the game here; later engines go on.
void Vm::call_unknown(const Function& function) {
  return_vector(vec3(0.0f));
  if (unknown_told_.size() > kMostUnknown) return;
  const std::string what = builtin_label(function.builtin_number(), function.name);
  if (!unknown_told_.insert(what).second) return;
  if (unknown_told_.size() > kMostUnknown)
    log_warning("{}: more builtins are called that are not known here; no more of them are named", program_->file);
  else
    log_warning("{}: {} is not known here: calls of it do nothing and return 0", place(), what);
}

std::string Vm::place() const {
  if (function_ == FunctionId::kNull) return program_->file;
  const Function& function = program_->functions[index(function_)];
  return fmt::format("{}: {} ({}), statement {}", program_->file, function.name, function.file, statement_);
}

void Vm::fail(std::string_view cause) {
  if (failed_) return;
  failed_ = true;
  backtrace_ = current_backtrace();
  cause_ = fmt::format("{}: {}", place(), cause);
  if (function_ != FunctionId::kNull) log_line(LogLevel::kInfo, backtrace_);
}

void Vm::warn(std::string_view cause) {
  constexpr std::size_t kMostWarnings = 64;
  if (failed_) return;
  warning_ = fmt::format("{}: {}", place(), cause);
  if (warned_of_.size() > kMostWarnings || !warned_of_.insert(statement_).second) return;
  if (warned_of_.size() > kMostWarnings)
    log_warning("{}: more is wrong, of which no more is told on this level", program_->file);
  else
    log_warning("{}", warning_);
}

std::string Vm::current_backtrace() const {
  constexpr std::uint32_t kEnds = 16;  // of a deep one: the innermost and the outermost
  std::string text;
  std::uint32_t statement = statement_;
  FunctionId id = function_;
  for (std::uint32_t level = depth_;; --level) {
    const std::uint32_t from_top = depth_ - level;
    if (id != FunctionId::kNull && (from_top < kEnds || level < kEnds)) {
      const Function& function = program_->functions[index(id)];
      if (!text.empty()) text += '\n';
      text += fmt::format("{:>12} : {}, statement {} ({})", function.file, function.name, statement,
                          op_info(program_->statements[statement].op).name);
    } else if (from_top == kEnds) {
      text += "\n         ...";
    }
    if (level == 0) break;
    statement = frames_[level - 1].statement;
    id = frames_[level - 1].function;
  }
  return text;
}

void Vm::print_statement(std::uint32_t number) const {
  const Statement& statement = program_->statements[number];
  const OpInfo& info = op_info(statement.op);
  std::string line = fmt::format("{:6} {:10}", number, info.name);
  const auto add = [&](Operand kind, std::uint16_t operand) {
    if (kind == Operand::kJump) line += fmt::format(" {:+}", jump_of(operand));
    if (kind != Operand::kGlobal) return;
    const Definition* definition = program_->global_at(operand);
    line += definition ? fmt::format(" {}({})", operand, definition->name) : fmt::format(" {}", operand);
  };
  add(info.a, statement.a);
  add(info.b, statement.b);
  add(info.c, statement.c);
  log_line(LogLevel::kInfo, line);
}

// "parameter 1 of find"
std::string Vm::parm_name(int i) const { return fmt::format("parameter {} of {}", i + 1, function_name(builtin_)); }

std::string_view Vm::parm_string(int i) {
  const StringId id = parm_string_id(i);
  if (const auto text = strings_.find(id)) return *text;
  warn(fmt::format("{} is string {}, which there is not: it is taken as empty", parm_name(i),
                   static_cast<std::int32_t>(id)));
  return "";
}

EdictId Vm::parm_entity(int i) {
  const EdictId id{parm_words(i)[0]};
  if (edicts_.valid(id)) return id;
  skip(fmt::format("{} is entity {}, of {}: the call does nothing", parm_name(i), index(id), edicts_.count()));
  return EdictId::kWorld;
}

std::uint32_t Vm::checked_field(int i, std::uint32_t words) {
  const Word value = parm_words(i)[0];
  if (value <= program_->field_words - words) return value;
  skip(fmt::format("{} is field {}, of {} words: the call does nothing", parm_name(i), value, program_->field_words));
  return kAbsent;
}

std::string Vm::parm_text_from(int first) {
  std::string text;
  for (int i = first; i < parm_count_; ++i) text += parm_string(i);
  return text;
}

std::vector<ProfileRow> Vm::take_profile(std::size_t count) {
  std::vector<ProfileRow> rows;
  for (std::uint32_t i = 0; i < profile_.size(); ++i) {
    if (profile_[i] > 0) rows.push_back({FunctionId{i}, profile_[i]});
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const ProfileRow& a, const ProfileRow& b) { return a.statements > b.statements; });
  if (rows.size() > count) rows.resize(count);
  for (const ProfileRow& row : rows) profile_[index(row.function)] = 0;
  return rows;
}

}  // namespace fb::progs
