// Texts in the player's language: the 2021 re-release's QuakeC and maps speak in keys ("$qc_found_secret"), whose texts
// are in files localization/loc_LANGUAGE.txt. One entry a line, of UTF-8:
//
//   // a comment
//   qc_entered = "{0} entered the game\n"
//
// Keys and texts may stand without quotes; \n \t \" \' and \\ are escapes. QuakeSpasm, vkQuake and Ironwail read the
// same. Letters become what Quake's font has: those with accents lose them, others become "?".
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "base/bytes.h"
#include "base/result.h"

namespace fb::con {

class Localization {
 public:
  // What a file may hold; the re-release's has 2,000 texts in 200 kB.
  static constexpr std::size_t kMostFileBytes = 8u << 20u, kMostTexts = 65536, kMostKeyBytes = 256,
                               kMostTextBytes = 8192;
  static constexpr std::size_t kMostMessageBytes = 65535;

  // Adds a file's texts; a key that is there already keeps its text. Returns how many were added. Fails on a file that
  // is too large, and on more texts than there may be: what comes behind these is left out.
  Result<std::size_t> add(ByteView file, std::string_view name);
  void clear() { texts_.clear(); }
  std::size_t size() const { return texts_.size(); }

  // The text of "$key"; what is no key that is known is returned as it is.
  std::string_view text(std::string_view given) const;
  // What a message says that QuakeC gives in pieces. Where the first has placeholders ({0}, {1} ...; {} is {0}) the
  // others take their places, else they follow it. Without any texts placeholders are nothing special (QuakeSpasm).
  std::string message(std::span<const std::string_view> pieces) const;

 private:
  void add_line(std::string_view line, std::size_t& added);

  std::map<std::string, std::string, std::less<>> texts_;  // by key, without the $
};

}  // namespace fb::con
