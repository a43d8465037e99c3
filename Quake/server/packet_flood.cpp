// packet_flood [PACKETS] [SEED]: a whole server under fire. Players sign on, walk and talk over a network in memory;
// what they send is recorded, made wrong (net/test_mutation.h), and sent again: by strangers, in players' names, and by
// players who have signed on properly and then say wrong things in order. Run it sanitized. It demands that
// - the game goes on, and a player in whose name no packet can be forged stays in it;
// - no stranger gets more than DatagramListener::kMostReply times the bytes that it has sent;
// - memory does not grow: what is allocated at the end is what was after a tenth of the packets, but for kMostGrowth;
// - no command of a player's reaches the console.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <map>
#include <memory>

#include "base/log.h"
#include "formats/test_bsp.h"
#include "net/connect_attempt.h"
#include "net/datagram_listener.h"
#include "net/test_mutation.h"
#include "net/test_network.h"
#include "progs/test_program.h"
#include "server/clients/clients.h"
#include "server/server.h"
#include "server/simulation/test_map.h"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

extern "C" std::size_t __sanitizer_get_current_allocated_bytes() __attribute__((weak));

namespace fb::sv {
namespace {

using net::Address;
using net::DatagramListener;
using net::testing::TestNetwork;
namespace clc = net::clc;

const Address kServer = net::ipv4(192, 0, 2, 1, 26000);
constexpr double kFrame = 0.05;
constexpr int kPacketsAFrame = 128;
constexpr std::size_t kMostGrowth = std::size_t{4} << 20;

void demand(bool condition, const std::string& complaint) {
  if (condition) return;
  std::fprintf(stderr, "packet_flood: promise broken: %s\n", complaint.c_str());
  std::abort();
}

// 0 where nobody knows.
std::size_t allocated_bytes() {
  if (__sanitizer_get_current_allocated_bytes) return __sanitizer_get_current_allocated_bytes();
#if defined(__GLIBC__)
  return mallinfo2().uordblks;
#else
  return 0;
#endif
}

// --- the server ---

class Game {
 public:
  explicit Game(TestNetwork& network) : network_(network), server_(console_, services(), {.max_clients = 8}) {
    console_.add_command("quit", "", [this](const con::Args&) { reached_ = true; });
    const Status begun = server_.map("flood");
    demand(begun.ok(), begun.ok() ? "" : begun.error().message);
    auto opened = DatagramListener::open(
        network.host(kServer), kServer.port, [this] { return server_.clients().status(network_.now()); }, 1);
    demand(opened.ok(), "a port");
    listener_ = std::move(*opened);
    listener_->set_timeout(30.0);
    server_.clients().add_listener(*listener_);
  }
  ~Game() {
    server_.shutdown();
    server_.clients().remove_listener(*listener_);
  }
  void frame() {
    network_.advance(kFrame);
    server_.frame(kFrame, network_.now());
    console_.execute();
    demand(server_.active(), server_.last_error() ? server_.last_error()->message : "the game goes on");
    demand(!reached_, "no command of a player's reaches the console");
    for (int i = 0; i < server_.max_clients(); ++i) put_on_feet(server_.clients()[i]);
  }
  int players() { return server_.clients().active_count(); }

 private:
  // What a mod's PutClientInServer does.
  void put_on_feet(const ServerClient& client) {
    Edict edict = server_.level()->edict(client.edict_id());
    if (!client.spawned() || edict.get(progs::fields::movetype) != 0.0f) return;
    edict.set(progs::fields::movetype, 3.0f);
    edict.set(progs::fields::solid, 3.0f);
    edict.set(progs::fields::health, 100.0f);
    edict.set(progs::fields::mins, vec3(-16, -16, -24));
    edict.set(progs::fields::maxs, vec3(16, 16, 32));
    edict.set(progs::fields::origin, vec3(64.0f * static_cast<float>(client.slot) - 256.0f, 0.0f, 30.0f));
  }
  ServerServices services() {
    progs::testing::ProgramBuilder program;
    program.function("worldspawn", {{progs::Op::kDone}});
    testing::MapBuilder room(vec3(-512, -512, 0), vec3(512, 512, 256));
    room.box(vec3(-512, -512, 0), vec3(-256, 512, 64), formats::kContentsWater);
    files_["progs.dat"] = program.build();
    files_["maps/flood.bsp"] = formats::testing::write_bsp(room.build());
    ServerServices services;
    services.read_file = [this](std::string_view name) -> std::optional<Bytes> {
      const auto found = files_.find(std::string(name));
      return found == files_.end() ? std::nullopt : std::optional(found->second);
    };
    return services;
  }

