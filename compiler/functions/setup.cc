#include "functions/setup.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/diagnostic.h"
#include "model/findings.h"
#include "model/names.h"

namespace arboc {
namespace {

std::vector<int> links_called(const Model& model, const std::vector<std::string>& names,
                              const char* option) {
  std::vector<int> links;
  for (const std::string& name : names) {
    const int link = link_called(model, name, option);
    if (std::find(links.begin(), links.end(), link) != links.end())
      throw UsageError(fmt::format("{}: {} is given twice", option, named("link", name)));
    links.push_back(link);
  }
  return links;
}

/// The frames that the file wants to be seen; of files that do not say, the links that move.
std::vector<int> frames_of(const Model& model, const std::vector<int>& moving) {
  std::vector<int> links;
  for (size_t k = 0; k < model.links.size(); ++k)
    if (model.links[k].reported) links.push_back(static_cast<int>(k));
  return links.empty() ? moving : links;
}

/// Springs that are not asked for have no parameters.
void check_springs(const Setup& setup) {
  for (const Parameter& p : setup.parameters)
    if ((p.kind == Parameter::Kind::kStiffness || p.kind == Parameter::Kind::kNeutral) &&
        !setup.joint_forces.stiffness)
      throw UsageError(
          fmt::format("--parameters: {} acts only with --joint-forces stiffness", p.name));
}

}  // namespace

Setup resolve(Model model, const FunctionOptions& options) {
  Setup setup;
  for (const Joint& joint : model.joints)
    if (nv(joint.type) > 0) setup.moving.push_back(joint.child);
  setup.frames = options.frames.empty() ? frames_of(model, setup.moving)
                                        : links_called(model, options.frames, "--frames");
  setup.loads = links_called(model, options.external_forces, "--external-forces");
  setup.axes = options.axes;
  setup.transform_order = options.transform_order;
  setup.joint_forces = options.joint_forces;
  setup.parameters = resolve_parameters(model, options.parameters);
  check_springs(setup);
  setup.iterated = options.iterated;
  setup.simplify = options.simplify;
  setup.optimise = options.optimise;
  setup.max_function_size = options.max_function_size;
  const Coordinates at = coordinates(model);
  setup.nq = at.nq;
  setup.nv = at.nv;
  setup.model = std::move(model);
  return setup;
}

DynamicTree lower(const Setup& setup, const LoweringOptions& options) {
  return lower(setup.model, options, numbers(setup.model, setup.joint_forces));
}

}  // namespace arboc
