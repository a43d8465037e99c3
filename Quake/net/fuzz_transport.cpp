// Fuzz target: datagrams of a stranger's making, from any of a few addresses, to a listening server with a player on it
// and to a client, with time going by. Nothing may crash, no player may be lost to them, and a stranger gets no more
// than so many times what it has sent.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/check.h"
#include "net/connect_attempt.h"
#include "net/datagram_listener.h"
#include "net/server_query.h"
#include "net/test_network.h"

namespace {

using namespace fb::net;

const Address kServer = ipv4(192, 0, 2, 1, 26000), kPlayer = ipv4(192, 0, 2, 2, 0),
              kStranger = ipv4(198, 51, 100, 1, 9);

struct Game {
  Game() {
    status.players.reserve(4);
    status.max_players = 4;
    status.rules = {{"sv_gravity", "800"}};
    listener = std::move(*DatagramListener::open(
        network.host(kServer), kServer.port, [this] { return status; }, 3));
    ConnectAttempt attempt(network.host(kPlayer), kServer);
    while (attempt.poll(network.now()) == ConnectAttempt::State::kTrying) frame();
    client = attempt.take();
    while (!server) frame();
    network.watch = [this](const Address&, const Address& to, fb::ByteView data) {
      if (to == kStranger) given += data.size();
    };
  }
  void frame() {
    if (auto accepted = listener->accept(network.now()); accepted && !server) server = std::move(accepted);
    if (server) (void)server->receive(network.now());
    network.advance(0.05);
  }
  fb::net::testing::TestNetwork network;
  ServerStatus status;
  std::unique_ptr<DatagramListener> listener;
  std::unique_ptr<Connection> client, server;
  std::uint64_t sent = 0, given = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Game game;
  ServerSearch search(game.network.host(kPlayer), {kServer});
  ServerInquiry inquiry(game.network.host(kPlayer), kServer);
  // Each datagram: where it goes, its length, its bytes.
  const Address player = *parse_address(game.client->address());
  std::size_t at = 0;
  for (int packets = 0; at + 2 <= size && packets < 64; ++packets) {
    const int where = data[at] % 4;
    const std::size_t length = std::min<std::size_t>(data[at + 1], size - at - 2);
    const fb::ByteView datagram(data + at + 2, length);
    at += 2 + length;
    const Address targets[] = {kServer, player, kPlayer.with_port(40000), kPlayer.with_port(40002)};
    game.network.forge(kStranger, targets[where], datagram);
    game.sent += datagram.size();
    (void)search.poll(game.network.now());
    (void)inquiry.poll(game.network.now());
    while (game.client->receive(game.network.now())) {}
    game.frame();
    FB_CHECK_LE(game.given, DatagramListener::kMostReply * game.sent + 50);
  }
  FB_CHECK(game.client->is_open());
  FB_CHECK(game.server->is_open());
  FB_CHECK(game.client->send_unreliable(fb::Bytes{3}, game.network.now()).ok());
  return 0;
}
