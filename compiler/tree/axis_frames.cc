#include "tree/axis_frames.h"

#include "model/model.h"

namespace arboc {

std::vector<Reframe> axis_frames(const Draft& draft) {
  std::vector<Reframe> frames(draft.body.size());
  for (size_t i = 1; i < draft.body.size(); ++i)
    if (!has_quaternion(draft.body[i].body.motion))
      frames[i].Q = clean_unit(axis_frame(draft.body[i].axis));
  return frames;
}

}  // namespace arboc
