// Fuzzes what players may say: bytes from one within the program and one from afar, before, while and after they sign
// on. Whoever makes no sense is dropped; everybody else goes on hearing messages that can be read, the other player's
// place stays its own, and no command reaches the console.
//
// The input: a byte that chooses the protocol (its low two bits) and who signs on at once (the next two); then pieces,
// each a byte that says who sends it (bit 0), how (bit 1: reliably) and whether the next one comes in the same frame
// (bit 2), and its length in a byte. What is behind kMostFrames frames or kMostPieces pieces is not played: an input of
// 4 KB would have thousands, most of them empty.
#include <cstdio>
#include <cstdlib>
#include <algorithm>

#include "base/log.h"
#include "net/loopback.h"
#include "progs/test_program.h"
#include "server/clients/clients.h"
#include "server/clients/test_remote_connection.h"
#include "server/simulation/test_map.h"

namespace fb::sv {
namespace {

constexpr int kMostFrames = 48, kMostPieces = 192;

void demand(bool condition, const char* complaint) {
  if (condition) return;
  std::fprintf(stderr, "promise broken: %s\n", complaint);
  std::abort();
}

// What a run does not change.
struct Game {
  Game() {
    set_log_level(LogLevel::kError);
    auto loaded = progs::load_program(progs::testing::ProgramBuilder().build(), "made.dat");
    demand(loaded.ok(), "the test's own progs");
    program = std::make_shared<progs::Program>(std::move(loaded).value());
    bsp = std::make_shared<formats::Bsp>(testing::MapBuilder(vec3(-512), vec3(512)).build());
    console.add_command("quit", "", [this](const con::Args&) { reached = true; });
  }
  con::Console console;
  bool reached = false;  // a player's words have come to the console, which no player of any run may do
  std::shared_ptr<const progs::Program> program;
  std::shared_ptr<const formats::Bsp> bsp;
};

struct Player {
  std::unique_ptr<net::Connection> connection;
  net::Protocol protocol;

  void hear(double now) {
    while (const auto message = connection->receive(now)) {
      net::ServerMessageReader reader(message->data, "server", protocol);
      while (!reader.at_end()) demand(reader.next().ok(), "messages that can be read");
      protocol = reader.protocol();
    }
  }
  void say(ByteView bytes, bool reliable, double now) {
    if (reliable && connection->can_send())
      (void)connection->send_reliable(bytes, now);
    else
      (void)connection->send_unreliable(bytes, now);
  }
  void command(std::string_view text, double now) {
    net::MessageWriter writer;
    net::write_client_message(writer, net::clc::StringCommand{std::string(text)});
    say(writer.bytes(), false, now);
  }
};

}  // namespace
}  // namespace fb::sv

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fb;
  using namespace fb::sv;
  static Game game;
  if (size == 0) return 0;
  con::Console& console = game.console;
  constexpr const char* kProtocols[] = {"15", "666", "999", "666"};
  Clients clients(console, {.max_clients = 3});
  console.set("sv_protocol", kProtocols[data[0] & 3]);
  auto vm = progs::Vm::create(game.program, {}, {.max_edicts = 64, .max_depth = 32, .max_local_words = 1024});
  demand(vm.ok(), "a virtual machine");
  (*vm)->edicts().start_level(3);
  Rng rng(1);
  Level level("test", game.bsp, std::move(*vm), console, clients, rng);
  level.max_clients = 3;
  level.models.push_back({"maps/test.bsp"});
  clients.begin_level(level);
  clients.finish_level();

  double now = 10.0;
  Player players[2];
  for (int i = 0; i < 2; ++i) {
    auto [client, server] = net::make_loopback(now);
    players[i].connection = std::move(client);
    if (i == 1) server = std::make_unique<testing::RemoteConnection>(std::move(server));
    clients.accept(std::move(server), now);
  }
  const auto frame = [&] {
    now += 0.02;
    level.time += 0.02;
    clients.receive(now, [](ServerClient&) {});
    clients.send(now);
    for (Player& player : players) player.hear(now);
  };
  for (const char* stage : {"prespawn", "spawn", "begin"}) {
    for (int i = 0; i < 2; ++i)
      if (data[0] >> (2 + i) & 1) players[i].command(stage, now);
    frame();
  }
  std::size_t at = 1;
  int frames = 0;
  for (int pieces = 0; pieces < kMostPieces && frames < kMostFrames && at + 2 <= size; ++pieces) {
    const unsigned how = data[at];
    const std::size_t length = std::min<std::size_t>(data[at + 1], size - at - 2);
    players[how & 1].say({data + at + 2, length}, (how & 2) != 0, now);
    at += 2 + length;
    if ((how & 4) != 0) continue;
    frame();
    ++frames;
  }
  frame();
  console.execute();
  demand(!game.reached, "commands that stay with the game");
  demand(!level.failed(), "a level that goes on");
  for (int i = 0; i < 3; ++i) {
    const ServerClient& client = clients[i];
    demand(client.name.size() <= 15 && client.name.find('\n') == std::string::npos, "names of one line");
    demand(i < 2 || !client.active(), "places that nobody took");
  }
  return 0;
}
