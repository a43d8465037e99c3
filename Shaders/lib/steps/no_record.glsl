// Step `record` of a technique that stores nothing of its paths.
#include "lib/incident.glsl"

const bool kRecords = false;

void record_direct(inout Path path, Vertex v, Guidance g, Direct direct, vec3 throughput) {}
void record_hit(inout Path path, Vertex v, Guidance g, Proposal p, Incident incident, vec3 throughput) {}
void record_last(inout Path path, Vertex v, Direct direct, vec3 throughput) {}
void record_path(Path path, vec3 sum, inout uint rng) {}
void record_none(uvec2 block, uvec2 pixel) {}
