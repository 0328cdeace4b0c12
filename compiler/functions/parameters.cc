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
       {"x", "y", "z"}},
      {Kind::kStiffness, "stiffness", "N m/rad, N/m", "of the joints that have springs", {""}},
      {Kind::kNeutral, "neutral", "rad, m", "where the springs are at rest", {""}}};
  return all;
}

/// Of a model with named lengths these are its lengths.
Group group_of(const Model& model, const Group& group) {
  if (group.kind != Kind::kLength || model.lengths.empty()) return group;
  return {Kind::kNamedLength, "lengths", "m", "named lengths of the model file", {""}};
}

enum class Owner { kNobody, kLink, kJoint, kLength };
Owner owner_of(Kind kind) {
  switch (kind) {
    case Kind::kGravity: return Owner::kNobody;
    case Kind::kMass:
    case Kind::kCentre:
    case Kind::kInertia: return Owner::kLink;
    case Kind::kNamedLength: return Owner::kLength;
    default: return Owner::kJoint;
  }
}

std::string owner_name(const Model& model, Kind kind, int k) {
  const auto i = static_cast<size_t>(k);
  switch (owner_of(kind)) {
    case Owner::kNobody: return "gravity";
    case Owner::kLink: return model.links[i].name;
    case Owner::kJoint: return model.joints[i].name;
    case Owner::kLength: return model.lengths[i].name;
  }
  return "";
}

int length_called(const Model& model, const std::string& name) {
  std::vector<std::string_view> names;
  for (size_t k = 0; k < model.lengths.size(); ++k) {
    if (model.lengths[k].name == name) return static_cast<int>(k);
    names.emplace_back(model.lengths[k].name);
  }
  throw UsageError(unknown("--parameters", "there is no length", name, names));
}

/// The model's own values of entry `k` (a link or a joint).
std::vector<double> nominal(const Model& model, Kind kind, int k) {
  const auto list = [](const Vector3<double>& a) { return std::vector<double>{a.x, a.y, a.z}; };
  if (kind == Kind::kGravity) return list(model.gravity);
  if (kind == Kind::kNamedLength) return {model.lengths[static_cast<size_t>(k)].value};
  if (owner_of(kind) == Owner::kJoint) {
    const Joint& joint = model.joints[static_cast<size_t>(k)];
    if (kind == Kind::kLength) return list(joint.origin.xyz);
    return {kind == Kind::kStiffness ? joint.stiffness : joint.neutral};
  }
  const Inertial& inertial = *model.links[static_cast<size_t>(k)].inertial;
  if (kind == Kind::kMass) return {inertial.mass};
  if (kind == Kind::kCentre) return list(inertial.origin.xyz);
  const Symmetric3<double>& I = inertial.inertia;
  return {I.xx, I.xy, I.xz, I.yy, I.yz, I.zz};
}

/// Whether a link, joint or length has the parameter.
bool has(const Model& model, Kind kind, size_t k) {
  if (owner_of(kind) == Owner::kLink) return model.links[k].inertial.has_value();
  if (kind == Kind::kLength) return model.joints[k].parent >= 0;
  if (owner_of(kind) == Owner::kJoint) return model.joints[k].stiffness != 0;
  return true;
}

/// Those that have it.
std::vector<int> candidates(const Model& model, Kind kind) {
  const Owner owner = owner_of(kind);
  const size_t n = owner == Owner::kNobody  ? 1
                   : owner == Owner::kLink  ? model.links.size()
                   : owner == Owner::kJoint ? model.joints.size()
                                            : model.lengths.size();
  std::vector<int> result;
  for (size_t k = 0; k < n; ++k)
    if (has(model, kind, k)) result.push_back(static_cast<int>(k));
  return result;
}

