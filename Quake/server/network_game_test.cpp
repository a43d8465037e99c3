// A game over a network that loses, repeats and reorders: players stay, and see in the end what is there.
#include "net/connect_attempt.h"
#include "net/datagram_listener.h"
#include "net/test_network.h"
#include "server/clients/test_clients.h"

namespace fb::sv::testing {
namespace {

using net::testing::TestNetwork;

const net::Address kServer = net::ipv4(192, 0, 2, 1, 26000);
constexpr double kFrame = 0.05;

class NetworkGame : public ClientsTest, public ::testing::WithParamInterface<int> {
 protected:
  void open() {
    auto opened = net::DatagramListener::open(
        network_.host(kServer), kServer.port, [this] { return clients_.status(network_.now()); }, 1);
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    listener_ = std::move(*opened);
    clients_.add_listener(*listener_);
  }
  // Sockets end before the network does.
  void TearDown() override {
    clients_.drop_all(now_);
    if (listener_) clients_.remove_listener(*listener_);
    fakes_.clear();
    ClientsTest::TearDown();
  }
  void step() {
    network_.advance(kFrame);
    now_ = network_.now();
    clients_.accept_new(now_);
    clients_.receive(now_, [](ServerClient&) {});
    level_->time += kFrame;
    clients_.send(now_);
    for (auto& fake : fakes_) fake->read(now_);
  }
  FakeClient& connect_from(const net::Address& host) {
    net::ConnectAttempt attempt(network_.host(host), kServer);
    while (attempt.poll(network_.now()) == net::ConnectAttempt::State::kTrying) step();
    EXPECT_EQ(attempt.failure(), "");
    fakes_.push_back(std::make_unique<FakeClient>(attempt.take()));
    return *fakes_.back();
  }

  TestNetwork network_{3, {.loss = 0.1f, .repeat = 0.05f, .delay = 0.02, .more_delay = 0.08}};
  std::unique_ptr<net::DatagramListener> listener_;
};
INSTANTIATE_TEST_SUITE_P(Protocols, NetworkGame, ::testing::Values(15, 666, 999));

TEST_P(NetworkGame, AMinuteOfBadWeather) {
  start_game("float i; void() main = { for (i = 0; i < 2500; i = i + 1) ambientsound('1 0 0' * i, \"a.wav\", 1, 3); };",
             4, GetParam());
  open();
  std::vector<std::uint32_t> things;
  for (int i = 0; i < 25; ++i) things.push_back(spawn({10.0f * static_cast<float>(i), 0, 0}));
  FakeClient& first = connect_from(net::ipv4(192, 0, 2, 50, 0));
  FakeClient& second = connect_from(net::ipv4(192, 0, 2, 51, 0));
  for (int tick = 0; tick < 1200; ++tick) {
    if (tick == 1100) network_.weather = {.loss = 0.0f, .delay = 0.02};
    for (std::size_t i = 0; i < things.size(); ++i)
      place(things[i], {static_cast<float>((tick * 3 + static_cast<int>(i) * 40) % 800), 50, 0});
    if (tick % 20 == 0) clients_.broadcast_print(fmt::format("{};", tick));
    for (FakeClient* fake : {&first, &second})
      if (fake->signon == 3)
        fake->send(net::clc::Move{fake->last<svc::Time>().time, vec3(0, static_cast<float>(tick % 32), 0), tick}, now_);
    step();
  }
  for (int i = 0; i < 4; ++i) step();  // what is on its way arrives
  ASSERT_EQ(clients_.active_count(), 2);
  EXPECT_GT(network_.lost, 100u);
  for (FakeClient* fake : {&first, &second}) {
    EXPECT_EQ(fake->signon, 3);
    EXPECT_EQ(fake->all<svc::SpawnStaticSound>().size(), 2500u);
    for (const std::uint32_t thing : things)
      EXPECT_EQ(fake->seen(static_cast<int>(thing)).origin, edict(thing).get(fields::origin));
    // What is reliable came once, and in order.
    std::string expected;
    const std::string prints = fake->prints();
    const std::size_t begin = prints.find(';');
    ASSERT_NE(begin, std::string::npos);
    const int from = std::stoi(prints.substr(prints.rfind('\n', begin) + 1));
    for (int tick = from; tick < 1200; tick += 20) expected += fmt::format("{};", tick);
    EXPECT_THAT(prints, ::testing::EndsWith(expected));
  }
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(slot(i).move.forward, 1199);
    EXPECT_GT(slot(i).average_ping(), 0.02f);
    EXPECT_LT(slot(i).average_ping(), 0.3f);
  }
}

}  // namespace
}  // namespace fb::sv::testing
