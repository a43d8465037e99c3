// FB_CHECK asserts what only a fault of the program itself can break. A failed check prints the operands and ends the
// program through fatal(), which also prints how to reproduce the failure (see set_reproduction_hint).
#pragma once

#include <functional>
#include <sstream>
#include <string>

namespace fb {

// Prints the message, the reproduction hint and aborts.
[[noreturn]] void fatal(const char* file, int line, const std::string& message);

// Sets what fatal() prints after the message: a function that returns, for instance, demo, frame and settings.
void set_reproduction_hint(std::function<std::string()> hint);

namespace detail {
template <typename A, typename B>
[[noreturn]] void check_failed(const char* file, int line, const char* expression, const A& a, const B& b) {
  std::ostringstream text;
  text << "check failed: " << expression << " (" << a << " against " << b << ")";
  fatal(file, line, text.str());
}
}  // namespace detail

}  // namespace fb

#define FB_CHECK(condition)                                                         \
  do {                                                                              \
    if (!(condition)) ::fb::fatal(__FILE__, __LINE__, "check failed: " #condition); \
  } while (false)

#define FB_CHECK_OP(a, op, b)                                                                           \
  do {                                                                                                  \
    const auto& fb_a = (a);                                                                             \
    const auto& fb_b = (b);                                                                             \
    if (!(fb_a op fb_b)) ::fb::detail::check_failed(__FILE__, __LINE__, #a " " #op " " #b, fb_a, fb_b); \
  } while (false)
#define FB_CHECK_EQ(a, b) FB_CHECK_OP(a, ==, b)
#define FB_CHECK_LT(a, b) FB_CHECK_OP(a, <, b)
#define FB_CHECK_LE(a, b) FB_CHECK_OP(a, <=, b)
