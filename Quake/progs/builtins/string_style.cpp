// How strings look: Quake's two alphabets (white, and red at 128 above it) and its golden digits, case, padding.
#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "progs/builtins/kinds.h"
#include "progs/vm.h"

namespace fb::progs {
namespace {

constexpr int kRed = 128, kGoldDigits = 18;
constexpr int kAlternate = 5, kAlternateFromRed = 6;  // of strconv's colours: every other character

bool alternate_is_red(int how, std::size_t position) { return (position % 2 == 1) == (how == kAlternate); }

// `digit` 0..9. Colours of strconv for digits: 1 white, 2 red, 3 gold, 4 gold 128 above, 5 and 6 gold by turns.
int styled_digit(int digit, int character, int how, std::size_t position) {
  switch (how) {
    case 1:
      return '0' + digit;
    case 2:
      return '0' + digit + kRed;
    case 3:
      return kGoldDigits + digit;
    case 4:
      return kGoldDigits + digit + kRed;
    case kAlternate:
    case kAlternateFromRed:
      return kGoldDigits + digit + (alternate_is_red(how, position) ? kRed : 0);
    default:
      return character;
  }
}

// `low` is the character without its colour.
int colored(int low, int character, int how, std::size_t position) {
  switch (how) {
    case 1:
      return low;
    case 2:
      return low | kRed;
    case kAlternate:
    case kAlternateFromRed:
      return alternate_is_red(how, position) ? low | kRed : low;
    default:
      return character;
  }
}

// FTE_STRINGS: case (1 lower, 2 upper), colour of letters, colour of digits, strings.
void strconv(Vm& vm) {
  const int to_case = vm.parm_int(0), letters = vm.parm_int(1), digits = vm.parm_int(2);
  std::string text = vm.parm_text_from(3);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int character = static_cast<unsigned char>(text[i]), low = character & 127;
    int styled = character;
    if (low >= kGoldDigits && low < kGoldDigits + 10) {
      styled = styled_digit(low - kGoldDigits, character, digits, i);
    } else if (std::isdigit(low)) {
      styled = styled_digit(low - '0', character, digits, i);
    } else if (std::isalpha(low)) {
      const int cased = to_case == 1 ? std::tolower(low) : to_case == 2 ? std::toupper(low) : low;
      styled = colored(cased, cased | (character & kRed), letters, i);
    } else if (low > ' ') {
      styled = colored(low, character, letters, i);
    }
    text[i] = static_cast<char>(styled);
  }
  vm.return_string(text);
}

// Blanks up to a length, behind the text or, where it is negative, before it.
void strpad(Vm& vm) {
  const std::int64_t pad = vm.parm_int(0);
  std::string text = vm.parm_text_from(1);
  const auto length = std::min<std::size_t>(static_cast<std::size_t>(std::llabs(pad)), StringTable::kMaxLength);
  if (text.size() < length) {
    text.insert(pad < 0 ? 0 : text.size(), std::string(length - text.size(), ' '));
  }
  vm.return_string(text);
}

template <int kFold(int)>
void to_case(Vm& vm) {
  std::string text(vm.parm_string(0));
  for (char& c : text) c = static_cast<char>(kFold(static_cast<unsigned char>(c)));
  vm.return_string(text);
}

std::string lower(std::string_view text) {
  std::string folded(text);
  for (char& c : folded) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return folded;
}

// strreplace(what, by, in): every occurrence.
void replace(Vm& vm, bool ignore_case) {
  const std::string what(vm.parm_string(0)), by(vm.parm_string(1)), in(vm.parm_string(2));
  if (what.empty()) return vm.return_string(in);
  const std::string key = ignore_case ? lower(what) : what, searched = ignore_case ? lower(in) : in;
  std::string result;
  std::size_t from = 0;
  for (std::size_t at; (at = searched.find(key, from)) != std::string::npos; from = at + key.size()) {
    result.append(in, from, at - from).append(by);
    if (result.size() > StringTable::kMaxLength) break;
  }
  vm.return_string(result.append(in, from));
}

}  // namespace

void add_string_style_builtins(BuiltinTable& table) {
  table.set(224, "strconv", strconv);
  table.set(225, "strpad", strpad);
  table.set(480, "strtolower", to_case<std::tolower>);
  table.set(481, "strtoupper", to_case<std::toupper>);
  table.add_extension("DP_QC_STRING_CASE_FUNCTIONS");
  table.set(484, "strreplace", [](Vm& vm) { replace(vm, false); });
  table.set(485, "strireplace", [](Vm& vm) { replace(vm, true); });
  table.add_extension("DP_QC_STRREPLACE");
}

}  // namespace fb::progs
