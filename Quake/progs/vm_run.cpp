// The interpreter. Operands and jumps were checked as the program was loaded; here only values are: entities, fields,
// pointers, strings and functions that QuakeC may have made of anything.
//
// Statements are counted where control goes elsewhere than to the next one, for the limit and for the profile.
#include <fmt/format.h>

#include <cstring>
#include <utility>

#include "progs/vm.h"

namespace fb::progs {

// Where the interpreter is, while it changes between tracing and not.
struct Vm::Run {
  const Statement* at;
  std::int64_t left;  // statements until it is a loop without end
  std::int64_t mark;  // `left` when the function that runs was entered or came back
  std::uint32_t exit_depth;
};

namespace {

constexpr Word kNowhere = ~Word{0};  // the address of a field that there is not

// Functions have a handful of locals: a call of memcpy takes longer than the words one by one.
inline void copy_words(const Word* from, std::uint32_t count, Word* to) {
  for (std::uint32_t i = 0; i < count; ++i) to[i] = from[i];
}

}  // namespace

inline bool Vm::enter(FunctionId id) {
  const Function& function = program_->functions[index(id)];
  if (depth_ >= options_.max_depth) {
    fail(fmt::format("functions call each other {} deep: stack overflow", depth_));
    return false;
  }
  if (function.local_count > options_.max_local_words - locals_used_) {
    fail(fmt::format("locals of the functions that wait take more than {} words", options_.max_local_words));
    return false;
  }
  frames_[depth_++] = {statement_, function_};
  Word* const locals = &globals_[function.first_local];
  copy_words(locals, function.local_count, locals_.data() + locals_used_);
  locals_used_ += function.local_count;

  Word* to = locals;
  for (std::uint32_t parm = 0; parm < function.parm_count; ++parm) {
    const Word* const from = &globals_[kOfsParm0 + 3 * parm];
    for (std::uint32_t word = 0; word < function.parm_sizes[parm]; ++word) *to++ = from[word];
  }
  function_ = id;
  return true;
}

inline std::uint32_t Vm::leave() {
  FB_CHECK(depth_ > 0);
  const Function& function = program_->functions[index(function_)];
  locals_used_ -= function.local_count;
  copy_words(locals_.data() + locals_used_, function.local_count, &globals_[function.first_local]);
  const Frame& frame = frames_[--depth_];
  function_ = frame.function;
  return statement_ = frame.statement;
}

void Vm::interpret(FunctionId id) {
  const std::uint32_t statement = statement_;
  const int parm_count = parm_count_;
  const std::uint32_t exit_depth = depth_;
  if (program_->functions[index(id)].is_builtin()) {
    call_builtin(id);  // `self.think = SUB_Null` is one thing, `self.think = remove` another
  } else if (enter(id)) {
    const auto first = static_cast<std::uint32_t>(program_->functions[index(id)].first_statement);
    Run run{&program_->statements[first], options_.max_statements, options_.max_statements, exit_depth};
    for (bool done = false; !done;) done = trace_ ? interpret_some<true>(run) : interpret_some<false>(run);
    statements_executed_ += options_.max_statements - run.left;
    while (depth_ > exit_depth) leave();  // after an error
  }
  statement_ = statement;
  parm_count_ = parm_count;
}

// Goes on until the run is over (true), or tracing was switched on or off.
template <bool kTrace>
bool Vm::interpret_some(Run& run) {
  const Statement* const code = program_->statements.data();
  const Function* const functions = program_->functions.data();
  const std::size_t function_count = program_->functions.size();
  Word* const g = globals_.data();
  Word* const fields = edicts_.words();
  const std::uint32_t stride = edicts_.words_per_edict();

  const Statement* st = run.at;     // that is executed
  const Statement* block = run.at;  // from here on statements are not counted yet
  std::int64_t left = run.left;

  const auto get = [&](std::uint16_t at) { return as_float(g[at]); };
  const auto put = [&](float value) { g[st->c] = as_word(value); };
  const auto truth = [&](bool value) { g[st->c] = as_word(value ? 1.0f : 0.0f); };
  const auto count = [&] {
    left -= st - block + 1;
    block = st + 1;
  };
  const auto count_for_function = [&] {
    count();
    profile_[index(function_)] += run.mark - left;
    run.mark = left;
  };
  const auto stop = [&](const std::string& cause) {
    statement_ = static_cast<std::uint32_t>(st - code);
    fail(cause);
  };
  const auto finish = [&] {
    run.left = left;
    return true;
  };
  // False where it is a loop without end.
  const auto jump = [&](std::uint16_t distance) {
    count();
    st += jump_of(distance) - 1;
    block = st + 1;
    return left >= 0;
  };
  const auto go_on = [&](const std::string& cause) {
    statement_ = static_cast<std::uint32_t>(st - code);
    warn(cause);
  };
  // The word of a field, or nullptr, with a warning, where there is none: it reads as 0.
  const auto field_of = [&](Word entity, Word field, std::uint32_t words) -> Word* {
    if (entity < edicts_.count() && field <= stride - words) return fields + (std::size_t{entity} * stride + field);
    go_on(entity < edicts_.count() ? fmt::format("field {}, of {} words", field, stride)
                                   : fmt::format("{} is no entity: there are {}", entity, edicts_.count()));
    return nullptr;
  };
  // What is written elsewhere is lost.
  const auto pointer = [&](Word at, std::uint32_t words) -> Word* {
    const std::size_t all = std::size_t{edicts_.count()} * stride;
    if (at < all && all - at >= words) return fields + at;
    if (at != kNowhere) go_on(fmt::format("pointer {} leads outside of the entities", at));
    return nullptr;
  };
  const auto string_of = [&](Word id) {
    const char* const text = strings_.c_str(static_cast<StringId>(id));
    if (!text) go_on(fmt::format("string {} is none: it is taken as empty", static_cast<std::int32_t>(id)));
    return text ? text : "";
  };

  for (;; ++st) {
    if constexpr (kTrace) print_statement(static_cast<std::uint32_t>(st - code));
    switch (st->op) {
      case Op::kAddF:
        put(get(st->a) + get(st->b));
        break;
      case Op::kSubF:
        put(get(st->a) - get(st->b));
        break;
      case Op::kMulF:
        put(get(st->a) * get(st->b));
        break;
      case Op::kDivF:
        put(get(st->a) / get(st->b));
        break;
      case Op::kAddV:
        for (int i = 0; i < 3; ++i) g[st->c + i] = as_word(as_float(g[st->a + i]) + as_float(g[st->b + i]));
        break;
      case Op::kSubV:
        for (int i = 0; i < 3; ++i) g[st->c + i] = as_word(as_float(g[st->a + i]) - as_float(g[st->b + i]));
        break;
      case Op::kMulV: {
        const Word *a = g + st->a, *b = g + st->b;
        put(as_float(a[0]) * as_float(b[0]) + as_float(a[1]) * as_float(b[1]) + as_float(a[2]) * as_float(b[2]));
        break;
      }
      case Op::kMulFV:  // the factor is read anew each time: it may be a component of the result
        for (int i = 0; i < 3; ++i) g[st->c + i] = as_word(get(st->a) * as_float(g[st->b + i]));
        break;
      case Op::kMulVF:
        for (int i = 0; i < 3; ++i) g[st->c + i] = as_word(get(st->b) * as_float(g[st->a + i]));
        break;

      case Op::kBitAnd:
        put(static_cast<float>(to_int(get(st->a)) & to_int(get(st->b))));
        break;
      case Op::kBitOr:
        put(static_cast<float>(to_int(get(st->a)) | to_int(get(st->b))));
        break;
      case Op::kAnd:
        truth(get(st->a) != 0.0f && get(st->b) != 0.0f);
        break;
      case Op::kOr:
        truth(get(st->a) != 0.0f || get(st->b) != 0.0f);
        break;

      case Op::kLe:
        truth(get(st->a) <= get(st->b));
        break;
      case Op::kGe:
        truth(get(st->a) >= get(st->b));
        break;
      case Op::kLt:
        truth(get(st->a) < get(st->b));
        break;
      case Op::kGt:
        truth(get(st->a) > get(st->b));
        break;
      case Op::kEqF:
        truth(get(st->a) == get(st->b));
        break;
      case Op::kNeF:
        truth(get(st->a) != get(st->b));
        break;
      case Op::kEqV:
      case Op::kNeV: {
        const Word *a = g + st->a, *b = g + st->b;
        const bool equal =
            as_float(a[0]) == as_float(b[0]) && as_float(a[1]) == as_float(b[1]) && as_float(a[2]) == as_float(b[2]);
        truth(equal == (st->op == Op::kEqV));
        break;
      }
      case Op::kEqS:
      case Op::kNeS: {
        const bool equal = g[st->a] == g[st->b] || std::strcmp(string_of(g[st->a]), string_of(g[st->b])) == 0;
        truth(equal == (st->op == Op::kEqS));
        break;
      }
      case Op::kEqE:
      case Op::kEqFnc:
        truth(g[st->a] == g[st->b]);
        break;
      case Op::kNeE:
      case Op::kNeFnc:
        truth(g[st->a] != g[st->b]);
        break;

      case Op::kNotF:
        truth(get(st->a) == 0.0f);
        break;
      case Op::kNotV:
        truth(as_float(g[st->a]) == 0.0f && as_float(g[st->a + 1]) == 0.0f && as_float(g[st->a + 2]) == 0.0f);
        break;
      case Op::kNotS:
        truth(g[st->a] == 0 || *string_of(g[st->a]) == 0);
        break;
      case Op::kNotEnt:
      case Op::kNotFnc:
        truth(g[st->a] == 0);
        break;

      case Op::kStoreF:
      case Op::kStoreS:
      case Op::kStoreEnt:
      case Op::kStoreFld:
      case Op::kStoreFnc:
        g[st->b] = g[st->a];
        break;
      case Op::kStoreV:
        for (int i = 0; i < 3; ++i) g[st->b + i] = g[st->a + i];
        break;
      case Op::kStorepF:
      case Op::kStorepS:
      case Op::kStorepEnt:
      case Op::kStorepFld:
      case Op::kStorepFnc: {
        if (Word* const to = pointer(g[st->b], 1)) *to = g[st->a];
        break;
      }
      case Op::kStorepV: {
        Word* const to = pointer(g[st->b], 3);
        for (int i = 0; to && i < 3; ++i) to[i] = g[st->a + i];
        break;
      }
      case Op::kAddress: {
        const Word* const field = field_of(g[st->a], g[st->b], 1);
        if (g[st->a] == 0 && protect_world) {
          stop("assignment to a field of the world");
          return finish();
        }
        g[st->c] = field ? static_cast<Word>(field - fields) : kNowhere;
        break;
      }
      case Op::kLoadF:
      case Op::kLoadS:
      case Op::kLoadEnt:
      case Op::kLoadFld:
      case Op::kLoadFnc: {
        const Word* const field = field_of(g[st->a], g[st->b], 1);
        g[st->c] = field ? *field : 0;
        break;
      }
      case Op::kLoadV: {
        const Word* const field = field_of(g[st->a], g[st->b], 3);
        for (int i = 0; i < 3; ++i) g[st->c + i] = field ? field[i] : 0;
        break;
      }

      // Conditions are asked of the word, not the float: -0 is true (Misc/QUIRKS.md).
      case Op::kIf:
        if (g[st->a] != 0 && !jump(st->b)) goto runaway;
        break;
      case Op::kIfNot:
        if (g[st->a] == 0 && !jump(st->b)) goto runaway;
        break;
      case Op::kGoto:
        if (!jump(st->a)) goto runaway;
        break;

      case Op::kCall0:
      case Op::kCall1:
      case Op::kCall2:
      case Op::kCall3:
      case Op::kCall4:
      case Op::kCall5:
      case Op::kCall6:
      case Op::kCall7:
      case Op::kCall8: {
        const Word callee = g[st->a];
        parm_count_ = static_cast<int>(st->op) - static_cast<int>(Op::kCall0);
        statement_ = static_cast<std::uint32_t>(st - code);
        if (callee == 0 || callee >= function_count) {
          stop(callee == 0 ? "call of a NULL function" : fmt::format("call of function {}, which is none", callee));
          return finish();
        }
        if (functions[callee].is_builtin()) {
          call_builtin(FunctionId{callee});
          if (failed_) return finish();
          if (charge_ != 0) {
            left -= std::exchange(charge_, 0);
            if (left < 0) goto runaway;
          }
          if (trace_ != kTrace) {
            count();
            run.at = st + 1;
            run.left = left;
            return false;
          }
          break;
        }
        count_for_function();
        if (left < 0) goto runaway;
        if (!enter(FunctionId{callee})) return finish();
        block = code + functions[callee].first_statement;
        st = block - 1;
        break;
      }
      case Op::kDone:
      case Op::kReturn: {
        for (int i = 0; i < 3; ++i) g[kOfsReturn + i] = g[st->a + i];
        count_for_function();
        const std::uint32_t back = leave();
        if (depth_ == run.exit_depth) return finish();
        st = code + back;
        block = st + 1;
        break;
      }
      case Op::kState: {
        const Word self = g[globals::self.offset];
        if (!field_of(self, 0, 1)) break;
        Edict edict = edicts_[EdictId{self}];
        // A tenth of a second in double precision, as C has it where Quake writes 0.1.
        edict.set(fields::nextthink, static_cast<float>(static_cast<double>(get(globals::time.offset)) + 0.1));
        edict.set(fields::frame, get(st->a));
        edict.set(fields::think, FunctionId{g[st->b]});
        break;
      }
      case Op::kEnd:
        stop("statements end without a return");
        return finish();
      default:
        __builtin_unreachable();  // the loader lets nothing else through
    }
  }

runaway:
  stop(fmt::format("more than {} statements: a loop without end", options_.max_statements));
  return finish();
}

}  // namespace fb::progs
