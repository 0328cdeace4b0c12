#include "tree/numbering.h"

#include <fmt/format.h>

#include "base/diagnostic.h"
#include "base/number.h"
#include "tree/lower.h"

namespace arboc {
namespace {

bool is_zero(const Vector3<double>& a) { return a.x == 0 && a.y == 0 && a.z == 0; }

bool is_massless(const MassMoments& I) {
  return I.m == 0 && is_zero(I.h) && is_zero({I.Sigma.xx, I.Sigma.yy, I.Sigma.zz});
}

const char* type_of(const Model& model, const std::string& joint) {
  for (const Joint& j : model.joints)
    if (j.name == joint) return name(j.type);
  return "";
}

/// The name by which the author knows what joint i moves.
void name_links(const Model& model, const DynamicTree& tree, std::vector<NumberedLink>& links) {
  std::vector<bool> named(links.size());
  for (size_t k = 0; k < model.links.size(); ++k) {
    const int body = tree.frame[k].body;
    if (body == 0 || !model.links[k].reported || named[static_cast<size_t>(body - 1)]) continue;
    links[static_cast<size_t>(body - 1)].link = model.links[k].name;
    named[static_cast<size_t>(body - 1)] = true;
  }
}

}  // namespace

std::vector<NumberedLink> number_links(const Model& model) {
  const DynamicTree tree = lower(model, LoweringOptions{});
  std::vector<NumberedLink> links;
  std::vector<bool> has_length(tree.body.size());
  for (int i = 1; i <= tree.nb(); ++i) {
    const BodyOf<double>& body = tree.body[static_cast<size_t>(i)];
    NumberedLink link{body.joint, body.link, type_of(model, body.joint), body.parent - 1};
    link.mass = body.inertia.m;
    link.dummy = is_massless(body.inertia);
    if (!is_zero(body.c)) has_length[static_cast<size_t>(body.parent)] = true;
    if (link.parent >= 0) links[static_cast<size_t>(link.parent)].branches.push_back(i - 1);
    links.push_back(std::move(link));
  }
  for (size_t i = 0; i < links.size(); ++i) links[i].dummy = links[i].dummy && !has_length[i + 1];
  name_links(model, tree, links);
  return links;
}

std::string print(const std::vector<NumberedLink>& links) {
  int dummies = 0;
  for (const NumberedLink& link : links) dummies += link.dummy ? 1 : 0;
  std::string out = fmt::format("dynamic tree: {} joints, {} links of which {} {} dummy\n",
                                links.size(), links.size(), dummies, dummies == 1 ? "is" : "are");
  out += fmt::format("{:<5} {:<20} {:<11} {:<5} {:<5} {:<20} {:<12} {}\n", "joint", "", "", "on",
                     "link", "", "mass", "branch joints");
  for (size_t i = 0; i < links.size(); ++i) {
    const NumberedLink& link = links[i];
    std::string branches;
    for (const int b : link.branches)
      branches += fmt::format("{}J{}", branches.empty() ? "" : " ", b);
    out += fmt::format("{:<5} {:<20} {:<11} {:<5} {:<5} {:<20} {:<12} {}\n", fmt::format("J{}", i),
                       printable(link.joint), link.type,
                       link.parent < 0 ? "null" : fmt::format("L{}", link.parent),
                       fmt::format("L{}", i), printable(link.link),
                       link.dummy ? "dummy" : shortest(link.mass) + " kg",
                       branches.empty() ? "null" : branches);
  }
  return out;
}

}  // namespace arboc
