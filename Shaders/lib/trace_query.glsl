// trace() by VK_KHR_ray_query. Primitive indices are in leaf order, as the attributes are; custom indices are
// instances.
#ifndef FB_LIB_TRACE_QUERY
#define FB_LIB_TRACE_QUERY

Hit trace(vec3 origin, vec3 direction, float t_min, float t_max, uint mask, inout uint rng) {
  rayQueryEXT query;
  rayQueryInitializeEXT(query, scene_tlas, FEATURE_CANDIDATES ? gl_RayFlagsNoneEXT : gl_RayFlagsOpaqueEXT, mask, origin,
                        t_min, direction, t_max);
  while (rayQueryProceedEXT(query)) {
    if (!FEATURE_CANDIDATES) continue;
    Hit candidate;
    candidate.t = rayQueryGetIntersectionTEXT(query, false);
    candidate.bary = rayQueryGetIntersectionBarycentricsEXT(query, false);
    candidate.instance = rayQueryGetIntersectionInstanceCustomIndexEXT(query, false);
    candidate.triangle = rayQueryGetIntersectionPrimitiveIndexEXT(query, false);
    bool ask = (instance_at(candidate.instance).flags & kInstanceTranslucent) != 0u ||
               (attribute_at(instance_at(candidate.instance).first_attribute + candidate.triangle).flags &
                kTriangleAlphaTest) != 0u;
    if (!ask || accept_candidate(candidate, rng)) rayQueryConfirmIntersectionEXT(query);
  }
  Hit hit = Hit(t_max, vec2(0.0), kNoIndex, 0u);
  if (rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionTriangleEXT) {
    hit.t = rayQueryGetIntersectionTEXT(query, true);
    hit.bary = rayQueryGetIntersectionBarycentricsEXT(query, true);
    hit.instance = rayQueryGetIntersectionInstanceCustomIndexEXT(query, true);
    hit.triangle = rayQueryGetIntersectionPrimitiveIndexEXT(query, true);
  }
  return hit;
}
#endif
