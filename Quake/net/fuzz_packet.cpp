// Fuzz target: one datagram to each parser. What is accepted comes out the same when written and read again.
#include <cstddef>
#include <cstdint>

#include "base/check.h"
#include "net/control.h"
#include "net/packet.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fb::net;
  const fb::ByteView datagram(data, size);
  const auto packet = parse_packet(datagram);
  if (packet) {
    FB_CHECK(write_packet(*packet) == fb::Bytes(datagram.begin(), datagram.end()));
  } else {
    FB_CHECK(!packet.error().message.empty());
  }
  if (const auto request = parse_control_request(datagram)) {
    const auto again = parse_control_request(write_control(*request));
    FB_CHECK(again.ok() && *again == *request);
  }
  if (const auto reply = parse_control_reply(datagram)) {
    const auto again = parse_control_reply(write_control(*reply));
    FB_CHECK(again.ok() && (*again == *reply || std::holds_alternative<ccrep::RuleInfo>(*reply)));
  }
  return 0;
}
