#include "report/report_tables.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

namespace arboc {
namespace {

using nlohmann::ordered_json;

ordered_json vector(const Vector3<double>& v) { return {v.x, v.y, v.z}; }
ordered_json finite(double x) { return std::isfinite(x) ? ordered_json(x) : ordered_json(nullptr); }

/// The joint that moves or holds each link; null of a root that is the world's.
std::vector<const Joint*> joint_of_links(const Model& model) {
  std::vector<const Joint*> joints(model.links.size(), nullptr);
  for (const Joint& joint : model.joints) joints[static_cast<size_t>(joint.child)] = &joint;
  return joints;
}

/// A line through bench/compile/compile.txt.
constexpr double kMsPerOperation = 0.13, kSecondsPerFile = 0.06;

}  // namespace

ordered_json skeleton_json(const Model& model) {
  ordered_json bodies = ordered_json::array();
  const std::vector<const Joint*> joints = joint_of_links(model);
  for (size_t k = 0; k < model.links.size(); ++k) {
    const Link& link = model.links[k];
    ordered_json body{{"name", link.name}, {"parent", joints[k] ? joints[k]->parent : -1}};
    if (link.inertial && link.inertial->mass > 0) {
      body["mass"] = link.inertial->mass;
      body["com"] = vector(link.inertial->origin.xyz);
    }
    if (joints[k] && has_axis(joints[k]->type))
      body["joint"] = {{"type", name(joints[k]->type)}, {"axis", vector(joints[k]->axis)}};
    bodies.push_back(std::move(body));
  }
  const Vector3<double>& g = model.gravity;
  const double size = std::sqrt(g.x * g.x + g.y * g.y + g.z * g.z);
  const Vector3<double> up =
      size > 0 ? Vector3<double>{-g.x / size, -g.y / size, -g.z / size} : Vector3<double>{0, 0, 1};
  return {{"up", vector(up)}, {"bodies", std::move(bodies)}};
}

ordered_json controls_json(const Model& model) {
  const Coordinates at = coordinates(model);
  ordered_json list = ordered_json::array();
  for (size_t k = 0; k < model.joints.size(); ++k) {
    const Joint& joint = model.joints[k];
    if (nv(joint) == 0 || joint.mimic) continue;
    list.push_back({{"name", joint.name},
                    {"type", name(joint.type)},
                    {"q", at.joint[k].q},
                    {"v", at.joint[k].v},
                    {"nv", nv(joint)},
                    {"lower", finite(joint.limits.lower)},
                    {"upper", finite(joint.limits.upper)},
                    {"unit", joint.type == JointType::kPrismatic ? "N" : "N m"}});
  }
  return list;
}

ordered_json links_json(const Model& model) {
  ordered_json list = ordered_json::array();
  const std::vector<const Joint*> joints = joint_of_links(model);
  for (size_t k = 0; k < model.links.size(); ++k) {
    const Link& link = model.links[k];
    const Joint* joint = joints[k];
    const bool on_world = joint && joint->parent < 0;
    list.push_back(
        {{"name", link.name},
         {"joint", joint ? joint->name : ""},
         {"type", joint ? name(joint->type) : ""},
         {"parent",
          !joint || on_world ? "world" : model.links[static_cast<size_t>(joint->parent)].name},
         {"mass", link.inertial ? link.inertial->mass : 0.0}});
  }
  return list;
}

ordered_json to_json(const Diagnostic& d) {
  return {{"severity", name(d.severity)},
          {"file", d.file},
          {"line", d.location.line},
          {"column", d.location.column},
          {"element", d.element},
          {"message", d.message},
          {"hint", d.hint}};
}

ordered_json diagnostics_json(const Diagnostics& diagnostics) {
  ordered_json list = ordered_json::array();
  for (const Diagnostic& d : diagnostics.all()) list.push_back(to_json(d));
  return list;
}

ordered_json operations_json(const ReportInput& input) {
  const size_t columns = input.functions.size();
  std::map<std::string, std::vector<int>> rows;
  const auto row = [&](const std::string& name) -> std::vector<int>& {
    return rows.try_emplace(name, columns, 0).first->second;
  };
  ordered_json functions = ordered_json::array();
  for (size_t f = 0; f < columns; ++f) {
    const Program& program = input.functions[f].program;
    const std::vector<OpCount> ops = count_ops_by_block(program);
    for (size_t b = 0; b < ops.size(); ++b)
      if (ops[b].total() > 0)  // "forearm, motion"
        row(program.blocks[b].substr(0, program.blocks[b].rfind(", ")))[f] += ops[b].total();
    functions.push_back({{"name", name(input.functions[f].request)},
                         {"total", program.ops.total()},
                         {"sincos", program.ops.sincos}});
    if (input.functions[f].lanes)
      functions.back()["lanes"] = input.functions[f].lanes->program.ops.total();
  }
  ordered_json list = ordered_json::array();
  for (const Link& link : input.setup.model.links) {
    const auto found = rows.find(link.name);
    if (found == rows.end()) continue;
    list.push_back({{"name", link.name}, {"counts", found->second}});
    rows.erase(found);
  }
  std::vector<int> rest(columns, 0);
  for (const auto& [name, counts] : rows)
    for (size_t f = 0; f < columns; ++f) rest[f] += counts[f];
  if (!rows.empty()) list.push_back({{"name", "of no link"}, {"counts", rest}});
  return {{"functions", functions}, {"rows", list}, {"absent", input.absent}};
}

ordered_json matrices_json(const Setup& setup) {
  ordered_json list = ordered_json::array();
  const auto add = [&](const char* title, const CompiledFunction& f, size_t output) {
    std::vector<int> row = f.patterns[output].row, col = f.patterns[output].col;
    const size_t upper = f.signature.outputs[output].symmetric ? row.size() : 0;
    for (size_t k = 0; k < upper; ++k) {
      if (row[k] == col[k]) continue;
      row.push_back(f.patterns[output].col[k]);
      col.push_back(f.patterns[output].row[k]);
    }
    list.push_back({{"name", title}, {"size", setup.nv}, {"row", row}, {"col", col}});
  };
  Setup plain = setup;
  plain.simplify.limbs = false;
  try {
    const CompiledFunction crba = compile_function({"crba"}, plain);
    const CompiledFunction derivatives = compile_function({"rnea_derivatives"}, plain);
    add("M", crba, 0);
    add("∂τ/∂q", derivatives, 0);
    add("∂τ/∂v", derivatives, 1);
  } catch (const AbsentError&) {
    return ordered_json::array();
  }
  return list;
}

ordered_json cost_json(const std::vector<CompiledFunction>& functions) {
  ordered_json list = ordered_json::array();
  for (const CompiledFunction& f : functions) {
    const int operations = f.lanes ? f.lanes->program.ops.total() : f.program.ops.total();
    list.push_back({{"name", name(f.request)},
                    {"operations", operations},
                    {"seconds", kSecondsPerFile + 1e-3 * kMsPerOperation * operations}});
  }
  return {{"ms_per_operation", kMsPerOperation},
          {"s_per_file", kSecondsPerFile},
          {"compiler", "g++ 12 -O2 -march=native"},
          {"functions", list}};
}

}  // namespace arboc
