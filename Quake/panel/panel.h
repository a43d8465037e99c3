// The panel: what the renderer does and what can be set of it, live, in a window over the picture. Passes' times as a
// graph, all settings of the renderer with their ranges, debug views, what light the scene has. Made with Dear ImGui,
// which is seen in this module alone: its drawing goes the way of all 2D (draw_data.h), its input comes as events.
//
//   panel.handle(event);                        // true: it was the panel's
//   panel.add_frame(passes, times);             // of each frame that is shown
//   panel.draw(list, atlas, facts, output, now) // while it is open
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "console/console.h"
#include "platform/input_event.h"
#include "render/scene/gpu_scene.h"
#include "render/passes/pass.h"
#include "scene/draw_list.h"
#include "scene/snapshot.h"
#include "ui/atlas.h"

struct ImGuiContext;

namespace fb::panel {

// What it tells of the frame before this one.
struct Facts {
  const scene::FrameSnapshot& snapshot;
  render::SceneStatistics scene = {};
  std::string device = {}, rays = {};  // "llvmpipe ...", "bvh"
  uvec2 rendered{0, 0};                // pixels
  std::uint64_t device_bytes = 0;      // in all
  std::uint64_t learnt_bytes = 0;      // of these, of path guiding's states and cache
  std::uint32_t accumulated = 0;       // frames in the picture's mean
};

class Panel {
 public:
  static constexpr std::size_t kFrames = 120;  // in the graph

  // Registers togglepanel. The console must outlive it.
  explicit Panel(con::Console& console);
  ~Panel();
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;

  bool open() const { return open_; }
  // Whether letters are typed into it.
  bool typing() const;
  // Takes what is meant for it: the mouse over its window, keys while something is typed into it, and Escape.
  bool handle(const platform::InputEvent& event);
  // Of a frame that has been shown: milliseconds of its passes, and in all.
  void add_frame(const std::vector<render::PassTime>& passes, double whole);
  // Appends it to the list; nothing if it is closed. `now`: seconds of a clock.
  void draw(scene::DrawList& list, ui::Atlas& atlas, const Facts& facts, uvec2 output, double now);

 private:
  struct Frame {
    std::vector<render::PassTime> passes;
    double whole = 0.0;  // milliseconds
  };
  // panel_pages.cpp
  void draw_pages(const Facts& facts);
  void draw_times(const Facts& facts);
  void draw_graph(double highest);
  void draw_settings();
  void draw_setting(const con::Cvar& cvar);
  void draw_views();
  void draw_scene(const Facts& facts);

  bool open_ = false;
  con::Console& console_;
  ImGuiContext* context_;
  std::deque<Frame> history_;
  std::vector<int> pressed_, let_go_;  // keys since the last frame; of these, those that are up again
  std::string filter_;
  float scale_ = 1.0f;  // output pixels to a unit of ImGui's
  double last_ = -1.0;  // when it was drawn last
};

}  // namespace fb::panel
