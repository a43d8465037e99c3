// For gpu/device_test.cpp: y = a x + b over both descriptor sets and the uniform buffer, some rounds of it.
#version 460
layout(local_size_x = 64) in;
layout(set = 0, binding = 3, std430) readonly buffer Source { uint source[]; };
layout(set = 0, binding = 16, std140) uniform Factors { uint a, b, count, rounds; };
layout(set = 1, binding = 10, std430) buffer Target { uint target[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  uint x = source[i];
  for (uint round = 0u; round < rounds; ++round) x = a * x + b;
  target[i] += x;
}
