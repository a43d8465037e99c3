// For tests: a session that is told messages, with models made by hand.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "client/session/parse.h"
#include "client/session/session.h"
#include "client/test_demo.h"

namespace fb::cl::test {

// A session that has been told messages, with models made by hand.
struct ToldSession : Session {
  explicit ToldSession(const net::Protocol& protocol = {}) {
    for (scene::Model& m : known) m.kind = scene::ModelKind::kMissing;
    known[2].kind = scene::ModelKind::kAlias;
    known[2].name = "progs/thing.mdl";
    known[2].mesh = 1;
    known[2].frames = {{"a", 0, 1, {}}, {"b", 1, 1, {}}, {"c", 2, 1, {}}, {"group", 3, 2, {0.2f, 0.4f}}};
    known[2].skin_materials = {5, 6};
    load_world = [this](ClientState& s) {
      for (std::size_t i = 1; i < s.models.size() && i <= known.size(); ++i) s.models[i] = &known[i - 1];
      return ok_status();
    };
    tell({server_info(protocol), net::svc::SetView{1}, net::svc::SignonNum{1}, net::svc::SignonNum{2},
          net::svc::SignonNum{3}});
  }
  // One datagram; it must be understood.
  void tell(const std::vector<net::ServerMessage>& messages) {
    const Bytes bytes = datagram(messages, state.protocol);
    const Status status = parse_server_message(*this, bytes, "test");
    EXPECT_TRUE(status.ok()) << (status.ok() ? "" : status.error().message);
  }
  // One that is not; returns why.
  std::string refuse(const std::vector<net::ServerMessage>& messages) {
    const Bytes bytes = datagram(messages, state.protocol);
    const Status status = parse_server_message(*this, bytes, "test");
    EXPECT_FALSE(status.ok());
    return status.ok() ? "" : status.error().message;
  }
  Entity& entity(std::size_t i) { return state.entities.at(i); }

  std::array<scene::Model, 4> known;  // precaches 1 to 4
};

}  // namespace fb::cl::test
