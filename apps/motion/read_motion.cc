#include <fstream>
#include <nlohmann/json.hpp>

#include "phases.h"

namespace motion {
namespace {

/// Of so many rows of control points.
arboc::BSpline curve_of(const nlohmann::json& json, std::size_t curves, double duration) {
  std::vector<double> knots = json.at("knots").get<std::vector<double>>();
  if (knots.empty()) throw std::invalid_argument("there are no knots");
  const double begin = knots.front(), stretch = duration / (knots.back() - begin);
  for (double& u : knots) u = (u - begin) * stretch;
  const auto rows = json.at("control_points").get<std::vector<std::vector<double>>>();
  if (rows.size() != curves)
    throw std::invalid_argument("there are not as many curves as there should be");
  arboc::BSplineBasis basis(json.at("degree").get<int>(), std::move(knots));
  Eigen::MatrixXd P(static_cast<Eigen::Index>(rows.size()), basis.size());
  for (std::size_t j = 0; j < rows.size(); ++j) {
    if (static_cast<int>(rows[j].size()) != basis.size())
      throw std::invalid_argument("control points do not fit the knots");
    for (std::size_t i = 0; i < rows[j].size(); ++i)
      P(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)) = rows[j][i];
  }
  return {std::move(basis), std::move(P)};
}

Motion motion_of(const nlohmann::json& json, const Model& model, const Task& task) {
  std::vector<std::string> contacts;
  for (const auto& c : task.start.posture.contacts) contacts.push_back(c.name);
  if (json.at("contacts").get<std::vector<std::string>>() != contacts)
    throw std::invalid_argument("it has other contacts");
  const nlohmann::json& curves = json.at("curves");
  return {curve_of(curves.at("q"), model.robot.coordinates.size(), task.duration),
          curve_of(curves.at("reactions"), 6 * contacts.size(), task.duration)};
}

}  // namespace

std::vector<Motion> read_motions(const std::string& path, const Model& model, const Plan& plan) {
  std::ifstream in(path);
  if (!in) throw std::invalid_argument(path + " cannot be read");
  try {
    const nlohmann::json json = nlohmann::json::parse(in);
    if (json.at("coordinates").get<std::vector<std::string>>() != model.robot.coordinates)
      throw std::invalid_argument("it is of another model");
    if (plan.phases.size() == 1) return {motion_of(json, model, plan.phases.front())};
    const nlohmann::json& phases = json.at("phases");
    if (phases.size() != plan.phases.size())
      throw std::invalid_argument("it has not as many phases");
    std::vector<Motion> out;
    for (std::size_t k = 0; k < phases.size(); ++k)
      out.push_back(motion_of(phases[k], model, plan.phases[k]));
    return out;
  } catch (const std::exception& e) {
    throw std::invalid_argument(path + " is no result of motion: " + e.what());
  }
}

}  // namespace motion
