#include "tree/axis_frames.h"

#include "model/model.h"
#include "tree/tallied.h"

namespace arboc {

void turn_axes_to_z(Draft& draft) {
  std::vector<Reframe> frames(draft.body.size());
  for (size_t i = 1; i < draft.body.size(); ++i)
    if (draft.body[i].body.motion != Motion::kFloating)
      frames[i].Q = clean_unit(axis_frame(draft.body[i].axis));
  reframe(draft, frames);
  for (DraftBody& b : draft.body) b.axis = {0, 0, 1};
}

}  // namespace arboc
