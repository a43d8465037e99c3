#include "net/datagram_listener.h"

#include <algorithm>

namespace fb::net {
namespace {

constexpr int kMostRequestsACall = 512;  // so that a flood cannot delay the frame

std::string cut(const std::string& text, std::size_t most) { return text.substr(0, most); }
int to_byte(std::size_t n) { return static_cast<int>(std::min<std::size_t>(n, 255)); }

// The rule after the named one, the first for an empty name; nothing if there is no such rule. Rules whose names would
// not fit a reply are skipped; an empty name ends the list.
std::optional<ccrep::RuleInfo> rule_after(const ServerStatus& status, const std::string& previous, std::size_t room) {
  auto rule = status.rules.begin();
  if (!previous.empty()) {
    rule = std::ranges::find(status.rules, previous, &std::pair<std::string, std::string>::first);
    if (rule == status.rules.end()) return std::nullopt;
    ++rule;
  }
  rule = std::find_if(rule, status.rules.end(), [&](const auto& r) { return r.first.size() <= room; });
  if (rule == status.rules.end()) return ccrep::RuleInfo{};
  return ccrep::RuleInfo{rule->first, cut(rule->second, room - rule->first.size())};
}

}  // namespace

Result<std::unique_ptr<DatagramListener>> DatagramListener::open(Network& network, std::uint16_t port,
                                                                 StatusSource status, std::uint64_t seed) {
  std::vector<std::unique_ptr<Socket>> sockets;
  auto v4 = network.open(Family::kIpv4, port);
  if (v4) sockets.push_back(std::move(*v4));
  // Opens both address families on the same port, also if any port is allowed.
  auto v6 = network.open(Family::kIpv6, v4 ? sockets.front()->port() : port);
  if (v6) sockets.push_back(std::move(*v6));
  if (sockets.empty()) return v4.error();
  return std::unique_ptr<DatagramListener>(new DatagramListener(network, std::move(sockets), std::move(status), seed));
}

DatagramListener::DatagramListener(Network& network, std::vector<std::unique_ptr<Socket>> sockets, StatusSource status,
                                   std::uint64_t seed)
    : network_(network), sockets_(std::move(sockets)), status_(std::move(status)), limit_(seed) {}

DatagramListener::~DatagramListener() = default;

std::unique_ptr<Connection> DatagramListener::accept(double now) {
  for (const auto& socket : sockets_) read_requests(*socket, now);
  return take_verified(now);
}

void DatagramListener::read_requests(Socket& socket, double now) {
  for (int i = 0; i < kMostRequestsACall; ++i) {
    const auto datagram = socket.receive_from();
    if (!datagram) return;
    const auto request = parse_control_request(datagram->data);
    if (request && limit_.allow(datagram->from, now))
      answer_request(socket, datagram->from, datagram->data.size(), *request, now);
  }
}

void DatagramListener::answer(Socket& socket, const Address& to, std::size_t request_size, const ControlReply& reply) {
  const Bytes bytes = write_control(reply);
  if (bytes.size() <= kMostReply * request_size) socket.send_to(to, bytes);
}

void DatagramListener::answer_request(Socket& socket, const Address& from, std::size_t size,
                                      const ControlRequest& request, double now) {
  // Room for text in a reply, after its numbers, headers and terminating zeros.
  const auto room = [&](std::size_t fixed) { return kMostReply * size - fixed; };
  if (const auto* connect = std::get_if<ccreq::Connect>(&request)) {
    if (connect->game == kGameName) answer_connect(socket, from, size, *connect, now);
  } else if (const auto* info = std::get_if<ccreq::ServerInfo>(&request)) {
    if (info->game != kGameName) return;
    const ServerStatus status = status_();
    const std::size_t each = room(kControlHeader + 1 + 3 + 3) / 2;
    answer(socket, from, size,
           ccrep::ServerInfo{"", cut(status.name, each), cut(status.map, each), to_byte(status.players.size()),
                             std::clamp(status.max_players, 0, 255), kConnectVersion});
  } else if (const auto* player = std::get_if<ccreq::PlayerInfo>(&request)) {
    const ServerStatus status = status_();
    const auto index = static_cast<std::size_t>(player->player);
    if (index >= status.players.size()) return;
    const PlayerStatus& p = status.players[index];
    answer(socket, from, size,
           ccrep::PlayerInfo{player->player, cut(p.name, room(kControlHeader + 2 + 12 + 2)), p.colors, p.frags,
                             static_cast<std::int32_t>(std::clamp(p.seconds, 0.0, 1e9)), ""});
  } else if (const auto* rule = std::get_if<ccreq::RuleInfo>(&request)) {
    if (const auto reply = rule_after(status_(), rule->previous, room(kControlHeader + 1 + 2)))
      answer(socket, from, size, *reply);
  }
}

void DatagramListener::answer_connect(Socket& socket, const Address& from, std::size_t size,
                                      const ccreq::Connect& request, double now) {
  if (request.version != kConnectVersion) return answer(socket, from, size, ccrep::Reject{"Incompatible version.\n"});
  const auto same = std::ranges::find_if(pending_, [&](const auto& p) { return p->peer()->address == from; });
  if (same != pending_.end()) return answer(socket, from, size, ccrep::Accept{(*same)->local_port()});
  if (knows(from, now)) return;
  const ServerStatus status = status_();
  if (static_cast<int>(status.players.size()) >= status.max_players)
    return answer(socket, from, size, ccrep::Reject{"Server is full.\n"});
  if (pending_.size() == kMostPending) pending_.erase(pending_.begin());
  auto own = network_.open(from.family, 0);
  if (!own) return;
  pending_.push_back(std::make_unique<DatagramConnection>(std::move(*own), from, now, timeout_));
  pending_.back()->doubt_peer();
  answer(socket, from, size, ccrep::Accept{pending_.back()->local_port()});
}

// Whether `from` belongs to a live connection. Closes connections that `from` replaces.
bool DatagramListener::knows(const Address& from, double now) {
  std::erase_if(connected_, [](const auto& weak) {
    const auto peer = weak.lock();
    return !peer || !peer->open;
  });
  for (const auto& weak : connected_) {
    const auto peer = weak.lock();
    const double silence = now - peer->last_heard;
    if (peer->address == from && silence < kSilent) return true;
    // Another port of the same host may be another player, or a player back after a crash: wait longer before replacing
    // it.
    if (peer->address == from || (peer->address.same_host(from) && silence > 2 * kSilent)) {
      peer->open = false;
      peer->close_reason = "connected anew";
    }
  }
  return false;
}

std::unique_ptr<Connection> DatagramListener::take_verified(double now) {
  std::unique_ptr<DatagramConnection> taken;
  for (auto& pending : pending_) {
    if (!pending->poll_peer(now) || taken) continue;
    const ServerStatus status = status_();
    if (static_cast<int>(status.players.size()) < status.max_players)
      taken = std::move(pending);
    else
      pending->close();  // other clients took the slots
  }
  std::erase_if(pending_, [](const auto& pending) { return !pending || !pending->is_open(); });
  if (taken) connected_.push_back(taken->peer());
  return taken;
}

}  // namespace fb::net
