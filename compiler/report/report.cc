#include "report/report.h"

#include <arboc/page/page.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "emit/emit.h"
#include "emit/template.h"
#include "report/report_tables.h"
#include "tree/numbering.h"

namespace arboc {
namespace {

using nlohmann::ordered_json;

/// The functions that the page runs, of all links, with the model's own numbers.
class PageFunctions {
 public:
  explicit PageFunctions(const Setup& given) {
    FunctionOptions plain;
    plain.joint_forces = given.joint_forces;
    plain.simplify = given.simplify;
    plain.simplify.limbs = false;
    Setup setup = resolve(given.model, plain);
    setup.frames.resize(setup.model.links.size());
    std::iota(setup.frames.begin(), setup.frames.end(), 0);
    Compilation compilation{setup, {compile_function({"fk"}, setup)}};
    try {
      compilation.functions.push_back(compile_function({"gravity"}, setup));
    } catch (const AbsentError&) {
      // A model without masses moves all the same.
    }
    target_ = arboc::target(compilation, {});
  }

  /// The function as an ES module; one that exports null if the model cannot have it.
  std::string module(const std::string& name) const {
    for (const TargetFunction& f : target_.functions)
      if (f.signature.name == name) return js_function(target_, f);
    return "export const " + name + " = null;\n";
  }

  const TargetModel& target() const { return target_; }

 private:
  TargetModel target_;
};

double mass(const Model& model) {
  double sum = 0;
  for (const Link& link : model.links)
    if (link.inertial) sum += link.inertial->mass;
  return sum;
}

/// m, how far the placements of the links add up: how far a free body may want to go.
double reach(const Model& model) {
  double sum = 0;
  for (const Joint& joint : model.joints) {
    const Vector3<double>& p = joint.origin.xyz;
    sum += std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
  }
  return sum;
}

ordered_json model_json(const ReportInput& input, const PageFunctions& functions) {
  const Model& model = input.setup.model;
  return {{"name", model.name},
          {"file", model.file},
          {"sha256", model.source_sha256},
          {"version", version()},
          {"options", input.options},
          {"nq", input.setup.nq},
          {"nv", input.setup.nv},
          {"mass", mass(model)},
          {"reach", reach(model)},
          {"gravity", {model.gravity.x, model.gravity.y, model.gravity.z}},
          {"velocities", functions.target().velocity_names}};
}

}  // namespace

std::string html_report(const ReportInput& input) {
  const Model& model = input.setup.model;
  const PageFunctions functions(input.setup);
  const ordered_json data{{"model", model_json(input, functions)},
                          {"skeleton", skeleton_json(model)},
                          {"controls", controls_json(model)},
                          {"links", links_json(model)},
                          {"diagnostics", diagnostics_json(input.diagnostics)},
                          {"operations", operations_json(input)},
                          {"matrices", matrices_json(input.setup)},
                          {"cost", cost_json(input.functions)}};
  page::Page page;
  page.title = printable(model.name);
  page.style = embedded("page/report.css");
  page.body = fill("page/report.html", {{"tree", draw_svg(model.name, number_links(model))}});
  page.modules = {{"arboc/fk", functions.module("fk")},
                  {"arboc/gravity", functions.module("gravity")},
                  {"report", embedded("page/report.js")}};
  page.main = "report";
  page.data["report"] = data.dump(-1, ' ', true, ordered_json::error_handler_t::replace);
  return page::write(page);
}

}  // namespace arboc
