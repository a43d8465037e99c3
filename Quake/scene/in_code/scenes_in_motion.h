// Films made in code in which the light itself changes: what an estimator that learns from former frames must follow.
// Closed, all emission EmissionKind::kConstant. Each is a function of the frame's number, so that any frame can be had
// alone; snapshots that share `assets` are frames of one film. Frames are 1 / frames_per_second seconds apart.
#pragma once

#include <cstdint>
#include <memory>

#include "scene/snapshot.h"

namespace fb::scene {

// Hard: the one strong light is small and fast. A dark corridor with pillars (two arms, 128 high and 160 wide, around a
// bend) in which a few dim panels glow; from frame 1 on a rocket of radius 5 flies away from the camera at 1000 units a
// second, turns the corner after 664 units and is gone after 1224 (Alber 2025, Fig. 4: in frame 0 it is not there). At
// 60 frames a second it moves 16.7 units from frame to frame.
constexpr std::uint64_t kRocketFirstFrame = 1;
constexpr std::uint32_t kRocket = kIdDynamicLight;
constexpr float kRocketSpeed = 1000.0f;                        // units a second
constexpr float kRocketCorner = 664.0f, kRocketEnd = 1224.0f;  // units flown
std::shared_ptr<const Assets> rocket_assets();
FrameSnapshot rocket(const std::shared_ptr<const Assets>& assets, std::uint64_t frame, double frames_per_second);
// Whether the rocket is there.
bool rocket_flies(std::uint64_t frame, double frames_per_second);

// Hard: all that was learnt becomes wrong at once. A pillared room with a lamp that is there until frame
// kLightsOutFrame - 1, and from then on is gone; six weak lights (together a fiftieth of its power) stay.
constexpr std::uint64_t kLightsOutFrame = 100;
constexpr std::uint32_t kLightsOutLamp = kIdDynamicLight;
constexpr std::uint32_t kLightsOutWeak = kIdEntityLight;  // + 0 .. 5
std::shared_ptr<const Assets> lights_out_assets();
FrameSnapshot lights_out(const std::shared_ptr<const Assets>& assets, std::uint64_t frame, double frames_per_second);

// Hard: what shines on a place hides within a frame. A small strong lamp under the ceiling of a closed room, a plate
// that swings beneath it, so that the edges of its shadow run over the floor at up to 430 units a second, and a lamp
// with a hundredth of its power (Dittebrandt 2023, Fig. 15). A function of time, in seconds.
constexpr std::uint32_t kOccluder = kIdEntity + 1;
constexpr std::uint32_t kOccluderLamp = kIdEntityLight;  // and the weak one
std::shared_ptr<const Assets> occluder_assets();
FrameSnapshot occluder(const std::shared_ptr<const Assets>& assets, double time, double prev_time);

}  // namespace fb::scene
