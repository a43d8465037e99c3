// A connection: messages that arrive exactly once and in order (reliable), and messages that arrive at most once, never
// older than one before (unreliable). One reliable message is on its way at a time, as in Quake: can_send() says
// whether the next may be sent. There are two kinds: loopback.h inside the program, datagram_connection.h over UDP.
//
// Time is in seconds since any fixed moment, the same for all connections of a program, and never decreases.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/bytes.h"
#include "base/result.h"

namespace fb::net {

constexpr std::size_t kMaxMessage = 64000;  // bytes of a message of either kind
constexpr std::size_t kDatagramMtu = 1400;  // bytes of an unreliable message that usual networks do not fragment
constexpr double kDefaultTimeout = 300.0;   // seconds without a packet (net_messagetimeout)

struct ReceivedMessage {
  bool reliable = false;
  Bytes data;
};

class Connection {
 public:
  virtual ~Connection() = default;
  Connection() = default;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  // Whether a reliable message may be sent now: the one before has arrived, and the connection is open.
  virtual bool can_send() const = 0;
  // Fails, and sends nothing, if !can_send(), if the message is empty or longer than kMaxMessage.
  virtual Status send_reliable(ByteView message, double now) = 0;
  // Fails, and sends nothing, if the connection is closed, or for such messages; otherwise the message may still be
  // lost on its way.
  virtual Status send_unreliable(ByteView message, double now) = 0;
  // The next message; nothing if there is none yet. Also does timed work (resending, timing out), so it has to be
  // called every frame until it returns nothing.
  virtual std::optional<ReceivedMessage> receive(double now) = 0;

  virtual bool is_open() const = 0;
  // Why it is closed, for people: "timed out", "closed by the other side"; empty while it is open.
  virtual std::string_view close_reason() const = 0;
  // Does not tell the other side, unless both are local: svc_disconnect and clc_disconnect do that.
  virtual void close() = 0;

  virtual std::string address() const = 0;  // "LOCAL", "192.0.2.1:26000"
  virtual bool is_local() const = 0;
  // The longest unreliable message that no network fragments: kMaxMessage or kDatagramMtu.
  virtual std::size_t unreliable_limit() const = 0;
  virtual double connect_time() const = 0;
  // The player is in the game: a listener that limits how many sign on at a time counts this one no more.
  virtual void set_signed_on() {}

  // For Keepalive, from any thread where the network allows that: sends an unreliable message of one byte, svc_nop and
  // clc_nop; how many packets have been sent so far.
  virtual void say_nothing() {}
  virtual std::uint64_t packets_sent() const { return 0; }
};

// A listener, which accepts connections.
class Listener {
 public:
  virtual ~Listener() = default;
  // The next new connection; null if there is none. Call every frame until it is null.
  virtual std::unique_ptr<Connection> accept(double now) = 0;
};

}  // namespace fb::net
