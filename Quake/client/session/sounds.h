// What a game sounds like: what the server's messages begin and end, and from where it is heard. Everything goes to the
// session's listener as it comes (scene/sounds.h).
#pragma once

#include <string_view>

#include "base/maths.h"
#include "client/session/session.h"
#include "formats/bsp.h"
#include "scene/sounds.h"

namespace fb::cl {

void apply_sound(Session& session, const net::svc::Sound& message);
void apply_stop_sound(Session& session, const net::svc::StopSound& message);
void apply_static_sound(Session& session, const net::svc::SpawnStaticSound& message);
// A demo that names a track of its own has that one played.
void apply_track(Session& session, const net::svc::CdTrack& message);
// Impacts and explosions have sounds that no server sends.
void temp_entity_sound(Session& session, const net::svc::TempEntity& message);
// A level of these sounds begins; without any, the game is left.
void begin_level_sounds(Session& session);
void end_sounds(Session& session);
// After a seek: falls silent but for the music; begins what sounds at this moment, where it would be by now. The music
// changes only if it is another than `heard_track`.
void stop_hearing(const Session& session);
void hear_again(const Session& session, int heard_track);
// A sound of the program itself, at full volume: "misc/talk.wav".
void local_sound(Session& session, std::string_view name);

// Heard from this place and these angles, in the map; without one there is nothing around.
scene::SoundScene sound_scene(const Session& session, const vec3& origin, const vec3& angles, const formats::Bsp* map);

}  // namespace fb::cl
