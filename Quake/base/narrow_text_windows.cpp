// Narrow text is UTF-8 in this program, whatever the system's code page: names of files, above all. Of the standard
// library std::filesystem::path gives UTF-8, but takes what the C library's locale says, and MinGW's C library (msvcrt)
// has no locale of UTF-8. Its static library's functions for one character are therefore replaced by these (ISO
// C 7.29.6); the linker takes them since they come first (Misc/cmake/options.cmake).
//
// wchar_t is UTF-16 here. Of a character beyond 0xffff the first three bytes give the high surrogate, and the state
// keeps the low one for the fourth.
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cwchar>

namespace {

constexpr std::size_t kInvalid = static_cast<std::size_t>(-1), kIncomplete = static_cast<std::size_t>(-2);

std::size_t invalid() {
  errno = EILSEQ;
  return kInvalid;
}

bool continues(unsigned char byte) { return (byte & 0xc0u) == 0x80u; }

// The bytes of a character by its first one; 0: no character begins with it.
std::size_t length_of(unsigned char first) {
  if (first < 0x80u) return 1;
  if (first >= 0xc2u && first <= 0xdfu) return 2;
  if (first >= 0xe0u && first <= 0xefu) return 3;
  return first >= 0xf0u && first <= 0xf4u ? 4 : 0;
}

std::size_t wide_of(wchar_t* to, const unsigned char* from, std::size_t size, std::mbstate_t& low_surrogate) {
  if (size == 0) return kIncomplete;
  if (low_surrogate != 0) {
    if (to != nullptr) *to = static_cast<wchar_t>(low_surrogate);
    low_surrogate = 0;
    return 1;
  }
  const std::size_t length = length_of(from[0]);
  if (length == 0) return invalid();
  constexpr std::array<std::uint32_t, 5> kBits{0, 0x7f, 0x1f, 0x0f, 0x07}, kLeast{0, 0, 0x80, 0x800, 0x10000};
  std::uint32_t code = from[0] & kBits[length];
  for (std::size_t i = 1; i < length; ++i) {
    if (i >= size) return kIncomplete;
    if (!continues(from[i])) return invalid();
    code = code << 6u | (from[i] & 0x3fu);
  }
  if (code < kLeast[length] || code > 0x10ffffu || (code >= 0xd800u && code <= 0xdfffu)) return invalid();
  if (code > 0xffffu) {
    low_surrogate = static_cast<std::mbstate_t>(0xdc00u | (code & 0x3ffu));
    code = 0xd7c0u + (code >> 10u);
  }
  if (to != nullptr) *to = static_cast<wchar_t>(code);
  if (code == 0) return 0;
  return length == 4 ? 3 : length;
}

}  // namespace

extern "C" {

std::size_t mbrtowc(wchar_t* to, const char* from, std::size_t size, std::mbstate_t* state) {
  static thread_local std::mbstate_t own{};
  std::mbstate_t& kept = state != nullptr ? *state : own;
  if (from == nullptr) {
    kept = {};
    return 0;
  }
  return wide_of(to, reinterpret_cast<const unsigned char*>(from), size, kept);
}

std::size_t mbrlen(const char* from, std::size_t size, std::mbstate_t* state) {
  static thread_local std::mbstate_t own{};
  return mbrtowc(nullptr, from, size, state != nullptr ? state : &own);
}

std::size_t mbsrtowcs(wchar_t* to, const char** from, std::size_t size, std::mbstate_t* state) {
  static thread_local std::mbstate_t own{};
  std::mbstate_t& kept = state != nullptr ? *state : own;
  const char* at = *from;
  std::size_t count = 0;
  for (; to == nullptr || count < size; ++count) {
    // As many bytes as the text can be sure to have: each call looks no further than a character that is not over.
    const std::size_t took = mbrtowc(to != nullptr ? to + count : nullptr, at, 4, &kept);
    if (took == kInvalid || took == kIncomplete) return invalid();
    if (took == 0) {
      if (to != nullptr) *from = nullptr;
      return count;
    }
    at += took;
  }
  *from = at;
  return count;
}

}  // extern "C"
