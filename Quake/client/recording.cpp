// record and stop: what the server says, as it comes, into a demo.
#include <fmt/format.h>

#include <system_error>

#include "base/log.h"
#include "base/number.h"
#include "client/client_impl.h"
#include "console/console.h"

namespace fb::cl {
namespace {

constexpr const char* kRecordHelp =
    "record <demo> [<map> [cd track]]: record a demo, from now or from a map's start, until stop";

}  // namespace

void Client::Impl::register_recording_commands() {
  console.add_command("record", kRecordHelp, [this](const con::Args& args) { record(args); });
  console.add_command("stop", "stop: end the recording of a demo", [this](const con::Args&) {
    if (recorder)
      stop_recording();
    else
      log_info("Not recording a demo.");
  });
}

void Client::Impl::record(const con::Args& args) {
  if (demo()) return log_info("Can't record during demo playback");
  stop_recording();
  if (args.size() < 2 || args.size() > 4) return log_info("{}", kRecordHelp);
  if (args.size() == 2 && link() && session.state.signon < 2)
    return log_info("Can't record while the game is still loading; try again in a moment.");
  if (!write_path) return console.fail(fmt::format("record {}: there is nowhere to write to", args[1]));
  const auto path = write_path(demo_path(args[1]));
  if (!path.ok()) return console.fail(fmt::format("record {}: {}", args[1], path.error().message));

  const auto track = whole_number_in<int>("record: CD track", args.size() == 4 ? args[3] : "-1", -1, 255);
  if (!track) return console.fail(track.error().message);
  if (args.size() > 2) {
    const int before = games;
    console.execute_line("map " + con::in_quotes(args[2]));
    if (games == before) return;  // it has said why
  }
  auto started = DemoRecorder::start(*path, *track);
  if (!started.ok()) return console.fail_unless(started.error());
  std::error_code ignored;
  const bool replaces = std::filesystem::exists(*path, ignored);
  log_info("recording to {}{}", path->string(), replaces ? ", which will be replaced when the recording ends" : "");
  recorder.emplace(std::move(*started));
  session.forced_track = *track;
  if (args.size() == 2 && link()) record_game_so_far();
}

void Client::Impl::record_message(ByteView data) {
  if (!recorder) return;
  const Status status = recorder->add(session.state.view_angles, data);
  if (!status.ok()) cut_recording(status.error());
}

void Client::Impl::cut_recording(const Error& why) {
  const auto kept = recorder->cut_short();
  console.fail(fmt::format("{}; the recording ends here{}", why.message, kept.ok() ? ", as " + kept->string() : ""));
  recorder.reset();
  session.forced_track = -1;
}

// A server that talks for ever before the game begins fills no memory: such a game cannot be recorded from its midst.
void Client::Impl::keep_for_recording(ByteView data) {
  constexpr std::size_t kMostMessages = 1024;
  if (head.size() < kMostMessages) head.emplace_back(data.begin(), data.end());
}

// What somebody has to be told who comes to the game now: the messages of its signon as they came, then what has
// changed since, so far as it is told once only. Entities follow with the next message.
void Client::Impl::record_game_so_far() {
  for (const Bytes& message : head) record_message(message);
  const ClientState& state = session.state;
  net::MessageWriter writer(state.protocol);
  const auto say = [&writer](const net::ServerMessage& message) { net::write_server_message(writer, message); };
  for (std::size_t i = 0; i < state.hud.scores.size(); ++i) {
    const Score& score = state.hud.scores[i];
    const int client = static_cast<int>(i);
    say(net::svc::UpdateName{client, score.name});
    say(net::svc::UpdateFrags{client, score.frags});
    say(net::svc::UpdateColors{client, score.colors});
  }
  for (std::size_t i = 0; i < state.light_styles.size(); ++i)
    say(net::svc::LightStyle{static_cast<int>(i), state.light_styles[i]});
  for (const int stat : {net::kStatTotalSecrets, net::kStatTotalMonsters, net::kStatSecrets, net::kStatMonsters})
    say(net::svc::UpdateStat{stat, state.hud.stats[static_cast<std::size_t>(stat)]});
  for (const std::string& line : state.late_precaches) say(net::svc::StuffText{line});
  if (state.skybox) say(net::svc::StuffText{fmt::format("sky \"{}\"\n", *state.skybox)});
  const Fog& fog = state.fog.now;
  say(net::svc::StuffText{fmt::format("fog {} {} {} {}\n", fog.density, fog.color.x, fog.color.y, fog.color.z)});
  if (state.hud.paused) say(net::svc::SetPause{true});
  say(net::svc::SetView{state.view_entity});
  say(net::svc::SignonNum{3});
  record_message(writer.bytes());
}

void Client::Impl::stop_recording() {
  if (!recorder) return;
  const Status status = recorder->finish(session.state.view_angles);
  if (!status.ok()) return cut_recording(status.error());
  log_info("Completed demo {}", recorder->path().string());
  recorder.reset();
  session.forced_track = -1;
}

}  // namespace fb::cl