  TestNetwork& network_;
  con::Console console_;
  std::map<std::string, Bytes> files_;
  Server server_;
  std::unique_ptr<DatagramListener> listener_;
  bool reached_ = false;
};

// --- players ---

// Connects, signs on and walks; comes again when it is thrown out.
class Player {
 public:
  Player(TestNetwork& network, const Address& host, std::uint64_t seed) : network_(network), host_(host), rng_(seed) {}

  void frame() {
    const double now = network_.now();
    if (!connection_) return connect(now);
    while (auto message = connection_->receive(now)) hear(*message);
    if (!connection_->is_open() || disconnected_ || now - last_heard_ > 3.0) return leave();
    if (!commands_.empty() && connection_->can_send()) {
      (void)connection_->send_reliable(bytes_of(clc::StringCommand{commands_.front()}), now);
      commands_.pop_front();
    }
    if (signon_ == 3) walk(now);
  }
  void leave() {
    connection_.reset();
    attempt_.reset();
    signon_ = 0;
    disconnected_ = false;
    commands_.clear();
    protocol_ = {};
    ++left_;
  }
  void say(ByteView bytes, bool reliable) {
    if (reliable && connection_->can_send())
      (void)connection_->send_reliable(bytes, network_.now());
    else
      (void)connection_->send_unreliable(bytes, network_.now());
  }
  Bytes bytes_of(const net::ClientMessage& message) const {
    net::MessageWriter writer(protocol_);
    net::write_client_message(writer, message);
    return writer.take();
  }
  bool in_game() const { return connection_ && signon_ == 3; }
  bool playing() const { return in_game() && commands_.empty(); }  // and has said all of its own
  double last_heard() const { return last_heard_; }
  int left() const { return left_; }
  // Where the server speaks to it from, and where it is.
  std::optional<Address> server_port() const {
    return connection_ ? net::parse_address(connection_->address()) : std::nullopt;
  }
  const Address& host() const { return host_; }

 private:
  void connect(double now) {
    if (!attempt_) attempt_ = std::make_unique<net::ConnectAttempt>(network_.host(host_), kServer);
    const auto state = attempt_->poll(now);
    if (state == net::ConnectAttempt::State::kConnected) connection_ = attempt_->take();
    last_heard_ = now;
    if (state != net::ConnectAttempt::State::kTrying) attempt_.reset();
  }
  void hear(const net::ReceivedMessage& message) {
    last_heard_ = network_.now();
    net::ServerMessageReader reader(message.data, "server", protocol_);
    while (!reader.at_end() && !disconnected_) {
      const auto next = reader.next();
      if (!next.ok()) break;  // forged in the server's name
      if (std::holds_alternative<net::svc::Disconnect>(*next)) disconnected_ = true;
      if (const auto* stage = std::get_if<net::svc::SignonNum>(&*next)) reply(stage->signon);
      if (const auto* time = std::get_if<net::svc::Time>(&*next)) time_ = time->time;
    }
    protocol_ = reader.protocol();
  }
  void reply(int signon) {
    signon_ = signon;
    if (signon == 1) commands_ = {"prespawn"};
    if (signon == 2) commands_ = {"name \"player\"", "color 4 3", "spawn 1 2"};
    if (signon == 3) commands_ = {"begin"};
  }
  void walk(double now) {
    clc::Move move;
    move.time = time_;
    move.view_angles = vec3(0.0f, rng_.uniform(-180.0f, 180.0f), 0.0f);
    move.forward = 400;
    move.buttons = static_cast<int>(rng_.below(4));
    (void)connection_->send_unreliable(bytes_of(move), now);
    if (rng_.below(200) == 0) commands_.push_back("say hello");
  }

  TestNetwork& network_;
  Address host_;
  Rng rng_;
  std::unique_ptr<net::ConnectAttempt> attempt_;
  std::unique_ptr<net::Connection> connection_;
  net::Protocol protocol_;
  std::deque<std::string> commands_;
  int signon_ = 0, left_ = 0;
  bool disconnected_ = false;
  float time_ = 0.0f;
  double last_heard_ = 0.0;
};

// --- the flood ---

struct Strangers {
  struct Account {
    std::uint64_t sent = 0, answered = 0;
  };
  static constexpr std::uint32_t kHosts = 4000;
  std::map<Address, Account> accounts;  // by host

  static Address any(Rng& rng) {
    const std::uint32_t host = rng.below(kHosts);
    return net::ipv4(198, 51, static_cast<std::uint8_t>(100 + host / 250), static_cast<std::uint8_t>(1 + host % 250),
                     static_cast<std::uint16_t>(1024 + rng.below(4)));
  }
  static bool is_one(const Address& address) { return address.bytes[0] == 198; }
  Account& of(const Address& address) { return accounts[address.with_port(0)]; }
  Account all() const {
    Account sum;
    for (const auto& [host, account] : accounts) {
      demand(account.answered <= DatagramListener::kMostReply * account.sent,
             host.to_string() + " gets " + std::to_string(account.answered) + " bytes for " +
                 std::to_string(account.sent));
      sum.sent += account.sent;
      sum.answered += account.answered;
    }
    return sum;
  }
};

class Flood {
 public:
  explicit Flood(std::uint64_t seed) : rng_(seed), network_(seed), game_(network_) {
    network_.watch = [this](const Address& from, const Address& to, ByteView data) { see(from, to, data); };
  }
  void run(std::uint64_t packets);

