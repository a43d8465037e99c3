// client_make_seed_corpus DIRECTORY: writes what fuzz_message and fuzz_whole_client start from into folders of these
// names: messages made in code, and for the latter demos of testdemos, where it is started beside them.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "client/test_demo.h"

namespace fb::cl {
namespace {

namespace svc = net::svc;

std::vector<std::vector<net::ServerMessage>> datagrams() {
  svc::ClientData data;
  data.health = 100;
  data.weapon = 3;
  data.velocity = {20, 5, 0};
  data.on_ground = true;
  net::EntityState torch;
  torch.model = 3;
  std::vector<std::vector<net::ServerMessage>> all;
  all.push_back({svc::SpawnBaseline{1, torch, false}, svc::SpawnStatic{torch, false}, svc::LightStyle{4, "az"},
                 svc::UpdateName{0, "player"}, svc::UpdateColors{0, 0x4d}, svc::CdTrack{2, 2}});
  all.push_back({svc::SpawnBaseline{2, torch, true}, svc::SpawnStatic{torch, true}, svc::Skybox{"dusk_"},
                 svc::Fog{10, 20, 30, 40, 100}, svc::SpawnStaticSound{{1, 2, 3}, 1, 2, 3, true}});
  for (int i = 0; i < 4; ++i) {
    const auto x = static_cast<float>(10 * i);
    auto monster = test::update(2, 3, {x, 50, 0}, {0, 90, 0},
                                net::kUpdateStep | net::kUpdateFrame | net::kUpdateEffects | net::kUpdateAlpha |
                                    net::kUpdateScale | net::kUpdateLerpFinish | net::kUpdateSkin);
    monster.frame = i % 2;
    monster.effects = i == 1 ? 2 : 1 << i;
    monster.alpha = 200;
    monster.scale = 20;
    auto player = test::update(1, 3, {x, 0, 24}, vec3(0.0f), net::kUpdateColormap);
    player.colormap = 1;
    all.push_back({svc::Time{1.0f + 0.1f * static_cast<float>(i)}, data, player, monster,
                   test::update(300, 4, {0, x, 0}), test::update(4, 2, {x, x, x})});
  }
  std::vector<net::ServerMessage> effects{svc::Time{1.5f}};
  for (int type = 0; type <= 13; ++type) {
    svc::TempEntity t;
    t.type = static_cast<net::TempEntityType>(type);
    t.end = {0, 200, 50};
    t.entity = type;
    effects.push_back(t);
  }
  all.push_back(effects);
  all.push_back({svc::Particle{{0, 0, 0}, {1, 2, 3}, 255, 70}, svc::Damage{5, 10, {1, 1, 1}}, svc::BonusFlash{},
                 svc::Achievement{"ACH"}, svc::LocalSound{16, 1}, svc::StuffText{"v_cshift 1 2 3 4\nfog 0.1\n"},
                 svc::Sound{}, svc::StopSound{1, 1}, svc::Print{"hi\n"}});
  all.push_back({svc::SetAngle{{1, 2, 3}}, svc::SetPause{true}, svc::CenterPrint{"text"}, svc::KilledMonster{},
                 svc::FoundSecret{}, svc::UpdateStat{11, 5}, svc::UpdateFrags{1, 2}, svc::Finale{"end"},
                 svc::Intermission{}, svc::Cutscene{"x"}, svc::SellScreen{}, svc::Version{15}, svc::Disconnect{}});
  return all;
}

constexpr net::Protocol kProtocols[] = {{15, 0},
                                        {666, 0},
                                        {999, net::kShortAngle | net::kInt32Coord},
                                        {999, net::kFloatAngle | net::kFloatCoord},
                                        {999, net::kCoord24}};

void append(Bytes& out, const Bytes& datagram) {
  out.push_back(static_cast<std::uint8_t>(datagram.size() & 255u));
  out.push_back(static_cast<std::uint8_t>(datagram.size() >> 8u));
  out.insert(out.end(), datagram.begin(), datagram.end());
}

}  // namespace
}  // namespace fb::cl

int main(int argc, char** argv) {
  using namespace fb::cl;
  if (argc != 2) {
    std::fprintf(stderr, "usage: client_make_seed_corpus DIRECTORY\n");
    return 1;
  }
  const std::filesystem::path to = argv[1];
  const auto write = [&](const std::string& target, const std::string& name, const fb::Bytes& bytes) {
    std::filesystem::create_directories(to / target);
    std::ofstream out(to / target / name, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  };
  for (std::size_t p = 0; p < std::size(kProtocols); ++p) {
    const auto protocol = static_cast<std::uint8_t>(p);
    fb::Bytes game{protocol}, whole{protocol, 0x23};
    int number = 0;
    for (const auto& messages : datagrams()) {
      const fb::Bytes datagram = test::datagram(messages, kProtocols[p]);
      append(game, datagram);
      append(whole, datagram);
      fb::Bytes alone{protocol};
      append(alone, datagram);
      write("fuzz_message", "protocol" + std::to_string(p) + "_" + std::to_string(number++), alone);
    }
    write("fuzz_message", "protocol" + std::to_string(p) + "_game", game);
    write("fuzz_whole_client", "protocol" + std::to_string(p) + "_game", whole);
  }
  for (const std::string name : {"cbox", "plain"}) {
    std::ifstream in("testdemos/" + name + ".dem", std::ios::binary);
    fb::Bytes demo{static_cast<std::uint8_t>(std::size(kProtocols)), 0x31};
    demo.insert(demo.end(), std::istreambuf_iterator<char>(in), {});
    if (demo.size() > 2) write("fuzz_whole_client", name, demo);
  }
  return 0;
}
