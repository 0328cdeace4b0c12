#include "recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace study {
namespace {

/// Lines of a file, with complaints that say where.
class Lines {
 public:
  explicit Lines(const std::string& path) : path_(path), in_(path) {
    if (!in_) fail("cannot be read");
  }
  bool next() {
    if (!std::getline(in_, text_)) return false;
    if (!text_.empty() && text_.back() == '\r') text_.pop_back();
    ++number_;
    return true;
  }
  void need() {
    if (!next()) fail("ends too early");
  }
  const std::string& text() const { return text_; }
  [[noreturn]] void fail(const std::string& message) const {
    throw std::invalid_argument(
        fmt::format("{}{}: {}", path_, number_ > 0 ? fmt::format(":{}", number_) : "", message));
  }
  /// By blanks and tabs, or each separator by itself.
  std::vector<std::string> words() const {
    std::istringstream in(text_);
    std::vector<std::string> out;
    for (std::string word; in >> word;) out.push_back(word);
    return out;
  }
  std::vector<std::string> cells(char separator) const {
    std::vector<std::string> out;
    std::string cell;
    for (std::istringstream in(text_); std::getline(in, cell, separator);) {
      const auto first = cell.find_first_not_of(" \""), last = cell.find_last_not_of(" \"");
      out.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
    }
    return out;
  }
  double number(const std::string& word) const {
    std::size_t used = 0;
    double x = 0;
    try {
      x = std::stod(word, &used);
    } catch (const std::exception&) {
      fail("'" + word + "' is not a number");
    }
    if (used != word.size()) fail("'" + word + "' is not a number");
    return x;
  }

 private:
  std::string path_, text_;
  std::ifstream in_;
  int number_ = 0;
};

/// Rows that follow; `skip` leading cells before time.
void read_rows(Lines& lines, std::size_t skip, char separator, Recording& out) {
  const std::size_t width = out.columns.size() + 1;
  std::vector<double> all;
  while (lines.next()) {
    std::vector<std::string> cells = separator == ' ' ? lines.words() : lines.cells(separator);
    if (cells.empty()) continue;
    if (separator == '\t' && cells.size() > skip + 1)
      cells.resize(std::max(cells.size(), skip + width));  // the last markers were not seen
    if (cells.size() < skip + width) lines.fail("fewer numbers than columns");
    for (std::size_t k = 0; k < width; ++k)
      // A marker that was not seen.
      all.push_back(cells[skip + k].empty() ? std::nan("") : lines.number(cells[skip + k]));
    const std::size_t n = all.size() / width;
    if (n > 1 && !(all[(n - 1) * width] > all[(n - 2) * width])) lines.fail("time does not rise");
  }
  const auto rows = static_cast<Eigen::Index>(all.size() / width);
  if (rows == 0) lines.fail("has no numbers");
  const Eigen::Map<const Rows> table(all.data(), rows, static_cast<Eigen::Index>(width));
  out.times = table.col(0);
  out.values = table.rightCols(static_cast<Eigen::Index>(width) - 1);
}

Recording read_opensim(Lines& lines) {
  Recording out;
  lines.need();
  out.name = lines.text();
  for (;;) {
    lines.need();
    const std::string text = lines.text();
    if (text.rfind("inDegrees", 0) == 0) out.degrees = text.find("yes") != std::string::npos;
    if (text.rfind("endheader", 0) == 0) break;
  }
  lines.need();
  out.columns = lines.words();
  if (out.columns.empty()) lines.fail("has no columns");
  out.columns.erase(out.columns.begin());
  read_rows(lines, 0, ' ', out);
  return out;
}

Recording read_trc(Lines& lines) {
  Recording out;
  for (int k = 0; k < 3; ++k) lines.need();
  const std::vector<std::string> heads = lines.words();
  const double unit = std::find(heads.begin(), heads.end(), "mm") != heads.end() ? 1e-3 : 1;
  lines.need();
  const std::vector<std::string> names = lines.words();
  if (names.size() < 3 || names[1] != "Time") lines.fail("is not the line of markers");
  for (std::size_t k = 2; k < names.size(); ++k)
    for (const char* axis : {" x", " y", " z"}) out.columns.push_back(names[k] + axis);
  lines.need();
  read_rows(lines, 1, '\t', out);
  out.values *= unit;
  return out;
}

Recording read_csv(Lines& lines) {
  Recording out;
  lines.need();
  out.columns = lines.cells(',');
  if (out.columns.size() < 2) lines.fail("has no columns beside time");
  out.columns.erase(out.columns.begin());
  read_rows(lines, 0, ',', out);
  return out;
}

/// The column at time t, linear between instants.
double interpolated(const Recording& r, Eigen::Index column, double t) {
  const auto begin = r.times.data(), end = begin + r.times.size();
  const auto after = std::clamp<Eigen::Index>(std::upper_bound(begin, end, t) - begin, 1,
                                              std::max<Eigen::Index>(r.times.size() - 1, 1));
  if (r.times.size() == 1) return r.values(0, column);
  const double u = (t - r.times[after - 1]) / (r.times[after] - r.times[after - 1]);
  return (1 - u) * r.values(after - 1, column) + u * r.values(after, column);
}

Difference difference(const Recording& predicted, Eigen::Index p, const Recording& measured,
                      Eigen::Index m) {
  const double slack = 1e-9, from = predicted.times[0] - slack;
  const double to = predicted.times[predicted.times.size() - 1] + slack;
  Difference out;
  double sx = 0, sy = 0, sxx = 0, syy = 0, sxy = 0;
  for (Eigen::Index k = 0; k < measured.times.size(); ++k) {
    const double t = measured.times[k], y = measured.values(k, m);
    if (t < from || t > to || std::isnan(y)) continue;
    const double x = interpolated(predicted, p, t);
    ++out.instants;
    out.rmse += (x - y) * (x - y);
    if (std::fabs(x - y) > out.largest) out.largest = std::fabs(x - y), out.at = t;
    sx += x;
    sy += y;
    sxx += x * x;
    syy += y * y;
    sxy += x * y;
  }
  const double n = out.instants;
  if (out.instants == 0) return out;
  out.rmse = std::sqrt(out.rmse / n);
  const double vx = sxx - sx * sx / n, vy = syy - sy * sy / n;
  if (vx > 1e-12 * sxx && vy > 1e-12 * syy)
    out.correlation = (sxy - sx * sy / n) / std::sqrt(vx * vy);
  return out;
}

}  // namespace

