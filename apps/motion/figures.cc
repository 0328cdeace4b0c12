#include "figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace motion {
namespace {

using arboc::nlp::Contact;
using Eigen::VectorXd;

constexpr int kPictures = 9;          ///< of the stroboscope
constexpr int kFramesPerSecond = 60;  ///< of animations
constexpr int kMostFrames = 600;
constexpr int kLines = 10;          ///< of a plot of torques
constexpr double kNearLimit = 0.8;  ///< of a limit of forces: it is drawn

VectorXd constant(Eigen::Index n, double value) { return VectorXd::Constant(n, value); }

/// The sample closest to an instant; phases have as many samples each, whatever they last.
Eigen::Index at(const Samples& s, double t) {
  const auto after = std::lower_bound(s.t.begin(), s.t.end(), t) - s.t.begin();
  if (after == 0 || after == s.t.size()) return after == 0 ? 0 : after - 1;
  return s.t[after] - t < t - s.t[after - 1] ? after : after - 1;
}

/// Indices of samples for an animation, without repetition.
std::vector<Eigen::Index> frames(const Samples& s) {
  const double duration = s.t[s.t.size() - 1] - s.t[0];
  const int wanted = std::clamp(static_cast<int>(duration * kFramesPerSecond) + 1, 2, kMostFrames);
  const int count = std::min<int>(wanted, static_cast<int>(s.t.size()));
  std::vector<Eigen::Index> out;
  for (int k = 0; k < count; ++k) {
    const Eigen::Index sample = at(s, s.t[0] + duration * k / (count - 1));
    if (out.empty() || sample > out.back()) out.push_back(sample);
  }
  return out;
}

}  // namespace

study::Animation animation(const Task& task, const Model& model, const Result& result) {
  const Samples& s = result.samples;
  const std::vector<Eigen::Index> chosen = frames(s);
  study::Animation out;
  out.name = task.name;
  out.bodies = model.robot.frames;
  out.up = model.up;
  out.placements.resize(static_cast<Eigen::Index>(chosen.size()), s.placements.cols());
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    out.times.push_back(s.t[chosen[k]]);
    out.placements.row(static_cast<Eigen::Index>(k)) = s.placements.row(chosen[k]);
  }
  for (const std::vector<std::string>& limb : model.limbs) out.add_limb(limb);
  const std::vector<Contact>& contacts = task.start.posture.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    study::Force force;
    force.name = contacts[c].name;
    force.at = {out.body(contacts[c].frame), contacts[c].point};
    force.newtons.resize(static_cast<Eigen::Index>(chosen.size()), 3);
    for (std::size_t k = 0; k < chosen.size(); ++k)
      force.newtons.row(static_cast<Eigen::Index>(k)) =
          s.reactions.row(chosen[k]).segment<3>(static_cast<Eigen::Index>(6 * c));
    out.forces.push_back(std::move(force));
  }
  return out;
}

namespace {

/// Coordinates whose torques have limits.
std::vector<std::size_t> limited(const Model& model) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < model.passive.size(); ++i)
    if (!model.passive[i] && std::isfinite(model.robot.tau_upper[i])) out.push_back(i);
  return out;
}

study::Plot torque_plot_of(const Model& model, const Samples& s, const std::string& title,
                           const std::vector<std::size_t>& coordinates) {
  study::Plot plot;
  plot.title = title;
  plot.x_label = "s";
  plot.y_label = "1";
  for (const std::size_t i : coordinates) {
    const double low = model.robot.tau_lower[i], high = model.robot.tau_upper[i];
    const VectorXd tau = s.tau.col(static_cast<Eigen::Index>(i));
    plot.lines.push_back({model.robot.coordinates[i], s.t,
                          tau.unaryExpr([&](double x) { return x < 0 ? -x / low : x / high; })});
  }
  plot.lines.push_back({"limit", s.t, constant(s.t.size(), 1)});
  plot.lines.push_back({"limit", s.t, constant(s.t.size(), -1)});
  return plot;
}

}  // namespace

