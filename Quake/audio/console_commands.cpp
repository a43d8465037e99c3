// The sound's cvars and commands. Names and defaults are QuakeSpasm's where QuakeSpasm has them.
#include <fmt/format.h>

#include <string>

#include "audio/sound_system.h"
#include "base/log.h"
#include "base/number.h"
#include "console/console.h"

namespace fb::audio {
namespace {

constexpr int kFirstPlayed = 345;  // entity of the first sound of `play`; each gets the next, so that none ends another

std::string with_extension(const std::string& name) {
  return name.find('.') == std::string::npos ? name + ".wav" : name;
}

}  // namespace

void SoundSystem::register_cvars() {
  using con::kCvarArchive;
  using con::kCvarPlain;
  const auto add = [this](con::CvarSpec spec) { console_.add_cvar(std::move(spec)); };
  add({"volume", "0.7", "volume of sounds", kCvarArchive, 0.0f, 1.0f});
  add({"bgmvolume", "1", "volume of the music", kCvarArchive, 0.0f, 1.0f});
  add({"ambient_level", "0.3", "volume of ambient sounds of water and sky", kCvarPlain, 0.0f, 10.0f});
  add({"ambient_fade", "100", "speed at which ambient sounds fade, 255ths of full volume a second", kCvarPlain, 0.0f,
       1e6f});
  add({"nosound", "0", "1: no new sounds; music plays on", kCvarPlain, 0.0f, 1.0f, true});
  add({"precache", "1", "1: load sounds when a level begins; 0: when they are first played", kCvarPlain, 0.0f, 1.0f,
       true});
  add({"loadas8bit", "0", "1: sounds are loaded with 8 bits", kCvarPlain, 0.0f, 1.0f, true});
  add({"sndspeed", "11025",
       "11025: sounds are resampled by a filter (snd_filterquality); any other rate: samples are held, as in Quake",
       kCvarPlain, 1000.0f, 384000.0f, true});
  add({"snd_mixspeed", "44100", "mixing rate, Hz, from -mixspeed", kCvarPlain, 8000.0f, 192000.0f, true});
  add({"snd_filterquality", "1", "quality of sound resampling: 1 to 5, longer and steeper filters", kCvarPlain,
       static_cast<float>(kLowestQuality), static_cast<float>(kHighestQuality), true});
  add({"snd_waterfx", "1", "strength of the filter that muffles sounds under water; 0: none", kCvarArchive, 0.0f,
       2.0f});
  add({"snd_mute_unfocused", "1", "1: silent while the window has no focus", kCvarArchive, 0.0f, 1.0f, true});
  add({"bgm_extmusic", "1", "1: play music from files", kCvarArchive, 0.0f, 1.0f, true});
}

void SoundSystem::register_commands() {
  const auto add = [this](const char* name, const char* help, con::Handler handler) {
    console_.add_command(name, help, [this, handler = std::move(handler)](const con::Args& args) {
      if (!started()) return log_info("{}: sound is off", args[0]);
      handler(args);
    });
  };
  add("play", "play <sound> ...: play sounds, such as misc/menu1.wav",
      [this](const con::Args& args) { play_names(args, false); });
  add("playvol", "playvol <sound> <volume> ...: play sounds at a volume of 0 to 1",
      [this](const con::Args& args) { play_names(args, true); });
  add("stopsound", "stopsound: end all sounds", [this](const con::Args&) { send(command::StopAll{}); });
  add("soundlist", "soundlist: list the loaded sounds", [this](const con::Args&) { list_sounds(); });
  add("soundinfo", "soundinfo: describe the output, and what plays", [this](const con::Args&) { print_info(); });
  add("music", "music <file>: play music/FILE, with or without its extension; without a name: say what plays",
      [this](const con::Args& args) { music_command(args); });
  add("music_stop", "music_stop: end the music", [this](const con::Args&) { music_.stop(); });
  add("music_pause", "music_pause: pause the music", [this](const con::Args&) { music_.pause_by_player(true); });
  add("music_resume", "music_resume: go on with the music",
      [this](const con::Args&) { music_.pause_by_player(false); });
  add("music_loop", "music_loop [on|off|toggle]: whether music begins anew when it is over",
      [this](const con::Args& args) {
        if (args[1] == "on" || args[1] == "off" || args[1] == "toggle")
          music_.set_looping(args[1] == "toggle" ? !music_.looping() : args[1] == "on");
        log_info("Music {}.", music_.looping() ? "begins anew when it is over" : "plays once");
      });
  add("cd", "cd <play N|loop N|stop|pause|resume|info|on|off>: Quake's commands for a disc, here for music files",
      [this](const con::Args& args) { cd_command(args); });
}

void SoundSystem::play_names(const con::Args& args, bool with_volumes) {
  const std::size_t step = with_volumes ? 2 : 1;
  for (std::size_t i = 1; i < args.size(); i += step) {
    const float volume = with_volumes ? glm::clamp(args.number(i + 1), 0.0f, 1.0f) : 1.0f;
    on(scene::SoundStart{with_extension(args[i]), kFirstPlayed + next_played_++, 0, listener_, volume, 1.0f});
  }
}

void SoundSystem::list_sounds() const {
  std::size_t bytes = 0;
  for (const auto& [name, sample] : samples_.loaded()) {
    if (!sample) continue;
    bytes += sample->frames.size() * sizeof(sample->frames[0]);
    log_info("{} {:2} bits {:6} Hz {:7.2f} s : {}", sample->loop_start ? "L" : " ", sample->bits, sample->rate,
             static_cast<double>(sample->frames.size()) / samples_.format().rate, name);
  }
  log_info("{} KB in {} sounds", bytes / 1024, samples_.loaded().size());
}

void SoundSystem::print_info() const {
  const Figures figures = this->figures();
  const std::uint32_t rate = samples_.format().rate;
  log_info("{}: stereo, {} Hz", output_name_, rate);
  log_info("{:.2f} s mixed, {} late, longest wait between two mixes {:.1f} ms",
           static_cast<double>(figures.frames) / rate, figures.late, 1e3 * figures.longest_wait);
  if (const std::string playing = music_.playing(); !playing.empty())
    log_info("{}{}, {} frames late", playing, music_.paused() ? " (paused)" : "", figures.music_late);
}

void SoundSystem::music_command(const con::Args& args) {
  if (args.size() > 1) {
    music_.play(args[1]);
    return;
  }
  const std::string playing = music_.playing();
  if (playing.empty())
    log_info("No music plays; music <file> plays one.");
  else
    log_info("{} plays{}.", playing, music_.paused() ? ", paused" : "");
}

void SoundSystem::cd_command(const con::Args& args) {
  const std::string& what = args[1];
  if (what == "play" || what == "loop") {
    const auto track = whole_number_in<int>("cd " + what, args[2], 0, 255);
    if (!track) return log_info("{}", track.error().message);
    music_.set_looping(what == "loop");
    on(scene::SoundTrack{*track});
  } else if (what == "stop" || what == "off" || what == "close" || what == "eject") {
    if (what == "off") console_.set("bgm_extmusic", "0");
    music_.stop();
  } else if (what == "on" || what == "reset") {
    console_.set("bgm_extmusic", "1");
  } else if (what == "pause" || what == "resume") {
    music_.pause_by_player(what == "pause");
  } else if (what == "info") {
    music_command(con::Args("music"));
  } else {
    log_info("cd: play N, loop N, stop, pause, resume, info, on or off is wanted");
  }
}

}  // namespace fb::audio
