// Cutting what a server says between two messages. QuakeC writes bytes, so that nobody knows where its messages end
// until they are read back; what cannot be read (a mod's own message, say) is never cut.
#pragma once

#include <cstddef>
#include <vector>

#include "base/bytes.h"
#include "net/protocol.h"

namespace fb::sv {

// How many of the first bytes are whole messages and no more than `most`.
std::size_t whole_messages(ByteView bytes, std::size_t most, const net::Protocol& protocol);

// The messages, in order, in parts of at most `most` bytes. What is longer as it cannot be cut is a part of its own.
std::vector<Bytes> split_messages(ByteView bytes, std::size_t most, const net::Protocol& protocol);

}  // namespace fb::sv
