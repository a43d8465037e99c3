// For gpu/vmf_device_test.cpp and gpu/vmf_table.cpp: shared/vmf.h as the device computes it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/test_vmf_probe.h"
layout(local_size_x = 64) in;
layout(push_constant) uniform Push { uint count; };
layout(set = 0, binding = 0, std430) readonly buffer Queries { VmfQuery queries[]; };
layout(set = 1, binding = 0, std430) writeonly buffer Answers { VmfAnswer answers[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < count) answers[i] = vmf_probe(queries[i]);
}
