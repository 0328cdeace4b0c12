// Pinocchio + CppADCodeGen: Pinocchio's algorithms are recorded with CppAD, the tape is optimised
// and written as C, which the compiler of the toolchain turns into a library.
//
// The functions are called by their symbols, without Pinocchio's wrapper, which copies vectors.  Of
// the derivatives of inverse dynamics there are two recordings: Pinocchio's analytic algorithm, and
// CppAD's Jacobian of inverse dynamics where no joint has a quaternion (it differentiates by the
// coordinates); the shorter source is kept.
#include "pinocchio_model.hpp"
// After its headers.
#include <dlfcn.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <pinocchio/codegen/cppadcg.hpp>
#include <sstream>
#include <stdexcept>
// After cppadcg.hpp.
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>

namespace peers {
namespace {

namespace pin = pinocchio;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using CG = CppAD::cg::CG<double>;
using AD = CppAD::AD<CG>;
using Tape = CppAD::ADFun<CG>;
using Model = pin::ModelTpl<AD>;
using Vector = Eigen::Matrix<AD, Eigen::Dynamic, 1>;
using Matrix = Eigen::Matrix<AD, Eigen::Dynamic, Eigen::Dynamic>;

/// Files by name.
using Sources = std::map<std::string, std::string>;

/// As declared in the sources that CppADCodeGen writes.
struct AtomicFun {
  void* library = nullptr;
  void* forward = nullptr;
  void* reverse = nullptr;
};
using Call = void (*)(const double* const*, double* const*, AtomicFun);

size_t size(const Sources& sources) {
  size_t sum = 0;
  for (const auto& [name, text] : sources) sum += text.size();
  return sum;
}

/// The expressions in the independent variables that `make` returns, as C with the options that
/// CppADCodeGen's own library generator has by default.
template <class Make>
Sources source(const std::string& name, size_t inputs, const Make& make) {
  Sources sources;
  CppAD::cg::CodeHandler<double> handler;
  std::vector<CG> x(inputs);
  handler.makeVariables(x);
  std::vector<CG> y = make(x);
  CppAD::cg::LanguageC<double> language("double");
  language.setMaxAssignmentsPerFunction(20000, &sources);
  language.setMaxOperationsPerAssignment(1000);
  language.setParameterPrecision(17);
  language.setGenerateFunction(name);
  CppAD::cg::LangCDefaultVariableNameGenerator<double> names("y");
  std::ostringstream code;
  handler.generateCode(code, language, y, names);
  return sources;
}

class Codegen : public Peer {
 public:
  explicit Codegen(const Body& given) : Peer(given), model_(pinocchio_model(body()).cast<AD>()) {}

  bool has(Function) const override { return true; }

  void run(Function f, const State& x) override {
    Compiled& compiled = of(f);
    const double* const in[] = {x.q.data()};
    double* const out[] = {compiled.y.data()};
    compiled.call(in, out, {});
  }

 private:
  struct Compiled {
    Call call = nullptr;
    VectorXd y;
    bool by_rows = false;  ///< y is the Jacobian of inverse dynamics
  };

  /// All inputs one after the other, in q; each function is recorded with all of them.
  State converted(const State& x) const override {
    State y;
    y.q.resize(x.q.size() + 3 * x.v.size());
    y.q << x.q, x.v, x.a, x.tau;
    return y;
  }

  Compiled& of(Function f) {
    Compiled& compiled = compiled_[static_cast<size_t>(f)];
    if (!compiled.call) compile(f, compiled);
    return compiled;
  }

  void compile(Function f, Compiled& compiled) {
    const std::string name = "peer" + std::to_string(static_cast<int>(f));
    const size_t inputs = static_cast<size_t>(body().nq + 3 * body().nv);
    Tape tape = record(f);
    Sources sources =
        source(name, inputs, [&](const std::vector<CG>& x) { return tape.Forward(0, x); });
    compiled.y.resize(static_cast<Eigen::Index>(tape.Range()));
    if (f == Function::kRneaDerivatives && body().nq == body().nv) {
      Tape rnea = record(Function::kRnea);
      const Sources jacobian =
          source(name, inputs, [&](const std::vector<CG>& x) { return rnea.Jacobian(x); });
      if (size(jacobian) < size(sources)) {
        sources = jacobian;
        compiled.by_rows = true;
        compiled.y.resize(body().nv * static_cast<Eigen::Index>(inputs));
      }
    }
    compiled.call = build(name, sources);
  }

