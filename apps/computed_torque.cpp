// A computed-torque controller of the arm in a loop of 1 kHz:
//
//   tau = rnea(q, v, a_d + Kd (v_d - v) + Kp (q_d - q))
//
// makes the error obey e'' + Kd e' + Kp e = 0 where the model is right.  The arm is simulated by
// its forward dynamics with friction that the controller does not know.  The loop wakes up by the
// clock and prints how late it was; it must not allocate, which a counting malloc proves.
//
//   computed_torque [SECONDS]
#include <time.h>

#include <algorithm>
#include <arm/arm.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

bool counting = false;
long allocations = 0;

}  // namespace

// All memory of the program comes from here; operator new calls malloc.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* malloc(std::size_t size) {
  allocations += counting;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  allocations += counting;
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
  allocations += counting;
  return __libc_realloc(memory, size);
}
}

namespace {

constexpr double kPeriod = 1e-3;  // s
constexpr double kRate = 20;      // rad/s, of the error
constexpr double kKp = kRate * kRate, kKd = 2 * kRate;
constexpr double kSettled = 1;  // s

struct Motion {
  arm::Tangent q, v, a;
};

/// Each joint swings by 0.5 rad about a bent pose, slower ones first; starts from rest.
Motion desired(double t) {
  Motion m;
  for (int i = 0; i < arm::nv; ++i) {
    const double rate = 1 + 0.3 * i;  // rad/s
    m.q[i] = -0.3 + 0.2 * i + 0.25 * (1 - std::cos(rate * t));
    m.v[i] = 0.25 * rate * std::sin(rate * t);
    m.a[i] = 0.25 * rate * rate * std::cos(rate * t);
  }
  return m;
}

arm::Tangent controller(double t, const Motion& is) {
  const Motion d = desired(t);
  const arm::Tangent a = d.a + kKd * (d.v - is.v) + kKp * (d.q - is.q);
  arm::Tangent tau = arm::rnea(is.q, is.v, a);
  for (int i = 0; i < arm::nv; ++i)
    tau[i] = std::clamp(tau[i], arm::tau_lower[i], arm::tau_upper[i]);
  return tau;
}

/// The arm for one period, in steps of an eighth.
void plant(const arm::Tangent& tau, Motion& is) {
  constexpr int kSteps = 8;
  for (int k = 0; k < kSteps; ++k) {
    is.v += kPeriod / kSteps * arm::aba(is.q, is.v, tau);
    is.q += kPeriod / kSteps * is.v;
  }
}

double seconds(const timespec& t) {
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}
double now() {
  timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return seconds(t);
}

void sleep_until(timespec& t, double period) {
  t.tv_nsec += static_cast<long>(1e9 * period);
  if (t.tv_nsec >= 1000000000) {
    t.tv_nsec -= 1000000000;
    ++t.tv_sec;
  }
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr) != 0) {
  }
}

void print(const char* what, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double part) {
    return 1e6 * values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
  };
  std::printf("%-12s median %8.2f us, 99 %% %8.2f us, worst %8.2f us\n", what, at(0.5), at(0.99),
              at(1));
}

}  // namespace

int main(int argc, char** argv) {
  const int cycles = static_cast<int>((argc > 1 ? std::atof(argv[1]) : 2) / kPeriod);
  if (cycles < 1) return 1;
  std::vector<double> late(static_cast<std::size_t>(cycles)), busy(late.size());

  counting = true;
  std::free(std::malloc(1));  // the counter counts
  if (allocations != 1) return 1;

  Motion is = desired(0);
  is.q.array() += 0.1;
  double error = 0;
  timespec wake;
  clock_gettime(CLOCK_MONOTONIC, &wake);
  for (int k = 0; k < cycles; ++k) {
    sleep_until(wake, kPeriod);
    const double start = now();
    late[static_cast<std::size_t>(k)] = start - seconds(wake);
    const arm::Tangent tau = controller(k * kPeriod, is);
    busy[static_cast<std::size_t>(k)] = now() - start;
    plant(tau, is);
    if (k * kPeriod >= kSettled)
      error = std::max(error, (desired((k + 1) * kPeriod).q - is.q).cwiseAbs().maxCoeff());
  }
  counting = false;

  print("jitter", late);
  print("controller", busy);
  std::printf("error after %.0f s %.1e rad; %ld allocations in %d cycles\n", kSettled, error,
              allocations - 1, cycles);
  // 0.1 (1 + 20) e^-20 is nothing; what is left is the torque that stands still for a period.
  return allocations == 1 && error < 1e-3 ? 0 : 1;
}