/// Adds what one word asks for to the chosen links or joints of its group.
void choose(const Model& model, const Group& group, const std::optional<std::string>& which,
            std::vector<int>& chosen) {
  std::vector<int> wanted = candidates(model, group.kind);
  if (which && group.kind == Kind::kGravity)
    throw UsageError("--parameters: gravity is one for all links: write gravity");
  const Owner owner = owner_of(group.kind);
  if (which) {
    const int k = owner == Owner::kJoint  ? joint_called(model, *which, "--parameters")
                  : owner == Owner::kLink ? link_called(model, *which, "--parameters")
                                          : length_called(model, *which);
    if (std::find(wanted.begin(), wanted.end(), k) == wanted.end())
      throw UsageError(printable(
          fmt::format("--parameters: {} has no {}: {}",
                      named(owner == Owner::kJoint ? "joint" : "link", *which), group.name,
                      group.kind == Kind::kLength ? "it holds the base"
                      : owner == Owner::kJoint    ? "it has no spring"
                                                  : "it has no <inertial>")));
    wanted = {k};
  } else if (wanted.empty() && owner == Owner::kJoint && group.kind != Kind::kLength) {
    throw UsageError(
        fmt::format("--parameters: no joint of the model has a spring, so there is "
                    "no {}",
                    group.name));
  }
  for (const int k : wanted)
    if (std::find(chosen.begin(), chosen.end(), k) == chosen.end()) chosen.push_back(k);
}

Parameter make(const Model& model, const Group& group, std::vector<int> of) {
  std::sort(of.begin(), of.end());
  Parameter parameter{group.kind, group.name, group.unit, group.meaning, std::move(of), {}, {}};
  for (const int k : parameter.of) {
    const std::string owner = owner_name(model, group.kind, k);
    for (const std::string entry : group.entries)
      parameter.labels.push_back(entry.empty() ? owner : owner + "." + entry);
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
    std::string group = word.substr(0, colon);
    if (group == "cgs") group = "centres";
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
    choose(model, group_of(model, groups()[g]), which, chosen[g]);
  }
  std::vector<Parameter> parameters;
  for (size_t g = 0; g < groups().size(); ++g)
    if (!chosen[g].empty())
      parameters.push_back(make(model, group_of(model, groups()[g]), chosen[g]));
  return parameters;
}

namespace {

/// The model's numbers while parameters take the place of some.
template <class S>
struct Changed {
  NumbersOf<S> numbers;
  std::vector<LinkNumbers<S>> links;
  std::vector<bool> changed;  // per link
};

/// What is written in terms of named lengths.
template <class S>
void set_lengths(const Model& model, const std::vector<S>& values, Changed<S>& draft) {
  const auto length = [&](int k) { return values[static_cast<size_t>(k)]; };
  for (size_t k = 0; k < model.joints.size(); ++k)
    if (!model.joints[k].origin.terms.empty())
      draft.numbers.origin[k] = xyz_with<S>(model.joints[k].origin, length);
  for (size_t k = 0; k < model.links.size(); ++k) {
    const auto& inertial = model.links[k].inertial;
    if (!inertial || inertial->origin.terms.empty()) continue;
    draft.links[k].centre = xyz_with<S>(inertial->origin, length);
    draft.changed[k] = true;
  }
}

template <class S>
void set(Kind kind, size_t k, const S* x, Changed<S>& draft) {
  switch (kind) {
    case Kind::kGravity: draft.numbers.gravity = {x[0], x[1], x[2]}; return;
    case Kind::kLength: draft.numbers.origin[k] = {x[0], x[1], x[2]}; return;
    case Kind::kStiffness: draft.numbers.forces[k].stiffness = x[0]; return;
    case Kind::kNeutral: draft.numbers.forces[k].neutral = x[0]; return;
    case Kind::kNamedLength: return;
    case Kind::kMass: draft.links[k].mass = x[0]; break;
    case Kind::kCentre: draft.links[k].centre = {x[0], x[1], x[2]}; break;
    case Kind::kInertia: draft.links[k].inertia = {x[0], x[3], x[5], x[1], x[2], x[4]}; break;
  }
  draft.changed[k] = true;
}

/// All named lengths, of which some are parameters.
template <class S>
std::vector<S> lengths_with(const Model& model, const Parameter& parameter,
                            const std::vector<S>& values) {
  std::vector<S> all;
  for (const NamedLength& length : model.lengths) all.push_back(S(length.value));
  for (size_t i = 0; i < parameter.of.size(); ++i)
    all[static_cast<size_t>(parameter.of[i])] = values[i];
  return all;
}

}  // namespace

