// Blends the rays of probes that had a turn into what they know: a workgroup a probe, of whose maps a lane has one
// texel of light and four of distances, so that a ray is read once for all of these.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "estimators/ddgi/steps/probes.glsl"
#include "shared/rng.h"

layout(local_size_x = 64) in;

const float kInWall = 0.2;  // of the distance that rays count as which end at a back: such a probe sees next to nothing
const float kLeastWeight = 1e-3;  // of rays near a texel's direction, for it to learn anything

vec4 power_50(vec4 x) {
  vec4 x2 = x * x, x4 = x2 * x2, x8 = x4 * x4, x16 = x8 * x8;
  return x16 * x16 * x16 * x2;
}

void blend_depth(uint at, float weight, float sum, float square, float share) {
  if (!(weight > kLeastWeight)) return;
  ddgi_depth.at[at] = packUnorm2x16(mix(unpackUnorm2x16(ddgi_depth.at[at]), vec2(sum, square) / weight, share));
}

// Each ray stands for light over the density of rays per solid angle: their mean with the cosine, over pi, is the
// irradiance over pi whatever that density is.
void main() {
  uint turn = gl_WorkGroupID.x, lane = gl_LocalInvocationID.x;
  uint probe = ddgi_turns.at[turn], first = 2u * turn * ddgi.rays;
  float updates = float(ddgi_probes.at[2u * probe + 1u].x & kDdgiUpdates);
  if (updates == 0.0) return;
  float share = max(1.0 / updates, 1.0 - ddgi.ddgi_hysteresis);
  vec3 about = ddgi_direction(lane, kDdgiLightSide), light = vec3(0.0);
  // Of distances: a column for each of the lane's texels.
  vec3 a = ddgi_direction(lane, kDdgiDepthSide), b = ddgi_direction(lane + 64u, kDdgiDepthSide);
  vec3 c = ddgi_direction(lane + 128u, kDdgiDepthSide), d = ddgi_direction(lane + 192u, kDdgiDepthSide);
  bool keeps = ddgi_keeps_sent(ddgi.ddgi_control, ddgi.ddgi_guide);
  vec3 sent = vec3(0.0);
  vec4 weights = vec4(0.0), sums = vec4(0.0), squares = vec4(0.0);
  uint i = 0u;
  do {
    vec4 ray = uintBitsToFloat(texelFetch(ddgi_ray_texels, int(first + 2u * i)));
    uvec4 brings = texelFetch(ddgi_ray_texels, int(first + 2u * i + 1u));
    light += uintBitsToFloat(brings.rgb) * max(dot(ray.xyz, about), 0.0);
    if (keeps && ddgi_texel_about(ray.xyz, kDdgiLightSide) == lane) sent += unpack_rgb9e5(brings.w);
    float far = ray.w / ddgi.origin.w;
    far = far < 0.0 ? -kInWall * far : far;
    // Rays that look for lights know no distances.
    vec4 near =
        i < ddgi.looking
            ? vec4(0.0)
            : power_50(max(vec4(dot(ray.xyz, a), dot(ray.xyz, b), dot(ray.xyz, c), dot(ray.xyz, d)), vec4(0.0)));
    weights += near;
    sums += near * far;
    squares += near * far * far;
  } while (++i < ddgi.rays);

  uint at = probe * kDdgiLightTexels + lane, rng = rng_seed(at, frame.frame, 0u, frame.seed ^ 0x14057b7eu);
  vec3 before = unpack_rgb9e5(ddgi_light.at[at]);
  ddgi_light.at[at] = pack_rgb9e5(mix(before, light / (kPiShared * float(ddgi.rays)), share), rng_uniform(rng));
  if (keeps) {
    // Of an estimate of the integral over the texel.
    sent /= float(ddgi.rays) * ddgi_texel_angle(lane, kDdgiLightSide);
    uint kept = ddgi.probes * kDdgiLightTexels + at;
    ddgi_light.at[kept] = pack_rgb9e5(mix(unpack_rgb9e5(ddgi_light.at[kept]), sent, share), rng_uniform(rng));
  }
  uint depth = probe * kDdgiDepthTexels + lane;
  blend_depth(depth, weights.x, sums.x, squares.x, share);
  blend_depth(depth + 64u, weights.y, sums.y, squares.y, share);
  blend_depth(depth + 128u, weights.z, sums.z, squares.z, share);
  blend_depth(depth + 192u, weights.w, sums.w, squares.w, share);
}
