#include "fixed_model.h"

#include <algorithm>
#include <stdexcept>

namespace study {
namespace {

int find(const std::vector<std::string>& names, const std::string& wanted,
         const std::string& what) {
  const auto at = std::find(names.begin(), names.end(), wanted);
  if (at != names.end()) return static_cast<int>(at - names.begin());
  std::string known;
  for (const std::string& n : names) known += (known.empty() ? "" : ", ") + n;
  throw std::invalid_argument("there is no " + what + " '" + wanted + "'; there are " + known);
}

}  // namespace

int FixedModel::joint(const std::string& wanted) const { return find(joints, wanted, "joint"); }
int FixedModel::frame(const std::string& wanted) const { return find(frames, wanted, "frame"); }

}  // namespace study
