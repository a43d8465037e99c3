// Players for tests: a level with Clients, and clients over a loopback that sign on as real ones do and keep what they
// hear. Nothing moves by itself: tests put edicts where they want them. Skips where there is no compiler of QuakeC.
//
//   class MyTest : public ClientsTest {};
//   TEST_F(MyTest, Hears) {
//     start_game("void() shout = { bprint(\"hello\"); };");
//     FakeClient& player = join();
//     call("shout");
//     frame();
//     EXPECT_THAT(player.prints(), HasSubstr("hello"));
//   }
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/log.h"
#include "net/loopback.h"
#include "progs/builtins/builtins.h"
#include "progs/test_qc.h"
#include "server/builtins/game_builtins.h"
#include "server/clients/clients.h"
#include "server/clients/test_remote_connection.h"
#include "server/simulation/link.h"
#include "server/simulation/test_map.h"

namespace fb::sv::testing {

namespace fields = progs::fields;
namespace globals = progs::globals;
namespace svc = net::svc;

// Players are 100 healthy at the origin; how often they came and went is counted.
constexpr const char* kPlayersSource = R"(
float connects, entries, disconnects, kills;
.float alpha, scale;
void(entity e, float channel, string sample, float volume, float attenuation) sound = #8;
void(entity e, string s) stuffcmd = #21;
void(entity e, string s, ...) sprint = #24;
void(float style, string s) lightstyle = #35;
void(vector o, vector d, float color, float count) particle = #48;
void(float to, float f) WriteByte = #52;
void(float to, float f) WriteCoord = #56;
void(float to, string s) WriteString = #58;
void(entity e) makestatic = #69;
void(entity e, string s, ...) centerprint = #73;
void(vector o, string sample, float volume, float attenuation) ambientsound = #74;
void() ClientKill = { kills = kills + 1; };
void() ClientConnect = { connects = connects + 1; sprint(self, "lost"); };
void() PutClientInServer = {
  entries = entries + 1;
  self.health = 100; self.view_ofs = '0 0 22'; self.movetype = 3; self.model = "progs/player.mdl"; self.modelindex = 2;
};
void() ClientDisconnect = { disconnects = disconnects + 1; };
void() SetNewParms = { parm1 = 11; parm16 = 16; };
void() SetChangeParms = { parm1 = self.health; };
)";

struct FakeClient {
  explicit FakeClient(std::unique_ptr<net::Connection> end) : connection(std::move(end)) {}

  std::unique_ptr<net::Connection> connection;
  net::Protocol protocol;
  bool answers = true;  // signs on by itself
  int signon = 0;
  std::vector<net::ServerMessage> heard;  // since forget()
  std::vector<std::size_t> sizes;         // of the messages received, reliable ones and datagrams
  std::map<int, net::EntityState> baselines;
  std::map<int, svc::EntityUpdate> updates;  // of the latest datagram
  std::size_t datagram_size = 0;
  std::deque<std::string> commands;  // wait until a reliable message may go

  void command(std::string text) { commands.push_back(std::move(text)); }
  void send(const net::ClientMessage& message, double now = 0.0) {
    net::MessageWriter writer(protocol);
    net::write_client_message(writer, message);
    EXPECT_TRUE(connection->send_unreliable(writer.bytes(), now));
  }
  void read(double now) {
    while (auto message = connection->receive(now)) {
      sizes.push_back(message->data.size());
      if (!message->reliable) {
        updates.clear();
        datagram_size = message->data.size();
      }
      net::ServerMessageReader reader(message->data, "test", protocol);
      while (!reader.at_end()) {
        auto next = reader.next();
        ASSERT_TRUE(next.ok()) << next.error().message;
        take(*next);
        heard.push_back(std::move(*next));
      }
      protocol = reader.protocol();
    }
    if (commands.empty() || !connection->can_send()) return;
    net::MessageWriter writer(protocol);
    for (; !commands.empty(); commands.pop_front())
      net::write_client_message(writer, net::clc::StringCommand{commands.front()});
    EXPECT_TRUE(connection->send_reliable(writer.bytes(), now));
  }
  void forget() { heard.clear(); }

