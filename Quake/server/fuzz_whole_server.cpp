// Fuzz target: a whole server with a real game's files (FULLBRIGHT_FUZZ_GAME, else build/game): its QuakeC, and a small
// map of it with monsters and things. Two players, one within the program and one from afar, sign on, play and say
// anything; the console says anything; time passes. The game goes on, or ends with a sentence, and what its players are
// told can be read. A run begins the level anew; the server, which has read the models, is made anew only after
// kRunsOfOne.
//
// The input: a byte with the protocol (its low two bits) and who signs on at once (the next two); then steps, each a
// byte that says what (kinds below, above them how) and, for what has words, their length in a byte.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/log.h"
#include "fs/filesystem.h"
#include "net/loopback.h"
#include "server/clients/clients.h"
#include "server/clients/test_remote_connection.h"
#include "server/server.h"

namespace fb::sv {
namespace {

constexpr const char* kMap = "lab_cbox";
constexpr std::string_view kEntities = R"({
"classname" "worldspawn"
"message" "A box"
}
{"classname" "info_player_start" "origin" "0 -200 -55" "angle" "90"}
{"classname" "info_player_deathmatch" "origin" "60 -200 -55" "angle" "90"}
{"classname" "monster_army" "origin" "-60 0 -55" "angle" "270"}
{"classname" "monster_dog" "origin" "60 0 -55"}
{"classname" "monster_zombie" "origin" "0 40 -55" "angle" "270"}
{"classname" "weapon_rocketlauncher" "origin" "0 -150 -50"}
{"classname" "item_health" "origin" "-60 -150 -50" "spawnflags" "2"}
{"classname" "item_artifact_super_damage" "origin" "60 -150 -50"}
{"classname" "light" "origin" "0 0 40" "style" "1" "targetname" "lamp"}
{"classname" "trigger_relay" "target" "lamp" "targetname" "all"}
)";
constexpr double kTick = 0.05;
constexpr int kMostTicks = 100, kRunsOfOne = 64;
// Steps: what player 0 or 1 says (above: whether reliably), a line of the console, ticks (above: how many).
enum Kind : unsigned { kLocal, kRemote, kLine, kTime, kKinds };

void demand(bool condition, const std::string& complaint) {
  if (condition) return;
  std::fprintf(stderr, "promise broken: %s\n", complaint.c_str());
  std::abort();
}

// The game's files, each read once, and what the game writes, which the next run does not find.
class Data {
 public:
  Data() {
    set_log_level(LogLevel::kError);
    const char* folder = std::getenv("FULLBRIGHT_FUZZ_GAME");
    fs::FsOptions options;
    options.base_dir = folder != nullptr ? folder : "build/game";
    options.user_dir = "";
    if (auto opened = fs::FileSystem::open(options)) files_ = std::make_unique<fs::FileSystem>(std::move(*opened));
    if (read("progs.dat") && read("maps/" + std::string(kMap) + ".bsp")) return;
    std::fprintf(stderr, "fuzz_whole_server: there is no game with map %s in %s\n", kMap, options.base_dir.c_str());
    std::exit(1);
  }
  std::optional<FileData> read(std::string_view name) {
    if (const auto own = written_.find(name); own != written_.end()) return own->second;
    if (name.starts_with("maps/") && name.ends_with(".ent")) return Bytes(kEntities.begin(), kEntities.end());
    if (known_.size() > 4096) known_.clear();
    auto known = known_.find(name);
    if (known == known_.end())
      known = known_.emplace(std::string(name), files_ ? files_->read(name) : std::nullopt).first;
    return known->second;
  }
  Status write(std::string_view name, ByteView bytes) {
    if (written_.size() > 64) return Error{"the disk is full"};
    written_[std::string(name)] = Bytes(bytes.begin(), bytes.end());
    return ok_status();
  }
  void forget_written() { written_.clear(); }

 private:
  std::unique_ptr<fs::FileSystem> files_;
  std::map<std::string, std::optional<FileData>, std::less<>> known_;
  std::map<std::string, FileData, std::less<>> written_;
};

// What is said to a player can be read, whatever it has said itself.
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
    say(writer.bytes(), true, now);
  }
};

