// Tells one version of the code that makes an estimator's linear picture from another: what a kept reference was made
// by. It holds all shaders, so that a new one is in it, but other techniques' and those behind the
// mean radiance (kBindMean): denoiser, exposure, bloom, tone curve, anti-aliasing. Of the host's code it holds numbers
// that are raised by hand.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "render/passes/shader_code.h"
#include "render/scene/light_list.h"

namespace fb::render {

struct RadianceCode {
  std::span<const CompiledShader> shaders = compiled_shaders();
  std::uint32_t light_list = kLightListVersion;
};
// Every variant counts: devices differ in which they take.
std::uint64_t radiance_hash(std::string_view estimator, const RadianceCode& code = {});

// The shaders that show the picture: in no estimator's hash.
std::span<const std::string_view> display_shaders();

}  // namespace fb::render
