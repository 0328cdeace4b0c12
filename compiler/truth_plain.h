// The functions of the catalogue that are not derivatives, by the reference engine on any scalar.
#pragma once
#include <map>
#include <string>

#include "functions/setup.h"
#include "reference/differentiate.h"
#include "reference/frames.h"
#include "reference/momentum.h"
#include "reference/regressor.h"
#include "reference/transforms.h"

namespace arboc::truth {

template <class S>
using Arguments = std::map<std::string, VectorOf<S>>;

template <class S, class M>
VectorOf<S> by_rows(const M& matrix) {
  const MatrixOf<S> transposed = matrix.transpose();
  return transposed.reshaped();
}

/// Moves one input by a tangent vector.
template <class S>
Arguments<S> moved(const ReferenceOf<S>& reference, Arguments<S> in, const std::string& name,
                   const VectorOf<S>& step) {
  VectorOf<S>& x = in.at(name);
  x = name == "q" || name == "q1" ? reference.integrate(x, step) : VectorOf<S>(x + step);
  return in;
}

/// The functions of the catalogue that are not derivatives, on any scalar.
template <class S>
class Plain {
 public:
  Plain(const Setup& setup, const Model& model)
      : setup_(setup), free_(model), reference_(model, setup.joint_forces) {}

  Arguments<S> operator()(const std::string& function, const Arguments<S>& in) const {
    const auto& q = in.at("q");
    if (function == "fk") return {{"placements", placements(in)}};
    if (function == "rnea") return {{"tau", reference_.rnea(q, in.at("v"), in.at("a"), loads(in))}};
    if (function == "gravity") return {{"g", free_.gravity(q)}};
    if (function == "statics") {
      const VectorOf<S> rest = VectorOf<S>::Zero(setup_.nv);
      return {{"tau", reference_.rnea(q, rest, rest, loads(in))}};
    }
    if (function == "nle") return {{"nle", reference_.nle(q, in.at("v"), loads(in))}};
    if (function == "crba") return {{"M", by_rows<S>(reference_.crba(q))}};
    if (function == "minv") return {{"Minv", by_rows<S>(reference_.minv(q))}};
    if (function == "aba") return {{"qdd", reference_.aba(q, in.at("v"), in.at("tau"), loads(in))}};
    if (function == "com")
      return {{"c", com(free_, q)}, {"vc", com_velocity(free_, q, in.at("v"))}};
    if (function == "com_jacobian") return {{"Jc", by_rows<S>(com_jacobian(free_, q))}};
    if (function == "joint_jacobians") return {{"J_world", by_rows<S>(joint_jacobians(free_, q))}};
    if (function == "energy")
      return {{"T", VectorOf<S>::Constant(1, free_.kinetic(q, in.at("v")))},
              {"V", VectorOf<S>::Constant(1, free_.potential(q))}};
    if (function == "centroidal") {
      const CentroidalOf<S> all = centroidal(free_, q, in.at("v"), in.at("a"));
      return {{"h", all.h}, {"A_G", by_rows<S>(all.A_G)}, {"dh", all.dh}};
    }
    if (function == "regressor")
      return {{"Y", by_rows<S>(regressor(free_, q, in.at("v"), in.at("a")))}};
    if (function == "transforms") return transforms(q);
    if (function == "integrate") return {{"q_next", free_.integrate(q, in.at("v"))}};
    if (function == "difference") return {{"d", free_.difference(q, in.at("q1"))}};
    return frames(function, in);
  }

 private:
  VectorOf<S> placements(const Arguments<S>& in) const {
    VectorOf<S> out(static_cast<Eigen::Index>(12 * setup_.frames.size()));
    const auto links = free_.fk(in.at("q"));
    Eigen::Index k = 0;
    for (const int frame : setup_.frames) {
      const auto& T = links[static_cast<size_t>(frame)];
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) out[k++] = T.R(r, c);
      for (int r = 0; r < 3; ++r) out[k++] = T.p(r);
    }
    return out;
  }