study::Plot torque_plot(const Model& model, const Result& result) {
  const Samples& s = result.samples;
  const auto peak = [&](std::size_t i) {
    const Eigen::VectorXd tau = s.tau.col(static_cast<Eigen::Index>(i));
    return std::max(tau.maxCoeff() / model.robot.tau_upper[i],
                    tau.minCoeff() / model.robot.tau_lower[i]);
  };
  std::vector<std::size_t> all = limited(model);
  std::stable_sort(all.begin(), all.end(),
                   [&](std::size_t a, std::size_t b) { return peak(a) > peak(b); });
  all.resize(std::min<std::size_t>(all.size(), kLines));
  return torque_plot_of(model, s, "Torques over their limits, the largest", all);
}

std::vector<study::Plot> torque_plots(const Model& model, const Result& result) {
  const std::vector<std::size_t> all = limited(model);
  std::vector<study::Plot> out;
  for (std::size_t k = 0; k < all.size(); k += kLines) {
    const std::vector<std::size_t> some(
        all.begin() + static_cast<std::ptrdiff_t>(k),
        all.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(k + kLines, all.size())));
    out.push_back(torque_plot_of(model, result.samples,
                                 "Torques over their limits, " +
                                     model.robot.coordinates[some.front()] + " to " +
                                     model.robot.coordinates[some.back()],
                                 some));
  }
  return out;
}

study::Plot reaction_plot(const Task& task, const Result& result, std::size_t contact) {
  const Samples& s = result.samples;
  const Contact& of = task.start.posture.contacts[contact];
  study::Plot plot;
  plot.title = "Force on " + of.name;
  plot.x_label = "s";
  plot.y_label = "N";
  const char* names[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i) {
    const VectorXd force = s.reactions.col(static_cast<Eigen::Index>(6 * contact) + i);
    plot.lines.push_back({names[i], s.t, force});
    if (of.own_axes) continue;
    const arboc::nlp::Limits& limits = of.force[static_cast<std::size_t>(i)];
    for (const double limit : {limits.lower, limits.upper})
      if (limit != 0 && std::isfinite(limit) &&
          (force.array() * (limit > 0 ? 1 : -1)).maxCoeff() > kNearLimit * std::fabs(limit))
        plot.lines.push_back(
            {std::string("limit of ") + names[i], s.t, constant(s.t.size(), limit)});
  }
  return plot;
}

study::Plot balance_plot(const Model& model, const Result& result) {
  const Samples& s = result.samples;
  const std::vector<bool> translation = translations(model);
  study::Plot plot;
  plot.title = "Missing forces (N) and moments (N m) of the body as a whole";
  plot.x_label = "s";
  plot.y_label = "N, N m";
  for (std::size_t i = 0; i < model.passive.size(); ++i)
    if (model.passive[i])
      plot.lines.push_back({model.robot.coordinates[i] + (translation[i] ? " (N)" : " (N m)"), s.t,
                            s.tau.col(static_cast<Eigen::Index>(i))});
  return plot;
}

namespace {

/// Skeletons side by side, seen along one axis of the world.
class Stroboscope {
 public:
  Stroboscope(const Model& model, const Samples& samples) : model_(model), s_(samples) {
    low_ = Eigen::Vector3d::Constant(1e9);
    high_ = -low_;
    for (int k = 0; k < kPictures; ++k)
      for (const auto& limb : model.limbs)
        for (const std::string& frame : limb) {
          const Eigen::Vector3d p = place(instant(k), frame);
          low_ = low_.cwiseMin(p);
          high_ = high_.cwiseMax(p);
        }
  }

