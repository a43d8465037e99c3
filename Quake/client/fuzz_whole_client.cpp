// Fuzz target: the whole client but for the picture, with a real game's files (FULLBRIGHT_FUZZ_GAME, else build/game):
// its models, a map, the console. It plays a demo, is told to seek and to pause in it, and everything that the renderer
// and the mixer would be given is looked at. Whatever the demo says, the client ends it with a sentence or shows it.
//
// The input: a byte that chooses a protocol, or a demo as it is in a file (kWhole); a byte with what is done at the
// demo's controls; then, but for kWhole, datagrams, each after its length (two bytes), which follow a real signon.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "base/log.h"
#include "client/client.h"
#include "client/session/session.h"
#include "client/test_demo.h"
#include "console/console.h"
#include "fs/filesystem.h"

namespace fb::cl {
namespace {

constexpr const char* kMap = "maps/lab_cbox.bsp";
constexpr net::Protocol kProtocols[] = {{15, 0},
                                        {666, 0},
                                        {999, net::kShortAngle | net::kInt32Coord},
                                        {999, net::kFloatAngle | net::kFloatCoord},
                                        {999, net::kCoord24}};
constexpr std::uint8_t kWhole = std::size(kProtocols);
constexpr int kMostFrames = 64;
constexpr std::size_t kLargestModel = 16384;  // bytes
constexpr std::size_t kMostEntities = 4096;   // a frame of more takes long and shows nothing new

void demand(bool condition, const char* complaint) {
  if (condition) return;
  std::fprintf(stderr, "promise broken: %s\n", complaint);
  std::abort();
}

// The game's files, each read once.
class Data {
 public:
  Data() {
    set_log_level(LogLevel::kError);
    const char* folder = std::getenv("FULLBRIGHT_FUZZ_GAME");
    fs::FsOptions options;
    options.base_dir = folder != nullptr ? folder : "build/game";
    options.user_dir = "";
    if (auto opened = fs::FileSystem::open(options)) files_ = std::make_unique<fs::FileSystem>(std::move(*opened));
    if (read(kMap)) return;
    std::fprintf(stderr, "fuzz_whole_client: there is no %s in %s\n", kMap, options.base_dir.c_str());
    std::exit(1);
  }
  std::optional<FileData> read(std::string_view name) {
    if (name.ends_with(".png")) return std::nullopt;  // in place of the map's textures: fuzz_image has these
    if (known_.size() > 4096) known_.clear();
    auto known = known_.find(name);
    if (known == known_.end())
      known = known_.emplace(std::string(name), files_ ? files_->read(name) : std::nullopt).first;
    const bool takes_long = name.ends_with(".mdl") && known->second && known->second->size() > kLargestModel;
    return takes_long ? std::nullopt : known->second;  // a run would be spent on reading monsters
  }

 private:
  std::unique_ptr<fs::FileSystem> files_;
  std::map<std::string, std::optional<FileData>, std::less<>> known_;
};

net::svc::ServerInfo server_info(const net::Protocol& protocol) {
  net::svc::ServerInfo info;
  info.protocol = protocol;
  info.max_clients = 4;
  info.level_name = "A box";
  info.models = {kMap, "progs/missile.mdl", "progs/grenade.mdl", "progs/s_explod.spr", "maps/b_bh25.bsp"};
  info.sounds = {"misc/null.wav", "weapons/guncock.wav", "doors/drclos4.wav"};
  return info;
}

Bytes demo_of(ByteReader& reader, const net::Protocol& protocol) {
  Bytes demo{'-', '1', '\n'};
  const auto add = [&](const Bytes& message) { formats::append_dem_message(demo, vec3(0.0f), message); };
  net::EntityState player;
  player.model = 2;
  add(test::datagram({server_info(protocol), net::svc::SetView{1}, net::svc::SignonNum{1}}, protocol));
  add(test::datagram({net::svc::SpawnBaseline{1, player, false}, net::svc::LightStyle{0, "m"}, net::svc::SignonNum{2}},
                     protocol));
  add(test::datagram({net::svc::SignonNum{3}}, protocol));
  for (int i = 0; i < kMostFrames && reader.remaining() > 2; ++i) {
    const ByteView bytes = reader.bytes(std::min<std::size_t>(reader.u16(), reader.remaining()));
    add(Bytes(bytes.begin(), bytes.end()));
  }
  return demo;
}

bool finite(const vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void look_at(const Client& client, const scene::FrameSnapshot& snapshot) {
  std::unordered_set<std::uint32_t> ids;
  demand(finite(snapshot.camera.position) && finite(snapshot.camera.angles), "a camera that is finite");
  for (const scene::Instance& i : snapshot.instances) {
    demand(ids.insert(i.id).second, "an id once");
    demand(i.mesh < snapshot.assets->meshes.size(), "a mesh that exists");
    for (int column = 0; column < 4; ++column) demand(finite(i.transform[column]), "transforms that are finite");
    const scene::Mesh& mesh = snapshot.assets->meshes[i.mesh];
    demand(!mesh.posed() || (i.pose.a < mesh.pose_count && i.pose.b < mesh.pose_count), "poses that exist");
    demand(std::isfinite(i.alpha) && finite(i.emission), "an emission that is finite");
  }
  const scene::SoundScene heard = client.sound_scene();
  demand(finite(heard.origin) && finite(heard.right), "an ear that is somewhere");
  demand(finite(client.view_angles()) && finite(client.velocity()), "a view that is finite");
}

void play(ByteView input, Data& data) {
  ByteReader reader(input, "input");
  const std::uint8_t kind = reader.u8() % (kWhole + 1), controls = reader.u8();
  con::Console console;
  const FileLoader loader = [&](std::string_view name) { return data.read(name); };
  scene::ModelLibrary library(loader);
  Client client(console, library, loader);
  double now = 0.0;
  client.set_clock([&] { return now; });
  bool reached = false;
  console.add_command("quit", "", [&](const con::Args&) { reached = true; });
  Bytes demo;
  if (kind == kWhole) {
    const ByteView rest = reader.bytes(reader.remaining());
    demo.assign(rest.begin(), rest.end());
  } else {
    demo = demo_of(reader, kProtocols[kind]);
  }
  if (!client.start_demo(FileData(std::move(demo)), "fuzzed", DemoMode::kPlay)) return;
  scene::FrameSnapshot snapshot;
  for (int frame = 0; frame < kMostFrames && client.playing(); ++frame) {
    now += 0.05;
    console.execute();
    client.look(0.05);
    client.advance(0.05);
    if (client.session().state.entities.size() > kMostEntities) return;
    if (client.active()) {
      client.build_snapshot(snapshot);
      look_at(client, snapshot);
    }
    if (frame == 8 && (controls & 1) != 0) client.pause_demo(true);
    if (frame == 12 && (controls & 1) != 0) client.pause_demo(false);
    if (frame == 16 && (controls & 2) != 0) (void)client.seek_demo(0.2 * (controls >> 4));
  }
  if (const auto& error = client.last_error()) demand(!error->message.empty(), "an error with a sentence");
  demand(!reached, "commands that stay with the game");
}

}  // namespace
}  // namespace fb::cl

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static fb::cl::Data game;
  fb::cl::play({data, size}, game);
  return 0;
}
