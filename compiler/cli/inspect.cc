// arboc inspect MODEL: what the model is, without tracing anything unless asked.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/number.h"
#include "cli/common.h"
#include "cli/output.h"
#include "report/report.h"
#include "report/report_tables.h"
#include "tree/numbering.h"

namespace arboc::cli {
namespace {

using nlohmann::ordered_json;

double mass(const Model& model) {
  double sum = 0;
  for (const Link& link : model.links)
    if (link.inertial) sum += link.inertial->mass;
  return sum;
}

ordered_json finite(double x) { return std::isfinite(x) ? ordered_json(x) : ordered_json(nullptr); }

ordered_json joint_json(const Model& model, const Coordinates& at, size_t k) {
  const Joint& joint = model.joints[k];
  const auto link = [&](int i) {
    return i < 0 ? std::string("world") : model.links[static_cast<size_t>(i)].name;
  };
  ordered_json row{{"name", joint.name},
                   {"type", name(joint.type)},
                   {"parent", link(joint.parent)},
                   {"child", link(joint.child)}};
  if (nv(joint) == 0) return row;
  row["q"] = at.joint[k].q;
  row["v"] = at.joint[k].v;
  row["nq"] = joint.mimic ? 0 : nq(joint);
  row["nv"] = joint.mimic ? 0 : nv(joint);
  if (has_axis(joint.type)) row["axis"] = {joint.axis.x, joint.axis.y, joint.axis.z};
  row["limits"] = {{"lower", finite(joint.limits.lower)},
                   {"upper", finite(joint.limits.upper)},
                   {"velocity", finite(joint.limits.velocity)},
                   {"effort", finite(joint.limits.effort)},
                   {"effort_lower", finite(joint.limits.effort_lower)}};
  row["damping"] = joint.damping;
  row["friction"] = joint.friction;
  row["stiffness"] = joint.stiffness;
  row["neutral"] = joint.neutral;
  row["rotor"] = joint.rotor_inertia;
  if (joint.mimic)
    row["mimic"] = {{"joint", model.joints[static_cast<size_t>(joint.mimic->leader)].name},
                    {"multiplier", joint.mimic->multiplier},
                    {"offset", joint.mimic->offset}};
  return row;
}

ordered_json describe(const Model& model, const Diagnostics& diagnostics) {
  const Coordinates at = coordinates(model);
  ordered_json json{{"name", model.name},
                    {"file", model.file},
                    {"sha256", model.source_sha256},
                    {"nq", at.nq},
                    {"nv", at.nv},
                    {"mass", mass(model)},
                    {"gravity", {model.gravity.x, model.gravity.y, model.gravity.z}}};
  json["links"] = ordered_json::array();
  for (const Link& link : model.links)
    json["links"].push_back(
        {{"name", link.name}, {"mass", link.inertial ? link.inertial->mass : 0.0}});
  json["joints"] = ordered_json::array();
  for (size_t k = 0; k < model.joints.size(); ++k)
    json["joints"].push_back(joint_json(model, at, k));
  json["warnings"] = ordered_json::array();
  json["notes"] = ordered_json::array();
  for (const Diagnostic& d : diagnostics.all())
    json[d.severity == Severity::kWarning ? "warnings" : "notes"].push_back(to_json(d));
  return json;
}

std::string range(const Limits& limits) {
  if (!std::isfinite(limits.lower) && !std::isfinite(limits.upper)) return "";
  return fmt::format("[{}, {}]", shortest(limits.lower), shortest(limits.upper));
}

void print_text(const Model& model) {
  const Coordinates at = coordinates(model);
  fmt::print("{} ({}): {} links, {} joints, nq {}, nv {}, mass {} kg\n", printable(model.name),
             printable(model.file), model.links.size(), model.joints.size(), at.nq, at.nv,
             shortest(mass(model)));
  fmt::print("{:>4} {:>4}  {:<11} {:<28} {:<28} {}\n", "q", "v", "type", "joint", "link", "limits");
  for (size_t k = 0; k < model.joints.size(); ++k) {
    const Joint& joint = model.joints[k];
    if (nv(joint) == 0) continue;
    std::string extra = range(joint.limits);
    if (joint.mimic)
      extra += fmt::format(" = {} * {} + {}", shortest(joint.mimic->multiplier),
                           printable(model.joints[static_cast<size_t>(joint.mimic->leader)].name),
                           shortest(joint.mimic->offset));
    fmt::print("{:>4} {:>4}  {:<11} {:<28} {:<28} {}\n", at.joint[k].q, at.joint[k].v,
               name(joint.type), printable(joint.name),
               printable(model.links[static_cast<size_t>(joint.child)].name), extra);
  }
}

ordered_json describe(const Setup& setup) {
  ordered_json json{{"frames", ordered_json::array()}, {"parameters", ordered_json::object()}};
  for (const int frame : setup.frames)
    json["frames"].push_back(setup.model.links[static_cast<size_t>(frame)].name);
  for (const Parameter& p : setup.parameters)
    json["parameters"][p.name] = {
        {"unit", p.unit}, {"meaning", p.meaning}, {"labels", p.labels}, {"nominal", p.nominal}};
  return json;
}

/// The entries of each parameter in their order, with the model's values.
void print_parameters(const Setup& setup) {
  for (const Parameter& p : setup.parameters) {
    fmt::print("parameter {} ({}): {}\n", p.name, p.unit, p.meaning);
    for (size_t k = 0; k < p.labels.size(); ++k)
      fmt::print("{:>4}  {:<40} {}\n", k, printable(p.labels[k]), shortest(p.nominal[k]));
  }
}

/// The dynamic tree in numbers, and drawn.
void show_tree(const Model& model, const InspectOptions& options, ordered_json& json) {
  const std::vector<NumberedLink> links = number_links(model);
  if (!options.svg.empty()) write_one_file(options.svg, draw_svg(model.name, links));
  if (!options.tree) return;
  if (json.is_null()) {
    fmt::print("{}", print(links));
    return;
  }
  json["tree"] = ordered_json::array();
  for (const NumberedLink& link : links)
    json["tree"].push_back({{"joint", link.joint},
                            {"link", link.link},
                            {"type", link.type},
                            {"parent", link.parent},
                            {"branches", link.branches},
                            {"mass", link.mass},
                            {"dummy", link.dummy}});
}

/// What is asked for, compiled; of default functions those that the model can have.
void count(const Common& common, ReportInput& report) {
  check_size(report.setup.model, common.compile.max_dof);
  for (const Request& request : requests(common)) {
    try {
      report.functions.push_back(compile_function(request, report.setup));
    } catch (const AbsentError& e) {
      if (!asks_by_default(common)) throw;
      Diagnostics left_out;
      report_left_out(request, e, left_out);
      print_diagnostics(left_out, common, false);
      report.absent.push_back(name(request));
    }
    check_interrupt();
  }
}

void show_ops(const std::vector<CompiledFunction>& functions, ordered_json& json) {
  if (json.is_null())
    fmt::print("{:<30} {:>7} {:>6} {:>6} {:>6} {:>4} {:>5} {:>6} {:>8}\n", "function", "total",
               "mul", "add", "fma", "div", "sqrt", "sincos", "in lanes");
  for (const CompiledFunction& f : functions) {
    const std::string function = name(f.request);
    const OpCount n = f.program.ops;
    if (json.is_null()) {
      fmt::print("{:<30} {:>7} {:>6} {:>6} {:>6} {:>4} {:>5} {:>6} {:>8}\n", function, n.total(),
                 n.mul, n.add, n.fma, n.div, n.sqrt, n.sincos,
                 f.lanes ? fmt::format("{}", f.lanes->program.ops.total()) : "-");
      continue;
    }
    json["ops"][function] = {{"mul", n.mul}, {"add", n.add},   {"fma", n.fma},
                             {"div", n.div}, {"sqrt", n.sqrt}, {"sincos", n.sincos}};
    if (f.lanes) json["ops"][function]["lanes"] = f.lanes->program.ops.total();
  }
}

}  // namespace

int run_inspect(const Common& common, const InspectOptions& options) {
  if (options.ops) requests(common);  // complains before anything is read
  Diagnostics diagnostics;
  const Model model = configured(common, read(common, diagnostics), diagnostics);
  print_diagnostics(diagnostics, common, common.verbose || !common.json);
  ordered_json json;
  if (common.json)
    json = describe(model, diagnostics);
  else
    print_text(model);
  if (options.tree || !options.svg.empty()) show_tree(model, options, json);
  ReportInput report{resolve(model, common.compile.function),
                     changed_options(common.compile),
                     {},
                     {},
                     diagnostics};
  if (common.json)
    json.update(describe(report.setup));
  else
    print_parameters(report.setup);
  if (options.ops || !options.html.empty()) count(common, report);
  if (options.ops) show_ops(report.functions, json);
  if (!options.html.empty()) write_one_file(options.html, html_report(report));
  if (common.json) fmt::print("{}\n", dump(json, 1));
  flush_stdout();
  return kOk;
}

}  // namespace arboc::cli
