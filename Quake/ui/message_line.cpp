#include "ui/message_line.h"

#include <algorithm>
#include <cmath>

#include "console/args.h"

namespace fb::ui {
namespace {

constexpr unsigned char kBlock = 11;

}  // namespace

void MessageLine::begin(bool to_team) {
  open_ = true;
  to_team_ = to_team;
  input_.set_text("");
}

void MessageLine::close() { open_ = false; }

std::string MessageLine::send() {
  close();
  if (input_.text().empty()) return {};
  return (to_team_ ? "say_team " : "say ") + con::in_quotes(input_.text()) + "\n";
}

// The part around the cursor that fits.
void MessageLine::draw(Painter& painter, float y, double time) const {
  if (!open_) return;
  const std::string_view before = to_team_ ? "(team) say: " : "say: ";
  const auto columns = static_cast<std::size_t>(std::max(painter.width() / 8 - 2, 1));
  const std::size_t room = columns > before.size() + 1 ? columns - before.size() - 1 : 1;
  const std::size_t first = input_.cursor() > room ? input_.cursor() - room : 0;
  const float x = 8.0f + 8.0f * static_cast<float>(before.size());
  painter.text(8.0f, y, before, true);
  painter.text(x, y, std::string_view(input_.text()).substr(first, room));
  if (std::fmod(time, 0.5) < 0.25) painter.character(x + 8.0f * static_cast<float>(input_.cursor() - first), y, kBlock);
}

}  // namespace fb::ui
