// Vulkan's structs: zeros and the type that each must name.
#pragma once

#include <vulkan/vulkan.h>

namespace fb::gpu {

template <typename Struct>
Struct vk_struct(VkStructureType type) {
  Struct made{};
  made.sType = type;
  return made;
}

}  // namespace fb::gpu