 private:
  static constexpr std::size_t kRecorded = 1024;

  void see(const Address& from, const Address& to, ByteView data) {
    if (Strangers::is_one(to)) strangers_.of(to).answered += data.size();
    if (!to.same_host(kServer) || from.same_host(kServer)) return;
    Bytes packet(data.begin(), data.end());
    if (recorded_.size() < kRecorded) return recorded_.push_back(std::move(packet));
    recorded_[rng_.below(kRecorded)] = std::move(packet);
  }
  void forge(const Address& from, const Address& to, const Bytes& data) {
    if (Strangers::is_one(from)) strangers_.of(from).sent += data.size();
    network_.forge(from, to, data);
    ++packets_;
    bytes_ += data.size();
  }
  const Bytes& recorded() { return recorded_[rng_.below(static_cast<std::uint32_t>(recorded_.size()))]; }

  void frame();
  void send_wrong_packet();
  void ask_as_stranger();
  void say_wrong_things(Player& player);
  Bytes wrong_message(const Player& player);
  Address some_port();
  void check_sheltered();

  Rng rng_;
  TestNetwork network_;
  Game game_;
  Player sheltered_{network_, net::ipv4(192, 0, 2, 2, 0), 2};  // nobody knows where the server speaks to it from
  Player known_{network_, net::ipv4(192, 0, 2, 3, 0), 3};      // packets are sent in its name
  Player wrong_[2] = {{network_, net::ipv4(192, 0, 2, 4, 0), 4}, {network_, net::ipv4(192, 0, 2, 5, 0), 5}};
  std::vector<Bytes> recorded_;
  Strangers strangers_;
  std::uint64_t packets_ = 0, bytes_ = 0;
};

Address Flood::some_port() {
  const Player* players[] = {&known_, &wrong_[0], &wrong_[1]};
  if (const auto port = players[rng_.below(3)]->server_port(); port && rng_.below(2) == 0) return *port;
  return rng_.below(8) == 0 ? kServer.with_port(static_cast<std::uint16_t>(rng_.below(1024))) : kServer;
}

void Flood::send_wrong_packet() {
  Bytes packet = rng_.below(8) == 0 ? net::testing::random_bytes(rng_, 1500) : recorded();
  if (rng_.below(8) == 0) packet = net::testing::spliced(packet, recorded(), rng_);
  if (rng_.below(8) != 0) net::testing::mutate(packet, rng_);
  if (rng_.below(8) != 0) net::testing::mend_length(packet);
  const Address to = some_port();
  Address from = Strangers::any(rng_);
  // In a player's name; in the sheltered one's only to where everybody speaks.
  if (rng_.below(4) == 0) from = known_.host().with_port(static_cast<std::uint16_t>(40000 + rng_.below(16)));
  if (rng_.below(16) == 0 && to == kServer)
    from = sheltered_.host().with_port(static_cast<std::uint16_t>(40000 + rng_.below(16)));
  forge(from, to, packet);
}

// What the listener takes, whole or a little wrong.
void Flood::ask_as_stranger() {
  net::ControlRequest request = net::ccreq::Connect{};
  if (rng_.below(3) == 0) request = net::ccreq::ServerInfo{};
  if (rng_.below(4) == 0) request = net::ccreq::PlayerInfo{static_cast<int>(rng_.below(20))};
  if (rng_.below(4) == 0) request = net::ccreq::RuleInfo{rng_.below(2) == 0 ? "coop" : ""};
  Bytes packet = net::write_control(request);
  if (rng_.below(3) == 0) {
    net::testing::mutate(packet, rng_);
    net::testing::mend_length(packet);
  }
  forge(Strangers::any(rng_), kServer, packet);
}

Bytes Flood::wrong_message(const Player& player) {
  static const std::string kCommands[] = {"prespawn",
                                          "spawn 1 2",
                                          "begin",
                                          "name \"x\"",
                                          "name " + std::string(500, 'a'),
                                          "color 4 3",
                                          "color -1 300",
                                          "say hello",
                                          "say_team \"hello",
                                          "tell player hello",
                                          "kill",
                                          "pause",
                                          "ping",
                                          "status",
                                          "god",
                                          "notarget",
                                          "fly",
                                          "noclip",
                                          "give h 100",
                                          "setpos 0 0 50",
                                          "setpos nan inf -1e38 1 2 3",
                                          "kick # 1",
                                          "kick player",
                                          "ban",
                                          "quit",
                                          "map flood",
                                          "sv_dump x",
                                          "",
                                          "\"",
                                          "\\",
                                          "say " + std::string(3000, 'x')};
  Bytes bytes;
  for (std::uint32_t i = 1 + rng_.below(3); i > 0; --i) {
    clc::Move move;
    move.view_angles = vec3(rng_.uniform(-400.0f, 400.0f));
    move.forward = static_cast<int>(rng_.next());
    move.up = static_cast<int>(rng_.next() & 0xffffu);
    move.buttons = static_cast<int>(rng_.next() & 0xffu);
    move.impulse = static_cast<int>(rng_.next() & 0xffu);
    net::ClientMessage message = move;
    if (rng_.below(2) == 0) message = clc::StringCommand{kCommands[rng_.below(std::size(kCommands))]};
    if (rng_.below(400) == 0) message = clc::Disconnect{};
    const Bytes one = player.bytes_of(message);
    bytes.insert(bytes.end(), one.begin(), one.end());
  }
  if (rng_.below(32) == 0) net::testing::mutate(bytes, rng_);
  if (rng_.below(256) == 0) bytes.resize(rng_.below(net::kMaxMessage), 0x01);
  return bytes;
}

void Flood::say_wrong_things(Player& player) {
  if (!player.playing()) return send_wrong_packet();
  const Bytes message = wrong_message(player);
  ++packets_;
  bytes_ += message.size();
  if (!message.empty()) player.say(message, rng_.below(3) == 0);
}

void Flood::frame() {
  game_.frame();
  for (Player* player : {&sheltered_, &known_, &wrong_[0], &wrong_[1]}) player->frame();
}

void Flood::check_sheltered() {
  demand(sheltered_.left() == 0, "the player in whose name nobody speaks stays");
  demand(sheltered_.in_game(), "it is in the game");
  demand(network_.now() - sheltered_.last_heard() < 1.0, "and hears of it");
}

void Flood::run(std::uint64_t packets) {
  for (int i = 0; i < 100; ++i) frame();  // all sign on
  check_sheltered();
  const auto begun = std::chrono::steady_clock::now();
  std::size_t settled = 0, most = 0;
  for (int tick = 0; packets_ < packets; ++tick) {
    // Storms of questions take all the answers that there are: nobody can join for as long.
    const std::uint32_t questions = tick % 1000 < 200 ? 300 : 30;
    for (int i = 0; i < kPacketsAFrame; ++i) {
      const std::uint32_t kind = rng_.below(1000);
      if (kind < questions)
        ask_as_stranger();
      else if (kind < 600)
        send_wrong_packet();
      else
        say_wrong_things(wrong_[kind & 1u]);
    }
    frame();
    // Who has been confused for good begins again.
    if (tick % 400 == 399) known_.leave();
    if (tick % 100 == 99) check_sheltered();
    if (settled == 0 && packets_ >= packets / 10) settled = allocated_bytes();
    if (tick % 256 == 255) most = std::max(most, allocated_bytes());
  }
  for (int i = 0; i < 100; ++i) frame();
  check_sheltered();
  const std::size_t end = allocated_bytes();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begun;
  const auto strangers = strangers_.all();
  std::printf("%llu packets, %.1f MB, in %.0f s and %.0f s of the game\n", static_cast<unsigned long long>(packets_),
              static_cast<double>(bytes_) * 1e-6, seconds.count(), network_.now());
  std::printf(
      "strangers: %llu bytes sent, %llu answered: %.3f times\n", static_cast<unsigned long long>(strangers.sent),
      static_cast<unsigned long long>(strangers.answered),
      static_cast<double>(strangers.answered) / static_cast<double>(std::max<std::uint64_t>(1, strangers.sent)));
  std::printf("players who said wrong things: left %d and %d times; the one in whose name others spoke: %d\n",
              wrong_[0].left(), wrong_[1].left(), known_.left());
  std::printf("allocated: %.2f MB after a tenth, %.2f MB at the end, at most %.2f MB; %d play\n",
              static_cast<double>(settled) * 1e-6, static_cast<double>(end) * 1e-6, static_cast<double>(most) * 1e-6,
              game_.players());
  std::fflush(stdout);
  demand(end <= settled + kMostGrowth, "memory does not grow");
}

}  // namespace
}  // namespace fb::sv

int main(int argc, char** argv) {
  fb::set_log_level(fb::LogLevel::kError);
  const std::uint64_t packets = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 200000;
  const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  if (packets == 0) {
    std::fprintf(stderr, "usage: packet_flood [PACKETS] [SEED]\n");
    return 2;
  }
  fb::sv::Flood(seed).run(packets);
  return 0;
}
