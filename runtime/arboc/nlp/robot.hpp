// What problems need to know of a robot, from the folder that arboc generated for it.
//
//   arboc compile hero.urdf -o generated --base floating --expand --axes aligned
//     --external-forces left_foot,right_foot --joint-forces stiffness
//     --functions fk,statics --jacobian fk.placements:q --hessian fk.placements:q
//     --jacobian statics.tau:q,f_ext --hessian statics.tau:q,f_ext
//   #include <hero/hero_batch.hpp>
//   const arboc::nlp::Robot robot = ARBOC_NLP_ROBOT(hero);
// Coordinates are single (--expand): a step in q is a sum.  Motions also need, of this folder or
// another one,
//     --functions rnea --jacobian rnea.tau:q,v,a,f_ext --hessian rnea.tau:q,v,a,f_ext
//     --scalars double4
//   robot.dynamics = ARBOC_NLP_DYNAMICS(hero, 4);   // in lanes, 4 instants at a time
#ifndef ARBOC_NLP_ROBOT_HPP
#define ARBOC_NLP_ROBOT_HPP

#include <map>
#include <memory>

#include "generated.hpp"

namespace arboc {
inline namespace v1 {
namespace nlp {

struct Robot {
  std::string name;
  std::vector<std::string> coordinates;                 ///< one name an entry of q
  std::vector<double> q_lower, q_upper;                 ///< rad, m
  std::vector<double> tau_lower, tau_upper;             ///< N m, N
  std::vector<std::string> frames, loads;               ///< of placements, of f_ext
  std::shared_ptr<Function> placements;                 ///< q -> 12 a frame: R by rows, p
  std::shared_ptr<Function> statics;                    ///< q, f_ext -> tau
  std::shared_ptr<Function> dynamics;                   ///< q, v, a, f_ext -> tau; may be null
  std::map<std::string, std::vector<double>> postures;  ///< q by name

  int size() const { return static_cast<int>(coordinates.size()); }
  /// Indices; std::invalid_argument says which names there are, and how to have another.
  int coordinate(const std::string& wanted) const;
  int frame(const std::string& wanted) const;
  int load(const std::string& wanted) const;
};

/// The tables of a generated header.
struct RobotTables {
  const char* name;
  int nq, nv;
  const char* const* coordinates;
  const double *q_lower, *q_upper, *tau_lower, *tau_upper;
  int frame_count;
  const char* const* frames;
  int load_count;
  const char* const* loads;
};

/// Throws std::invalid_argument where a coordinate is not single.
Robot robot_of(const RobotTables& tables, std::shared_ptr<Function> placements,
               std::shared_ptr<Function> statics);

#define ARBOC_NLP_ROBOT(ns)                                                                        \
  ::arboc::nlp::robot_of(                                                                          \
      ::arboc::nlp::RobotTables{#ns, ns::nq, ns::nv, ns::velocity_names, ns::q_lower, ns::q_upper, \
                                ns::tau_lower, ns::tau_upper, ns::frame::count, ns::frame::names,  \
                                ns::load::count, ns::load::names},                                 \
      ::std::make_shared<::arboc::nlp::Generated<ns::fk_fn, ns::fk_placements_jacobian_q_fn,       \
                                                 ns::fk_placements_hessian_q_fn>>(),               \
      ::std::make_shared<                                                                          \
          ::arboc::nlp::Generated<ns::statics_fn, ns::statics_tau_jacobian_q_f_ext_fn,             \
                                  ns::statics_tau_hessian_q_f_ext_fn>>())

#define ARBOC_NLP_DYNAMICS(ns, lanes)                                                           \
  ::std::make_shared<::arboc::nlp::Generated<ns::rnea_fn, ns::rnea_tau_jacobian_q_v_a_f_ext_fn, \
                                             ns::rnea_tau_hessian_q_v_a_f_ext_fn, lanes>>()

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_NLP_ROBOT_HPP
