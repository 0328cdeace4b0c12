#include "functions/arguments.h"

#include <fmt/format.h>

#include <cstdint>

#include "base/diagnostic.h"

namespace arboc {
namespace {

constexpr const char* kForce = "N m, N";
constexpr const char* kForceMeaning =
    "joint forces; floating joints force, moment in the body frame";

const char* axes_meaning(Axes axes) {
  switch (axes) {
    case Axes::kLocal: return "at the frame's origin, along its axes";
    case Axes::kWorld: return "of the point at the world's origin, along the world's axes";
    case Axes::kAligned: return "at the frame's origin, along the world's axes";
  }
  return "";
}

Argument sparse(Argument a) {
  a.sparse = true;
  return a;
}
Argument symmetric(Argument a) {
  a.sparse = a.symmetric = true;
  return a;
}

/// Four rows a frame, and four columns a coordinate, pair or triple.
Argument transform_argument(const std::string& name, const Setup& setup) {
  constexpr std::int64_t kLargest = 1 << 23;  // dense entries: 64 MiB of doubles
  const std::int64_t n = setup.nv, frames = static_cast<std::int64_t>(setup.frames.size());
  std::int64_t blocks = 1;
  std::string meaning = "four rows a frame: rotation and origin in the world, and 0 0 0 1";
  if (name == "T_inverse") meaning = "four rows a frame: the inverse of T";
  if (name == "dT") {
    blocks = n;
    meaning = "four columns a coordinate k, from 4 k on: derivatives of T";
  } else if (name == "d2T") {
    blocks = n * (n + 1) / 2;
    meaning = "four columns a pair j <= k of coordinates, from 4 (k (k + 1)/2 + j) on";
  } else if (name == "d3T") {
    blocks = n * (n + 1) * (n + 2) / 6;
    meaning =
        "four columns a triple j <= k <= l of coordinates, from 4 (l (l + 1) (l + 2)/6 + k (k + "
        "1)/2 + j) on";
  }
  if (16 * frames * blocks > kLargest)
    throw UsageError(fmt::format(
        "transforms: {} of {} coordinates and {} frames would have {} entries, more than {}: name "
        "fewer --frames, or lower --transform-order",
        name, n, frames, 16 * frames * blocks, kLargest));
  return {name, static_cast<int>(4 * frames), static_cast<int>(4 * blocks), "1, m", meaning, true};
}

Argument scalar(Argument a) {
  a.scalar = true;
  return a;
}

}  // namespace

Argument input_argument(const std::string& name, const Setup& setup) {
  if (name == "q" || name == "q1")
    return {
        name, setup.nq, 1, "rad, m",
        name == "q" ? "configuration; quaternions x y z w of length 1" : "another configuration"};
  if (name == "v")
    return {name, setup.nv, 1, "rad/s, m/s",
            "velocity; floating joints linear, angular in the body frame"};
  if (name == "a") return {name, setup.nv, 1, "rad/s^2, m/s^2", "time derivative of v"};
  if (name == "f_ext")
    return {name, static_cast<int>(6 * setup.loads.size()), 1, "N, N m",
            fmt::format("per loaded frame the force and moment that act on it, {}",
                        axes_meaning(setup.axes))};
  if (name == "lambda") return {name, setup.nv, 1, "1", "weights of the entries of tau"};
  return {name, setup.nv, 1, kForce, kForceMeaning};
}

Argument parameter_argument(const Parameter& parameter) {
  return {parameter.name, static_cast<int>(parameter.nominal.size()), 1, parameter.unit,
          parameter.meaning};
}

Argument output_argument(const std::string& function, const std::string& name, const Setup& setup) {
  const int n = setup.nv, frames = static_cast<int>(setup.frames.size());
  const std::string axes = axes_meaning(setup.axes);
  if (function == "transforms") return transform_argument(name, setup);
  const auto square = [&](const char* unit, const std::string& meaning) {
    return sparse({name, n, n, unit, meaning});
  };
  if (name == "placements")
    return {name, frames, 12, "1, m",
            "one row a frame: rotation matrix (world from link, by rows), then origin in the "
            "world"};
  if (name == "velocity")
    return {name, frames, 6, "m/s, rad/s", "one row a frame: linear, angular; " + axes};
  if (name == "acceleration")
    return {name, frames, 6, "m/s^2, rad/s^2", "one row a frame: linear, angular; " + axes};
  if (name == "J" || name == "dJ")
    return sparse({name, 6 * frames, n, name == "J" ? "m, 1" : "m/s, 1/s",
                   "six rows a frame: linear, angular; " + axes});
  if (name == "J_world")
    return sparse({name, 6, n, "m, 1",
                   "linear, angular; of the point at the world's origin, along the world's axes"});
  if (name == "M")
    return symmetric({name, n, n, "kg m^2, kg m, kg", "kinetic energy is v M v / 2"});
  if (name == "Minv") return symmetric({name, n, n, "1/(kg m^2), 1/(kg m), 1/kg", "inverse of M"});
  if (name == "dtau_dq")
    return square("N m, N, N/m",
                  "derivative of tau with respect to q; floating and planar joints move along "
                  "their body's axes");
  if (name == "dtau_dv") return square("N m s, N s, N s/m", "derivative of tau with respect to v");
  if (name == "dqdd_dq")
    return square("1/s^2, m/s^2, 1/(m s^2)", "derivative of qdd with respect to q, as that of tau");
  if (name == "dqdd_dv") return square("1/s, m/s, 1/(m s)", "derivative of qdd with respect to v");
  if (name == "qdd") return {name, n, 1, "rad/s^2, m/s^2", "time derivative of v"};
  if (name == "c") return {name, 3, 1, "m", "centre of mass in the world"};
  if (name == "vc") return {name, 3, 1, "m/s", "its velocity, world axes"};
  if (name == "Jc") return sparse({name, 3, n, "m, 1", "world axes"});
  if (name == "h") return {name, 6, 1, "kg m/s, kg m^2/s", "linear, angular momentum, world axes"};
  if (name == "A_G") return sparse({name, 6, n, "kg m, kg, kg m^2", "h = A_G v"});
  if (name == "dh") return {name, 6, 1, "N, N m", "time derivative of h"};
  if (name == "T") return scalar({name, 1, 1, "J", "kinetic energy"});
  if (name == "V")
    return scalar(
        {name, 1, 1, "J", "potential energy; 0 with the centre of mass at the world's origin"});
  if (name == "Y")
    return sparse({name, n, static_cast<int>(10 * setup.moving.size()), "m/s^2, m^2/s^2, 1/s^2",
                   "ten columns a moving link: m, m c (3), Ixx Ixy Iyy Ixz Iyz Izz about the "
                   "origin of its frame, in its axes"});
  if (name == "q_next") return {name, setup.nq, 1, "rad, m", "configuration"};
  if (name == "d") return {name, n, 1, "rad, m", "tangent vector at q"};
  if (function.ends_with("_derivatives")) return square("1, m, 1/m", "between tangent vectors");
  return {name, n, 1, kForce, kForceMeaning};
}

int tangent_size(const Argument& argument, const Setup& setup) {
  if (argument.name == "q" || argument.name == "q1") return setup.nv;
  return argument.rows * argument.cols;
}

}  // namespace arboc
