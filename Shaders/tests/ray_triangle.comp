// For gpu/ray_query_test.cpp: one ray an invocation against the top level; says what was hit and where.
#version 460
#extension GL_EXT_ray_query : require
layout(local_size_x = 64) in;
struct Ray {
  vec4 origin;     // w: t_max
  vec4 direction;  // w: bits of the mask
};
struct Hit {
  uint instance, triangle, front, candidates;
  vec4 t_bary;  // t, or -1 where nothing was hit
};
layout(push_constant) uniform Push { uint count, ray_flags; };
layout(set = 0, binding = 0, std430) readonly buffer Rays { Ray rays[]; };
layout(set = 0, binding = 17) uniform accelerationStructureEXT scene;
layout(set = 1, binding = 0, std430) writeonly buffer Hits { Hit hits[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  Hit hit = Hit(0u, 0u, 0u, 0u, vec4(-1.0));
  rayQueryEXT query;
  rayQueryInitializeEXT(query, scene, ray_flags, floatBitsToUint(rays[i].direction.w), rays[i].origin.xyz, 0.0,
                        rays[i].direction.xyz, rays[i].origin.w);
  while (rayQueryProceedEXT(query)) {
    ++hit.candidates;
    rayQueryConfirmIntersectionEXT(query);
  }
  if (rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionTriangleEXT) {
    hit.instance = rayQueryGetIntersectionInstanceCustomIndexEXT(query, true);
    hit.triangle = rayQueryGetIntersectionPrimitiveIndexEXT(query, true);
    hit.front = rayQueryGetIntersectionFrontFaceEXT(query, true) ? 1u : 0u;
    hit.t_bary =
        vec4(rayQueryGetIntersectionTEXT(query, true), rayQueryGetIntersectionBarycentricsEXT(query, true), 0.0);
  }
  hits[i] = hit;
}
