// A way to the other side: messages that arrive once and in order (reliable), and messages that arrive at most once,
// never older than one before (unreliable). One reliable message is on its way at a time, as in Quake: can_send() says
// whether the next may go. There are two kinds: loopback.h within the program, datagram_connection.h over UDP.
//
// Time is in seconds from any fixed moment, the same for all of a program's connections, and never goes back.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/bytes.h"
#include "base/result.h"

namespace fb::net {

constexpr std::size_t kMaxMessage = 64000;  // bytes of a message of either kind
constexpr std::size_t kDatagramMtu = 1400;  // bytes of an unreliable message that passes any usual network whole
constexpr double kDefaultTimeout = 300.0;   // seconds of silence (net_messagetimeout)

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
  // Fails, and sends nothing, if the connection is closed, or for such messages; may be lost on the way all the same.
  virtual Status send_unreliable(ByteView message, double now) = 0;
  // The next message, nothing if there is none yet. Also does what time demands (resending, timing out), so it has to
  // be called every frame until it gives nothing.
  virtual std::optional<ReceivedMessage> receive(double now) = 0;

  virtual bool is_open() const = 0;
  // Why it is not, for people: "timed out", "closed by the other side"; empty while it is open.
  virtual std::string_view close_reason() const = 0;
  // Tells the other side nothing (that is svc_disconnect's and clc_disconnect's business) but where both are local.
  virtual void close() = 0;

  virtual std::string address() const = 0;  // "LOCAL", "192.0.2.1:26000"
  virtual bool is_local() const = 0;
  // The longest unreliable message that is sure not to be cut up on its way: kMaxMessage or kDatagramMtu.
  virtual std::size_t unreliable_limit() const = 0;
  virtual double connect_time() const = 0;
};

// Somewhere to wait for others to connect.
class Listener {
 public:
  virtual ~Listener() = default;
  // The next connection that somebody has opened to here; null if there is none. Every frame until it is null.
  virtual std::unique_ptr<Connection> accept(double now) = 0;
};

}  // namespace fb::net
