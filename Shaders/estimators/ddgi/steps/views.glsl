// Step `views`: what probes say of surfaces, and the probes themselves as balls.
#ifndef FB_DDGI_VIEWS_GLSL
#define FB_DDGI_VIEWS_GLSL
#include "estimators/ddgi/steps/field.glsl"
#include "lib/store_light.glsl"
#include "shared/tone.h"

const bool kHasViews = true;

const float kBall = 0.06;  // radius, of the least spacing
const vec3 kNotKnown = vec3(0.5, 0.0, 0.5);

vec3 shown_light(vec3 light) { return srgb_from_linear(filmic(light * exposure_now())); }

// The nearest ball that the camera sees in a direction before a distance.
void draw_ball(vec3 ray, float reach, inout vec3 color) {
  float radius = kBall * ddgi.spacing.w;
  uint probe = 0u;
  do {
    vec3 off = frame.camera_position.xyz - place_of_probe(probe);
    float b = dot(off, ray), c = dot(off, off) - radius * radius, inside = b * b - c;
    float at = -b - sqrt(max(inside, 0.0));
    if (inside > 0.0 && at > 0.0 && at < reach && !stands_nowhere(probe)) {
      reach = at;
      uvec4 record = ddgi_probes.at[2u * probe + 1u];
      vec3 n = normalize(off + ray * at);
      bool known = (record.x & kDdgiUpdates) != 0u, asleep = (record.x & kDdgiAsleep) != 0u;
      vec3 shown = frame.debug_view == kViewDdgiProbes ? shown_light(light_of_probe(probe, n))
                                                       : vec3(depth_of_probe(probe, n).x / ddgi.origin.w);
      color = asleep ? vec3(0.7, 0.0, 0.0) : known ? shown : kNotKnown;
    }
  } while (++probe < ddgi.probes);
}

void draw_view(PathPixel p, bool lit, Vertex v) {
  vec3 color = vec3(0.0);
  Path path = path_of(p, 0u);
  path.own.entered = true;
  path.own.kind = kWhole;
  if (lit) {
    v.scatter.bsdf = Bsdf(vec3(1.0), 1.0, 0.0, 0.0);
    Field f = field_at(v, path);
    color = f.known ? shown_light(f.diffuse) : kNotKnown;
  }
  if (frame.debug_view != kViewDdgiLight) {
    color *= 0.3;
    float far = lit ? distance(v.position, frame.camera_position.xyz) : kRayEnd;
    draw_ball(normalize(camera_direction(vec2(p.pixel) + 0.5 + jitter_of(p.pixel))), far, color);
  }
  ldr.at[p.at] = packUnorm4x8(vec4(clamp(color, 0.0, 1.0), 1.0));
}
#endif