template <class S>
NumbersOf<S> numbers_with(const Model& model, const JointForces& forces,
                          const std::vector<Parameter>& parameters,
                          const std::vector<std::vector<S>>& values) {
  Changed<S> draft{cast_numbers<S>(numbers(model, forces)), {}, {}};
  draft.links.resize(model.links.size());
  draft.changed.assign(model.links.size(), false);
  for (size_t k = 0; k < model.links.size(); ++k) {
    if (!model.links[k].inertial) continue;
    const Inertial& inertial = *model.links[k].inertial;
    draft.links[k] = {S(inertial.mass), cast<S>(inertial.origin.xyz), cast<S>(inertial.inertia)};
  }
  // Centres that are parameters themselves do not follow lengths, so lengths come first.
  for (size_t p = 0; p < parameters.size(); ++p)
    if (parameters[p].kind == Kind::kNamedLength)
      set_lengths(model, lengths_with(model, parameters[p], values[p]), draft);
  for (size_t p = 0; p < parameters.size(); ++p) {
    const S* x = values[p].data();
    for (const int owner : parameters[p].of) {
      set(parameters[p].kind, static_cast<size_t>(owner), x, draft);
      x += parameters[p].size();
    }
  }
  for (size_t k = 0; k < draft.links.size(); ++k)
    if (draft.changed[k])
      draft.numbers.moments[k] =
          moments_of(draft.links[k], rotation(model.links[k].inertial->origin));
  return draft.numbers;
}

template NumbersOf<double> numbers_with(const Model&, const JointForces&,
                                        const std::vector<Parameter>&,
                                        const std::vector<std::vector<double>>&);
template NumbersOf<Expr> numbers_with(const Model&, const JointForces&,
                                      const std::vector<Parameter>&,
                                      const std::vector<std::vector<Expr>>&);
template DynamicTreeOf<Expr> lower(const Model&, const LoweringOptions&, const NumbersOf<Expr>&);

namespace {

void set_lengths(const std::vector<double>& values, Model& model) {
  const auto length = [&](int k) { return values[static_cast<size_t>(k)]; };
  for (size_t k = 0; k < values.size(); ++k) model.lengths[k].value = values[k];
  for (Joint& joint : model.joints) joint.origin.xyz = xyz_with<double>(joint.origin, length);
  for (Link& link : model.links)
    if (link.inertial) link.inertial->origin.xyz = xyz_with<double>(link.inertial->origin, length);
}

}  // namespace

Model model_with(Model model, const std::vector<Parameter>& parameters,
                 const std::vector<std::vector<double>>& values) {
  for (size_t p = 0; p < parameters.size(); ++p)
    if (parameters[p].kind == Kind::kNamedLength)
      set_lengths(lengths_with(model, parameters[p], values[p]), model);
  for (size_t p = 0; p < parameters.size(); ++p) {
    const double* x = values[p].data();
    for (const int owner : parameters[p].of) {
      const auto k = static_cast<size_t>(owner);
      switch (parameters[p].kind) {
        case Kind::kGravity: model.gravity = {x[0], x[1], x[2]}; break;
        case Kind::kLength: model.joints[k].origin.xyz = {x[0], x[1], x[2]}; break;
        case Kind::kStiffness: model.joints[k].stiffness = x[0]; break;
        case Kind::kNeutral: model.joints[k].neutral = x[0]; break;
        case Kind::kNamedLength: break;
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
