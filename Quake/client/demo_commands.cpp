// Demos at the console: playdemo, timedemo, the loop of startdemos, and what directs the demo that plays. demo_jump,
// demo_setspeed and demo_nudge have the names that ezQuake and FTE gave them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/log.h"
#include "base/number.h"
#include "client/client_impl.h"
#include "console/console.h"

namespace fb::cl {
namespace {

constexpr std::size_t kMaxDemoLoop = 8;
constexpr const char* kJumpHelp =
    "demo_jump [+|-][minutes:]seconds: go to this time of the demo, or that much further on or back";
constexpr const char* kTimeHelp =
    "timedemo <demo> ...: play demos as fast as possible and print frames a second; see scr_timedemo_json and "
    "scr_timedemo_runs";
constexpr const char* kSpeedHelp =
    "demo_setspeed <percent>: speed of the demo, 3.125 to 3200; 100 is its own, negative plays it backwards, 0 pauses";
constexpr const char* kNudgeHelp =
    "demo_nudge [frames]: pause the demo and move it by frames of 1/72 s; negative: back";

// "90", "1:30.5"
std::optional<double> parse_time(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == text.npos) return parse_number(text);
  const auto minutes = parse_whole_number_unsigned(text.substr(0, colon));
  const auto seconds = parse_number(text.substr(colon + 1));
  if (!minutes || *minutes > 1'000'000 || !seconds || *seconds < 0.0) return std::nullopt;
  return 60.0 * static_cast<double>(*minutes) + *seconds;
}

}  // namespace

bool Client::Impl::demo_command(const con::Args& args, DemoMode mode) {
  if (args.size() == 2) return play(args[1], mode);
  log_info("{} <demo>: play a demo", args[0]);
  return false;
}

// The whole list, as often as scr_timedemo_runs says; runs of one demo are apart, so that a slow minute is not one
// demo's.
void Client::Impl::time_demo_command(const con::Args& args) {
  if (args.size() < 2) return log_info("{}", kTimeHelp);
  end_demo(std::nullopt);
  time_demos.clear();
  for (int run = console.cvar("scr_timedemo_runs").integer(); run > 0; --run)
    for (std::size_t i = 1; i < args.size(); ++i) time_demos.push_back(args[i]);
  next_time_demo = 1;
  if (time_demos.size() > 1) demo_loop_next = -1;
  play(time_demos.front(), DemoMode::kTime);
  // What stands behind it on the command line has to wait: +timedemo demo1 +quit.
  if (!times() || console.buffer_empty()) return;
  held = true;
  console.insert("wait\ntimedemo_wait\n");
}

// Whatever else began in the meantime ends the list.
void Client::Impl::start_next_time_demo() {
  if (link() || asked() || shows_map()) next_time_demo = time_demos.size();
  while (!demo() && next_time_demo < time_demos.size()) play(time_demos[next_time_demo++], DemoMode::kTime);
}

// True if the demo started.
bool Client::Impl::play(const std::string& name, DemoMode mode) {
  const std::string path = demo_path(name);
  std::optional<FileData> data = files ? files(path) : std::nullopt;
  end_demo(std::nullopt);
  const Status status = data ? start(std::move(*data), path, mode) : Status(Error{"couldn't open " + path});
  if (status.ok()) return true;
  console.fail_unless(status);
  error = status.error();
  demo_loop_next = -1;
  return false;
}

// From the demo that plays, if it is in the list of startdemos, else from its beginning.
void Client::Impl::go_through_list(int steps) {
  const int count = static_cast<int>(demo_loop.size());
  if (count == 0) return log_info("No demos listed with startdemos");
  const auto here = std::find_if(demo_loop.begin(), demo_loop.end(), [this](const std::string& name) {
    return demo() && demo_path(name) == demo()->name();
  });
  const int from = here != demo_loop.end() ? static_cast<int>(here - demo_loop.begin()) : steps > 0 ? -1 : 0;
  demo_loop_next = (from + steps + count) % count;
  next_demo();
}

