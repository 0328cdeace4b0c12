#include "plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <arboc/page/page.hpp>
#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace study {
namespace {

constexpr std::array<const char*, 10> kColours = {"#1f77b4", "#d62728", "#2ca02c", "#9467bd",
                                                  "#ff7f0e", "#17becf", "#8c564b", "#e377c2",
                                                  "#7f7f7f", "#bcbd22"};
constexpr double kLeft = 64, kRight = 150, kTop = 28, kBottom = 42;
constexpr Eigen::Index kMostPoints = 1500;

struct Range {
  double low = HUGE_VAL, high = -HUGE_VAL;
  void include(double x) {
    if (!std::isfinite(x)) return;
    low = std::min(low, x);
    high = std::max(high, x);
  }
  /// Never empty.
  void settle() {
    if (!(low <= high)) low = 0, high = 1;
    if (low == high) low -= 0.5 + std::fabs(low) / 10, high += 0.5 + std::fabs(high) / 10;
  }
};

class Paper {
 public:
  explicit Paper(const Plot& plot) : plot_(plot) {
    for (const Line& line : plot.lines) {
      if (line.x.size() != line.y.size())
        throw std::invalid_argument("plot: line '" + line.name + "' has other x than y");
      for (const double x : line.x) x_.include(x);
      for (const double y : line.y) y_.include(value(y));
    }
    x_.settle();
    y_.settle();
    if (!plot.log_y) {
      const double margin = 0.04 * (y_.high - y_.low);
      y_.low -= margin;
      y_.high += margin;
    }
  }

  std::string draw() const {
    std::string out = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
        "{1}\" font-family=\"sans-serif\" font-size=\"11\">\n<text x=\"{2}\" y=\"16\" "
        "font-size=\"13\" font-weight=\"bold\">{3}</text>\n",
        plot_.width, plot_.height, kLeft, arboc::page::html(plot_.title));
    out += axes();
    for (const double mark : plot_.marks)
      if (mark >= x_.low && mark <= x_.high) out += vertical(mark, "#bbb\" stroke-dasharray=\"3 3");
    for (std::size_t k = 0; k < plot_.lines.size(); ++k) out += line(k);
    out += fmt::format(
        "<line class=\"now\" data-t0=\"{:.9g}\" data-t1=\"{:.9g}\" data-x0=\"{:.2f}\" "
        "data-x1=\"{:.2f}\" x1=\"{:.2f}\" x2=\"{:.2f}\" y1=\"{}\" y2=\"{:.2f}\" "
        "stroke=\"#000\" visibility=\"hidden\"/>\n",
        x_.low, x_.high, kLeft, right(), kLeft, kLeft, kTop, bottom());
    return out + "</svg>\n";
  }

 private:
  double right() const { return plot_.width - kRight; }
  double bottom() const { return plot_.height - kBottom; }
  double value(double y) const {
    if (!plot_.log_y) return y;
    return y > 0 ? std::log10(y) : std::nan("");
  }
  double across(double x) const {
    return kLeft + (x - x_.low) / (x_.high - x_.low) * (right() - kLeft);
  }
  double down(double y) const {
    return bottom() - (y - y_.low) / (y_.high - y_.low) * (bottom() - kTop);
  }
  std::string vertical(double x, const char* stroke) const {
    return fmt::format(
        "<line x1=\"{0:.2f}\" x2=\"{0:.2f}\" y1=\"{1}\" y2=\"{2:.2f}\" stroke=\"{3}\"/>\n",
        across(x), kTop, bottom(), stroke);
  }

