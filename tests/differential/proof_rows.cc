#include "differential/proof_rows.h"

namespace arboc::test {
namespace {

constexpr Derivative kJacobian = Derivative::kJacobian, kGradient = Derivative::kGradient,
                     kVjp = Derivative::kVjp, kHessian = Derivative::kHessian;

Row row(Derivative kind, const std::string& of, const Variation& variation = {}) {
  if (kind == Derivative::kNone) return {{of}, variation};
  return {parse_request("proof", kind, of), variation};
}

int order_of(const std::string& function) {
  if (function.ends_with("_derivatives")) return 1;
  return function.ends_with("_hessian") ? 2 : 0;
}

struct Known {
  const char *function, *libraries;
};
constexpr Known kKnown[] = {{"fk", "Pinocchio"},
                            {"rnea", "Pinocchio, KDL, DART, MuJoCo"},
                            {"gravity", "Pinocchio"},
                            {"nle", "Pinocchio"},
                            {"crba", "Pinocchio, KDL, DART, MuJoCo"},
                            {"minv", "Pinocchio"},
                            {"aba", "Pinocchio"},
                            {"rnea_derivatives", "Pinocchio"},
                            {"aba_derivatives", "Pinocchio"},
                            {"rnea_hessian", "Pinocchio"},
                            {"joint_jacobians", "Pinocchio"},
                            {"centroidal", "Pinocchio"},
                            {"regressor", "Pinocchio"}};

Variation loaded(const char* name, Axes axes) {
  Variation v{name};
  v.loads = true;
  v.axes = axes;
  return v;
}
Variation turned(const char* name, Axes axes) {
  Variation v{name};
  v.axes = axes;
  return v;
}
Variation forced(const char* name, bool loads, bool iterated = false) {
  Variation v{name};
  v.joint_forces = true;
  v.loads = loads;
  v.iterated = iterated;
  return v;
}

void add_force_rows(std::vector<Row>& rows) {
  const Variation local = loaded("external forces", Axes::kLocal);
  for (const Variation& v : {local, loaded("external forces, world axes", Axes::kWorld),
                             loaded("external forces, aligned axes", Axes::kAligned)}) {
    for (const char* f : {"rnea", "nle", "aba", "rnea_derivatives", "aba_derivatives"})
      rows.push_back({{f}, v});
    rows.push_back(row(kJacobian, "rnea.tau:q,f_ext", v));
    rows.push_back({{"rnea_hessian"}, v});
    rows.push_back({{"statics"}, v});
    rows.push_back(row(kJacobian, "statics.tau:q,f_ext", v));
    rows.push_back(row(kHessian, "statics.tau:q,f_ext", v));
  }
  const Variation joints = forced("joint forces", false), both = forced("all forces", true);
  for (const char* f : {"rnea", "statics", "nle", "crba", "minv", "aba", "rnea_derivatives"})
    rows.push_back({{f}, joints});
  for (const Variation& v : {joints, both}) {
    rows.push_back({{"aba_derivatives"}, v});
    rows.push_back({{"rnea_hessian"}, v});
    rows.push_back(row(kHessian, "statics.tau:q", v));
  }
  rows.push_back({{"rnea_hessian"}, forced("all forces, iterated", true, true)});
}

void add_axes_rows(std::vector<Row>& rows) {
  for (const Variation& v :
       {turned("world axes", Axes::kWorld), turned("aligned axes", Axes::kAligned)})
    for (const char* f :
         {"frame_velocity", "frame_acceleration", "frame_jacobian", "frame_jacobian_dot",
          "frame_velocity_derivatives", "frame_acceleration_derivatives"})
      rows.push_back({{f}, v});
}

void add_transform_rows(std::vector<Row>& rows) {
  Variation v{"third derivatives"};
  v.transform_order = 3;
  rows.push_back({{"transforms"}, v});
  v.name = "third derivatives, parameters";
  v.parameters = {"lengths"};
  rows.push_back({{"transforms"}, v});
}

void add_parameter_rows(std::vector<Row>& rows) {
  Variation v{"parameters"};
  v.parameters = {"gravity", "masses", "centres", "inertias", "lengths"};
  for (const std::string& f : function_names())
    if (order_of(f) < 2) rows.push_back({{f}, v});
  for (const char* of :
       {"rnea.tau:gravity,masses,centres,inertias,lengths", "crba.M:masses,lengths",
        "fk.placements:lengths", "aba.qdd:masses,inertias"})
    rows.push_back(row(kJacobian, of, v));
  rows.push_back(row(kGradient, "energy.V:q,gravity,masses,centres", v));
  rows.push_back(row(kGradient, "rnea.tau^2:masses,lengths", v));
  rows.push_back(row(kHessian, "rnea.tau:q,masses", v));
  v.name = "parameters, all forces";
  v.loads = v.joint_forces = true;
  for (const char* f : {"rnea", "statics", "aba", "rnea_derivatives", "aba_derivatives"})
    rows.push_back({{f}, v});
  rows.push_back(row(kJacobian, "rnea.tau:f_ext,masses,lengths", v));
}

}  // namespace

std::string Row::label() const {
  std::string label = text(request);
  if (*variation.name) label += std::string("; ") + variation.name;
  return label;
}

int Row::order() const {
  const int taken = request.derivative == Derivative::kNone ? 0
                    : request.derivative == kHessian        ? 2
                                                            : 1;
  return order_of(request.function) + taken;
}

std::string Row::others() const {
  if (request.derivative != Derivative::kNone || *variation.name) return "";
  for (const Known& known : kKnown)
    if (request.function == known.function) return known.libraries;
  return "";
}

std::vector<Row> function_rows() {
  std::vector<Row> rows;
  for (const std::string& f : function_names()) rows.push_back({{f}});
  return rows;
}

std::vector<Row> jacobian_rows() {
  const Setup setup = proof_setup(proof_model(kinds().front(), Base::kFixed, 1), {});
  std::vector<Row> rows;
  for (const std::string& f : function_names())
    for (const Argument& output : signature({f}, setup).outputs) {
      rows.push_back(row(kJacobian, f + "." + output.name));
      if (order_of(f) > 0) break;  // refused, whatever the output
    }
  return rows;
}

std::vector<Row> sample_rows() {
  std::vector<Row> rows;
  for (const char* of :
       {"energy.V", "energy.T", "rnea.tau^2", "aba.qdd^2", "com.c^2", "frame_velocity.velocity^2"})
    rows.push_back(row(kGradient, of));
  for (const char* of : {"fk.placements", "rnea.tau", "crba.M", "minv.Minv", "aba.qdd",
                         "frame_velocity.velocity", "com.c", "centroidal.h", "difference.d"})
    rows.push_back(row(kVjp, of));
  for (const char* of :
       {"fk.placements", "energy.V", "energy.T", "rnea.tau", "rnea.tau^2:q", "crba.M", "aba.qdd",
        "com.c", "frame_velocity.velocity", "integrate.q_next", "difference.d"})
    rows.push_back(row(kHessian, of));
  Variation iterated{"iterated"};
  iterated.iterated = true;
  rows.push_back({{"rnea_hessian"}, iterated});
  rows.push_back(row(kHessian, "energy.V", iterated));
  return rows;
}

std::vector<Row> option_rows() {
  std::vector<Row> rows;
  add_force_rows(rows);
  add_axes_rows(rows);
  add_transform_rows(rows);
  add_parameter_rows(rows);
  return rows;
}

}  // namespace arboc::test
