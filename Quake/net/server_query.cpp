#include "net/server_query.h"

#include <algorithm>

namespace fb::net {
namespace {

constexpr double kAskAgain = 0.75, kSearchFor = 1.5;  // seconds
constexpr double kInquireAgain = 0.5, kInquireFor = 3.0;
constexpr int kMostAnswersACall = 256, kMostPlayers = 255;
constexpr std::size_t kMostRules = 256;

}  // namespace

ServerSearch::ServerSearch(Network& network, std::vector<Address> targets) : targets_(std::move(targets)) {
  for (const Family family : {Family::kIpv4, Family::kIpv6}) {
    if (std::ranges::find(targets_, family, &Address::family) == targets_.end()) continue;
    if (auto socket = network.open(family, 0)) sockets_.push_back(std::move(*socket));
  }
}

bool ServerSearch::poll(double now) {
  if (asked_ == 0) started_ = now;
  if (asked_ == 0 || (asked_ == 1 && now >= started_ + kAskAgain)) ask();
  for (const auto& socket : sockets_) take_replies(*socket);
  return now < started_ + kSearchFor;
}

void ServerSearch::ask() {
  ++asked_;
  const Bytes request = write_control(ControlRequest(ccreq::ServerInfo{}));
  for (const auto& socket : sockets_)
    for (const Address& target : targets_)
      if (target.family == socket->family()) socket->send_to(target, request);
}

void ServerSearch::take_replies(Socket& socket) {
  for (int i = 0; i < kMostAnswersACall; ++i) {
    const auto datagram = socket.receive_from();
    if (!datagram) return;
    const auto reply = parse_control_reply(datagram->data);
    const auto* info = reply ? std::get_if<ccrep::ServerInfo>(&*reply) : nullptr;
    if (info == nullptr || found_.size() == kMostServers) continue;
    if (std::ranges::find(found_, datagram->from, &FoundServer::address) != found_.end()) continue;
    found_.push_back(
        {datagram->from, info->name, info->map, info->players, info->max_players, info->version == kConnectVersion});
  }
}

ServerInquiry::ServerInquiry(Network& network, const Address& server) : server_(server) {
  if (auto socket = network.open(server.family, 0)) socket_ = std::move(*socket);
}

bool ServerInquiry::poll(double now) {
  if (!socket_) return false;
  if (started_ < 0.0) started_ = next_ask_ = now;
  for (int i = 0; i < kMostAnswersACall; ++i) {
    const auto datagram = socket_->receive_from();
    if (!datagram) break;
    if (datagram->from != server_) continue;
    if (const auto reply = parse_control_reply(datagram->data)) take_reply(*reply, now);
  }
  if (answered_ && all_rules_ && static_cast<int>(players_.size()) == player_count_) return false;
  if (now >= started_ + kInquireFor) return false;
  if (now >= next_ask_) ask_for_missing(now);
  return true;
}

void ServerInquiry::ask_for_missing(double now) {
  next_ask_ = now + kInquireAgain;
  const auto ask = [&](const ControlRequest& request) { socket_->send_to(server_, write_control(request)); };
  if (!answered_) return ask(ccreq::ServerInfo{});
  for (int i = 0; i < player_count_; ++i)
    if (!players_.contains(i)) ask(ccreq::PlayerInfo{i});
  if (!all_rules_) ask(ccreq::RuleInfo{status_.rules.empty() ? "" : status_.rules.back().first});
}

void ServerInquiry::take_reply(const ControlReply& reply, double now) {
  if (const auto* info = std::get_if<ccrep::ServerInfo>(&reply)) {
    if (answered_) return;
    answered_ = true;
    status_.name = info->name;
    status_.map = info->map;
    status_.max_players = info->max_players;
    player_count_ = std::min(info->players, kMostPlayers);
    ask_for_missing(now);
  } else if (const auto* player = std::get_if<ccrep::PlayerInfo>(&reply)) {
    if (player->player < player_count_)
      players_.try_emplace(player->player, PlayerStatus{player->name, player->colors, player->frags,
                                                        static_cast<double>(player->seconds)});
  } else if (const auto* rule = std::get_if<ccrep::RuleInfo>(&reply)) {
    if (!answered_ || all_rules_) return;
    if (rule->name.empty() || status_.rules.size() == kMostRules) {
      all_rules_ = true;
      return;
    }
    if (std::ranges::find(status_.rules, rule->name, &std::pair<std::string, std::string>::first) !=
        status_.rules.end())
      return;  // a repeated reply
    status_.rules.emplace_back(rule->name, rule->value);
    socket_->send_to(server_, write_control(ControlRequest(ccreq::RuleInfo{rule->name})));
  }
}

ServerStatus ServerInquiry::status() const {
  ServerStatus all = status_;
  for (const auto& [number, player] : players_) all.players.push_back(player);
  return all;
}

}  // namespace fb::net
