// One page without scripts or other files: three drawings, a bar chart, tables.
#include <fmt/format.h>

#include <algorithm>
#include <arboc/page/page.hpp>
#include <cmath>

#include "write.h"

namespace posture {
namespace {

constexpr double kWidth = 320, kHeight = 420;  ///< of a drawing, px
constexpr double kMetrePerNewton = 1e-3;       ///< of arrows

/// Two axes of the world on paper: right and up.
struct View {
  const char* name;
  int right, up;
};

/// Frames of the model where they are, and what is drawn between them.
class Drawing {
 public:
  Drawing(const Task& task, const Model& model, const Result& result)
      : task_(task), model_(model), result_(result), at_(12 * model.robot.frames.size()) {
    model.robot.placements->values(1, result.q.data(), at_.data());
    for (std::size_t k = 0; k < model.robot.frames.size(); ++k)
      include(origin(static_cast<int>(k)));
    for (std::size_t c = 0; c < result.reactions.size(); ++c) include(arrow(c)[1]);
    for (const Target& t : task.targets)
      if (t.place.kind == arboc::nlp::Place::Kind::kPoint) include(t.place.at);
  }

  std::string svg(const View& view) const {
    const double scale = 0.9 * std::min(kWidth / span(view.right), kHeight / span(view.up));
    const auto x = [&](const Vector3& p) {
      return kWidth / 2 + scale * (p[view.right] - middle(view.right));
    };
    const auto y = [&](const Vector3& p) {
      return kHeight / 2 - scale * (p[view.up] - middle(view.up));
    };
    std::string out = fmt::format(
        "<figure><svg width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n", kWidth, kHeight);
    for (const auto& limb : model_.limbs) {
      out += "<polyline class=\"bone\" points=\"";
      for (const std::string& frame : limb) {
        const Vector3 p = origin(model_.robot.frame(frame));
        out += fmt::format("{:.1f},{:.1f} ", x(p), y(p));
      }
      out += "\"/>\n";
    }
    for (const Target& t : task_.targets) {
      if (t.place.kind != arboc::nlp::Place::Kind::kPoint) continue;
      out += fmt::format("<circle class=\"target\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"6\"/>\n",
                         x(t.place.at), y(t.place.at));
    }
    for (std::size_t c = 0; c < result_.reactions.size(); ++c) {
      const auto [from, to] = arrow(c);
      out += fmt::format(
          "<line class=\"force\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" "
          "marker-end=\"url(#head)\"/>\n",
          x(from), y(from), x(to), y(to));
    }
    return out + fmt::format("</svg><figcaption>{}</figcaption></figure>\n", view.name);
  }

 private:
  Vector3 origin(int frame) const { return Vector3(at_.data() + 12 * frame + 9); }
  /// From the point of a contact along the force on the body.
  std::array<Vector3, 2> arrow(std::size_t c) const {
    const arboc::nlp::Contact& contact = task_.contacts[c];
    const arboc::nlp::Placement at(at_.data() + 12 * model_.robot.frame(contact.frame));
    const Vector3 p = at(contact.point);
    return {p, p + kMetrePerNewton * Vector3(result_.reactions[c].data())};
  }
  void include(const Vector3& p) {
    low_ = low_.cwiseMin(p);
    high_ = high_.cwiseMax(p);
  }
  double span(int axis) const { return std::max(high_[axis] - low_[axis], 0.1); }
  double middle(int axis) const { return (high_[axis] + low_[axis]) / 2; }

