#include "expenditure.h"

#include <fmt/format.h>

#include <arboc/measures/energy.hpp>
#include <cmath>

namespace study {

Effort::Effort(std::size_t frames, std::size_t joints) : times(frames) {
  const auto n = static_cast<Eigen::Index>(frames), m = static_cast<Eigen::Index>(joints);
  for (Rows* x : {&torques, &rates, &segment_rates, &accelerations}) x->setZero(n, m);
  energies.setZero(n);
}

Eigen::VectorXd Effort::time_column() const {
  return Eigen::Map<const Eigen::VectorXd>(times.data(), static_cast<Eigen::Index>(times.size()));
}

Eigen::VectorXd weighted_torques(const Effort& e) {
  Eigen::VectorXd out(e.torques.rows());
  for (Eigen::Index k = 0; k < out.size(); ++k) {
    out[k] = 0;
    for (Eigen::Index j = 0; j < e.torques.cols(); ++j)
      out[k] += arboc::joint_effort(e.torques(k, j), e.rates(k, j));
  }
  return out;
}

std::map<std::string, double> expenditure(const Effort& e) {
  const Eigen::VectorXd weighted = weighted_torques(e);
  double effort = 0, power = 0, transfer = 0, jerk = 0;
  for (Eigen::Index k = 0; k < weighted.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double before = i > 0 ? e.times[i] - e.times[i - 1] : 0;
    const double after = i + 1 < e.times.size() ? e.times[i + 1] - e.times[i] : 0;
    const double weight = (before + after) / 2;
    effort += weight * weighted[k];
    for (Eigen::Index j = 0; j < e.torques.cols(); ++j) {
      power += weight * arboc::joint_power(e.torques(k, j), e.rates(k, j));
      transfer += weight * arboc::power_transfer(e.torques(k, j), e.segment_rates(k, j));
    }
    if (k > 0) jerk += (e.accelerations.row(k) - e.accelerations.row(k - 1)).cwiseAbs().sum();
  }
  return {{"effort", effort},
          {"exchange", arboc::exchange(e.energies)},
          {"power", power},
          {"transfer", transfer},
          {"jerk", jerk}};
}

std::vector<Peak> peaks(const std::vector<std::string>& joints, const Effort& e) {
  std::vector<Peak> out;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    Peak peak{joints[j]};
    for (std::size_t k = 0; k < e.times.size(); ++k) {
      const double tau = e.torques(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j));
      if (std::fabs(tau) > std::fabs(peak.torque)) peak = {joints[j], tau, e.times[k]};
    }
    out.push_back(peak);
  }
  return out;
}

std::string peaks_csv(const std::vector<Peak>& all) {
  std::string out = "joint,torque,time\n";
  for (const Peak& p : all) out += fmt::format("{},{:.17g},{:.17g}\n", p.joint, p.torque, p.time);
  return out;
}

}  // namespace study
