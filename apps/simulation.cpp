// Free motion of the arm by a symplectic integrator, and what becomes of its energy.
//
// The variational midpoint rule: with q' = (q0 + q1) / 2 and v' = (q1 - q0) / h,
//   p0 = M(q') v' - h/2 dL/dq(q', v'),    p1 = M(q') v' + h/2 dL/dq(q', v'),
//   dL/dq = dT/dq - g(q),
// solved for v' by Newton's method with M in place of the Jacobian.  The energy of a symplectic
// method does not drift; that of semi-implicit Euler steps on (q, v), which are symplectic only
// where M is constant, is drawn beside it.
//
//   simulation [SVG]
#include <Eigen/Cholesky>
#include <algorithm>
#include <arm/arm.hpp>
#include <cmath>
#include <cstdio>
#include <vector>

namespace {

constexpr double kStep = 1e-3;  // s
constexpr int kSteps = 20000;
constexpr int kEvery = 20;  // steps a point of the plot

double energy(const arm::Config& q, const arm::Tangent& v) {
  double T, V;
  arm::Energy out;
  out.T_ = &T;
  out.V = &V;
  arm::energy(q, v, out);
  return T + V;
}

struct State {
  arm::Config q;
  arm::Tangent p;
};

/// Returns the number of Newton steps, 0 if they do not converge.
int midpoint_step(State& s) {
  arm::Tangent v = arm::crba(s.q).llt().solve(s.p);
  for (int k = 1; k <= 50; ++k) {
    const arm::Config q = s.q + 0.5 * kStep * v;
    const arm::Matrix M = arm::crba(q);
    const arm::Tangent force = arm::energy_T_gradient_q(q, v) - arm::gravity(q), Mv = M * v;
    const arm::Tangent residual = s.p - Mv + 0.5 * kStep * force;
    v += M.llt().solve(residual);
    if (residual.norm() > 1e-12 * (1 + s.p.norm())) continue;
    s = {s.q + kStep * v, Mv + 0.5 * kStep * force};
    return k;
  }
  return 0;
}

void euler_step(arm::Config& q, arm::Tangent& v) {
  v += kStep * arm::aba(q, v, arm::Tangent::Zero());
  q += kStep * v;
}

struct Curve {
  const char* name;
  const char* colour;
  std::vector<double> drift;  ///< J, a point every kEvery steps
};

double largest(const std::vector<double>& x, std::size_t begin, std::size_t end) {
  double most = 0;
  for (std::size_t k = begin; k < end; ++k) most = std::max(most, std::fabs(x[k]));
  return most;
}

bool draw(const char* path, const std::vector<Curve>& curves) {
  std::FILE* file = std::fopen(path, "w");
  if (!file) return false;
  double scale = 1e-9;
  for (const Curve& c : curves) scale = std::max(scale, largest(c.drift, 0, c.drift.size()));
  std::fprintf(
      file,
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 760 330' font-family='sans-serif' "
      "font-size='12'>\n<rect width='760' height='330' fill='white'/>\n"
      "<path d='M60 20V300M60 160H740' stroke='black' fill='none'/>\n"
      "<text x='8' y='16'>energy - energy at the start, J</text>\n"
      "<text x='14' y='34'>%+.2g</text><text x='14' y='304'>%+.2g</text>\n"
      "<text x='700' y='178'>%.0f s</text>\n",
      scale, -scale, kSteps * kStep);
  int line = 0;
  for (const Curve& c : curves) {
    std::fprintf(
        file,
        "<text x='560' y='%d' fill='%s'>%s</text>\n<polyline fill='none' stroke='%s' points='",
        36 + 16 * line++, c.colour, c.name, c.colour);
    for (std::size_t k = 0; k < c.drift.size(); ++k)
      std::fprintf(file, "%.1f,%.1f ",
                   60 + 680.0 * static_cast<double>(k) / static_cast<double>(c.drift.size()),
                   160 - 130 * c.drift[k] / scale);
    std::fprintf(file, "'/>\n");
  }
  std::fprintf(file, "</svg>\n");
  return std::fclose(file) == 0;
}

}  // namespace

int main(int argc, char** argv) {
  arm::Config q;
  q << 0, -0.4, 0.8, 0.3, -0.5, 0.2;
  arm::Tangent v = arm::Tangent::Zero();
  State s{q, arm::crba(q) * v};
  const double start = energy(q, v);
  Curve midpoint{"variational midpoint", "#1060c0", {}},
      euler{"semi-implicit Euler", "#d06010", {}};
  long newton = 0;
  for (int k = 0; k < kSteps; ++k) {
    const int taken = midpoint_step(s);
    if (taken == 0) return 1;
    newton += taken;
    euler_step(q, v);
    if (k % kEvery != 0) continue;
    midpoint.drift.push_back(energy(s.q, arm::crba(s.q).llt().solve(s.p)) - start);
    euler.drift.push_back(energy(q, v) - start);
  }
  const std::size_t n = midpoint.drift.size();
  const double first = largest(midpoint.drift, 0, n / 2), last = largest(midpoint.drift, n / 2, n);
  const double other = largest(euler.drift, 0, n);
  std::printf(
      "%.0f s in %d steps: energy off by %.2e J in the first half, %.2e J in the second; "
      "Euler %.2e J; %.1f Newton steps\n",
      kSteps * kStep, kSteps, first, last, other, 1.0 * static_cast<double>(newton) / kSteps);
  if (argc > 1 && !draw(argv[1], {euler, midpoint})) return 1;
  return std::isfinite(last) && last < 3 * first && last < 0.1 * other ? 0 : 1;
}
