#include "model/names.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/diagnostic.h"
#include "base/words.h"

namespace arboc {
namespace {

template <class Item>
int index_of(const std::vector<Item>& items, const std::string& name, const char* kind,
             const char* option) {
  const auto found =
      std::find_if(items.begin(), items.end(), [&](const Item& i) { return i.name == name; });
  if (found != items.end()) return static_cast<int>(found - items.begin());
  std::vector<std::string_view> known;
  for (const Item& item : items) known.push_back(item.name);
  throw UsageError(unknown(option, fmt::format("there is no {}", kind), name, known));
}

}  // namespace

int link_called(const Model& model, const std::string& name, const char* option) {
  return index_of(model.links, name, "link", option);
}

int joint_called(const Model& model, const std::string& name, const char* option) {
  return index_of(model.joints, name, "joint", option);
}

}  // namespace arboc
