// The larger steps of configure(), each in a file of its name.
#pragma once
#include <string>
#include <vector>

#include "model/model.h"

namespace arboc {

/// Makes the named joints and the followers of these fixed joints, whose placements take up where
/// they stand.  Warns of places beyond a joint's limits.  Throws UsageError for an unknown joint,
/// one that cannot be locked, and a wrong number of coordinates.
void lock_joints(Model& model, const std::vector<Lock>& locks, Diagnostics& diagnostics);

/// Drops all but the subtree of the link `root` (empty: of model.root), which becomes the root, and
/// if there are tips, all but the links on the paths to these and what is welded to a kept link.
/// Says in a note what was dropped.  Throws UsageError for unknown links and for tips that do not
/// hang on the root, InputError if a kept joint follows a dropped one.
void keep_subchain(Model& model, const std::string& root, const std::vector<std::string>& tips,
                   Diagnostics& diagnostics);

/// Hangs the body from the link: the joints between it and the root are reversed, with the same
/// coordinates, names and frames of links; what held the root (the world, or the joints of a free
/// root) holds the link.  Throws UsageError for an unknown link and for planar, floating and
/// spherical joints on the way.
void reroot(Model& model, const std::string& link);

/// Planar, floating and spherical joints become multi-axis ones that reach the same places: planar
/// x, y, then a turn about its axis; floating x, y, z, then turns about z, y, x; spherical turns
/// about z, y, x.  Says so in notes.
void expand_joints(Model& model, Diagnostics& diagnostics);

/// Makes chains of joints with one freedom each, and massless links between, of joints of several
/// axes; of a helical joint a slide that follows the turn behind it.  A joint NAME that moves LINK
/// becomes NAME.1 and so on, or what the axes are called, through LINK.1 and so on; the turn of a
/// helical joint keeps its name, the slide is NAME.slide.  `model` is sorted, and afterwards is
/// not.
void split_joints(Model& model);

/// Continuous joints become unbounded ones, but for those that follow another or are followed.
void unbind_continuous_joints(Model& model, Diagnostics& diagnostics);

}  // namespace arboc
