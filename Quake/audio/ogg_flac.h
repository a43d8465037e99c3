// FLAC within Ogg, which libsndfile knows and does not decode (1.2.0): taken out, it is a FLAC file. Formats: RFC 3533
// (pages), and the mapping of FLAC to Ogg, whose first packet has nine bytes before the usual beginning.
#pragma once

#include <optional>

#include "base/bytes.h"

namespace fb::audio {

// nullopt if the bytes are no Ogg file, or there is no FLAC in it. Of a damaged file what comes before the damage.
std::optional<Bytes> flac_of_ogg(ByteView file);

}  // namespace fb::audio