  std::string axes() const {
    std::string out;
    for (const double x : ticks(x_.low, x_.high, 8))
      out += vertical(x, "#eee") +
             fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\">{:.6g}</text>\n",
                         across(x), bottom() + 14, x);
    for (const double y : ticks(y_.low, y_.high, 6)) {
      if (plot_.log_y && y != std::floor(y)) continue;
      out += fmt::format(
          "<line x1=\"{0}\" x2=\"{1:.2f}\" y1=\"{2:.2f}\" y2=\"{2:.2f}\" stroke=\"#eee\"/>\n"
          "<text x=\"{3}\" y=\"{4:.2f}\" text-anchor=\"end\">{5}</text>\n",
          kLeft, right(), down(y), kLeft - 6, down(y) + 4,
          plot_.log_y ? fmt::format("1e{:.0f}", y) : fmt::format("{:.6g}", y));
    }
    return out + fmt::format(
                     "<rect x=\"{0}\" y=\"{1}\" width=\"{2:.2f}\" height=\"{3:.2f}\" "
                     "fill=\"none\" stroke=\"#888\"/>\n<text x=\"{4:.2f}\" y=\"{5}\" "
                     "text-anchor=\"middle\">{6}</text>\n<text transform=\"translate(14 {7:.2f}) "
                     "rotate(-90)\" text-anchor=\"middle\">{8}</text>\n",
                     kLeft, kTop, right() - kLeft, bottom() - kTop, (kLeft + right()) / 2,
                     plot_.height - 8, arboc::page::html(plot_.x_label), (kTop + bottom()) / 2,
                     arboc::page::html(plot_.y_label));
  }

  /// Of each bucket of points the first, the lowest and the highest.
  std::vector<Eigen::Index> chosen(const Line& line) const {
    const Eigen::Index n = line.x.size(), bucket = std::max<Eigen::Index>(1, 3 * n / kMostPoints);
    std::vector<Eigen::Index> out;
    for (Eigen::Index begin = 0; begin < n; begin += bucket) {
      Eigen::Index low = begin, high = begin;
      for (Eigen::Index k = begin; k < std::min(n, begin + bucket); ++k) {
        if (line.y[k] < line.y[low]) low = k;
        if (line.y[k] > line.y[high]) high = k;
      }
      for (const Eigen::Index k : {begin, std::min(low, high), std::max(low, high)})
        if (out.empty() || out.back() < k) out.push_back(k);
    }
    if (n > 0 && out.back() != n - 1) out.push_back(n - 1);
    return out;
  }

  std::string line(std::size_t k) const {
    const Line& l = plot_.lines[k];
    const char* colour = kColours[k % kColours.size()];
    std::string path;
    bool pen_down = false;
    for (const Eigen::Index i : chosen(l)) {
      const double y = value(l.y[i]);
      if (!std::isfinite(y) || !std::isfinite(l.x[i])) {
        pen_down = false;
        continue;
      }
      fmt::format_to(std::back_inserter(path), "{}{:.2f} {:.2f}", pen_down ? "L" : "M",
                     across(l.x[i]), down(y));
      pen_down = true;
    }
    const double y = kTop + 8 + 14 * static_cast<double>(k);
    return fmt::format(
        "<path class=\"curve\" d=\"{0}\" fill=\"none\" stroke=\"{1}\" stroke-width=\"1.5\"/>\n"
        "<line x1=\"{2:.1f}\" x2=\"{3:.1f}\" y1=\"{4:.1f}\" y2=\"{4:.1f}\" stroke=\"{1}\" "
        "stroke-width=\"3\"/><text x=\"{5:.1f}\" y=\"{6:.1f}\">{7}</text>\n",
        path, colour, right() + 8, right() + 24, y, right() + 28, y + 4, arboc::page::html(l.name));
  }

  const Plot& plot_;
  Range x_, y_;
};

}  // namespace

std::vector<double> ticks(double low, double high, int most) {
  if (!(high > low) || !std::isfinite(high - low)) return {low};
  const double rough = (high - low) / most, power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * power >= rough * (1 - 1e-9)) step = factor * power;
  std::vector<double> out;
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
    out.push_back(k * step + 0.0);
  return out;
}

std::string svg(const Plot& plot) { return Paper(plot).draw(); }

}  // namespace study
