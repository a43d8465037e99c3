#include "client/session/fog_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "console/args.h"
#include "world/entity_lump.h"

namespace fb::cl {

Result<std::string> fog_command(ClientState& state, const con::Args& args) {
  Fog fog = fog_at(state.fog, state.time);
  std::vector<float> numbers;
  for (std::size_t i = 1; i < args.size(); ++i) {
    const std::vector<float> number = world::parse_numbers(args[i], 1);
    if (number.empty()) return Error{fmt::format("fog {}: a number is wanted", args[i])};
    numbers.push_back(number[0]);
  }
  const std::size_t count = numbers.size();
  if (count == 0)
    return fmt::format(
        "fog <density> [seconds], fog <red> <green> <blue> or fog <density> <red> <green> <blue> [seconds]\n"
        "Now: density {:.4g}, colour {:.4g} {:.4g} {:.4g}",
        fog.density, fog.color.x, fog.color.y, fog.color.z);
  if (count != 3) fog.density = std::clamp(numbers[0], 0.0f, kDensestFog);
  if (count >= 3) {
    const std::size_t red = count == 3 ? 0 : 1;
    fog.color = glm::clamp(vec3(numbers[red], numbers[red + 1], numbers[red + 2]), 0.0f, 1.0f);
  }
  const float seconds = count == 2 ? numbers[1] : count == 5 ? numbers[4] : 0.0f;
  change_fog(state.fog, fog, std::max(seconds, 0.0f), state.time);
  return std::string();
}

}  // namespace fb::cl
