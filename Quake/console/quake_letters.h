// UTF-8 in the characters of Quake's font, which has no letters beyond ASCII: Latin letters lose their accents,
// typographic quotes, dashes and spaces become ASCII's, and what the font lacks is '?'.
#pragma once

#include <string>
#include <string_view>

namespace fb::con {

// Of a text from a file. Bytes that are no UTF-8 are taken for letters of that font (the bronze ones).
std::string quake_letters(std::string_view utf8);

// Of what a keyboard or a clipboard gives: a malformed byte is '?', too. Newlines stay, other control characters do
// not; a tab is a space.
std::string typed_text(std::string_view utf8);

}  // namespace fb::con