  const Task& task_;
  const Model& model_;
  const Result& result_;
  std::vector<double> at_;
  Vector3 low_ = Vector3::Constant(1e9), high_ = Vector3::Constant(-1e9);
};

/// Torques from the middle line towards their limits.
std::string bars(const Model& model, const Result& result) {
  constexpr double kRow = 14, kHalf = 180, kLabel = 110;
  std::string rows;
  int n = 0;
  for (std::size_t i = 0; i < result.tau.size(); ++i) {
    if (model.passive[i] || !std::isfinite(model.robot.tau_upper[i])) continue;
    const double tau = result.tau[i];
    const double part = tau / (tau < 0 ? -model.robot.tau_lower[i] : model.robot.tau_upper[i]);
    const double y = kRow * n++, width = kHalf * std::min(std::fabs(part), 1.1);
    rows += fmt::format(
        "<text x=\"0\" y=\"{:.0f}\">{}</text><rect class=\"bar\" x=\"{:.1f}\" y=\"{:.0f}\" "
        "width=\"{:.1f}\" height=\"10\"/><text x=\"{:.0f}\" y=\"{:.0f}\">{:.1f} N m</text>\n",
        y + 10, arboc::page::html(model.robot.coordinates[i]),
        kLabel + kHalf - (part < 0 ? width : 0), y + 1, width, kLabel + 2 * kHalf + 10, y + 10,
        tau);
  }
  const double height = kRow * n;
  return fmt::format(
      "<h2>Torques against their limits</h2>\n<svg width=\"{0}\" height=\"{1}\">\n"
      "<line class=\"axis\" x1=\"{2}\" x2=\"{2}\" y1=\"0\" y2=\"{1}\"/><line class=\"limit\" "
      "x1=\"{3}\" x2=\"{3}\" y1=\"0\" y2=\"{1}\"/><line class=\"limit\" x1=\"{4}\" x2=\"{4}\" "
      "y1=\"0\" y2=\"{1}\"/>\n{5}</svg>\n",
      kLabel + 2 * kHalf + 90, height, kLabel + kHalf, kLabel, kLabel + 2 * kHalf, rows);
}

std::string summary(const Task& task, const Result& result) {
  std::string out = fmt::format(
      "<h1>{}</h1>\n<p><b>{}</b>: {}. Objective {:.6g}, largest normalised torque {:.3f}, KKT "
      "error {:.1e}, largest violation {:.1e}; {} iterations, {} starts in {:.3f} s.</p>\n",
      arboc::page::html(task.name), text(result.status), arboc::page::html(result.reason),
      result.objective, result.max_normalised_torque, result.kkt_error, result.max_violation,
      result.iterations, result.starts.size(), result.seconds);
  out +=
      "<table><tr><th>contact</th><th>Fx</th><th>Fy</th><th>Fz</th><th>Mx</th><th>My</th>"
      "<th>Mz</th></tr>\n";
  for (std::size_t c = 0; c < result.reactions.size(); ++c) {
    out += "<tr><td>" + arboc::page::html(task.contacts[c].name) + "</td>";
    for (const double x : result.reactions[c]) out += fmt::format("<td>{:.1f}</td>", x);
    out += "</tr>\n";
  }
  out +=
      "</table>\n<h2>Constraints</h2>\n<table><tr><th>group</th><th>largest "
      "violation</th></tr>\n";
  for (const auto& v : result.violations)
    out += fmt::format("<tr><td>{}</td><td>{:.1e} {}</td></tr>\n", arboc::page::html(v.name),
                       v.largest, arboc::page::html(v.unit));
  out += "</table>\n<h2>At their limits</h2>\n<p>";
  for (const std::string& name : result.active) out += arboc::page::html(name) + "<br>";
  return out + "</p>\n";
}

}  // namespace

std::string page(const Task& task, const Model& model, const Result& result) {
  // Left, up and forward of the world.
  const int up = model.up, left = up == 1 ? 0 : 1, forward = up == 1 ? 2 : 0;
  const Drawing drawing(task, model, result);
  std::string out =
      "<!DOCTYPE html>\n<html><head><meta charset=\"utf-8\"><title>" +
      arboc::page::html(task.name) +
      "</title><style>body{font:14px sans-serif;margin:2em}figure{display:inline-block;margin:0 "
      "1em}"
      "table{border-collapse:collapse}td,th{border:1px solid #ccc;padding:2px 8px;text-align:right}"
      "td:first-child{text-align:left}.bone{fill:none;stroke:#345;stroke-width:5;"
      "stroke-linejoin:round;stroke-linecap:round}.force{stroke:#c30;stroke-width:2}"
      ".target{fill:none;stroke:#090;stroke-width:2}.bar{fill:#69c}.axis{stroke:#000}"
      ".limit{stroke:#c30}svg text{font-size:10px}</style></head><body>\n"
      "<svg width=\"0\" height=\"0\"><defs><marker id=\"head\" orient=\"auto\" markerWidth=\"6\" "
      "markerHeight=\"6\" refX=\"5\" refY=\"3\"><path d=\"M0,0 L6,3 L0,6 z\" fill=\"#c30\"/>"
      "</marker></defs></svg>\n";
  out += summary(task, result);
  out += "<h2>Posture</h2>\n";
  for (const View& view : {View{"from the front", left, up}, View{"from the right", forward, up},
                           View{"from above", left, forward}})
    out += drawing.svg(view);
  return out + bars(model, result) + "</body></html>\n";
}

}  // namespace posture
