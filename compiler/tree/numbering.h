// The dynamic tree in the terms of [Astronaut] section 2: joints J0, J1, ..., links L0, L1, ...
//
// The base is the null link; the joint on it is J0.  Link Li is the one that joint Ji moves, its
// root joint; the joints that Li carries are its branch joints.  Numbers are a preorder: a link's
// root joint is before its branch joints, and all of a left branch before a right one.  A dummy
// link has no length, mass or inertia: it stands between the joints that were one of several axes,
// or at the end of a branch.
#pragma once
#include <string>
#include <vector>

#include "model/model.h"
#include "tree/dynamic_tree.h"

namespace arboc {

/// Joint Ji and link Li.
struct NumberedLink {
  std::string joint, link;  ///< names in the model; of the link its first reported frame, if any
  std::string type;         ///< revolute, prismatic, floating, ...
  int parent = -1;          ///< the link that carries the joint; -1: the null link
  std::vector<int> branches{};
  double mass = 0;  ///< kg, with everything welded to it
  bool dummy = false;
};

/// `model` is configured.  Item i is Ji and Li.
std::vector<NumberedLink> number_links(const Model& model);

/// A line a link: `J3  hip.z  revolute  on L2  L3  thigh  4.5 kg  J4`.
std::string print(const std::vector<NumberedLink>& links);

/// A picture: links are boxes, dummy links dashed ones, joints circles on the lines between.
std::string draw_svg(const std::string& title, const std::vector<NumberedLink>& links);

}  // namespace arboc
