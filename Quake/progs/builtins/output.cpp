#include "progs/builtins/output.h"

#include <memory>
#include <string>

#include "base/log.h"

namespace fb::progs {

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
