// The steps of ReSTIR's techniques, and of their passes.
#include "estimators/restir/steps/begin.glsl"
#include "lib/steps/no_field.glsl"
#include "lib/steps/propose_scatter.glsl"
#include "estimators/restir/steps/direct.glsl"
#include "lib/steps/no_control.glsl"
#include "lib/steps/no_learning.glsl"
#include "lib/steps/no_record.glsl"
