// One game as the client sees it: from one svc_serverinfo to the next. Everything that a message can change is here.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "base/rng.h"
#include "client/effects/effects.h"
#include "client/session/settings.h"
#include "client/session/state.h"
#include "scene/sounds.h"

namespace fb::cl {

struct Session {
  ClientState state;
  Effects effects;
  Settings settings;
  Rng rng{0x66756c6c62726967ull};
  static constexpr std::uint64_t kSoundSeed = 0x736f756e6473ull;
  Rng sound_rng{kSoundSeed};  // its own: who listens must not change what is seen
  std::uint64_t frame = 1;    // of advance(): what Entity::cut_frame counts in
  bool disconnected = false;  // svc_disconnect
  bool reconnect = false;     // "reconnect" was stuffed: the level is over for whoever plays on the server
  int levels = 0;             // svc_serverinfos so far
  int signon_heard = 0;       // the last svc_signonnum, for whoever has to answer it and then sets it to 0
  int forced_track = -1;      // of the demo that plays or is recorded: instead of the server's; -1: none
  std::string stuffed;        // text after the last line break, until its line is complete

  // Called when svc_serverinfo has been understood: loads the map and fills state.models. Empty: nothing is loaded.
  std::function<Status(ClientState&)> load_world;
  // What a server stuffs beyond what shows (parse.cpp, obey): only the local one's goes to the console. Empty: nowhere.
  std::function<void(std::string_view line)> command;
  // What the server prints.
  std::function<void(const std::string&)> print;
  // What there is to hear, as it happens. Empty: nobody listens.
  scene::SoundListener sound_listener;

  // Forgets the game and keeps what outlives it: settings, callbacks, the frame count. The signon begins anew.
  void clear();
};

}  // namespace fb::cl
