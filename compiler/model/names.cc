#include "model/names.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/words.h"
#include "model/findings.h"

namespace arboc {
namespace {

template <class Item>
int index_of(const std::vector<Item>& items, const std::string& name, const char* kind,
             const char* option) {
  const auto found =
      std::find_if(items.begin(), items.end(), [&](const Item& i) { return i.name == name; });
  if (found != items.end()) return static_cast<int>(found - items.begin());
  constexpr size_t kShown = 8;
  std::vector<std::string_view> known;
  std::string list;
  for (const Item& item : items) {
    if (known.size() < kShown) list += (known.empty() ? "" : ", ") + quoted(item.name);
    known.push_back(item.name);
  }
  if (known.size() > kShown) list += ", ...";
  const std::string meant = nearest(name, known);
  const std::string hint = !meant.empty()  ? fmt::format("did you mean {}?", quoted(meant))
                           : known.empty() ? "there is none"
                                           : "known are " + list;
  throw UsageError(
      printable(fmt::format("{}: there is no {} {} ({})", option, kind, quoted(name), hint)));
}

}  // namespace

int link_called(const Model& model, const std::string& name, const char* option) {
  return index_of(model.links, name, "link", option);
}

int joint_called(const Model& model, const std::string& name, const char* option) {
  return index_of(model.joints, name, "joint", option);
}

}  // namespace arboc
