// The player's buttons at the console, and their work in a frame.
#include <fmt/format.h>

#include "base/log.h"
#include "client/client_impl.h"
#include "console/console.h"

namespace fb::cl {
namespace {

// Of "+name 32": the key; typed without one, kTyped.
int key_of(const con::Args& args) { return args.size() > 1 ? args.integer(1) : Button::kTyped; }

}  // namespace

void Client::Impl::register_input_commands() {
  register_input_cvars(console);
  register_stick_cvars(console);
  const auto add = [this](const std::string& name, Button& button, const char* help) {
    console.add_command("+" + name, fmt::format("+{}: {} until -{}", name, help, name),
                        [&button](const con::Args& args) {
                          if (!button.press(key_of(args))) log_info("Three keys down for a button!");
                        });
    console.add_command("-" + name, fmt::format("-{}: release +{}", name, name),
                        [this, &button](const con::Args& args) {
                          if (args.size() > 1)
                            button.release(key_of(args));
                          else
                            button.release_all();
                          if (&button == &buttons.mouse_look && !button.down() && console.cvar("lookspring").on())
                            drift.start(session.state.time, input);
                        });
  };
#define FB_ADD(member, name, help) add(name, buttons.member, help);
  FB_BUTTONS(FB_ADD)
#undef FB_ADD
  console.add_command("impulse", "impulse <number>: send a number to the game's rules (1 to 8 choose weapons)",
                      [this](const con::Args& args) { buttons.impulse = args.integer(1) & 255; });
  console.add_command("centerview", "centerview: turn the view back to level",
                      [this](const con::Args&) { drift.start(session.state.time, input); });
  // Looking with the mouse outlives the program, as in QuakeSpasm.
  console.add_config_section([this] { return std::string(buttons.mouse_look.down() ? "+mlook\n" : "-mlook\n"); });
}

void Client::Impl::look(double seconds, const vec2& mouse) {
  input = read_input_settings(console);
  stick_settings = read_stick_settings(console);
  const vec2 counts = input.mouse_filter != 0.0f ? 0.5f * (mouse + last_mouse) : mouse;
  last_mouse = mouse;
  ClientState& state = session.state;
  if (!link() || state.signon != kSignons) return;
  if (adjust_angles(buttons, input, seconds, state.view_angles)) drift.stop(state.time);
  if (apply_mouse(buttons, input, counts, state.view_angles, mouse_move)) drift.stop(state.time);
  if (apply_look_stick(sticks, stick_settings, input, seconds, state.view_angles)) drift.stop(state.time);
  if (apply_gyro(sticks, stick_settings, input, buttons.gyro_action.down(), seconds, state.view_angles))
    drift.stop(state.time);
}

void Client::Impl::drift_pitch(double seconds) {
  ClientState& state = session.state;
  if (state.hud.intermission != Intermission::kNone || state.hud.paused) return;
  PitchDrift::Moment moment;
  moment.seconds = seconds;
  moment.time = state.time;
  moment.on_ground = state.on_ground;
  moment.forward = last_forward;
  moment.ideal_pitch = static_cast<float>(state.ideal_pitch);
  drift.advance(moment, input, state.view_angles.x);
}

}  // namespace fb::cl