  std::string run() {
    const int up = model_.up, sideways = up == 1 ? 0 : 1, forward = up == 1 ? 2 : 0;
    width_ = (high_ - low_)[forward] + (high_ - low_)[sideways] + 3 * kGap;
    const double height = (high_ - low_)[up] + 2 * kGap;
    std::string body;
    for (int k = 0; k < kPictures; ++k) {
      body += skeleton(k, forward, kGap - low_[forward], false);
      body += skeleton(k, sideways, 2 * kGap + (high_ - low_)[forward], true);
    }
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.4f} {:.4f}\" width=\"{:.0f}\" "
        "height=\"{:.0f}\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{}</svg>\n",
        width_, height, kPixels * width_, kPixels * height, body);
  }

 private:
  static constexpr double kGap = 0.15, kPixels = 320;  ///< m; a metre

  Eigen::Index instant(int k) const {
    const double begin = s_.t[0], end = s_.t[s_.t.size() - 1];
    return at(s_, begin + (end - begin) * k / (kPictures - 1));
  }
  Eigen::Vector3d place(Eigen::Index k, const std::string& frame) const {
    return s_.placements.row(k).segment<3>(12 * model_.robot.frame(frame) + 9).transpose();
  }
  /// Earlier ones are lighter.  A front view is mirrored, so that left is on the left.
  std::string skeleton(int k, int axis, double offset, bool mirrored) const {
    std::string out = fmt::format(
        "<g fill=\"none\" stroke=\"hsl({:.0f},60%,{:.0f}%)\" stroke-width=\"0.012\" "
        "stroke-linecap=\"round\">\n",
        210 + 150.0 * k / (kPictures - 1), 75 - 40.0 * k / (kPictures - 1));
    for (const auto& limb : model_.limbs) {
      out += "<polyline points=\"";
      for (const std::string& frame : limb) {
        const Eigen::Vector3d p = place(instant(k), frame);
        const double across = mirrored ? high_[axis] - p[axis] : p[axis];
        out +=
            fmt::format("{:.4f},{:.4f} ", across + offset, high_[model_.up] - p[model_.up] + kGap);
      }
      out += "\"/>\n";
    }
    return out + "</g>\n";
  }

  const Model& model_;
  const Samples& s_;
  Eigen::Vector3d low_, high_;
  double width_ = 0;
};

study::PageTable stage_table(const Result& result) {
  study::PageTable table;
  table.caption = "Problems that were solved";
  table.header = {"",   "control points", "variables", "rows", "iterations",
                  "s",  "objective",      "KKT error", "N",    "N m",
                  "mm", "largest torque"};
  for (const Stage& s : result.stages)
    table.rows.push_back({s.name, fmt::format("{}", s.control_points),
                          fmt::format("{}", s.variables), fmt::format("{}", s.rows),
                          fmt::format("{}", s.iterations), fmt::format("{:.2f}", s.seconds),
                          fmt::format("{:.5g}", s.objective), fmt::format("{:.1e}", s.kkt_error),
                          fmt::format("{:.2f}", s.audit.force.value),
                          fmt::format("{:.2f}", s.audit.moment.value),
                          fmt::format("{:.3f}", 1e3 * s.audit.drift.value),
                          fmt::format("{:.3f}", s.audit.largest_normalised)});
  return table;
}

study::PageTable measure_table(const Result& result) {
  study::PageTable table;
  table.caption = "Means over time, and the largest torque over its limit";
  table.header = {"measure", "value"};
  for (const auto& [name, value] : result.measures)
    table.rows.push_back({name, fmt::format("{:.6g}", value)});
  return table;
}

}  // namespace

std::string stroboscope(const Model& model, const Result& result) {
  return Stroboscope(model, result.samples).run();
}

study::Page page(const Task& task, const Model& model, const Result& result,
                 const study::Animation& moving) {
  study::Page page;
  page.title = task.name;
  page.paragraphs = {
      fmt::format(
          "{}: {}. {:.2f} s of computation, of these {:.2f} s for the postures at the ends.",
          text(result.status), result.reason, result.seconds, result.posture_seconds),
      fmt::format("Between frames, at {} instants: {:.2f} N and {:.2f} N m that nothing gives, "
                  "contacts {:.3f} mm off, torques {:.2f} % beyond their limits.",
                  result.audit.instants, result.audit.force.value, result.audit.moment.value,
                  1e3 * result.audit.drift.value, 1e2 * result.audit.torque_excess.value)};
  page.tables = {stage_table(result), measure_table(result)};
  page.plots = torque_plots(model, result);
  for (std::size_t c = 0; c < task.start.posture.contacts.size(); ++c)
    page.plots.push_back(reaction_plot(task, result, c));
  page.plots.push_back(balance_plot(model, result));
  page.animation = &moving;
  return page;
}

}  // namespace motion
