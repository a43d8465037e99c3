// A demo that plays: its beginning and end, its messages, its pace, and the seeks.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/log.h"
#include "client/client_impl.h"
#include "console/console.h"
#include "client/session/parse.h"
#include "client/session/sounds.h"

namespace fb::cl {
namespace {

constexpr double kLongestStep = 0.05;  // seconds: of a demo that plays fast
constexpr float kFar = 100.0f;         // units: the eye jumps

}  // namespace

// Up twice as fast, down half as fast, through a pause below the slowest: as Ironwail's keys do.
void DemoControl::faster() {
  if (!paused) speed = std::copysign(std::clamp(std::abs(speed) * 2.0, kSlowest, kFastest), speed);
  paused = false;
}

void DemoControl::slower() {
  if (std::abs(speed) <= kSlowest)
    paused = true;
  else
    speed = std::copysign(std::max(std::abs(speed) * 0.5, kSlowest), speed);
}

Status Client::Impl::start(FileData data, std::string_view name, DemoMode mode) {
  end_demo(std::nullopt);
  disconnect();
  if (mode == DemoMode::kPlay) next_time_demo = time_demos.size();
  auto opened = DemoPlayback::open(std::move(data), name, mode, frame, clock());
  if (!opened.ok()) return opened.error();
  session.clear();
  session.reseed();
  session.state.message_view_angles = {};
  session.forced_track = opened->cd_track();
  view = {};
  view_memory = {};
  snapshots.forget();
  error.reset();
  source.emplace<DemoPlayback>(std::move(*opened));
  control = DemoControl();
  control.levels_before = session.levels;
  log_info("Playing demo from {}.", name);
  return ok_status();
}

void Client::Impl::end_demo(std::optional<Error> why, bool whole) {
  if (!demo()) return;
  if (timing()) {
    time_demo = demo()->result(frame, clock());
    time_demo->whole = whole;
    time_demo->index = static_cast<int>(std::max<std::size_t>(next_time_demo, 1)) - 1;
    time_demo->of = static_cast<int>(std::max<std::size_t>(time_demos.size(), 1));
    log_info("{}", time_demo->line());
  }
  source = NoSource{};
  control = DemoControl();
  session.quiet = false;
  session.state.signon = 0;
  session.state.hud.intermission = Intermission::kNone;
  session.forced_track = -1;
  end_sounds(session);
  snapshots.forget();
  if (why) {
    log_error("{}", why->message);
    error = std::move(why);
  }
}

void Client::Impl::read_demo() {
  ClientState& state = session.state;
  while (DemoPlayback* const playback = demo()) {
    if (!playback->due(state.signon == kSignons, state.time, state.message_times[0], frame, clock())) return;
    if (playback->at_end()) {
      end_demo(std::nullopt, true);
      next_demo();
      return;
    }
    auto message = playback->next();
    Status status = ok_status();
    if (message.ok()) {
      state.message_view_angles = {glm::clamp(message->view_angles, -1e6f, 1e6f), state.message_view_angles[0]};
      const bool begins = state.signon != kSignons;
      const vec3 before = state.view_angles;
      status = parse_server_message(session, message->data, playback->message_name());
      // With the first message that shows the level nobody has turned yet: the player looks where the server says in it
      // (svc_setangle), which the demo's own angles say from the next on.
      if (begins && state.signon == kSignons)
        state.message_view_angles.fill(state.view_angles != before ? state.view_angles : state.message_view_angles[0]);
    } else {
      status = message.error();
    }
    if (!status.ok()) {
      end_demo(status.error());
      return;
    }
    session.reconnect = false;  // the frames until the next svc_serverinfo are still the old level's
    if (session.disconnected) {
      session.disconnected = false;
      log_info("Server disconnected");
      end_demo(std::nullopt, true);
      next_demo();
      return;
    }
  }
}

DemoMoment Client::Impl::demo_moment() const {
  const int level = session.levels - control.levels_before - 1;
  return {static_cast<std::size_t>(std::max(level, 0)), session.state.time};
}

double Client::Impl::demo_seconds() { return demo()->index().seconds_at(demo_moment()); }

// `seconds` of the clock go by.
void Client::Impl::play_demo(double seconds) {
  if (timing()) return step(seconds);
  const double rate = active() ? control.rate() : 1.0;  // until there is something to pause
  follow_rate(rate);
  if (rate < 0.0) {
    play_back(-rate * seconds);
  } else if (rate == 0.0) {
    ++session.frame;  // nothing has moved since the last
  } else {
    // At the demo's own speed a frame is one step, as in Quake, however long it takes.
    const double longest = rate > 1.0 ? kLongestStep : seconds;
    double left = rate * seconds;
    do {
      step(std::min(left, longest));
      left -= longest;
    } while (left > 0.0 && demo());
  }
  if (demo()) take_keyframe();
  frame_seconds = seconds;
}

// Only what goes forwards is heard.
void Client::Impl::follow_rate(double rate) {
  if (rate >= 0.0) control.back_to.reset();
  const bool silent = rate <= 0.0;
  if (silent == control.heard_track.has_value() || !active()) return;
  if (silent) {
    control.heard_track = session.sounds.track();
    stop_hearing(session);
  } else {
    hear_again(session, *control.heard_track);
    control.heard_track.reset();
  }
}

void Client::Impl::take_keyframe() {
  const DemoMoment moment = demo_moment();
  if (session.state.signon != kSignons || !control.keyframes.wants(moment)) return;
  auto keyframe = std::make_unique<Keyframe>();
  keyframe->moment = moment;
  keyframe->place = demo()->place();
  keyframe->session = session;
  keyframe->view = view;
  keyframe->view_memory = view_memory;
  control.keyframes.add(std::move(keyframe));
}

Status Client::Impl::restore(const Keyframe& keyframe) {
  const bool other_level = keyframe.session.levels != loaded_level;
  const bool other_sky = other_level || keyframe.session.state.skybox != session.state.skybox;
  static_cast<SessionMoment&>(session) = keyframe.session;
  session.state.sky_changed = other_sky;
  view = keyframe.view;
  view_memory = keyframe.view_memory;
  demo()->go_to(keyframe.place);
  if (other_level) return load_models(session.state);
  find_models(session.state);  // those of the keyframe may be of an earlier visit to the level
  return ok_status();
}

// The level's first message begins everything anew.
void Client::Impl::go_to_level(std::size_t level) {
  demo()->go_to(demo()->index().levels[level].place);
  session.levels = control.levels_before + static_cast<int>(level);
  session.state.signon = 0;
  session.stuffed.clear();
}

// The first frame, of those a step apart, that is not before the moment. False: the demo has ended by an error.
bool Client::Impl::go_to_moment(const DemoMoment& moment) {
  // A level's first frame is a little before its first time.
  const bool at_first = moment.time <= demo()->index().levels[moment.level].first_time;
  const auto reached = [&] {
    const DemoMoment now = demo_moment();
    const bool begun = session.levels > control.levels_before && session.state.signon == kSignons;
    return begun && (now.level > moment.level || (now.level == moment.level && (at_first || now.time >= moment.time)));
  };
  const Keyframe* const keyframe = control.keyframes.before(moment);
  const DemoMoment now = demo_moment();
  const bool onward = active() && now.level == moment.level && now.time <= moment.time;
  if (!onward || (keyframe && keyframe->moment.time > now.time)) {
    if (!keyframe) {
      go_to_level(moment.level);
    } else if (const Status restored = restore(*keyframe); !restored.ok()) {
      end_demo(restored.error());
      return false;
    }
  }
  while (demo() && !reached()) {
    step(DemoControl::kStep);
    if (demo()) take_keyframe();
  }
  return demo() != nullptr;
}

// Where the demo stands after it is shown, not yet heard.
bool Client::Impl::pass_to(double seconds) {
  const DemoIndex& index = demo()->index();
  if (index.levels.empty()) return false;
  // The last frames read the message that ends the demo.
  const double latest = std::max(0.0, index.seconds() - 2.0 * DemoControl::kStep);
  session.quiet = true;
  const bool there = go_to_moment(index.moment_at(std::clamp(seconds, 0.0, latest)));
  session.quiet = false;
  return there;
}

bool Client::Impl::seek_demo(double seconds) {
  if (!demo() || timing() || !std::isfinite(seconds)) return false;
  const int track = session.sounds.track();
  if (!pass_to(seconds)) return false;
  snapshots.forget();
  control.back_to.reset();
  if (!control.heard_track) hear_again(session, track);
  finish_moment();
  return true;
}

// Backwards: what has been is passed through again, up to a little earlier. Frames follow one another as they do
// forwards, so the picture keeps its history.
void Client::Impl::play_back(double seconds) {
  const vec3 eye = view.origin;
  const int level = session.levels;
  control.back_to = std::max(0.0, control.back_to.value_or(demo_seconds()) - seconds);
  if (!pass_to(*control.back_to)) return;
  if (session.levels != level || glm::distance(eye, view.origin) > kFar) snapshots.forget();
}

void Client::Impl::nudge_demo(int steps) {
  if (!demo() || timing()) return;
  control.paused = true;
  if (steps > 0) {
    for (int i = 0; i < steps && demo(); ++i) step(DemoControl::kStep);
    if (demo()) finish_moment();
  } else {
    seek_demo(demo_seconds() + (steps - 0.5) * DemoControl::kStep);  // frames are that far apart, about
  }
}

void Client::Impl::next_demo() {
  if (demo_loop_next < 0) return;
  if (demo_loop.empty()) {
    log_info("No demos listed with startdemos");
    demo_loop_next = -1;
    return;
  }
  const auto index = static_cast<std::size_t>(demo_loop_next) % demo_loop.size();
  demo_loop_next = static_cast<int>(index) + 1;
  console.insert("playdemo \"" + demo_loop[index] + "\"\n");
}

}  // namespace fb::cl
