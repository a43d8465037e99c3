#include "host/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <map>
#include <string_view>

#include "base/number.h"
#include "host/option_table.h"

namespace fb::host {
namespace {

constexpr std::size_t kHelpColumn = 23, kHelpWidth = 120;

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

bool begins_option(const std::string& word) { return word.starts_with('-'); }
bool begins_command(const std::string& word) { return word.starts_with('+'); }
// "-1" and "-.5" are numbers that belong to a command.
bool is_negative_number(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && (is_digit(word[1]) || word[1] == '.');
}

Error unknown(const std::string& word) {
  if (!begins_option(word))
    return Error{fmt::format("{}: options begin with -, commands with +; -help lists the options", word)};
  const Option* near = nearest_option(word);
  const std::string meant = near ? fmt::format(" (is {} meant?)", near->name) : std::string();
  return Error{fmt::format("{}: there is no such option{}; -help lists them", word, meant)};
}

// Parses the arguments in one pass.
class Parser {
 public:
  explicit Parser(const std::vector<std::string>& arguments) : arguments_(arguments) { options_.arguments = arguments; }

  Result<GameOptions> parse() {
    while (at_ < arguments_.size()) {
      const std::string& word = arguments_[at_++];
      if (begins_command(word)) {
        skip_command();
      } else if (const Option* option = find_option(word); !option) {
        return unknown(word);
      } else if (const Status status = take(*option); !status) {
        return status.error();
      }
    }
    fill_size();
    return options_;
  }

 private:
  bool at_end() const { return at_ == arguments_.size(); }
  const std::string& here() const { return arguments_[at_]; }

  // Words up to the next '+' or '-' belong to the command.
  void skip_command() {
    options_.has_commands = true;
    while (!at_end() && !begins_command(here()) && (!begins_option(here()) || is_negative_number(here()))) ++at_;
  }

  // The value that the option's row requires; "" if there is none and none is needed.
  Result<std::string> value_of(const Option& option) {
    const std::string_view wanted = option.value;
    if (wanted.empty()) return std::string();
    const bool perhaps = wanted.starts_with('['), does_nothing = option.apply == nullptr;
    if (perhaps && (at_end() || here().empty() || !is_digit(here()[0]))) return std::string();
    if (does_nothing && (at_end() || begins_option(here()) || begins_command(here()))) return std::string();
    if (at_end()) return Error{fmt::format("{}: needs a value; -help lists the options", option.name)};
    return arguments_[at_++];
  }

  Status take(const Option& option) {
    const auto value = value_of(option);
    if (!value) return value.error();
    if (option.apply == nullptr) return ok_status();
    if (const Status status = option.apply(options_, *value); !status)
      return Error{fmt::format("{} {}: {}", option.name, *value, status.error().message)};
    return ok_status();
  }

  // If only one side of the size is given, computes the other.
  void fill_size() {
    uvec2& size = options_.size;
    if (size.x != 0 && size.y == 0) size.y = std::max(1u, size.x * 9 / 16);
    if (size.y != 0 && size.x == 0) size.x = std::max(1u, size.y * 16 / 9);
  }

  const std::vector<std::string>& arguments_;
  GameOptions options_;
  std::size_t at_ = 0;
};

std::string written(const Option& option) {
  return *option.value == '\0' ? option.name : fmt::format("{} {}", option.name, option.value);
}

std::string help_of_what_works() {
  std::string text;
  for (const Option& option : option_table()) {
    if (option.apply != nullptr && option.help != nullptr)
      text += fmt::format("  {:<{}}{}\n", written(option) + " ", kHelpColumn - 2, option.help);
  }
  return text;
}

// Each reason, followed by the options that have no effect for that reason, in lines of kHelpWidth.
std::string help_of_what_is_ignored() {
  std::vector<std::string> reasons;
  std::map<std::string, std::vector<std::string>> by_reason;
  for (const Option& option : option_table()) {
    if (option.apply != nullptr) continue;
    if (by_reason[option.help].empty()) reasons.emplace_back(option.help);
    by_reason[option.help].push_back(written(option));
  }
  std::string text;
  for (const std::string& reason : reasons) {
    std::string line = "  " + reason + ":";
    for (const std::string& name : by_reason[reason]) {
      if (line.size() + 1 + name.size() > kHelpWidth) {
        text += line + "\n";
        line = "   ";
      }
      line += " " + name;
    }
    text += line + "\n";
  }
  return text;
}

}  // namespace

Result<uvec2> parse_size(const std::string& text) {
  const std::size_t x = std::min(text.find('x'), text.size());
  const auto side = [](std::string_view side) { return whole_number_in<std::uint32_t>("", side, 1, kLargestSide); };
  const auto width = side(std::string_view(text).substr(0, x));
  const auto height = side(std::string_view(text).substr(std::min(x + 1, text.size())));
  if (!width || !height)
    return Error{fmt::format("a size is WIDTHxHEIGHT, each 1 to {}, not '{}'", kLargestSide, text)};
  return uvec2(*width, *height);
}

Result<GameOptions> parse_game_options(const std::vector<std::string>& arguments) { return Parser(arguments).parse(); }

std::vector<std::string> with_game(const std::vector<std::string>& arguments, const std::string& folder) {
  constexpr std::string_view kPacks[] = {"-hipnotic", "-rogue", "-quoth"};
  std::vector<std::string> kept;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (begins_command(arguments[i])) {
      while (i + 1 < arguments.size() && !begins_command(arguments[i + 1]) &&
             (!begins_option(arguments[i + 1]) || is_negative_number(arguments[i + 1])))
        ++i;
    } else if (arguments[i] == "-game") {
      ++i;
    } else if (std::ranges::find(kPacks, arguments[i]) == std::end(kPacks)) {
      kept.push_back(arguments[i]);
    }
  }
  if (std::ranges::find(kPacks, "-" + folder) != std::end(kPacks)) {
    kept.push_back("-" + folder);
  } else if (folder != "id1") {
    kept.insert(kept.end(), {"-game", folder});
  }
  return kept;
}

std::string version_text() { return "fullbright " FULLBRIGHT_VERSION; }

std::string game_help() {
  return version_text() + ": Quake, path traced.\n\nusage: fullbright [options] [+command arguments ...]\n\n" +
         help_of_what_works() +
         "\nAccepted for compatibility with QuakeSpasm, vkQuake and Ironwail, without effect:\n" +
         help_of_what_is_ignored() +
         R"(
Commands run in order; a timedemo ends before the next command runs:
  fullbright -basedir ~/quake +map start
  fullbright -basedir ~/quake -headless +timedemo demo1 +quit
  fullbright -basedir ~/quake -game ad +playdemo demo1
At the console: cvarlist, cmdlist, apropos WORD, help NAME.
)";
}

}  // namespace fb::host
