// Functions that arboc generates, as functions of a problem.
//
//   arboc compile ur5.urdf -o generated --functions statics --jacobian statics.tau:q,f_ext
//     --hessian statics.tau:q,f_ext --external-forces hand --axes aligned
//   #include <ur5/ur5_batch.hpp>
//   auto statics = std::make_shared<nlp::Generated<
//       ur5::statics_fn, ur5::statics_tau_jacobian_q_f_ext_fn,
//       ur5::statics_tau_hessian_q_f_ext_fn>>();
// Many points go over threads, and with a number of lanes (Generated<..., 4>, --scalars double4)
// that many at a time in the lanes of vectors. The inputs of the function are those by which
// derivatives are taken, one behind the other (q, then f_ext); what else the generated functions
// ask for is a parameter, the same at all points.
#ifndef ARBOC_NLP_GENERATED_HPP
#define ARBOC_NLP_GENERATED_HPP

#include <algorithm>
#include <arboc/batch.hpp>
#include <array>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>

#include "function.hpp"

namespace arboc {
inline namespace v1 {
namespace nlp {

/// F at n points, one a row of each argument: one after the other, or N at a time.
template <class F, int N>
class Points {
 public:
  using Inputs = std::array<Rows<const double>, F::inputs>;
  using Outputs = std::array<Rows<double>, F::outputs>;

  explicit Points(int threads) : team_(N > 1 ? 1 : threads), batch_(N > 1 ? threads : 1) {}

  void evaluate(int n, const Inputs& in, const Outputs& out) {
    if (N > 1 && n > 1) return batch_.evaluate(static_cast<std::size_t>(n), in, out);
    const int members = n < 2 * team_.size() ? 1 : team_.size();
    const auto part = [&](int member) {
      for (int s = n * member / members; s < n * (member + 1) / members; ++s)
        one(static_cast<std::size_t>(s), in, out);
    };
    if (members == 1) return part(0);
    team_.run(part);
  }

 private:
  static void one(std::size_t s, const Inputs& in, const Outputs& out) {
    const double* from[F::inputs];
    double* to[F::outputs];
    for (std::size_t k = 0; k < F::inputs; ++k) from[k] = in[k].row(s, F::input_size[k]);
    for (std::size_t k = 0; k < F::outputs; ++k) to[k] = out[k].row(s, F::output_size[k]);
    F::template call<double>(from, to);
  }
  struct None {
    explicit None(int) {}
    void evaluate(std::size_t, const Inputs&, const Outputs&) {}
  };

  Team team_;
  std::conditional_t<(N > 1), Batch<F, double, N>, None> batch_;
};

/// `Value` has the output, `Jacobian` and `Hessian` are what --jacobian and --hessian make of it,
/// by the same inputs; N lanes.
template <class Value, class Jacobian, class Hessian, int N = 1>
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
    std::size_t others = 0;  // outputs that nobody wants
    for (const int size : Value::output_size) others += static_cast<std::size_t>(size);
    scratch_.resize(others * static_cast<std::size_t>(n));
    std::vector<Rows<double>> out;
    double* other = scratch_.data();
    for (int k = 0; k < Value::outputs; ++k) {
      out.emplace_back(k == output_index_ ? y : other);
      other += static_cast<std::ptrdiff_t>(n) * Value::output_size[k];
    }
    values_->evaluate(n, in<Value>(x, nullptr), array<Value>(out));
  }
  void jacobian(int n, const double* x, double* entries) override {
    jacobians_->evaluate(n, in<Jacobian>(x, nullptr), out<Jacobian>(entries, jacobian_.size()));
  }
  void hessian(int n, const double* x, const double* weights, double* entries) override {
    hessians_->evaluate(n, in<Hessian>(x, weights), out<Hessian>(entries, hessian_.size()));
    if (weighted_) return;
    for (int s = 0; s < n; ++s)
      for (std::size_t k = 0; k < hessian_.size(); ++k) *entries++ *= weights[s];
  }
  void use_threads(int count) override {
    // Values take less than it takes to wake a thread.
    values_ = std::make_unique<Points<Value, N>>(1);
    jacobians_ = std::make_unique<Points<Jacobian, N>>(count);
    hessians_ = std::make_unique<Points<Hessian, N>>(count);
  }

 private:
  template <class F>
  typename Points<F, N>::Inputs in(const double* x, const double* weights) const {
    return in<F>(x, weights, std::make_index_sequence<F::inputs>());
  }
  template <class F, std::size_t... K>
  typename Points<F, N>::Inputs in(const double* x, const double* weights,
                                   std::index_sequence<K...>) const {
    const auto rows = [&](const std::string& name) -> Rows<const double> {
      const auto own = first_.find(name);
      if (own != first_.end()) return {x + own->second, inputs_};
      if (name == "lambda") return {weights, outputs_};
      return {parameters_.at(name).data(), 0};
    };
    return {rows(F::input_name[K])...};
  }
  /// Outputs one behind the other, `stride` entries a point.
  template <class F>
  static typename Points<F, N>::Outputs out(double* entries, std::size_t stride) {
    std::vector<Rows<double>> rows;
    for (int k = 0; k < F::outputs; entries += F::output_size[k++])
      rows.emplace_back(entries, static_cast<std::ptrdiff_t>(stride));
    return array<F>(rows);
  }
  template <class F>
  static typename Points<F, N>::Outputs array(const std::vector<Rows<double>>& rows) {
    return array<F>(rows, std::make_index_sequence<F::outputs>());
  }
  template <class F, std::size_t... K>
  static typename Points<F, N>::Outputs array(const std::vector<Rows<double>>& rows,
                                              std::index_sequence<K...>) {
    return {rows[K]...};
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
  std::unique_ptr<Points<Value, N>> values_;
  std::unique_ptr<Points<Jacobian, N>> jacobians_;
  std::unique_ptr<Points<Hessian, N>> hessians_;
  std::vector<double> scratch_;
  Pattern jacobian_, hessian_;
};

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_NLP_GENERATED_HPP
