// DP_QC_SPRINTF: C's sprintf on QuakeC's values.
//
//   %[N$][flags][width][.precision][modifier]conversion
//     N$         the N-th argument instead of the next; width and precision may be * or *N$
//     flags      # 0 - + blank, as in C
//     modifier   h: the argument is a float; l: it is an integer (an entity's number, say). Without: integer for i,
//                float for all others
//     conversion d i o u x X c e E f F g G as in C; s a string, S one in quotes (without any inside: else empty);
//                v V a vector, three times g or G; p P an integer of 8 hexadecimal digits; % itself
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include "progs/builtins/kinds.h"
#include "progs/vm.h"

namespace fb::progs {
namespace {

constexpr int kMaxField = 4096;  // of width and precision

struct Spec {
  int argument = 0;  // of sprintf, 1 is the first behind the format
  std::string flags;
  std::optional<int> width, precision;
  bool integer = false;
  char conversion = 0;
};

class Formatter {
 public:
  Formatter(Vm& vm, std::string_view format) : vm_(vm), format_(format) {}

  std::string run() {
    while (!format_.empty() && result_.size() <= StringTable::kMaxLength) {
      const std::size_t percent = std::min(format_.find('%'), format_.size());
      result_ += format_.substr(0, percent);
      format_.remove_prefix(percent);
      if (format_.empty()) break;
      const std::string_view written = format_;
      format_.remove_prefix(1);
      if (take('%')) {
        result_ += '%';
      } else if (!convert()) {
        vm_.warn(fmt::format("sprintf cannot make sense of \"{}\"", written));
        result_ += written;
        break;
      }
    }
    return std::move(result_);
  }

 private:
  bool take(char c) {
    if (!format_.starts_with(c)) return false;
    format_.remove_prefix(1);
    return true;
  }

  std::optional<int> take_number() {
    std::size_t digits = 0;
    int number = 0;
    while (digits < format_.size() && format_[digits] >= '0' && format_[digits] <= '9') {
      number = std::min(number * 10 + (format_[digits++] - '0'), kMaxField);
    }
    if (digits == 0) return std::nullopt;
    format_.remove_prefix(digits);
    return number;
  }

  // "N$", or nothing taken.
  std::optional<int> take_position() {
    const std::string_view before = format_;
    const auto number = take_number();
    if (number && take('$')) return number;
    format_ = before;
    return std::nullopt;
  }

  // A number, or a * for an argument.
  std::optional<int> take_size() {
    if (!take('*')) return take_number();
    const int argument = take_position().value_or(next_);
    if (argument == next_) ++next_;
    return has(argument) ? std::clamp(vm_.parm_int(argument), -kMaxField, kMaxField) : 0;
  }

  bool has(int argument) const { return argument >= 1 && argument < vm_.parm_count(); }

  bool convert() {
    Spec spec;
    const auto position = take_position();
    while (!format_.empty() && std::string_view("#0- +").find(format_[0]) != std::string_view::npos) {
      spec.flags += format_[0];
      format_.remove_prefix(1);
    }
    spec.width = take_size();
    if (spec.width && *spec.width < 0) {
      spec.flags += '-';
      spec.width = -*spec.width;
    }
    if (take('.')) {
      spec.precision = take_size().value_or(0);
      if (*spec.precision < 0) spec.precision.reset();
    }
    std::optional<bool> integer;
    for (; !format_.empty() && std::string_view("hlLqjzt").find(format_[0]) != std::string_view::npos;
         format_.remove_prefix(1)) {
      if (format_[0] == 'h') integer = false;
      if (format_[0] == 'l' || format_[0] == 'L') integer = true;
    }
    if (format_.empty()) return false;
    spec.conversion = format_[0];
    format_.remove_prefix(1);
    const bool pointer = spec.conversion == 'p' || spec.conversion == 'P';
    if (pointer) {
      spec.conversion = spec.conversion == 'p' ? 'x' : 'X';
      spec.flags += '0';
      spec.width = spec.width.value_or(8);
    }
    spec.integer = integer.value_or(spec.conversion == 'i' || pointer);
    spec.argument = position.value_or(next_);
    if (!position) ++next_;
    return append(spec);
  }

  bool append(const Spec& spec) {
    switch (spec.conversion) {
      case 'd':
      case 'i':
        print(spec, 'd', integer_of(spec));
        return true;
      case 'o':
      case 'u':
      case 'x':
      case 'X':
        print(spec, spec.conversion, static_cast<unsigned>(integer_of(spec)));
        return true;
      case 'c':
        print(spec, 'c', integer_of(spec));
        return true;
      case 'e':
      case 'E':
      case 'f':
      case 'F':
      case 'g':
      case 'G':
        print(spec, spec.conversion, number_of(spec));
        return true;
      case 's':
      case 'S':
        append_string(spec);
        return true;
      case 'v':
      case 'V':
        append_vector(spec);
        return true;
      default:
        return false;
    }
  }

  void append_string(const Spec& spec) {
    std::string text(has(spec.argument) ? vm_.parm_string(spec.argument) : std::string_view());
    if (spec.conversion == 'S') {
      if (text.find_first_of("\"\n\r") != std::string::npos) text.clear();
      text = '"' + text + '"';
    }
    if (spec.precision) text.resize(std::min(text.size(), static_cast<std::size_t>(*spec.precision)));
    const auto width = static_cast<std::size_t>(spec.width.value_or(0));
    if (text.size() < width) {
      const bool left = spec.flags.find('-') != std::string::npos;
      text.insert(left ? text.size() : 0, std::string(width - text.size(), ' '));
    }
    result_ += text;
  }

  void append_vector(const Spec& spec) {
    const vec3 v = has(spec.argument) ? vm_.parm_vector(spec.argument) : vec3(0.0f);
    for (int i = 0; i < 3; ++i) {
      if (i > 0) result_ += ' ';
      print(spec, spec.conversion == 'v' ? 'g' : 'G', static_cast<double>(v[i]));
    }
  }

  // What an integer's word holds, or a float cut to one.
  std::int32_t integer_of(const Spec& spec) const {
    if (!has(spec.argument)) return 0;
    return spec.integer ? static_cast<std::int32_t>(vm_.parm_string_id(spec.argument)) : vm_.parm_int(spec.argument);
  }
  double number_of(const Spec& spec) const {
    if (!has(spec.argument)) return 0.0;
    return spec.integer ? integer_of(spec) : static_cast<double>(vm_.parm_float(spec.argument));
  }

  // By C's own printf. Width and precision are bounded, so a value's text is, too.
  template <typename T>
  void print(const Spec& spec, char conversion, T value) {
    std::string format("%");
    format.append(spec.flags.substr(0, 8));
    if (spec.width) format.append(std::to_string(*spec.width));
    if (spec.precision && conversion != 'c') format.append(".").append(std::to_string(*spec.precision));
    format += conversion;
    char buffer[2 * kMaxField];
    const int length = std::snprintf(buffer, sizeof(buffer), format.c_str(), value);
    if (length > 0) result_.append(buffer, std::min<std::size_t>(static_cast<std::size_t>(length), sizeof(buffer) - 1));
  }

  Vm& vm_;
  std::string_view format_;
  std::string result_;
  int next_ = 1;
};

}  // namespace

void add_sprintf_builtin(BuiltinTable& table) {
  table.set(627, "sprintf", [](Vm& vm) {
    const std::string format(vm.parm_string(0));
    vm.return_string(Formatter(vm, format).run());
  });
  table.add_extension("DP_QC_SPRINTF");
}

}  // namespace fb::progs