// What would take as long as somebody likes, or ends the server: not what is looked for here.
bool is_left_out(const std::string& line) {
  for (const char* word : {"sv_run", "quit", "maxplayers", "map", "changelevel", "host_framerate", "sys_ticrate"})
    if (line.find(word) != std::string::npos) return true;
  return false;
}

// What outlives a run.
struct Game {
  explicit Game(Data& files) : data(files), server(console, services(), {.max_clients = 3, .autosaves = true}) {}
  ServerServices services() {
    ServerServices all;
    all.read_file = [this](std::string_view name) { return data.read(name); };
    all.write_file = [this](std::string_view name, ByteView bytes) { return data.write(name, bytes); };
    all.rng = &rng;
    return all;
  }
  void reset() {
    server.shutdown();
    console.forget_commands();
    console.execute("unaliasall");
    console.execute("resetall");
    rng = Rng(1);
    data.forget_written();
  }

  Data& data;
  Rng rng{1};
  con::Console console;
  Server server;
};

class Run {
 public:
  Run(Game& game, unsigned how) : console_(game.console), server_(game.server) {
    constexpr const char* kProtocols[] = {"15", "666", "999", "666"};
    game.reset();
    console_.set("max_edicts", "600");  // making room for thousands takes half of a run
    console_.set("sv_protocol", kProtocols[how & 3]);
    const Status begun = server_.map(kMap);
    demand(begun.ok(), begun.ok() ? "" : begun.error().message);
    for (int i = 0; i < 2; ++i) {
      auto [client, server] = net::make_loopback(now_);
      players_[i].connection = std::move(client);
      if (i == 1) server = std::make_unique<testing::RemoteConnection>(std::move(server));
      server_.clients().accept(std::move(server), now_);
    }
    for (const char* stage : {"prespawn", "spawn", "begin"}) {
      for (unsigned i = 0; i < 2; ++i)
        if (how >> (2 + i) & 1) players_[i].command(stage, now_);
      for (int i = 0; i < 2; ++i) tick();
    }
  }

  bool goes_on() { return server_.active() && ticks_ < kMostTicks; }
  void tick() {
    now_ += kTick;
    ++ticks_;
    server_.frame(kTick, now_);
    for (Player& player : players_) player.hear(now_);
  }
  void step(unsigned what, ByteView words) {
    switch (what % kKinds) {
      case kLocal:
      case kRemote:
        players_[what % kKinds].say(words, what / kKinds % 2 == 0, now_);
        break;
      case kLine: {
        const std::string line(reinterpret_cast<const char*>(words.data()), words.size());
        if (is_left_out(line)) return;
        console_.append(line + "\n");
        console_.execute();
        break;
      }
      default:
        for (unsigned i = 0; i < what / kKinds % 16 && goes_on(); ++i) tick();
    }
    if (goes_on()) tick();
  }
  void end() {
    if (!server_.active()) {
      demand(server_.last_error() && !server_.last_error()->message.empty(), "a game that ends with a sentence");
      return;
    }
    for (int i = 0; i < 3; ++i) {
      const ServerClient& client = server_.clients()[i];
      demand(client.name.size() <= 15 && client.name.find('\n') == std::string::npos, "names of one line");
    }
    demand(!server_.dump().empty(), "a state that can be written");
    server_.shutdown();
  }

 private:
  con::Console& console_;
  Server& server_;
  Player players_[2];
  double now_ = 10.0;
  int ticks_ = 0;
};

}  // namespace
}  // namespace fb::sv

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fb::sv;
  static Data files;
  static std::unique_ptr<Game> game;
  static int runs = 0;
  if (size == 0) return 0;
  if (!game || ++runs % kRunsOfOne == 0) game = std::make_unique<Game>(files);
  Run run(*game, data[0]);
  std::size_t at = 1;
  while (at < size && run.goes_on()) {
    const unsigned what = data[at++];
    const bool has_words = what % kKinds != kTime;
    const std::size_t length = has_words && at < size ? std::min<std::size_t>(data[at], size - at - 1) : 0;
    at += has_words ? 1 : 0;
    run.step(what, {data + std::min(at, size), length});
    at += length;
  }
  run.end();
  return 0;
}
