#include "reference/transforms.h"

#include <algorithm>

namespace arboc {
namespace {

/// The 4x4 matrix of a twist whose angular part comes first.
template <class S>
Matrix4<S> generator_of(const spatial6::Vector6<S>& twist) {
  Matrix4<S> G = Matrix4<S>::Zero();
  G.template topLeftCorner<3, 3>() = spatial6::skew(twist.template head<3>());
  G.template topRightCorner<3, 1>() = twist.template tail<3>();
  return G;
}

template <class S>
Matrix4<S> homogeneous(const PlacementOf<S>& placement) {
  Matrix4<S> T = Matrix4<S>::Identity();
  T.template topLeftCorner<3, 3>() = placement.R;
  T.template topRightCorner<3, 1>() = placement.p;
  return T;
}

}  // namespace

template <class S>
TransformsOf<S>::TransformsOf(const ReferenceOf<S>& reference, const VectorOf<S>& q, int link) {
  std::vector<int> chain;
  for (int i = link + 1; i > 0; i = reference.bodies()[i].parent) chain.push_back(i);
  std::reverse(chain.begin(), chain.end());
  factors_ = chain.size();
  std::vector<Matrix4<S>> factors;
  for (const int i : chain) {
    const auto& body = reference.bodies()[i];
    factors.push_back(homogeneous<S>(body.T_tree * joint_placement(body.joint, body.positions(q))));
    for (int d = 0; d < body.motion.cols(); ++d)
      steps_.push_back({static_cast<int>(factors.size()), body.at.v + d,
                        generator_of<S>(body.at.multiplier * body.motion.col(d))});
  }
  products_.resize((factors_ + 1) * (factors_ + 1));
  for (size_t from = 0; from <= factors_; ++from) {
    Matrix4<S> product = Matrix4<S>::Identity();
    for (size_t to = from; to <= factors_; ++to) {
      if (to > from) product = (product * factors[to - 1]).eval();
      products_[from * (factors_ + 1) + to] = product;
    }
  }
  for (const Step& step : steps_) coordinates_.push_back(step.coordinate);
  std::sort(coordinates_.begin(), coordinates_.end());
  coordinates_.erase(std::unique(coordinates_.begin(), coordinates_.end()), coordinates_.end());
}

template <class S>
Matrix4<S> TransformsOf<S>::inverse() const {
  const Matrix4<S>& forward = between(0, size());
  PlacementOf<S> back;
  back.R = forward.template topLeftCorner<3, 3>().transpose();
  back.p = -(back.R * forward.template topRightCorner<3, 1>());
  return homogeneous(back);
}

/// Each generator behind its factor; those of one factor in all orders, and the mean of these.
template <class S>
Matrix4<S> TransformsOf<S>::product(std::vector<const Step*> steps) const {
  std::vector<size_t> order(steps.size());
  for (size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::stable_sort(steps.begin(), steps.end(),
                   [](const Step* a, const Step* b) { return a->factor < b->factor; });
  Matrix4<S> sum = Matrix4<S>::Zero();
  int count = 0;
  do {
    bool along_chain = true;
    Matrix4<S> one = Matrix4<S>::Identity();
    int done = 0;
    for (size_t k = 0; k < order.size(); ++k) {
      const Step& step = *steps[order[k]];
      along_chain = along_chain && done <= step.factor;
      if (!along_chain) break;
      one = (one * between(done, step.factor) * step.generator).eval();
      done = step.factor;
    }
    if (!along_chain) continue;
    sum += one * between(done, size());
    ++count;
  } while (std::next_permutation(order.begin(), order.end()));
  return sum / static_cast<double>(count);
}

template <class S>
Matrix4<S> TransformsOf<S>::derivative(const std::vector<int>& along) const {
  std::vector<std::vector<const Step*>> choices(1);
  for (const int coordinate : along) {
    std::vector<std::vector<const Step*>> longer;
    for (const auto& choice : choices)
      for (const Step& step : steps_)
        if (step.coordinate == coordinate) {
          longer.push_back(choice);
          longer.back().push_back(&step);
        }
    choices = std::move(longer);
  }
  Matrix4<S> sum = Matrix4<S>::Zero();
  for (const auto& choice : choices) sum += product(choice);
  return sum;
}

template class TransformsOf<double>;
template class TransformsOf<Complex>;

}  // namespace arboc
