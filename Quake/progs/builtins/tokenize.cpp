// Cutting a string into words, which are asked for one by one.
#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "progs/builtins/kinds.h"
#include "progs/vm.h"

namespace fb::progs {
namespace {

constexpr std::size_t kMaxWords = 4096;

struct Words {
  struct Word {
    std::string text;
    std::size_t start, end;  // in the string
  };
  std::vector<Word> words;

  // Negative numbers count from the end.
  const Word* at(std::int64_t i) const {
    if (i < 0) i += static_cast<std::int64_t>(words.size());
    return i >= 0 && i < static_cast<std::int64_t>(words.size()) ? &words[static_cast<std::size_t>(i)] : nullptr;
  }
};

bool is_space(char c) { return static_cast<unsigned char>(c) <= ' '; }

// As the console cuts its lines: white space, "words in quotes" (\" and \\ inside), // comments.
void cut_words(std::string_view text, Words& into) {
  into.words.clear();
  std::size_t at = 0;
  while (into.words.size() < kMaxWords) {
    while (at < text.size() && is_space(text[at])) ++at;
    if (at >= text.size()) return;
    if (text.substr(at, 2) == "//") {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    Words::Word word{"", at, at};
    if (text[at] == '"') {
      for (++at; at < text.size() && text[at] != '"'; ++at) {
        if (text[at] == '\\' && at + 1 < text.size() && (text[at + 1] == '"' || text[at + 1] == '\\')) ++at;
        word.text += text[at];
      }
      at = std::min(at + 1, text.size());
    } else {
      while (at < text.size() && !is_space(text[at])) word.text += text[at++];
    }
    word.end = at;
    into.words.push_back(std::move(word));
  }
}

// Whatever stands between the separators, white space and all; the longest that fits counts.
void cut_at_separators(std::string_view text, const std::vector<std::string_view>& separators, Words& into) {
  into.words.clear();
  std::size_t start = 0;
  const auto add = [&](std::size_t end) {
    into.words.push_back({std::string(text.substr(start, end - start)), start, end});
  };
  for (std::size_t at = 0; at < text.size() && into.words.size() + 1 < kMaxWords;) {
    std::size_t length = 0;
    for (const std::string_view separator : separators) {
      if (separator.size() > length && text.substr(at).starts_with(separator)) length = separator.size();
    }
    if (length == 0) {
      ++at;
      continue;
    }
    add(at);
    start = at += length;
  }
  add(text.size());
}

}  // namespace

void add_tokenize_builtins(BuiltinTable& table) {
  const auto words = std::make_shared<Words>();
  const auto count = [words](Vm& vm) { vm.return_float(static_cast<float>(words->words.size())); };
  const auto tokenize = [words, count](Vm& vm) {
    cut_words(vm.parm_string(0), *words);
    count(vm);
  };
  table.set(441, "tokenize", tokenize);
  table.set(514, "tokenize_console", tokenize);
  table.set_named("tokenize_menuqc", tokenize);
  table.add_extension("DP_QC_TOKENIZE_CONSOLE");
  table.set(479, "tokenizebyseparator", [words, count](Vm& vm) {
    std::vector<std::string_view> separators;
    for (int i = 1; i < vm.parm_count(); ++i) separators.push_back(vm.parm_string(i));
    cut_at_separators(vm.parm_string(0), separators, *words);
    count(vm);
  });
  table.add_extension("DP_QC_TOKENIZEBYSEPARATOR");
  table.set_named("argc", count);
  table.set(442, "argv", [words](Vm& vm) {
    const auto* word = words->at(vm.parm_int(0));
    if (word) return vm.return_string(word->text);
    vm.return_string_id(StringId::kNull);
  });
  table.set(515, "argv_start_index", [words](Vm& vm) {
    const auto* word = words->at(vm.parm_int(0));
    vm.return_float(word ? static_cast<float>(word->start) : -1.0f);
  });
  table.set(516, "argv_end_index", [words](Vm& vm) {
    const auto* word = words->at(vm.parm_int(0));
    vm.return_float(word ? static_cast<float>(word->end) : -1.0f);
  });
}

}  // namespace fb::progs