  template <typename T>
  std::vector<T> all() const {
    std::vector<T> found;
    for (const auto& message : heard)
      if (const T* one = std::get_if<T>(&message)) found.push_back(*one);
    return found;
  }
  template <typename T>
  T last() const {
    const auto found = all<T>();
    EXPECT_FALSE(found.empty());
    return found.empty() ? T{} : found.back();
  }
  std::string prints() const {
    std::string text;
    for (const auto& print : all<svc::Print>()) text += print.text;
    return text;
  }
  // How an entity of the latest datagram looks: its baseline and what differs.
  net::EntityState seen(int entity) const {
    const auto found = updates.find(entity);
    EXPECT_TRUE(found != updates.end()) << "entity " << entity;
    const auto base = baselines.find(entity);
    net::EntityState state = base == baselines.end() ? net::EntityState{} : base->second;
    if (found == updates.end()) return state;
    const svc::EntityUpdate& u = found->second;
    constexpr std::uint32_t kAngles[] = {net::kUpdateAngle1, net::kUpdateAngle2, net::kUpdateAngle3};
    for (int axis = 0; axis < 3; ++axis) {
      if (u.bits & (net::kUpdateOrigin1 << axis)) state.origin[axis] = u.origin[axis];
      if (u.bits & kAngles[axis]) state.angles[axis] = u.angles[axis];
    }
    const auto take_over = [&](std::uint32_t bit, int& to, int from) { to = u.bits & bit ? from : to; };
    take_over(net::kUpdateModel, state.model, u.model);
    take_over(net::kUpdateFrame, state.frame, u.frame);
    take_over(net::kUpdateSkin, state.skin, u.skin);
    take_over(net::kUpdateColormap, state.colormap, u.colormap);
    take_over(net::kUpdateEffects, state.effects, u.effects);
    take_over(net::kUpdateAlpha, state.alpha, u.alpha);
    take_over(net::kUpdateScale, state.scale, u.scale);
    return state;
  }

 private:
  void take(const net::ServerMessage& message) {
    if (const auto* info = std::get_if<svc::ServerInfo>(&message)) {
      protocol = info->protocol;
      baselines.clear();
      signon = 0;
    }
    if (const auto* baseline = std::get_if<svc::SpawnBaseline>(&message)) baselines[baseline->entity] = baseline->state;
    if (const auto* update = std::get_if<svc::EntityUpdate>(&message)) updates[update->entity] = *update;
    const auto* stage = std::get_if<svc::SignonNum>(&message);
    if (!stage) return;
    signon = stage->signon;
    if (!answers) return;
    if (signon == 1) command("prespawn");
    if (signon == 2) {
      command("name \"player\"");
      command("color 4 3");
      command("spawn 1 2");
    }
    if (signon == 3) command("begin");
  }
};