  Tape record(Function f) const {
    const int nq = body().nq, nv = body().nv;
    Vector x(nq + 3 * nv);
    x << pin::neutral(model_), Vector::Zero(3 * nv);
    CppAD::Independent(x);
    const Vector q = x.head(nq), v = x.segment(nq, nv), a = x.segment(nq + nv, nv),
                 tau = x.tail(nv);
    Vector y = dependent(f, q, v, a, tau);
    Tape tape;
    tape.Dependent(x, y);
    tape.optimize("no_compare_op");
    return tape;
  }

  Vector dependent(Function f, const Vector& q, const Vector& v, const Vector& a,
                   const Vector& tau) const {
    pin::DataTpl<AD> data(model_);
    switch (f) {
      case Function::kRnea: return pin::rnea(model_, data, q, v, a);
      case Function::kAba: return pin::aba(model_, data, q, v, tau, pin::Convention::LOCAL);
      case Function::kCrba: return upper(pin::crba(model_, data, q, pin::Convention::LOCAL));
      case Function::kMinv: return upper(pin::computeMinverse(model_, data, q));
      default: break;
    }
    Matrix dtau_dq = Matrix::Zero(model_.nv, model_.nv), dtau_dv = dtau_dq, M = dtau_dq;
    pin::computeRNEADerivatives(model_, data, q, v, a, dtau_dq, dtau_dv, M);
    const Vector triangle = upper(M);
    Vector y(2 * dtau_dq.size() + triangle.size());
    y << Eigen::Map<Vector>(dtau_dq.data(), dtau_dq.size()),
        Eigen::Map<Vector>(dtau_dv.data(), dtau_dv.size()), triangle;
    return y;
  }

  /// The upper triangle by columns.
  template <class Symmetric>
  static Vector upper(const Symmetric& M) {
    Vector y(M.rows() * (M.rows() + 1) / 2);
    Eigen::Index n = 0;
    for (Eigen::Index col = 0; col < M.cols(); ++col)
      for (Eigen::Index row = 0; row <= col; ++row) y[n++] = M(row, col);
    return y;
  }
  static MatrixXd symmetric(const double* y, int n) {
    MatrixXd M(n, n);
    for (int col = 0; col < n; ++col)
      for (int row = 0; row <= col; ++row) M(row, col) = M(col, row) = *y++;
    return M;
  }

  Call build(const std::string& name, const Sources& sources) const {
    const Toolchain& tools = body().toolchain;
    const std::string folder = std::string(tools.folder) + "/";
    const std::string library = folder + name + ".so";
    std::string command = std::string(tools.compiler) + " " + tools.flags +
                          " -w -fPIC -shared -x c -o '" + library + "'";
    for (const auto& [file, text] : sources) {
      std::ofstream(folder + file) << text;
      command += " '" + folder + file + "'";
    }
    if (std::system((command + " -lm").c_str()) != 0)
      throw std::runtime_error("generated C does not compile: " + command);
    void* handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* symbol = handle ? dlsym(handle, name.c_str()) : nullptr;
    if (!symbol) throw std::runtime_error(std::string("cannot load ") + dlerror());
    return reinterpret_cast<Call>(symbol);
  }

  Outputs outputs(Function f) const override {
    const Compiled& compiled = compiled_[static_cast<size_t>(f)];
    const VectorXd& y = compiled.y;
    const int n = body().nv;
    if (f == Function::kRnea || f == Function::kAba) return {y};
    if (f == Function::kCrba || f == Function::kMinv) return {symmetric(y.data(), n)};
    if (compiled.by_rows) {
      const MatrixXd J = Eigen::Map<const MatrixXd>(y.data(), y.size() / n, n).transpose();
      return {J.leftCols(n), J.middleCols(n, n), J.middleCols(2 * n, n)};
    }
    return {Eigen::Map<const MatrixXd>(y.data(), n, n),
            Eigen::Map<const MatrixXd>(y.data() + n * n, n, n), symmetric(y.data() + 2 * n * n, n)};
  }

  Model model_;
  Compiled compiled_[5];
};

}  // namespace

std::unique_ptr<Peer> make_pinocchio_codegen(const Body& body) {
  return pinocchio_has(body) ? std::make_unique<Codegen>(body) : nullptr;
}

}  // namespace peers
