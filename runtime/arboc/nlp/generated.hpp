// Functions that arboc generates, as functions of a problem.
//
//   arboc compile ur5.urdf -o generated --functions statics --jacobian statics.tau:q,f_ext
//     --hessian statics.tau:q,f_ext --external-forces hand --axes aligned
//   #include <ur5/ur5_batch.hpp>
//   auto statics = std::make_shared<nlp::Generated<
//       ur5::statics_fn, ur5::statics_tau_jacobian_q_f_ext_fn,
//       ur5::statics_tau_hessian_q_f_ext_fn>>();
// The inputs of the function are those by which derivatives are taken, one behind the other (q,
// then f_ext); what else the generated functions ask for is a parameter, the same at all points.
#ifndef ARBOC_NLP_GENERATED_HPP
#define ARBOC_NLP_GENERATED_HPP

#include <algorithm>
#include <arboc/team.hpp>
#include <array>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>

#include "function.hpp"

namespace arboc {
inline namespace v1 {
namespace nlp {

/// `Value` has the output, `Jacobian` and `Hessian` are what --jacobian and --hessian make of it,
/// by the same inputs.
template <class Value, class Jacobian, class Hessian>
class Generated : public Function {
 public:
  Generated() {
    find_output();
    for (int k = 0; k < Value::inputs; ++k) {
      const std::string name = Value::input_name[k];
      if (column_of("d" + output_ + "_d" + name) < 0) {
        parameters_[name].assign(static_cast<std::size_t>(Value::input_size[k]), 0);
        continue;
      }
      first_[name] = inputs_;
      inputs_ += Value::input_size[k];
    }
    lay_out_jacobian();
    lay_out_hessian();
    use_threads(1);
  }

  int inputs() const override { return inputs_; }
  int outputs() const override { return outputs_; }
  const Pattern& jacobian_pattern() const override { return jacobian_; }
  const Pattern& hessian_pattern() const override { return hessian_; }

  void values(int n, const double* x, double* y) override {
    share_out(n, [&](int s, int member) {
      std::array<double*, Value::outputs> out;
      double* other = scratch_[static_cast<std::size_t>(member)].data();
      for (int k = 0; k < Value::outputs; other += Value::output_size[k++])
        out[k] = k == output_index_ ? y + s * outputs_ : other;
      Value::template call<double>(in<Value>(x + s * inputs_, nullptr).data(), out.data());
    });
  }
  void jacobian(int n, const double* x, double* entries) override {
    share_out(n, [&](int s, int) {
      call<Jacobian>(x + s * inputs_, nullptr, entries + s * jacobian_.size());
    });
  }
  void hessian(int n, const double* x, const double* weights, double* entries) override {
    share_out(n, [&](int s, int) {
      double* to = entries + s * hessian_.size();
      call<Hessian>(x + s * inputs_, weights + s * outputs_, to);
      if (weighted_) return;
      for (std::size_t k = 0; k < hessian_.size(); ++k) to[k] *= weights[s];
    });
  }
  void use_threads(int count) override {
    team_ = std::make_unique<Team>(count);
    int entries = 0;
    for (const int size : Value::output_size) entries += size;
    scratch_.assign(static_cast<std::size_t>(count),
                    std::vector<double>(static_cast<std::size_t>(entries)));
  }

 private:
  /// Calls job(point, member of the team) for n points.
  template <class Job>
  void share_out(int n, const Job& job) {
    const int members = n < 2 * team_->size() ? 1 : team_->size();
    const auto part = [&](int member) {
      for (int s = n * member / members; s < n * (member + 1) / members; ++s) job(s, member);
    };
    if (members == 1) return part(0);
    team_->run(part);
  }
  template <class F>
  std::array<const double*, F::inputs> in(const double* x, const double* weights) const {
    std::array<const double*, F::inputs> pointers;
    for (int k = 0; k < F::inputs; ++k) {
      const std::string name = F::input_name[k];
      const auto own = first_.find(name);
      if (own != first_.end())
        pointers[k] = x + own->second;
      else
        pointers[k] = name == "lambda" ? weights : parameters_.at(name).data();
    }
    return pointers;
  }
  template <class F>
  void call(const double* x, const double* weights, double* entries) const {
    std::array<double*, F::outputs> out;
    for (int k = 0; k < F::outputs; entries += F::output_size[k++]) out[k] = entries;
    F::template call<double>(in<F>(x, weights).data(), out.data());
  }

  static int column_of(const std::string& name) {
    for (int k = 0; k < Jacobian::outputs; ++k)
      if (name == Jacobian::output_name[k]) return k;
    return -1;
  }
  void find_output() {
    for (int k = 0; k < Value::outputs; ++k) {
      const std::string prefix = std::string("d") + Value::output_name[k] + "_d";
      if (std::string(Jacobian::output_name[0]).rfind(prefix, 0) != 0) continue;
      if (Value::output_row[k]) throw std::logic_error("outputs of problems are dense");
      output_ = Value::output_name[k];
      output_index_ = k;
      outputs_ = Value::output_size[k];
      return;
    }
    throw std::logic_error(std::string(Jacobian::name) + " is no Jacobian of " + Value::name);
  }

  template <class F>
  static void append(int k, int first_row, int first_col, Pattern& pattern) {
    for (int e = 0; e < F::output_size[k]; ++e) {
      const int row = F::output_row[k] ? F::output_row[k][e] : e / F::output_cols[k];
      const int col = F::output_col[k] ? F::output_col[k][e] : e % F::output_cols[k];
      pattern.push(first_row + row, first_col + col);
    }
  }
  void lay_out_jacobian() {
    for (int k = 0; k < Jacobian::outputs; ++k) {
      const std::string name = Jacobian::output_name[k];
      append<Jacobian>(k, 0, first_.at(name.substr(output_.size() + 3)), jacobian_);
    }
  }
  void lay_out_hessian() {
    for (int k = 0; k < Hessian::outputs; ++k) {
      Pattern block;
      for (const auto& [x, row] : first_) {
        for (const auto& [y, col] : first_) {
          if (std::string("H_") + x + y != Hessian::output_name[k]) continue;
          if (x == y && !Hessian::output_symmetric[k])
            throw std::logic_error("iterated Hessians are not those of a problem");
          append<Hessian>(k, row, col, block);
        }
      }
      if (static_cast<int>(block.size()) != Hessian::output_size[k])
        throw std::logic_error(std::string(Hessian::name) + " is by other inputs");
      for (std::size_t e = 0; e < block.size(); ++e)
        hessian_.push(std::max(block.row[e], block.col[e]), std::min(block.row[e], block.col[e]));
    }
    for (int k = 0; k < Hessian::inputs; ++k)
      weighted_ = weighted_ || std::string("lambda") == Hessian::input_name[k];
  }

  std::string output_;
  int output_index_ = 0, inputs_ = 0, outputs_ = 0;
  bool weighted_ = false;
  std::map<std::string, int> first_;  ///< of each input by which derivatives are taken
  std::map<std::string, std::vector<double>> parameters_;
  std::unique_ptr<Team> team_;
  std::vector<std::vector<double>> scratch_;  ///< of each member: outputs that nobody wants
  Pattern jacobian_, hessian_;
};

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_NLP_GENERATED_HPP
