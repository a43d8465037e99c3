// Step `learning` of a technique that does not.
#include "lib/incident.glsl"

const bool kLearns = false;
const bool kFollowsMotion = false;

void learn_direct(Guidance g, Direct direct, Path path, inout uint rng) {}
void learn_last(Field here, Direct direct, Path path, inout uint rng) {}
void learn_waste(Guidance g, Path path) {}
void learn_hit(Vertex v, inout Guidance g, Proposal p, Incident incident, inout Path path, inout uint rng) {}
