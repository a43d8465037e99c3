// The line at the top of the picture in which a message to other players is typed (messagemode, messagemode2).
#pragma once

#include <string>
#include <string_view>

#include "console/input_line.h"
#include "ui/painter.h"

namespace fb::ui {

class MessageLine {
 public:
  bool open() const { return open_; }
  void begin(bool to_team);
  void close();
  con::InputLine& input() { return input_; }
  // Closes the line. The console's command that sends it; empty if nothing was typed.
  std::string send();
  // Below the newest console lines: `line` of them.
  void draw(Painter& painter, float y, double time) const;

 private:
  con::InputLine input_;
  bool open_ = false, to_team_ = false;
};

}  // namespace fb::ui
