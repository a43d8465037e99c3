#include "progs/builtins/output.h"

#include <memory>
#include <vector>

#include "base/log.h"
#include "console/console.h"
#include "progs/vm.h"

namespace fb::progs {

std::string message_text(Vm& vm, int first, const con::Localization* localization) {
  if (!localization) return vm.parm_text_from(first);
  std::vector<std::string_view> pieces;
  for (int i = first; i < vm.parm_count(); ++i) pieces.push_back(vm.parm_string(i));
  return localization->message(pieces);
}

const con::Localization* localization_of(const Services& services) {
  return services.console ? &services.console->localization() : nullptr;
}

std::function<void(std::string_view)> output_of(const Services& services) {
  if (services.print) return services.print;
  constexpr std::size_t kMaxLine = 65536;
  return [line = std::make_shared<std::string>()](std::string_view text) {
    *line += text;
    for (std::size_t end; (end = line->find('\n')) != std::string::npos;) {
      log_line(LogLevel::kInfo, std::string_view(*line).substr(0, end));
      line->erase(0, end + 1);
    }
    if (line->size() > kMaxLine) line->clear();
  };
}

}  // namespace fb::progs
