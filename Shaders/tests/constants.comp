// For gpu/device_test.cpp: hands back what it was given as specialisation and push constants.
#version 460
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint kWord = 1u;
layout(constant_id = 2) const float kNumber = 1.0;
layout(constant_id = 3) const bool kFlag = false;
layout(push_constant) uniform Push {
  uint a;
  float b;
  uint words[30];
};
layout(set = 1, binding = 0, std430) writeonly buffer Result { uint result[]; };

void main() {
  if (gl_GlobalInvocationID.x != 0u) return;
  result[0] = gl_WorkGroupSize.x;
  result[1] = kWord;
  result[2] = floatBitsToUint(kNumber);
  result[3] = kFlag ? 1u : 0u;
  result[4] = a;
  result[5] = floatBitsToUint(b);
  result[6] = words[29];
}