  /// Four rows a frame; blocks of four columns a coordinate, pair j <= k, triple j <= k <= l.
  Arguments<S> transforms(const VectorOf<S>& q) const {
    const int n = setup_.nv;
    const int blocks[] = {1, 1, n, n * (n + 1) / 2, n * (n + 1) * (n + 2) / 6};
    std::vector<MatrixOf<S>> all;
    for (int k = 0; k < 2 + setup_.transform_order; ++k)
      all.push_back(MatrixOf<S>::Zero(4 * static_cast<int>(setup_.frames.size()), 4 * blocks[k]));
    for (size_t f = 0; f < setup_.frames.size(); ++f) {
      const TransformsOf<S> link(free_, q, setup_.frames[f]);
      const auto block = [&](size_t k, int at) {
        return all[k].template block<4, 4>(static_cast<Eigen::Index>(4 * f), 4 * at);
      };
      block(0, 0) = link.T();
      block(1, 0) = link.inverse();
      for (int l = 0; l < n && all.size() > 2; ++l) {
        block(2, l) = link.derivative({l});
        for (int k = 0; k <= l && all.size() > 3; ++k) {
          block(3, l * (l + 1) / 2 + k) = link.derivative({k, l});
          for (int j = 0; j <= k && all.size() > 4; ++j)
            block(4, l * (l + 1) * (l + 2) / 6 + k * (k + 1) / 2 + j) = link.derivative({j, k, l});
        }
      }
    }
    const char* names[] = {"T", "T_inverse", "dT", "d2T", "d3T"};
    Arguments<S> out;
    for (size_t k = 0; k < all.size(); ++k) out[names[k]] = by_rows<S>(all[k]);
    return out;
  }

  Arguments<S> frames(const std::string& function, const Arguments<S>& in) const {
    const auto& q = in.at("q");
    const auto n = static_cast<Eigen::Index>(setup_.frames.size());
    const bool matrix = function.starts_with("frame_jacobian");
    VectorOf<S> out(n * 6 * (matrix ? setup_.nv : 1));
    for (Eigen::Index k = 0; k < n; ++k) {
      const int link = setup_.frames[static_cast<size_t>(k)];
      const Axes axes = setup_.axes;
      VectorOf<S> part;
      if (function == "frame_velocity") part = frame_velocity(free_, q, in.at("v"), link, axes);
      if (function == "frame_acceleration")
        part = frame_acceleration(free_, q, in.at("v"), in.at("a"), link, axes);
      if (function == "frame_jacobian") part = by_rows<S>(frame_jacobian(free_, q, link, axes));
      if (function == "frame_jacobian_dot")
        part = by_rows<S>(frame_jacobian_dot(free_, q, in.at("v"), link, axes));
      if (part.size() == 0) throw std::logic_error("no reference for " + function);
      out.segment(k * part.size(), part.size()) = part;
    }
    const char* name = function == "frame_velocity"       ? "velocity"
                       : function == "frame_acceleration" ? "acceleration"
                       : function == "frame_jacobian"     ? "J"
                                                          : "dJ";
    return {{name, out}};
  }

  Loads loads(const Arguments<S>& in) const {
    Loads loads;
    for (size_t k = 0; k < setup_.loads.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(6 * k);
      loads.push_back({setup_.loads[k], setup_.axes, real(in.at("f_ext").segment(at, 6))});
    }
    return loads;
  }
  template <class X>
  static Eigen::Matrix<double, 6, 1> real(const X& x) {
    return x.real();
  }

  const Setup& setup_;
  ReferenceOf<S> free_;       ///< without the joints' own forces
  ReferenceOf<S> reference_;  ///< with those of the setup
};

/// The model with the parameters of a state.
template <class S>
Model model_of(const Setup& setup, const Arguments<S>& in) {
  std::vector<std::vector<double>> values;
  for (const Parameter& p : setup.parameters) {
    const Eigen::VectorXd x = in.at(p.name).real();
    values.emplace_back(x.begin(), x.end());
  }
  return model_with(setup.model, setup.parameters, values);
}

template <class S>
Arguments<S> plain(const std::string& function, const Setup& setup, const Arguments<S>& in) {
  return Plain<S>(setup, model_of(setup, in))(function, in);
}

}  // namespace arboc::truth
