#include "functions/catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/diagnostic.h"
#include "functions/run.h"
#include "graph/expr.h"

namespace arboc {
namespace {

/// Inputs are letters: q v a, t for tau.
struct Entry {
  const char* name;
  const char* inputs;
  std::array<const char*, 3> outputs;  ///< null where there are fewer
  const char* meaning;
};

constexpr std::array<Entry, 8> kFunctions = {{
    {"fk",
     "q",
     {"placements"},
     "Forward kinematics: where each moving link's frame is in the world."},
    {"rnea",
     "qva",
     {"tau"},
     "Inverse dynamics: tau = M(q) a + C(q, v) v + g(q). [RBDA] Table 5.1."},
    {"gravity", "q", {"g"}, "Gravity forces: the joint forces that hold the body at rest."},
    {"nle", "qv", {"nle"}, "Nonlinear effects: C(q, v) v + g(q)."},
    {"crba", "q", {"M"}, "Joint-space inertia matrix. [RBDA] Table 6.2."},
    {"minv", "q", {"Minv"}, "Inverse of the joint-space inertia matrix."},
    {"aba", "qvt", {"qdd"}, "Forward dynamics: M(q) qdd = tau - C(q, v) v - g(q)."},
    {"rnea_derivatives",
     "qva",
     {"dtau_dq", "dtau_dv", "M"},
     "First derivatives of inverse dynamics with respect to q, v and a."},
}};

const Entry& find(const std::string& name) {
  return *std::find_if(kFunctions.begin(), kFunctions.end(),
                       [&](const Entry& e) { return name == e.name; });
}

Argument input_argument(char letter, const DynamicTree& tree) {
  switch (letter) {
    case 'q': return {"q", tree.nq, 1, "rad, m", "configuration; quaternions x y z w of length 1"};
    case 'v':
      return {"v", tree.nv, 1, "rad/s, m/s",
              "velocity; floating joints linear, angular in the body frame"};
    case 'a': return {"a", tree.nv, 1, "rad/s^2, m/s^2", "time derivative of v"};
    default:
      return {"tau", tree.nv, 1, "N m, N",
              "joint forces; floating joints force, moment in the body frame"};
  }
}

Argument symmetric_matrix(const std::string& name, const DynamicTree& tree, const char* unit,
                          const char* meaning) {
  return {name, tree.nv, tree.nv, unit, meaning, true, true};
}

/// The reference engine has no derivatives but differences.  Relative to the forces they are good
/// for some 1e-12, and 1e-15 in v; derivatives may be smaller than forces.
Argument derivative(const std::string& name, const DynamicTree& tree, const char* unit,
                    const char* meaning, double tolerance) {
  return {name, tree.nv, tree.nv, unit, meaning, true, false, tolerance};
}

Argument output_argument(const std::string& name, const DynamicTree& tree) {
  if (name == "placements")
    return {
        name, static_cast<int>(moving_frames(tree).size()), 12, "1, m",
        "one row a frame: rotation matrix (world from link, by rows), then origin in the world"};
  if (name == "M")
    return symmetric_matrix(name, tree, "kg m^2, kg m, kg", "kinetic energy is v M v / 2");
  if (name == "Minv")
    return symmetric_matrix(name, tree, "1/(kg m^2), 1/(kg m), 1/kg", "inverse of M");
  if (name == "dtau_dq")
    return derivative(name, tree, "N m, N, N/m",
                      "derivative of tau with respect to q; floating and planar joints move along "
                      "their body's axes",
                      1e-9);
  if (name == "dtau_dv")
    return derivative(name, tree, "N m s, N s, N s/m", "derivative of tau with respect to v",
                      1e-10);
  if (name == "qdd") return {name, tree.nv, 1, "rad/s^2, m/s^2", "time derivative of v"};
  return {name, tree.nv, 1, "N m, N",
          "joint forces; floating joints force, moment in the body frame"};
}

/// The structural non-zeros of an output, by columns, and their values.
std::vector<Expr> non_zeros(const Argument& a, const std::vector<Expr>& matrix, Pattern& pattern) {
  std::vector<Expr> entries;
  for (int col = 0; col < a.cols; ++col) {
    for (int row = 0; row < (a.symmetric ? col + 1 : a.rows); ++row) {
      const Expr& entry =
          matrix[static_cast<size_t>(row) * static_cast<size_t>(a.cols) + static_cast<size_t>(col)];
      if (is_zero(entry)) continue;
      pattern.row.push_back(row);
      pattern.col.push_back(col);
      entries.push_back(entry);
    }
  }
  return entries;
}

/// Names the joint whose coordinate can never be accelerated by a finite force.
void refuse_singular(const DynamicTree& tree, const std::vector<Expr>& pivots,
                     const std::string& function) {
  for (size_t k = pivots.size(); k-- > 0;) {
    if (!pivots[k].is_constant() || pivots[k].value() > 0) continue;
    const auto body =
        std::find_if(tree.body.begin(), tree.body.end(), [&](const BodyOf<double>& b) {
          const int first = b.v, last = b.v + freedoms(b.motion);
          return first <= static_cast<int>(k) && static_cast<int>(k) < last;
        });
    throw InputError(
        fmt::format("error: joint '{}': what it moves has no inertia about its axis, so {} has no "
                    "solution (give its "
                    "links mass, fix the joint, or leave {} out)",
                    printable(body->joint), function, function));
  }
}

}  // namespace

std::vector<std::string> function_names() {
  std::vector<std::string> names;
  for (const Entry& entry : kFunctions) names.emplace_back(entry.name);
  return names;
}

bool is_function(const std::string& name) {
  return std::any_of(kFunctions.begin(), kFunctions.end(),
                     [&](const Entry& e) { return name == e.name; });
}

Signature signature(const std::string& function, const DynamicTree& tree) {
  const Entry& entry = find(function);
  Signature s;
  s.name = entry.name;
  s.meaning = entry.meaning;
  for (const char* letter = entry.inputs; *letter; ++letter)
    s.inputs.push_back(input_argument(*letter, tree));
  for (const char* output : entry.outputs)
    if (output) s.outputs.push_back(output_argument(output, tree));
  if (function == "aba" || function == "minv") s.positive = "pivot";
  return s;
}

std::vector<LoweringOptions> lowerings(const std::string& function) {
  const bool regroup = function != "fk";
  return {{FrameChoice::kAxis, regroup}, {FrameChoice::kDenavit, regroup}};
}

Traced trace(const std::string& function, const DynamicTree& tree) {
  const Signature s = signature(function, tree);
  Builder builder(function);
  std::vector<std::vector<Expr>> inputs;
  for (const Argument& a : s.inputs) {
    inputs.emplace_back();
    for (const Ref ref : builder.input(a.name, a.rows)) inputs.back().emplace_back(&builder, ref);
  }
  const Results<Expr> results = run(s, tree, inputs);
  if (!results.pivots.empty()) refuse_singular(tree, results.pivots, function);

  Traced traced;
  const auto output = [&](const std::string& name, const std::vector<Expr>& values) {
    std::vector<Ref> refs;
    for (const Expr& value : values) refs.push_back(value.ref(builder));
    builder.output(name, refs);
  };
  for (size_t k = 0; k < s.outputs.size(); ++k) {
    const Argument& a = s.outputs[k];
    const std::vector<Expr>& all = results.outputs[k];
    Pattern& pattern = traced.patterns.emplace_back();
    output(a.name, a.sparse ? non_zeros(a, all, pattern) : all);
  }
  if (!s.positive.empty()) output(s.positive, results.pivots);
  traced.graph = std::move(builder).finish();
  return traced;
}

Values evaluate_generic(const std::string& function, const DynamicTree& tree,
                        const Values& inputs) {
  const Signature s = signature(function, tree);
  std::vector<std::vector<double>> in;
  for (const Argument& a : s.inputs) in.push_back(inputs.at(a.name));
  Results<double> results = run(s, tree, in);
  Values values;
  for (size_t k = 0; k < s.outputs.size(); ++k) {
    const Argument& a = s.outputs[k];
    std::vector<double>& result = results.outputs[k];
    const auto n = static_cast<size_t>(a.rows);
    for (size_t i = 0; a.symmetric && i < n; ++i)
      for (size_t j = 0; j < i; ++j) result[i * n + j] = result[j * n + i];
    values[a.name] = std::move(result);
  }
  return values;
}

}  // namespace arboc
