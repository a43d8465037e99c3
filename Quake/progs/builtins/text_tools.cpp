// Strings for programs and pages: trimming, marks of colour, URIs, checksums, dates.
#include <fmt/format.h>

#include <cctype>
#include <ctime>

#include "base/system.h"
#include "progs/builtins/kinds.h"
#include "progs/markup.h"
#include "progs/vm.h"

namespace fb::progs {
namespace {

void strtrim(Vm& vm) {
  std::string_view text = vm.parm_string(0);
  const auto blank = [](char c) { return static_cast<unsigned char>(c) <= ' '; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  vm.return_string(text);
}

void strlennocol(Vm& vm) { vm.return_float(static_cast<float>(marked_up(vm.parm_string(0), vec4(1.0f)).size())); }

void strdecolorize(Vm& vm) {
  std::string text;
  for (const Letter& letter : marked_up(vm.parm_string(0), vec4(1.0f))) text += static_cast<char>(letter.code);
  vm.return_string(text);
}

bool stays_in_uri(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '_';
}

void uri_escape(Vm& vm) {
  std::string escaped;
  for (const char c : vm.parm_string(0))
    escaped += stays_in_uri(c) ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  vm.return_string(escaped);
}

// A % that begins no code stays; a code of zero, which would end the string, is left out.
void uri_unescape(Vm& vm) {
  const std::string_view escaped = vm.parm_string(0);
  const auto digit = [&](std::size_t i) {
    const auto at = i < escaped.size()
                        ? std::string_view("0123456789abcdef")
                              .find(static_cast<char>(std::tolower(static_cast<unsigned char>(escaped[i]))))
                        : std::string_view::npos;
    return at == std::string_view::npos ? -1 : static_cast<int>(at);
  };
  std::string text;
  for (std::size_t i = 0; i < escaped.size(); ++i) {
    if (escaped[i] != '%' || digit(i + 1) < 0 || digit(i + 2) < 0) {
      text += escaped[i];
      continue;
    }
    if (const int code = digit(i + 1) * 16 + digit(i + 2); code != 0) text += static_cast<char>(code);
    i += 2;
  }
  vm.return_string(text);
}

// crc16(whether case counts for nothing, strings...): CCITT's, as progs.dat has one.
void crc16(Vm& vm) {
  const bool fold = vm.parm_float(0) != 0.0f;
  std::uint32_t crc = 0xffff;
  for (const char c : vm.parm_text_from(1)) {
    const auto byte = static_cast<unsigned char>(c);
    crc ^= static_cast<std::uint32_t>(fold ? std::tolower(byte) : byte) << 8u;
    for (int bit = 0; bit < 8; ++bit) crc = ((crc << 1u) ^ ((crc & 0x8000u) != 0 ? 0x1021u : 0u)) & 0xffffu;
  }
  vm.return_float(static_cast<float>(crc));
}

// strftime(whether it is the time here, or Greenwich's, format...): now, as C's function writes it.
void strftime_now(Vm& vm) {
  const std::string format = vm.parm_text_from(1);
  const std::time_t now = std::time(nullptr);
  const auto parts = calendar_time(now, vm.parm_float(0) != 0.0f ? Zone::kLocal : Zone::kGreenwich);
  char text[1024];
  const std::size_t length = parts ? std::strftime(text, sizeof(text), format.c_str(), &*parts) : 0;
  vm.return_string({text, length});
}

}  // namespace

void add_text_tool_builtins(BuiltinTable& table) {
  table.set_named("strtrim", strtrim);
  table.set(476, "strlennocol", strlennocol);
  table.set(477, "strdecolorize", strdecolorize);
  table.add_extension("DP_QC_STRINGCOLORFUNCTIONS");
  table.set(478, "strftime", strftime_now);
  table.add_extension("DP_QC_STRFTIME");
  table.set(494, "crc16", crc16);
  table.add_extension("DP_QC_CRC16");
  table.set(510, "uri_escape", uri_escape);
  table.set(511, "uri_unescape", uri_unescape);
  table.add_extension("DP_QC_URI_ESCAPE");
}

}  // namespace fb::progs
