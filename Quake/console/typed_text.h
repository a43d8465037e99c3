// What a keyboard or a clipboard gives, in the characters of Quake's font, which has no letters beyond ASCII.
#pragma once

#include <string>
#include <string_view>

namespace fb::con {

// Of UTF-8: Latin letters lose their accents, typographic quotes, dashes and spaces become ASCII's, what the font lacks
// (and a malformed byte) becomes '?'. Newlines stay, other control characters do not; a tab is a space.
std::string typed_text(std::string_view utf8);

}  // namespace fb::con
