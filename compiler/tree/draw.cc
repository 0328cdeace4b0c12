// draw_svg(): the tree from left to right, leaves one below the other.
#include <fmt/format.h>

#include <algorithm>

#include "base/diagnostic.h"
#include "tree/numbering.h"

namespace arboc {
namespace {

constexpr double kColumn = 150, kRow = 34, kBoxWidth = 92, kBoxHeight = 24, kMargin = 40,
                 kRadius = 11;

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : printable(text)) {
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

/// The first characters of a text that is too long for its box.
std::string shortened(const std::string& text) {
  constexpr size_t kCharacters = 14;
  size_t count = 0, last = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xC0) == 0x80) continue;  // inside a character
    if (++count == kCharacters) last = i;
  }
  return count > kCharacters ? text.substr(0, last) + "\xE2\x80\xA6" : text;
}

struct Spot {
  double x = 0, y = 0;
};

/// Leaves in rows of their own, a link half way between its outer branches.
std::vector<Spot> layout(const std::vector<NumberedLink>& links, Spot& base, int& rows) {
  std::vector<Spot> spots(links.size());
  rows = 0;
  for (size_t i = 0; i < links.size(); ++i) {
    const int parent = links[i].parent;
    spots[i].x = parent < 0 ? kMargin + kColumn : spots[static_cast<size_t>(parent)].x + kColumn;
    if (links[i].branches.empty()) spots[i].y = kMargin + 30 + kRow * rows++;
  }
  double first = 0, last = 0;
  bool any = false;
  for (size_t i = links.size(); i-- > 0;) {
    if (!links[i].branches.empty())
      spots[i].y = (spots[static_cast<size_t>(links[i].branches.front())].y +
                    spots[static_cast<size_t>(links[i].branches.back())].y) /
                   2;
    if (links[i].parent >= 0) continue;
    first = spots[i].y;
    if (!any) last = spots[i].y;
    any = true;
  }
  base = {kMargin, (first + last) / 2};
  return spots;
}

std::string box(const Spot& at, const std::string& text, const std::string& title, bool dashed) {
  return fmt::format(
      "<g><title>{}</title><rect x=\"{:g}\" y=\"{:g}\" width=\"{:g}\" height=\"{:g}\" rx=\"4\" "
      "fill=\"{}\" stroke=\"#333\"{}/><text x=\"{:g}\" y=\"{:g}\">{}</text></g>\n",
      title, at.x, at.y - kBoxHeight / 2, kBoxWidth, kBoxHeight, dashed ? "#fff" : "#dce9f7",
      dashed ? " stroke-dasharray=\"4 3\"" : "", at.x + kBoxWidth / 2, at.y + 4, text);
}

}  // namespace

std::string draw_svg(const std::string& title, const std::vector<NumberedLink>& links) {
  Spot base;
  int rows = 0;
  const std::vector<Spot> spots = layout(links, base, rows);
  double width = base.x + kBoxWidth, height = 2 * kMargin + 30 + kRow * rows;
  for (const Spot& s : spots) width = std::max(width, s.x + kBoxWidth);
  std::string lines, boxes = box(base, "null link", "the base", true);
  for (size_t i = 0; i < links.size(); ++i) {
    const NumberedLink& link = links[i];
    const Spot from = link.parent < 0 ? base : spots[static_cast<size_t>(link.parent)];
    const Spot joint{(from.x + kBoxWidth + spots[i].x) / 2, spots[i].y};
    lines += fmt::format(
        "<path d=\"M {:g} {:g} L {:g} {:g} L {:g} {:g}\" fill=\"none\" stroke=\"#333\"/>\n",
        from.x + kBoxWidth, from.y, joint.x, joint.y, spots[i].x, spots[i].y);
    boxes += fmt::format(
        "<g><title>{} ({})</title><circle cx=\"{:g}\" cy=\"{:g}\" r=\"{:g}\" fill=\"#f7e3c4\" "
        "stroke=\"#333\"/><text x=\"{:g}\" y=\"{:g}\">J{}</text></g>\n",
        escaped(link.joint), link.type, joint.x, joint.y, kRadius, joint.x, joint.y + 4, i);
    const std::string text = shortened(printable(fmt::format("L{} {}", i, link.link)));
    boxes += box(spots[i], escaped(text),
                 link.dummy ? escaped(link.link) + ", dummy link"
                            : fmt::format("{}, {:.6g} kg", escaped(link.link), link.mass),
                 link.dummy);
  }
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}\" height=\"{1:g}\" "
      "viewBox=\"0 0 {0:g} {1:g}\" font-family=\"sans-serif\" font-size=\"11\" "
      "text-anchor=\"middle\">\n<rect width=\"{0:g}\" height=\"{1:g}\" fill=\"#fff\"/>\n"
      "<text x=\"{2:g}\" y=\"24\" font-size=\"15\" "
      "text-anchor=\"start\">{3}</text>\n{4}{5}</svg>\n",
      width + kMargin, height, kMargin, escaped(title), lines, boxes);
}

}  // namespace arboc
