// Which member of a looping group shows at a time: groups of textures, skins, poses and sprite images alike.
#pragma once

#include <cstddef>
#include <vector>

namespace fb::scene {

// The first member whose end time (seconds, ascending) lies after `time` modulo the last one. 0 without end times.
std::size_t frame_of_group(const std::vector<float>& end_times, std::size_t count, double time);

// Members that each show for 1 / frames_per_second. At 5 a second this is Quake's R_TextureAnimation, which counts
// tenths of seconds and gives each texture two.
std::size_t frame_of_rate(double frames_per_second, std::size_t count, double time);

}  // namespace fb::scene
