#include "functions/catalogue.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "base/diagnostic.h"
#include "base/words.h"
#include "functions/arguments.h"
#include "functions/derived_signature.h"

namespace arboc {
namespace {

/// Whose inertial parameters an algorithm needs.
enum class Masses {
  kAny,  ///< regrouped ones give the same result
  kOwn,  ///< those of the bodies themselves
};

struct Entry {
  const char* name;
  std::vector<const char*> inputs;
  std::vector<const char*> outputs;
  Masses masses;
  const char* positive;    ///< values that must be positive, or null
  const char* definition;  ///< of a derivative: what and with respect to what, or null
  const char* meaning;
};

// clang-format off
const std::vector<Entry>& table() {
  static const std::vector<Entry> entries = {
    {"fk", {"q"}, {"placements"}, Masses::kAny, nullptr, nullptr,
     "Forward kinematics: where the reported links' frames are in the world."},
    {"rnea", {"q", "v", "a", "f_ext"}, {"tau"}, Masses::kAny, nullptr, nullptr,
     "Inverse dynamics: tau = M(q) a + C(q, v) v + g(q). [RBDA] Table 5.1."},
    {"gravity", {"q"}, {"g"}, Masses::kAny, nullptr, nullptr,
     "Gravity forces: the joint forces that hold the body at rest."},
    {"statics", {"q", "f_ext"}, {"tau"}, Masses::kAny, nullptr, nullptr,
     "Statics: the joint forces that hold the body at rest under loads, tau = g(q) - J^T f_ext."},
    {"nle", {"q", "v", "f_ext"}, {"nle"}, Masses::kAny, nullptr, nullptr,
     "Nonlinear effects: C(q, v) v + g(q)."},
    {"crba", {"q"}, {"M"}, Masses::kAny, nullptr, nullptr,
     "Joint-space inertia matrix. [RBDA] Table 6.2."},
    {"minv", {"q"}, {"Minv"}, Masses::kAny, "pivot", nullptr,
     "Inverse of the joint-space inertia matrix."},
    {"aba", {"q", "v", "tau", "f_ext"}, {"qdd"}, Masses::kAny, "pivot", nullptr,
     "Forward dynamics: M(q) qdd = tau - C(q, v) v - g(q)."},
    {"rnea_derivatives", {"q", "v", "a", "f_ext"}, {"dtau_dq", "dtau_dv", "M"}, Masses::kAny, nullptr, nullptr,
     "First derivatives of inverse dynamics with respect to q, v and a."},
    {"aba_derivatives", {"q", "v", "tau", "f_ext"}, {"dqdd_dq", "dqdd_dv", "Minv"}, Masses::kAny, "pivot", nullptr,
     "First derivatives of forward dynamics with respect to q, v and tau."},
    {"rnea_hessian", {"q", "v", "a", "f_ext", "lambda"}, {"H_qq", "H_qv", "H_vv", "H_qa"}, Masses::kAny, nullptr, "rnea.tau:q,v,a",
     "Second derivatives of lambda^T tau with respect to q, v and a."},
    {"frame_velocity", {"q", "v"}, {"velocity"}, Masses::kAny, nullptr, nullptr,
     "Velocities of the reported frames."},
    {"frame_acceleration", {"q", "v", "a"}, {"acceleration"}, Masses::kAny, nullptr, nullptr,
     "Accelerations of the reported frames: time derivatives of their velocities, J a + dJ v."},
    {"frame_jacobian", {"q"}, {"J"}, Masses::kAny, nullptr, nullptr,
     "Jacobians of the reported frames: velocity = J v."},
    {"frame_jacobian_dot", {"q", "v"}, {"dJ"}, Masses::kAny, nullptr, nullptr,
     "Time derivatives of the Jacobians of the reported frames."},
    {"frame_velocity_derivatives", {"q", "v"}, {"dvelocity_dq", "dvelocity_dv"}, Masses::kAny, nullptr, "frame_velocity.velocity:q,v",
     "First derivatives of the velocities of the reported frames."},
    {"frame_acceleration_derivatives", {"q", "v", "a"}, {"dacceleration_dq", "dacceleration_dv", "dacceleration_da"}, Masses::kAny, nullptr, "frame_acceleration.acceleration:q,v,a",
     "First derivatives of the accelerations of the reported frames."},
    {"joint_jacobians", {"q"}, {"J_world"}, Masses::kAny, nullptr, nullptr,
     "Motion subspaces of all coordinates at the world's origin, along its axes."},
    {"transforms", {"q"}, {"T", "T_inverse", "dT", "d2T", "d3T"}, Masses::kAny, nullptr, nullptr,
     "Homogeneous transforms of the reported frames, their inverses and derivatives."},
    {"com", {"q", "v"}, {"c", "vc"}, Masses::kOwn, nullptr, nullptr,
     "Centre of mass of the moving links, and its velocity."},
    {"com_jacobian", {"q"}, {"Jc"}, Masses::kOwn, nullptr, nullptr,
     "Jacobian of the centre of mass: vc = Jc v."},
    {"centroidal", {"q", "v", "a"}, {"h", "A_G", "dh"}, Masses::kOwn, nullptr, nullptr,
     "Momentum about the centre of mass, its matrix, h = A_G v, and its rate."},
    {"energy", {"q", "v"}, {"T", "V"}, Masses::kOwn, nullptr, nullptr,
     "Kinetic energy, and potential energy in the field of gravity."},
    {"regressor", {"q", "v", "a"}, {"Y"}, Masses::kOwn, nullptr, nullptr,
     "Regressor of inverse dynamics: tau = Y pi, pi ten inertial parameters a moving link."},
    {"integrate", {"q", "v"}, {"q_next"}, Masses::kAny, nullptr, nullptr,
     "Moves a configuration: q (+) v."},
    {"difference", {"q", "q1"}, {"d"}, Masses::kAny, nullptr, nullptr,
     "What moves q to q1: q (+) d = q1."},
    {"integrate_derivatives", {"q", "v"}, {"dq_next_dq", "dq_next_dv"}, Masses::kAny, nullptr, nullptr,
     "First derivatives of q (+) v in the tangent spaces."},
    {"difference_derivatives", {"q", "q1"}, {"dd_dq", "dd_dq1"}, Masses::kAny, nullptr, nullptr,
     "First derivatives of difference in the tangent spaces."},
  };
  return entries;
}
// clang-format on

const Entry& find(const std::string& name) {
  for (const Entry& entry : table())
    if (name == entry.name) return entry;
  throw std::logic_error("no function " + name);
}

/// The function asked for; a complaint begins with the option.
const Entry& find(const Request& request) {
  check_function(request.derivative == Derivative::kNone ? "--function" : text(request),
                 request.function);
  return find(request.function);
}

/// Refuses derivatives of what is a derivative by definition, and third ones.
void check_order(const Request& request) {
  if (request.derivative == Derivative::kNone) return;
  const bool first = request.function.ends_with("_derivatives");
  if (!find(request).definition && !(first && request.derivative == Derivative::kHessian)) return;
  throw UsageError(fmt::format("{}: {} is a derivative itself; ask for one of {}", text(request),
                               request.function,
                               request.function.substr(0, request.function.rfind('_'))));
}

/// The catalogue's own functions; f_ext and parameters are inputs where there are any.
Signature plain_signature(const Entry& entry, const Setup& setup) {
  Signature s;
  s.name = entry.name;
  s.meaning = entry.meaning;
  for (const char* input : entry.inputs)
    if (std::string(input) != "f_ext" || !setup.loads.empty())
      s.inputs.push_back(input_argument(input, setup));
  for (const Parameter& parameter : setup.parameters)
    s.inputs.push_back(parameter_argument(parameter));
  const size_t outputs = s.name == "transforms" ? static_cast<size_t>(2 + setup.transform_order)
                                                : entry.outputs.size();
  for (size_t k = 0; k < outputs; ++k)
    s.outputs.push_back(output_argument(entry.name, entry.outputs[k], setup));
  if (entry.positive) s.positive = entry.positive;
  return s;
}

}  // namespace

std::vector<std::string> function_names() {
  std::vector<std::string> names;
  for (const Entry& entry : table()) names.emplace_back(entry.name);
  return names;
}

void check_function(const std::string& option, const std::string& name) {
  std::vector<std::string_view> known;
  for (const Entry& entry : table()) known.emplace_back(entry.name);
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw UsageError(unknown(option, "there is no function", name, known, known.size()));
}

Request defined_as(const Request& request) {
  if (request.derivative != Derivative::kNone) return request;
  const Entry& entry = find(request);
  if (!entry.definition) return request;
  const Derivative kind =
      request.function == "rnea_hessian" ? Derivative::kHessian : Derivative::kJacobian;
  return parse_request(entry.name, kind, entry.definition);
}

Signature signature(const Request& request, const Setup& setup) {
  check_order(request);
  const Request definition = defined_as(request);
  Signature s = plain_signature(find(definition.function), setup);
  if (definition.derivative == Derivative::kNone) return s;
  const Argument of = named(s.outputs, definition.output, request, "output");
  const std::string meaning = meaning_of(definition, s, of, setup.iterated);
  s.outputs.clear();
  check_inputs(definition, s);
  add_derivatives(definition, setup, of, s);
  s.name = name(request);
  if (request.derivative == Derivative::kNone) {
    const Entry& entry = find(request.function);
    s.meaning = entry.meaning;
    std::vector<Argument> outputs;
    for (const char* output : entry.outputs)
      outputs.push_back(named(s.outputs, output, request, "output"));
    s.outputs = outputs;
  } else {
    s.meaning = meaning;
  }
  return s;
}

std::vector<LoweringOptions> lowerings(const std::string& function) {
  const bool regroup = find(function).masses == Masses::kAny;
  return {{FrameChoice::kAxis, regroup}, {FrameChoice::kDenavit, regroup}};
}

EngineFrames engine_frames(const Setup& setup) {
  return {setup.frames, setup.loads, setup.axes, setup.transform_order};
}

}  // namespace arboc
