// Where equations are asked for.
#include <algorithm>
#include <cmath>

#include "build.h"

namespace motion {
namespace {

using arboc::BSplineBasis;
using Eigen::VectorXd;

/// Instants of q's and of reactions' free control points; these may be at an end.
std::vector<Frames::Frame> greville_frames(const Ends& ends, const BSplineBasis& q,
                                           const BSplineBasis& reactions) {
  std::vector<Frames::Frame> all;
  const double near = 1e-9 * (q.end() - q.begin());
  const VectorXd places = q.greville(), r = reactions.greville();
  for (Eigen::Index k = ends.fixed(0); k < places.size() - ends.fixed(1); ++k)
    all.push_back({places[k], true, true, 0});
  for (Eigen::Index k = 0; k < r.size(); ++k) {
    const bool first = k == 0, last = k == r.size() - 1;
    const bool known = (first && ends.all(0)) || (last && ends.all(1));
    if (!known && std::none_of(all.begin(), all.end(), [&](const Frames::Frame& f) {
          return std::fabs(f.t - r[k]) < near;
        }))
      all.push_back({r[k], true, false, 0});
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
  return all;
}

/// Frames of torques only, without a share in means, so that these stay what they are.
void watch(const std::vector<double>& instants, std::vector<Frames::Frame>& all) {
  for (const double t : instants) all.push_back({t, false, false, 0});
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
}

}  // namespace

Frames frames_of(const Task& task, const Ends& ends, const BSplineBasis& q,
                 const BSplineBasis& reactions) {
  Frames frames;
  std::vector<Frames::Frame> given;
  if (const int n = task.search.frames; n > 0) {
    if (!ends.all(0)) given.push_back({q.begin(), true, false, 0});
    for (int k = 1; k <= n; ++k)
      given.push_back({q.begin() + (q.end() - q.begin()) * k / (n + 1), true, true, 0});
    if (!ends.all(1)) given.push_back({q.end(), true, false, 0});
    frames.exact = n <= q.size() - ends.fixed(0) - ends.fixed(1);
  } else {
    given = greville_frames(ends, q, reactions);
  }
  for (std::size_t k = 0; k <= given.size(); ++k) {
    const double from = k == 0 ? q.begin() : given[k - 1].t;
    const double to = k == given.size() ? q.end() : given[k].t;
    for (int i = 1; i <= task.search.between; ++i)
      frames.all.push_back({from + (to - from) * i / (task.search.between + 1), false, false, 0});
    if (k < given.size()) frames.all.push_back(given[k]);
  }
  const std::size_t n = frames.all.size();
  for (std::size_t k = 0; k < n; ++k) {
    const double before = k == 0 ? q.begin() : frames.all[k - 1].t;
    const double after = k + 1 == n ? q.end() : frames.all[k + 1].t;
    frames.all[k].weight = (after - before) / 2 / (q.end() - q.begin());
  }
  watch(task.watched, frames.all);
  return frames;
}

}  // namespace motion
