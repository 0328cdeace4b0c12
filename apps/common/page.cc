#include "page.h"

#include <fmt/format.h>

#include <arboc/page/page.hpp>
#include <cmath>
#include <iterator>

namespace study {
namespace {

constexpr const char* kStyle =
    "body{font:14px sans-serif;margin:2em;max-width:1000px}table{border-collapse:collapse;"
    "margin:1em 0}caption{text-align:left;font-weight:bold}td,th{border:1px solid #ccc;padding:2px "
    "8px;text-align:right}td:first-child,th:first-child{text-align:left}canvas{border:1px solid "
    "#ccc;touch-action:none}#player input[type=range]{width:480px;vertical-align:middle}";

std::string table(const PageTable& t) {
  std::string out = "<table><caption>" + arboc::page::html(t.caption) + "</caption>\n<tr>";
  for (const std::string& cell : t.header) out += "<th>" + arboc::page::html(cell) + "</th>";
  out += "</tr>\n";
  for (const auto& row : t.rows) {
    out += "<tr>";
    for (const std::string& cell : row) out += "<td>" + arboc::page::html(cell) + "</td>";
    out += "</tr>\n";
  }
  return out + "</table>\n";
}

/// Ends in tenths of a millimetre: whole numbers are short and finer than a screen.
void append(const Rows& ends, std::string& out) {
  for (Eigen::Index k = 0; k < ends.size(); ++k)
    fmt::format_to(std::back_inserter(out), "{}{}", k ? "," : "",
                   std::lround(1e4 * ends.data()[k]));
}

std::string player(const Animation& a) {
  std::string data = "{\"up\":" + std::to_string(a.up) + ",\"times\":[";
  for (std::size_t k = 0; k < a.times.size(); ++k)
    fmt::format_to(std::back_inserter(data), "{}{:.9g}", k ? "," : "", a.times[k]);
  data += "],\"segments\":[";
  const char* separator = "";
  for (const Segment& s : segments(a)) {
    fmt::format_to(std::back_inserter(data), "{}{{\"kind\":{},\"radius\":{:.4g},\"ends\":[",
                   separator, static_cast<int>(s.kind), s.radius);
    append(s.ends, data);
    data += "]}";
    separator = ",";
  }
  return "<div id=\"player\"><canvas width=\"900\" height=\"560\"></canvas><br>\n"
         "<button>pause</button> <input type=\"range\" min=\"0\" max=\"1\" step=\"any\" "
         "value=\"0\">\n<select><option value=\"0.25\">1/4</option><option value=\"1\" selected>"
         "real time</option><option value=\"4\">4 x</option></select> <span></span><br>\n"
         "<small>drag: turn, wheel: nearer</small></div>\n<script>\n" +
         std::string(player_script()) + "play(" + data + "]});\n</script>\n";
}

}  // namespace

std::string html(const Page& page) {
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html><head><meta charset=\"utf-8\"><title>{0}</title><style>{1}</style>"
      "</head><body>\n<h1>{0}</h1>\n",
      arboc::page::html(page.title), kStyle);
  for (const std::string& text : page.paragraphs) out += "<p>" + arboc::page::html(text) + "</p>\n";
  if (page.animation) out += player(*page.animation);
  for (const PageTable& t : page.tables) out += table(t);
  for (const Plot& p : page.plots) out += "<figure>" + svg(p) + "</figure>\n";
  return out + "</body></html>\n";
}

}  // namespace study