void Client::Impl::register_demo_commands() {
  if (!console.find_cvar("cl_startdemos"))
    console.add_cvar("cl_startdemos", "1", "0: startdemos plays nothing", con::kCvarArchive);

  console.add_command("playdemo", "playdemo <demo>: play a demo",
                      [this](const con::Args& args) { demo_command(args, DemoMode::kPlay); });
  console.add_cvar(
      {"scr_timedemo_runs", "1", "how often timedemo plays its list of demos", con::kCvarPlain, 1.0f, 1000.0f, true});
  console.add_command("timedemo", kTimeHelp, [this](const con::Args& args) { time_demo_command(args); });
  console.add_command("timedemo_wait", "timedemo_wait: delay the commands that follow until the timedemo has ended",
                      [this](const con::Args&) {
                        if (times()) console.insert("wait\ntimedemo_wait\n");
                      });
  console.add_command("stopdemo", "stopdemo: stop the playing demo", [this](const con::Args&) {
    demo_loop_next = -1;
    next_time_demo = time_demos.size();
    end_demo(std::nullopt);
  });
  console.add_command("startdemos", "startdemos <demo> ...: play demos in a loop", [this](const con::Args& args) {
    demo_loop.clear();
    for (std::size_t i = 1; i < args.size() && i <= kMaxDemoLoop; ++i) demo_loop.push_back(args[i]);
    const bool busy = held || !std::holds_alternative<NoSource>(source);
    held = false;
    demo_loop_next = busy || !console.cvar("cl_startdemos").on() ? -1 : 0;
    next_demo();
  });
  // A loop that has ended begins at its second demo, as Quake's does.
  console.add_command("demos", "demos: continue the loop of startdemos", [this](const con::Args&) {
    if (demo_loop_next < 0) demo_loop_next = 1;
    end_demo(std::nullopt);
    disconnect();
    next_demo();
  });
  console.add_command("demo_next", "demo_next: play the next demo of startdemos' list",
                      [this](const con::Args&) { go_through_list(1); });
  console.add_command("demo_prev", "demo_prev: play the demo before this one in startdemos' list",
                      [this](const con::Args&) { go_through_list(-1); });

  // Those of the demo that plays; a timedemo is not directed.
  const auto direct = [this](const char* name, const char* help, std::function<void(const con::Args&)> act) {
    console.add_command(name, help, [this, act = std::move(act)](const con::Args& args) {
      if (!demo() || timing()) return log_info("{}: no demo is playing", args[0]);
      act(args);
    });
  };
  direct("demo_jump", kJumpHelp, [this](const con::Args& args) {
    const std::string& text = args[1];
    const bool relative = text.starts_with('+') || text.starts_with('-');
    const auto time = parse_time(std::string_view(text).substr(relative ? 1 : 0));
    if (args.size() != 2 || !time || *time < 0.0) return log_info("{}", kJumpHelp);
    const double from = relative ? control.back_to.value_or(demo_seconds()) : 0.0;
    seek_demo(from + (text.starts_with('-') ? -*time : *time));
  });
  direct("demo_setspeed", kSpeedHelp, [this](const con::Args& args) {
    if (args.size() < 2) return log_info("The demo's speed is {} percent. {}", 100.0 * control.speed, kSpeedHelp);
    const auto percent = parse_number(args[1]);
    if (!percent) return log_info("{}", kSpeedHelp);
    control.paused = *percent == 0.0;
    if (control.paused) return;
    const double size = std::clamp(std::abs(*percent) / 100.0, DemoControl::kSlowest, DemoControl::kFastest);
    control.speed = std::copysign(size, *percent);
  });
  direct("demo_nudge", kNudgeHelp, [this](const con::Args& args) {
    const auto frames = args.size() < 2 ? 1 : parse_whole_number(args[1].substr(args[1].starts_with('+') ? 1 : 0));
    if (!frames || *frames == 0) return log_info("{}", kNudgeHelp);
    nudge_demo(static_cast<int>(std::clamp<std::int64_t>(*frames, -72'000, 72'000)));
  });
  direct("demo_pause", "demo_pause: pause the demo, or let it go on",
         [this](const con::Args&) { control.paused = !control.paused; });
  direct("demo_faster", "demo_faster: double the demo's speed, or end its pause",
         [this](const con::Args&) { control.faster(); });
  direct("demo_slower", "demo_slower: halve the demo's speed; below 1/32 it pauses",
         [this](const con::Args&) { control.slower(); });
  // A key that is let go after the demo has no effect, and needs no word.
  const auto hold = [this](const std::string& name, bool DemoControl::*member, const char* help) {
    for (const bool down : {true, false})
      console.add_command(
          (down ? "+" : "-") + name,
          down ? fmt::format("+{}: {} until -{}", name, help, name) : fmt::format("-{}: release +{}", name, name),
          [this, member, down](const con::Args&) { control.*member = down; });
  };
  hold("demo_forward", &DemoControl::forward, "play the demo five times as fast");
  hold("demo_rewind", &DemoControl::rewind, "play the demo backwards, five times as fast");
}

}  // namespace fb::cl
