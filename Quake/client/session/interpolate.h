// Where everything is between two messages. relink() is Quake's CL_RelinkEntities with QuakeSpasm's rules: places and
// angles go evenly from the message before to the latest, monsters go by steps of a tenth of a second instead, and
// alias models blend from pose to pose.
#pragma once

#include "client/session/session.h"

namespace fb::cl {

// How far the present is between the two latest messages, 0..1. Moves state.time where it has run away from them.
// `timing`: a timedemo shows the latest message.
float lerp_point(ClientState& state, bool timing, bool no_lerp);

// Interpolates the player's velocity and view angles and every entity's place; leaves trails and lights behind them.
// Entities that the latest message did not name lose their model.
void relink(Session& session, bool demo, bool timing);

// Sets drawn_origin, drawn_angles, drawn_pose and visible of every entity and static. After relink().
void place_entities(Session& session);

// The place of an entity that moves in steps (or its origin and angles as they are).
void place_entity(Entity& entity, double time, bool lerp_move);
// The poses to blend; `smooth` is false for models that must not be blended.
void animate_entity(Entity& entity, const scene::Model& model, double time, bool smooth);

// Is a model's animation to be blended (r_lerpmodels, r_nolerp_list)?
bool animates_smoothly(const Settings& settings, const std::string& model_name);

}  // namespace fb::cl
