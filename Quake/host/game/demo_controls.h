// Keys and mouse that direct a demo, and when its bar is shown. Keys and their work are Ironwail's: Space pauses, the
// arrows rewind and go forward while they are held, or change the speed. Besides: comma and full stop move by a frame,
// Home goes to the beginning, Page Up and Page Down to the demos before and after; the mouse on the bar seeks.
#pragma once

#include <optional>

#include "client/client.h"
#include "console/console.h"
#include "platform/input_event.h"
#include "ui/demo_bar.h"

namespace fb::host {

class DemoControls {
 public:
  // Both must outlive it.
  DemoControls(con::Console& console, cl::Client& client) : console_(console), client_(client) {}

  // True if the event was for a demo that plays. What is let go must come here, too, wherever keys go by then.
  bool handle(const platform::InputEvent& event);
  // Once a frame: follows a pointer that holds the line. The bar of this frame, or none.
  std::optional<ui::DemoBar> frame(uvec2 output, double now);

 private:
  bool directs() const;
  bool press(int key);
  bool release(int key);
  void let_go();

  con::Console& console_;
  cl::Client& client_;
  ivec2 output_{0};
  vec2 pointer_{0.0f};
  bool touched_ = false;     // since the last frame
  bool line_held_ = false;   // by the mouse
  bool was_paused_ = false;  // before that
  int arrow_ = 0;            // the key that is held, of those that go forward and back
  double shown_until_ = -1e9;
};

}  // namespace fb::host
