// Who plays on this server, and what it says to them: a slot for each player with its connection, and the buffers that
// the game writes into. Clients outlive levels; begin_level() ties them to the next one.
//
// What is said goes one of four ways, which are QuakeC's MSG_* too:
// - datagram(): to everybody in this frame's unreliable message, lost where it does not fit;
// - ServerClient::reliable: to one player, in order, some time;
// - write_to_all(): the same to all;
// - signon(): to whoever comes to this level, before it is in the game.
// QuakeC writes bytes, not messages, so a buffer is bytes; where a message ends is found by reading it back
// (split_messages), which is only done where something has to be cut.
//
//   Clients clients(console, {.max_clients = 4});
//   Level level(name, bsp, vm, console, clients);
//   clients.begin_level(level);            // before the entities spawn: they may speak
//   ... spawn ...
//   clients.finish_level();                // baselines; who was here on the last level is asked in again
//   each frame: clients.accept_new(now);   // from add_listener()'s listeners
//               clients.receive(now, [&](ServerClient& c) { client_think(level, c...); });
//               ... physics ...
//               clients.send(now);         // then level.failed() says whether QuakeC went wrong in any of these
//   clients.save_spawn_parms(); clients.send_reconnect(now); clients.end_level();    // changelevel
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "console/console.h"
#include "net/client_messages.h"
#include "net/connection.h"
#include "net/server_messages.h"
#include "net/server_status.h"
#include "server/simulation/level.h"

namespace fb::sv {

// A player's place. Its edict is always there; who plays comes and goes.
struct ServerClient {
  static constexpr std::size_t kPings = 16;

  int slot = 0;
  EdictId edict_id() const { return EdictId{static_cast<std::uint32_t>(slot) + 1}; }
  std::unique_ptr<net::Connection> connection;  // null: nobody is here
  bool active() const { return connection != nullptr; }
  // How far it is on its way into the level: each is asked for by its client command (prespawn, spawn, begin), which
  // is not taken before its turn.
  enum class Stage { kConnected, kPrespawned, kInLevel, kPlaying };
  Stage stage = Stage::kConnected;
  bool spawned() const { return stage == Stage::kPlaying; }  // gets datagrams, and its moves count
  // Whether it has been in the game, on this level or one before, and how long a newcomer has been on its way, seconds.
  bool signed_on = false;
  double signing_on = 0.0;

  std::string name;  // as it may be shown
  int colors = 0;    // 16 * shirt + trousers
  int old_frags = 0;
  std::array<float, progs::globals::kSpawnParms> spawn_parms{};  // what it takes along from level to level

  // What it wants to do, as of its last message; angles, buttons and impulse are in its edict already.
  net::clc::Move move;
  std::array<float, kPings> ping_times{};  // seconds, the latest kPings
  std::size_t pings = 0;
  float average_ping() const;  // seconds

  net::MessageWriter reliable;
  bool overflowed = false;      // more waits than a message holds: send() drops it
  bool sent_away = false;       // by the mod: send() drops it
  std::deque<Bytes> before_it;  // reliable messages that go before, each on its own

  // On the way into a level nothing is sent but the stage that has been asked for: kParts the signon buffer, a part
  // at a time; kFlush what `reliable` holds; kWaiting: the player's turn, and prints and the like gather.
  enum class Signon { kWaiting, kParts, kFlush };
  Signon signon = Signon::kWaiting;
  std::size_t next_part = 0;
  double last_message = 0.0;  // when it was sent anything

  double command_allowance = 60.0, allowance_time = 0.0;  // of commands as text: client_commands.cpp
  bool flood_told = false;
};

struct ClientsOptions {
  int max_clients = 1;         // 1 to net::kMaxClients
  bool standard_quake = true;  // false for hipnotic (and quoth) and rogue: weapons are sent as numbers of bits
};

class Clients final : public LevelEvents {
 public:
  static constexpr std::size_t kMostBytes = net::kMaxMessage;  // of a buffer but the signon
  static constexpr std::size_t kMostSignonBytes = std::size_t{1} << 24;

  Clients(con::Console& console, const ClientsOptions& options);
  ~Clients() override;

  // Slots. Changing their number drops everybody, and is not for while a level runs.
  int max_clients() const { return static_cast<int>(slots_.size()); }
  void set_max_clients(int count);
  int active_count() const;
  ServerClient& operator[](int slot) { return *slots_.at(static_cast<std::size_t>(slot)); }
  // Whose edict that is; null where it is no player's. Nobody may be there: ask active().
  ServerClient* find(EdictId edict);
  bool standard_quake = true;

  // --- levels ---
  // Empties the buffers and chooses the protocol (level_protocol.h). The level must outlive end_level() or the next
  // call.
  void begin_level(Level& level);
  // After spawning: makes the baselines, sends everybody who is here the new level's serverinfo.
  void finish_level();
  // Nobody is in the game any more; connections stay.
  void end_level();
  Level* level() { return level_; }
  const net::Protocol& protocol() const { return protocol_; }
  // Asks QuakeC what each player takes along (SetChangeParms).
  void save_spawn_parms();
  // Tells everybody but not those within the program to expect another level; the latter hear it as well.
  void send_reconnect(double now);
  // Says goodbye and drops everybody, as the server ends. QuakeC is not asked.
  void drop_all(double now);

