#include "tree/draft.h"

#include "tree/mass_moments.h"
#include "tree/tallied.h"

namespace arboc {

void reframe(Draft& draft, const std::vector<Reframe>& frames) {
  for (size_t i = 1; i < draft.body.size(); ++i) {
    DraftBody& b = draft.body[i];
    const Reframe& own = frames[i];
    const Reframe& parent = frames[static_cast<size_t>(b.body.parent)];
    const Matrix3<double> down = transpose(parent.Q);
    const Vector3<double> c = place(b.R, own.t, b.body.c);
    b.body.c = place(down, clean(tallied(c) - tallied(parent.t)), {});
    b.R = rotate(down, rotate(b.R, own.Q));
    b.axis = clean_unit(transpose(own.Q)) * b.axis;
    const Matrix3<double> Qt = transpose(own.Q);
    b.body.inertia = move(b.body.inertia, Qt, place(Qt, -own.t, {}));
  }
  for (Frame& frame : draft.frame) {
    const Reframe& body = frames[static_cast<size_t>(frame.body)];
    const Matrix3<double> Qt = transpose(body.Q);
    frame.p = place(Qt, clean(tallied(frame.p) - tallied(body.t)), {});
    frame.R = rotate(Qt, frame.R);
  }
}

}  // namespace arboc
