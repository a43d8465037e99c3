#include "lab/authored/authored_report.h"

#include <fmt/format.h>

#include <iterator>

namespace fb::lab {
namespace {

constexpr const char* kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>{0}</title><style>
body {{ font: 15px sans-serif; margin: 2em; max-width: 1100px }}
table {{ border-collapse: collapse; margin: 1em 0 }}
td, th {{ padding: 0.2em 0.8em; text-align: right; border-bottom: 1px solid #ccc }}
td:first-child, th:first-child {{ text-align: left }}
img {{ width: 100%; image-rendering: pixelated }}
figure {{ margin: 1em 0 }}
</style></head><body>
<h1>{0}</h1>
<p>Left: as it is drawn. Right: what its author saw, textures in their baked light. Median and spread of log2 luminance over 16 x 9 blocks are in stops, correlation is of log luminance, colour the mean sum of absolute differences of the channels' shares.</p>
)";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string numbers(const AuthoredDistance& d) {
  if (d.black) return "<td colspan=\"4\">black in both pictures</td>";
  return fmt::format("<td>{:+.2f}</td><td>{:.2f}</td><td>{:.2f}</td><td>{:.2f}</td>", d.median, d.spread, d.correlation,
                     d.color);
}

}  // namespace

std::string authored_html(const AuthoredPage& page) {
  std::string out = fmt::format(kHead, escaped(page.title));
  const auto to = std::back_inserter(out);
  for (const std::string& note : page.notes) fmt::format_to(to, "<p>{}</p>\n", escaped(note));
  out += "<table><tr><th>camera</th><th>median</th><th>spread</th><th>correlation</th><th>colour</th></tr>\n";
  for (const AuthoredRow& row : page.rows)
    fmt::format_to(to, "<tr><td>{}</td>{}</tr>\n", escaped(row.camera), numbers(row.distance));
  fmt::format_to(to, "<tr><th>all</th>{}</tr></table>\n", numbers(page.mean));
  for (const AuthoredRow& row : page.rows)
    if (!row.picture.empty())
      fmt::format_to(to, "<figure><img src=\"{}\" alt=\"drawn and authored\"><figcaption>{}</figcaption></figure>\n",
                     escaped(row.picture), escaped(row.camera));
  if (!page.emitters.empty())
    out +=
        "<h2>Emitters</h2><table><tr><th>emitter</th><th>factor, red</th><th>green</th><th>blue</th>"
        "<th>share of the light, %</th></tr>\n";
  for (const AuthoredPage::Emitter& e : page.emitters)
    fmt::format_to(to, "<tr><td>{}</td><td>{:.4f}</td><td>{:.4f}</td><td>{:.4f}</td><td>{:.2f}</td></tr>\n",
                   escaped(e.name), e.factor.x, e.factor.y, e.factor.z, 100.0f * e.share);
  if (!page.emitters.empty()) out += "</table>\n";
  return out + "</body></html>\n";
}

}  // namespace fb::lab
