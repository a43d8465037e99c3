// What editors put before the first letter of a text file.
#pragma once

#include <string_view>

namespace fb {

// The text without a byte order mark of UTF-8, which Windows' editors write.
inline std::string_view without_byte_order_mark(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  return text;
}

}  // namespace fb
