#include "functions/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/diagnostic.h"
#include "base/words.h"
#include "model/findings.h"
#include "model/names.h"
#include "tree/lowering.h"

namespace arboc {
namespace {

using Kind = Parameter::Kind;

struct Group {
  Kind kind;
  const char *name, *unit, *meaning;
  std::vector<const char*> entries;
};

const std::vector<Group>& groups() {
  static const std::vector<Group> all = {
      {Kind::kGravity,
       "gravity",
       "m/s^2",
       "acceleration of a falling body, world axes",
       {"x", "y", "z"}},
      {Kind::kMass, "masses", "kg", "one a link", {"mass"}},
      {Kind::kCentre,
       "centres",
       "m",
       "centres of mass, three a link, in the link's frame",
       {"x", "y", "z"}},
      {Kind::kInertia,
       "inertias",
       "kg m^2",
       "six a link: ixx ixy ixz iyy iyz izz about the centre of mass, axes of its inertial frame",
       {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}},
      {Kind::kLength,
       "lengths",
       "m",
       "xyz of the joints' placements, three a joint",
       {"x", "y", "z"}}};
  return all;
}

/// The model's own values of entry `k` (a link or a joint).
std::vector<double> nominal(const Model& model, Kind kind, int k) {
  const auto list = [](const Vector3<double>& a) { return std::vector<double>{a.x, a.y, a.z}; };
  if (kind == Kind::kGravity) return list(model.gravity);
  if (kind == Kind::kLength) return list(model.joints[static_cast<size_t>(k)].origin.xyz);
  const Inertial& inertial = *model.links[static_cast<size_t>(k)].inertial;
  if (kind == Kind::kMass) return {inertial.mass};
  if (kind == Kind::kCentre) return list(inertial.origin.xyz);
  const Symmetric3<double>& I = inertial.inertia;
  return {I.xx, I.xy, I.xz, I.yy, I.yz, I.zz};
}

/// Links or joints that have the parameter.
std::vector<int> candidates(const Model& model, Kind kind) {
  std::vector<int> result;
  if (kind == Kind::kGravity) return {0};
  const size_t n = kind == Kind::kLength ? model.joints.size() : model.links.size();
  for (size_t k = 0; k < n; ++k)
    if (kind == Kind::kLength ? model.joints[k].parent >= 0 : model.links[k].inertial.has_value())
      result.push_back(static_cast<int>(k));
  return result;
}

/// Adds what one word asks for to the chosen links or joints of its group.
void choose(const Model& model, const Group& group, const std::optional<std::string>& which,
            std::vector<int>& chosen) {
  std::vector<int> wanted = candidates(model, group.kind);
  if (which && group.kind == Kind::kGravity)
    throw UsageError("--parameters: gravity is one for all links: write gravity");
  if (which) {
    const int k = group.kind == Kind::kLength ? joint_called(model, *which, "--parameters")
                                              : link_called(model, *which, "--parameters");
    if (std::find(wanted.begin(), wanted.end(), k) == wanted.end())
      throw UsageError(printable(
          fmt::format("--parameters: {} has no {}: {}",
                      named(group.kind == Kind::kLength ? "joint" : "link", *which), group.name,
                      group.kind == Kind::kLength ? "it holds the base" : "it has no <inertial>")));
    wanted = {k};
  }
  for (const int k : wanted)
    if (std::find(chosen.begin(), chosen.end(), k) == chosen.end()) chosen.push_back(k);
}

Parameter make(const Model& model, const Group& group, std::vector<int> of) {
  std::sort(of.begin(), of.end());
  Parameter parameter{group.kind, group.name, group.unit, group.meaning, std::move(of), {}, {}};
  for (const int k : parameter.of) {
    const std::string owner = group.kind == Kind::kGravity ? "gravity"
                              : group.kind == Kind::kLength
                                  ? model.joints[static_cast<size_t>(k)].name
                                  : model.links[static_cast<size_t>(k)].name;
    for (const char* entry : group.entries) parameter.labels.push_back(owner + "." + entry);
    for (const double x : nominal(model, group.kind, k)) parameter.nominal.push_back(x);
  }
  return parameter;
}

/// Inertial parameters of a link, as far as they are parameters in S.
template <class S>
struct LinkNumbers {
  S mass{};
  Vector3<S> centre;
  Symmetric3<S> inertia;
};

template <class S>
MassMomentsOf<S> moments_of(const LinkNumbers<S>& link, const Matrix3<double>& R) {
  const Symmetric3<S>& I = link.inertia;
  const S half(0.5);
  const MassMomentsOf<S> at_centre{link.mass,
                                   Vector3<S>{S(0), S(0), S(0)},
                                   {half * (I.yy + I.zz - I.xx), half * (I.xx + I.zz - I.yy),
                                    half * (I.xx + I.yy - I.zz), -I.xy, -I.xz, -I.yz}};
  return move(at_centre, R, link.centre);
}

template <class S>
NumbersOf<S> cast_numbers(const NumbersOf<double>& numbers) {
  NumbersOf<S> result;
  result.gravity = cast<S>(numbers.gravity);
  for (const auto& x : numbers.origin) result.origin.push_back(cast<S>(x));
  for (const auto& I : numbers.moments)
    result.moments.push_back({S(I.m), cast<S>(I.h), cast<S>(I.Sigma)});
  for (const auto& f : numbers.forces)
    result.forces.push_back(
        {S(f.damping), S(f.friction), S(f.stiffness), S(f.neutral), S(f.rotor)});
  result.friction_velocity = numbers.friction_velocity;
  return result;
}

}  // namespace

int Parameter::size() const { return static_cast<int>(nominal.size() / of.size()); }

std::vector<Parameter> resolve_parameters(const Model& model,
                                          const std::vector<std::string>& words) {
  std::vector<std::vector<int>> chosen(groups().size());
  for (const std::string& word : words) {
    const size_t colon = word.find(':');
    const std::string group = word.substr(0, colon);
    const auto found = std::find_if(groups().begin(), groups().end(),
                                    [&](const Group& g) { return group == g.name; });
    if (found == groups().end()) {
      std::vector<std::string_view> known;
      for (const Group& g : groups()) known.emplace_back(g.name);
      throw UsageError(unknown("--parameters", "there is no group", group, known));
    }
    const auto g = static_cast<size_t>(found - groups().begin());
    std::optional<std::string> which;
    if (colon != std::string::npos) which = word.substr(colon + 1);
    choose(model, groups()[g], which, chosen[g]);
  }
  std::vector<Parameter> parameters;
  for (size_t g = 0; g < groups().size(); ++g)
    if (!chosen[g].empty()) parameters.push_back(make(model, groups()[g], chosen[g]));
  return parameters;
}

template <class S>
NumbersOf<S> numbers_with(const Model& model, const JointForces& forces,
                          const std::vector<Parameter>& parameters,
                          const std::vector<std::vector<S>>& values) {
  NumbersOf<S> result = cast_numbers<S>(numbers(model, forces));
  std::vector<LinkNumbers<S>> links(model.links.size());
  std::vector<bool> changed(model.links.size(), false);
  for (size_t k = 0; k < links.size(); ++k) {
    if (!model.links[k].inertial) continue;
    const Inertial& inertial = *model.links[k].inertial;
    links[k] = {S(inertial.mass), cast<S>(inertial.origin.xyz), cast<S>(inertial.inertia)};
  }
  for (size_t p = 0; p < parameters.size(); ++p) {
    const S* x = values[p].data();
    for (const int owner : parameters[p].of) {
      const auto k = static_cast<size_t>(owner);
      const Kind kind = parameters[p].kind;
      if (kind == Kind::kGravity) result.gravity = {x[0], x[1], x[2]};
      if (kind == Kind::kLength) result.origin[k] = {x[0], x[1], x[2]};
      if (kind == Kind::kMass) links[k].mass = x[0];
      if (kind == Kind::kCentre) links[k].centre = {x[0], x[1], x[2]};
      if (kind == Kind::kInertia) links[k].inertia = {x[0], x[3], x[5], x[1], x[2], x[4]};
      if (kind != Kind::kGravity && kind != Kind::kLength) changed[k] = true;
      x += parameters[p].size();
    }
  }
  for (size_t k = 0; k < links.size(); ++k)
    if (changed[k])
      result.moments[k] = moments_of(links[k], rotation(model.links[k].inertial->origin));
  return result;
}

template NumbersOf<double> numbers_with(const Model&, const JointForces&,
                                        const std::vector<Parameter>&,
                                        const std::vector<std::vector<double>>&);
template NumbersOf<Expr> numbers_with(const Model&, const JointForces&,
                                      const std::vector<Parameter>&,
                                      const std::vector<std::vector<Expr>>&);
template DynamicTreeOf<Expr> lower(const Model&, const LoweringOptions&, const NumbersOf<Expr>&);

Model model_with(Model model, const std::vector<Parameter>& parameters,
                 const std::vector<std::vector<double>>& values) {
  for (size_t p = 0; p < parameters.size(); ++p) {
    const double* x = values[p].data();
    for (const int owner : parameters[p].of) {
      const auto k = static_cast<size_t>(owner);
      switch (parameters[p].kind) {
        case Kind::kGravity: model.gravity = {x[0], x[1], x[2]}; break;
        case Kind::kLength: model.joints[k].origin.xyz = {x[0], x[1], x[2]}; break;
        case Kind::kMass: model.links[k].inertial->mass = x[0]; break;
        case Kind::kCentre: model.links[k].inertial->origin.xyz = {x[0], x[1], x[2]}; break;
        case Kind::kInertia:
          model.links[k].inertial->inertia = {x[0], x[3], x[5], x[1], x[2], x[4]};
          break;
      }
      x += parameters[p].size();
    }
  }
  return model;
}

}  // namespace arboc