// What the log is told while this lives, a line each.
class LogWatch {
 public:
  LogWatch() : handle_(add_log_listener([this](LogLevel, std::string_view line) { text_.append(line) += '\n'; })) {
    set_log_level(LogLevel::kInfo);
  }
  ~LogWatch() {
    remove_log_listener(handle_);
    set_log_level(LogLevel::kError);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  int handle_;
};

class ClientsTest : public progs::testing::QcTest {
 protected:
  // Compiles and begins the first level. QuakeC's `main` spawns what it wants, before baselines are made.
  void start_game(const std::string& source = "void() main = {};", int max_clients = 1, int protocol = 666) {
    const auto compiled =
        progs::testing::compile(std::string(progs::testing::kBuiltinSource) + kPlayersSource + source);
    ASSERT_FALSE(compiled.progs.empty()) << compiled.output;
    auto program = progs::load_program(compiled.progs, "progs.dat");
    ASSERT_TRUE(program.ok()) << program.error().message;
    program_ = std::make_shared<progs::Program>(std::move(program).value());
    console_.set("sv_protocol", std::to_string(protocol));
    clients_.set_max_clients(max_clients);
    begin_level();
    finish_level();
  }
  void begin_level() {
    if (!bsp_) {
      MapBuilder room(vec3(-1024, -1024, -64), vec3(1024, 1024, 512));
      bsp_ = std::make_shared<formats::Bsp>(room.build());
    }
    progs::BuiltinTable table = progs::standard_builtins({});
    add_message_builtins(table, context_);
    auto vm = progs::Vm::create(program_, std::move(table), {});
    ASSERT_TRUE(vm.ok());
    (*vm)->edicts().start_level(static_cast<std::uint32_t>(clients_.max_clients()));
    clients_.end_level();
    level_ = std::make_unique<Level>("test", bsp_, std::move(*vm), console_, clients_, rng_);
    context_.level = level_.get();
    level_->max_clients = clients_.max_clients();
    for (const char* model : {"maps/test.bsp", "progs/player.mdl", "progs/box.mdl"}) level_->models.push_back({model});
    level_->sounds.push_back("a.wav");
    clients_.begin_level(*level_);
    call("main");
  }
  void finish_level() {
    for (std::uint32_t i = 1; i < level_->edicts().count(); ++i) link_edict(*level_, EdictId{i});
    level_->loading = false;
    clients_.finish_level();
  }
  void TearDown() override {
    if (level_ && level_->failed() && !may_fail_) ADD_FAILURE() << level_->error()->message;
    QcTest::TearDown();
  }

  FakeClient& connect(bool remote = false) {
    auto [client, server] = net::make_loopback(now_);
    fakes_.push_back(std::make_unique<FakeClient>(std::move(client)));
    if (remote) server = std::make_unique<RemoteConnection>(std::move(server));
    clients_.accept(std::move(server), now_);
    return *fakes_.back();
  }
  // Connects and signs on.
  FakeClient& join(bool remote = false) {
    FakeClient& fake = connect(remote);
    frame(12);
    return fake;
  }
  // Server, then clients, as often.
  void frame(int count = 1) {
    for (int i = 0; i < count; ++i) {
      now_ += 0.1;
      clients_.receive(now_, [this](ServerClient& client) { thought_.push_back(client.slot); });
      level_->time += 0.1;
      clients_.send(now_);
      for (auto& fake : fakes_) fake->read(now_);
    }
  }
  bool call(const std::string& function, std::uint32_t self = 0) {
    return level_->run(program_->find_function(function), EdictId{self});
  }
  float number(const char* global) { return level_->vm->get(program_->global<float>(global)); }
  Edict edict(std::uint32_t id) { return level_->edict(EdictId{id}); }
  ServerClient& slot(int i) { return clients_[i]; }
  // An edict that can be seen.
  std::uint32_t spawn(const vec3& origin, float model = 3.0f) {
    const std::uint32_t id = index(*level_->edicts().alloc(level_->time));
    place(id, origin);
    edict(id).set(fields::model, level_->vm->strings().intern("progs/box.mdl"));
    edict(id).set(fields::modelindex, model);
    link_edict(*level_, EdictId{id});
    return id;
  }
  void place(std::uint32_t id, const vec3& origin) {
    edict(id).set(fields::origin, origin);
    edict(id).set(fields::mins, vec3(-8.0f));
    edict(id).set(fields::maxs, vec3(8.0f));
    link_edict(*level_, EdictId{id});
  }

  con::Console console_;
  Rng rng_{1};
  Clients clients_{console_, {}};
  GameContext context_{clients_};
  std::shared_ptr<const formats::Bsp> bsp_;
  std::shared_ptr<const progs::Program> program_;
  std::unique_ptr<Level> level_;
  std::vector<std::unique_ptr<FakeClient>> fakes_;
  std::vector<int> thought_;  // slots, in the order in which they did
  double now_ = 100.0;
  bool may_fail_ = false;
};

}  // namespace fb::sv::testing