  // --- a frame ---
  // Where players come from; the listener must outlive this or be taken away again.
  void add_listener(net::Listener& listener) { listeners_.push_back(&listener); }
  void remove_listener(net::Listener& listener) { std::erase(listeners_, &listener); }
  // Takes in who waits at the listeners.
  void accept_new(double now);
  // Somebody has connected: it gets a place and serverinfo, or, where there is no place, a sentence and no connection.
  void accept(std::unique_ptr<net::Connection> connection, double now);
  // Reads what players say, and calls `think` for each who is in the game, after its messages and before the next's.
  void receive(double now, const std::function<void(ServerClient&)>& think);
  // Everything that waits, and this frame's datagram to each; then muzzle flashes are over.
  void send(double now);
  // Ends a player's game: QuakeC's ClientDisconnect unless `crashed`, and all are told.
  void drop(ServerClient& client, bool crashed, double now);

  // --- what QuakeC and the engine say ---
  // To everybody in the game (bprint), to one (sprint, centerprint, stuffcmd).
  void broadcast_print(std::string_view text);
  void print(ServerClient& client, std::string_view text);
  // Whether somebody plays in this program, whose console shows what players are told: it needs no line of the
  // server's.
  bool heard_here() const;
  void center_print(ServerClient& client, std::string_view text);
  void stuff(ServerClient& client, std::string_view text);
  // MSG_BROADCAST 0, MSG_ONE 1 (to `msg_entity`), MSG_ALL 2, MSG_INIT 3, for QuakeC's Write functions; MSG_MULTICAST 4
  // (and FTE's MSG_ENTITY 5) gathers what multicast() sends. An Error where
  // it is none of these or where MSG_ONE goes to no player. Ask for each write: what a full buffer is given is lost.
  Result<net::MessageWriter*> destination(int where, EdictId msg_entity);
  void start_sound(EdictId source, int channel, std::string_view sample, float volume, float attenuation) override;
  // The same, for one player alone, as loud everywhere (the 2021 re-release's localsound).
  void local_sound(ServerClient& client, std::string_view sample);
  void sound_at(const vec3& origin, EdictId source, int channel, std::string_view sample, float volume,
                float attenuation);
  // Sends what has gathered (FTE_QC_MULTICAST): 0 to 2 to all, unreliably, 3 to 5 reliably, 6 and 7 to msg_entity, 8 to
  // whoever comes. Who cannot see a place is told, too.
  void multicast(int set, EdictId msg_entity);
  void start_particle(const vec3& origin, const vec3& direction, int color, int count);
  // ambientsound. A sample that is not precached: a warning once.
  void ambient_sound(const vec3& origin, std::string_view sample, float volume, float attenuation);
  // makestatic, without freeing the edict.
  void make_static(Edict edict);
  // Keeps the style, and tells those who are in the game.
  void light_style(int style, std::string_view pattern);
  void set_pause(bool paused);
  // A "model" or "sound" that was precached while the level runs (network.md): those who are here learn its number.
  void tell_of_precache(std::string_view kind, int number, std::string_view name);

  net::MessageWriter& datagram() { return datagram_; }
  net::MessageWriter& signon() { return signon_; }

  // Whether mods may be told of extensions of QuakeC (pr_checkextension).
  bool extensions_wanted() const;
  // As if the player had sent it; costs nothing, and is for QuakeC (clientcommand).
  void execute_command(ServerClient& client, std::string_view text);

  // --- for consoles ---
  // `status`, `kick`, `ping` and `say` as the server's own console has them. False: none of these.
  bool console_command(const con::Args& args, double now);
  net::ServerStatus status(double now);

 private:
  friend struct ClientCommands;  // client_commands.cpp
  ServerClient* free_slot();
  void write_reliable(ServerClient& client, const net::ServerMessage& message);
  void write_to_all(const net::ServerMessage& message);
  void send_server_info(ServerClient& client);
  bool read_messages(ServerClient& client, double now);
  bool read_message(ServerClient& client, ByteView message, double now);
  void read_move(ServerClient& client, const net::clc::Move& move);
  bool signs_on_too_long(ServerClient& client, double passed);
  void update_frags();
  void send_signon(ServerClient& client, double now);
  bool send_datagram(ServerClient& client, double now);
  void send_reliable(ServerClient& client, double now);
  const std::vector<Bytes>& signon_parts();

  con::Console& console_;
  std::vector<net::Listener*> listeners_;
  std::vector<std::unique_ptr<ServerClient>> slots_;
  Level* level_ = nullptr;
  net::Protocol protocol_;
  net::MessageWriter datagram_, reliable_datagram_, signon_, multicast_, lost_;
  std::vector<Bytes> signon_parts_;
  std::size_t signon_parts_of_ = 0;  // bytes of signon_ that these are of
  bool told_full_ = false;
  double heard_at_ = 0.0;           // when players were listened to last
  std::int32_t effects_mask_ = -1;  // send_entities.h
};

}  // namespace fb::sv