Recording read_recording(const std::string& path) {
  Lines lines(path);
  const std::string end = std::filesystem::path(path).extension().string();
  if (end == ".mot" || end == ".sto") return read_opensim(lines);
  if (end == ".trc") return read_trc(lines);
  if (end == ".csv") return read_csv(lines);
  lines.fail("is none of .mot, .sto, .trc, .csv");
}

std::string opensim_text(const Recording& r) {
  std::string out =
      fmt::format("{}\nversion=1\nnRows={}\nnColumns={}\ninDegrees={}\nendheader\ntime", r.name,
                  r.values.rows(), r.values.cols() + 1, r.degrees ? "yes" : "no");
  for (std::string name : r.columns) {
    std::replace(name.begin(), name.end(), ' ', '_');
    out += '\t' + name;
  }
  out += '\n';
  for (Eigen::Index k = 0; k < r.values.rows(); ++k) {
    out += fmt::format("{:.17g}", r.times[k]);
    for (Eigen::Index i = 0; i < r.values.cols(); ++i)
      out += fmt::format("\t{:.17g}", r.values(k, i));
    out += '\n';
  }
  return out;
}

std::string trc_text(const Recording& r) {
  const auto frames = r.values.rows(), markers = r.values.cols() / 3;
  const double span = r.times[frames - 1] - r.times[0];
  const double rate = frames > 1 ? static_cast<double>(frames - 1) / span : 1;
  std::string out = fmt::format(
      "PathFileType\t4\t(X/Y/Z)\t{0}\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\t"
      "OrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n{1:.6g}\t{1:.6g}\t{2}\t{3}\tmm\t{1:.6g}"
      "\t1\t"
      "{2}\nFrame#\tTime",
      r.name, rate, frames, markers);
  for (Eigen::Index m = 0; m < markers; ++m) {
    const std::string& column = r.columns[static_cast<std::size_t>(3 * m)];
    out += '\t' + column.substr(0, column.size() - 2) + "\t\t";
  }
  out += "\n\t";
  for (Eigen::Index m = 1; m <= markers; ++m) out += fmt::format("\tX{0}\tY{0}\tZ{0}", m);
  out += "\n";
  for (Eigen::Index k = 0; k < frames; ++k) {
    out += fmt::format("{}\t{:.17g}", k + 1, r.times[k]);
    for (Eigen::Index i = 0; i < 3 * markers; ++i)
      out += fmt::format("\t{:.12g}", 1e3 * r.values(k, i));
    out += '\n';
  }
  return out;
}

std::vector<Difference> compare(const Recording& predicted, const Recording& measured,
                                const std::string& prefix) {
  std::vector<Difference> out;
  for (std::size_t m = 0; m < measured.columns.size(); ++m) {
    const auto at =
        std::find(predicted.columns.begin(), predicted.columns.end(), measured.columns[m]);
    if (at == predicted.columns.end() || !at->starts_with(prefix)) continue;
    Difference d = difference(predicted, at - predicted.columns.begin(), measured,
                              static_cast<Eigen::Index>(m));
    d.column = measured.columns[m];
    if (d.instants > 0) out.push_back(std::move(d));
  }
  if (out.empty()) throw std::invalid_argument("the recordings have no column and time in common");
  return out;
}

std::string comparison_csv(const std::vector<Difference>& differences) {
  std::string out = "column,instants,rmse,largest,time,correlation\n";
  for (const Difference& d : differences)
    out += fmt::format("{},{},{:.17g},{:.17g},{:.17g},{:.17g}\n", d.column, d.instants, d.rmse,
                       d.largest, d.at, d.correlation);
  return out;
}

}  // namespace study
