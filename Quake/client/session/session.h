// One game as the client sees it: from one svc_serverinfo to the next. Everything that a message can change is here.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "base/rng.h"
#include "client/effects/effects.h"
#include "client/session/settings.h"
#include "client/session/sound_memory.h"
#include "client/session/state.h"
#include "console/localization.h"
#include "scene/sounds.h"

namespace fb::cl {

// A moment of the game: what messages and the passing of time change. Copied whole by keyframes of demos.
struct SessionMoment {
  static constexpr std::uint64_t kSeed = 0x66756c6c62726967ull, kSoundSeed = 0x736f756e6473ull;

  ClientState state;
  Effects effects;
  SoundMemory sounds;
  Rng rng{kSeed};
  Rng sound_rng{kSoundSeed};  // its own: what is heard must not change what is seen
  bool disconnected = false;  // svc_disconnect
  bool reconnect = false;     // "reconnect" was stuffed: the level is over for whoever plays on the server
  int levels = 0;             // svc_serverinfos so far
  int signon_heard = 0;       // the last svc_signonnum, for whoever has to answer it and then sets it to 0
  std::string stuffed;        // text after the last line break, until its line is complete
};

struct Session : SessionMoment {
  Settings settings;
  std::uint64_t frame = 1;  // steps of time so far, be it backwards: what Entity::cut_frame counts in
  int forced_track = -1;    // of the demo that plays or is recorded: instead of the server's; -1: none
  bool quiet = false;       // what is passed over is neither heard nor printed, only remembered

  // Called when svc_serverinfo has been understood: loads the map and fills state.models. Empty: nothing is loaded.
  std::function<Status(ClientState&)> load_world;
  // A model that a level gets while it runs. Empty: none is loaded.
  std::function<const scene::Model*(const std::string& name)> load_model;
  // What a server stuffs beyond what shows (parse.cpp, obey): only the local one's goes to the console. Empty: nowhere.
  std::function<void(std::string_view line)> command;
  // What the server prints.
  std::function<void(const std::string&)> print;
  // What the server says by keys, in the player's language; null: as it is.
  const con::Localization* localization = nullptr;
  // What there is to hear, as it happens. Empty: nobody listens.
  scene::SoundListener sound_listener;

  // Forgets the game and keeps what outlives it: settings, callbacks, the frame count. The signon begins anew.
  void clear();
  // Random numbers and the numbers of particles begin anew, so that a level of a demo is the same whatever came before.
  void reseed();
};

}  // namespace fb::cl
