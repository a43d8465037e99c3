// All steps of a technique that has none: for passes that start or end pixels (lib/pixel_start.glsl,
// lib/store_light.glsl) or trace rays of their own, and define no step themselves.
#include "lib/steps/one_path.glsl"
#include "lib/steps/no_field.glsl"
#include "lib/steps/propose_scatter.glsl"
#include "lib/steps/no_direct.glsl"
#include "lib/steps/no_control.glsl"
#include "lib/steps/no_learning.glsl"
#include "lib/steps/no_record.glsl"
#include "lib/steps/no_views.glsl"
