// One game as the client sees it: from one svc_serverinfo to the next. Everything that a message can change is here.
#pragma once

#include <functional>
#include <string>

#include "base/rng.h"
#include "client/dlights.h"
#include "client/particles.h"
#include "client/settings.h"
#include "client/state.h"
#include "client/temp_entities.h"

namespace fb::cl {

struct Session {
  ClientState state;
  ParticleSystem particles;
  DynamicLights lights;
  Beams beams;
  Settings settings;
  Rng rng{0x66756c6c62726967ull};
  std::uint64_t frame = 1;    // of advance(): what Entity::cut_frame counts in
  bool disconnected = false;  // svc_disconnect
  bool reconnect = false;     // "reconnect" was stuffed: the next frame starts the signon stages anew
  std::string stuffed;        // text after the last line break, until its line is complete

  // Called when svc_serverinfo has been understood: loads the map and fills state.models. Empty: nothing is loaded.
  std::function<Status(ClientState&)> load_world;
  // What the server prints.
  std::function<void(const std::string&)> print;

  // Forgets the game and keeps what outlives it: settings, callbacks, the frame count, the signon stage.
  void clear();
};

}  // namespace fb::cl
