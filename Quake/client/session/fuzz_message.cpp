// Fuzzes what a server may say: datagrams with random bytes are refused with a place and a cause or obeyed, and then
// the client lives through a frame and shows it, with every number finite and every id once.
//
// The input: a byte that chooses the protocol, then datagrams, each after its length (two bytes).
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <unordered_set>

#include "base/log.h"
#include "client/session/interpolate.h"
#include "client/session/parse.h"
#include "client/snapshot_builder.h"
#include "client/test_demo.h"

namespace fb::cl {
namespace {

void demand(bool condition, const char* complaint) {
  if (condition) return;
  std::fprintf(stderr, "promise broken: %s\n", complaint);
  std::abort();
}

struct Fixture {
  Fixture() : files(test::game_files()), library(files.loader()) {
    set_log_level(LogLevel::kError);
    demand(library.load_map("maps/test.bsp").ok(), "the test's own map");
    for (const std::string& name : test::server_info().models) models.push_back(&library.model(name));
  }
  scene::test::TestFiles files;
  scene::ModelLibrary library;
  std::vector<const scene::Model*> models;
};

bool finite(const vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void show(const scene::FrameSnapshot& snapshot) {
  std::unordered_set<std::uint32_t> ids;
  demand(finite(snapshot.camera.position) && finite(snapshot.camera.angles), "a camera that is finite");
  for (const scene::Instance& i : snapshot.instances) {
    demand(ids.insert(i.id).second, "an id once");
    demand(i.mesh < snapshot.assets->meshes.size(), "a mesh that exists");
    for (int column = 0; column < 4; ++column) demand(finite(i.transform[column]), "transforms that are finite");
    const scene::Mesh& mesh = snapshot.assets->meshes[i.mesh];
    demand(!mesh.posed() || (i.pose.a < mesh.pose_count && i.pose.b < mesh.pose_count), "poses that exist");
    demand(i.pose.t >= 0.0f && i.pose.t <= 1.0f, "a blend from 0 to 1");
    demand(std::isfinite(i.alpha) && finite(i.emission), "an emission that is finite");
  }
}

void frame(Session& session, ViewMemory& memory, SnapshotBuilder& builder, Fixture& fixture) {
  ++session.frame;
  ClientState& state = session.state;
  state.old_time = state.time;
  state.time += 0.02;
  relink(session, true, false);
  const Entity* eye = state.view_entity_state();
  session.effects.beams.update(state.time, state.view_entity, eye ? eye->origin : vec3(0.0f));
  const View view = calculate_view(session, memory, fixture.library.map(), 0.02);
  place_entities(session);
  static scene::FrameSnapshot snapshot;
  builder.build({session, view, fixture.library, state.model(1), std::nullopt, 64, 48, true, {}}, snapshot);
  show(snapshot);
  session.effects.particles.run(state.time, 0.02);
  session.effects.lights.decay(state.time, 0.02);
}

void play(ByteView input, Fixture& fixture) {
  constexpr net::Protocol kProtocols[] = {{15, 0},
                                          {666, 0},
                                          {999, net::kShortAngle | net::kInt32Coord},
                                          {999, net::kFloatAngle | net::kFloatCoord},
                                          {999, net::kCoord24}};
  ByteReader reader(input, "input");
  Session session;
  session.load_world = [&](ClientState& s) {
    for (std::size_t i = 1; i < s.models.size() && i <= fixture.models.size(); ++i) s.models[i] = fixture.models[i - 1];
    return ok_status();
  };
  session.settings.v_idlescale = 1.0f;
  ViewMemory memory;
  SnapshotBuilder builder;
  const net::Protocol protocol = kProtocols[reader.u8() % std::size(kProtocols)];
  const Bytes signon = test::datagram({test::server_info(protocol), net::svc::SetView{1}, net::svc::SignonNum{3}});
  demand(parse_server_message(session, signon, "fuzzed").ok(), "signon messages that are understood");
  for (int datagrams = 0; datagrams < 32 && reader.remaining() > 2; ++datagrams) {
    const std::size_t length = std::min<std::size_t>(reader.u16(), reader.remaining());
    const Status status = parse_server_message(session, reader.bytes(length), "fuzzed");
    if (!status.ok()) demand(status.error().message.starts_with("fuzzed: offset "), "an error with a place");
    if (session.state.entities.size() > 4096) return;  // a frame of them takes long and shows nothing new
    frame(session, memory, builder, fixture);
    if (!status.ok() || session.disconnected) return;
  }
}

}  // namespace
}  // namespace fb::cl

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static fb::cl::Fixture fixture;
  fb::cl::play({data, size}, fixture);
  return 0;
}
