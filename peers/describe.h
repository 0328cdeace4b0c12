// Model -> Body: what peers are built from.
#pragma once
#include <vector>

#include "body.hpp"
#include "model/model.h"

namespace arboc {

struct Described {
  std::vector<peers::Joint> joints;
  std::vector<peers::Link> links;
  int nq = 0, nv = 0;

  /// Refers to this object.
  peers::Body body(const Model& model) const;
};

/// Of a configured model; mimic joints are taken as independent.  Empty joints and links if the
/// model has joints that no peer knows (spherical ones, angles as cosine and sine).
Described describe(const Model& model);

}  // namespace arboc
