// Reads a state of the arm, q v a, and prints tau, by the interface in C.
#include <arm/arm_casadi.h>
#include <stdio.h>

int main(void) {
  double x[3][arm_nq], tau[arm_nv], w[arm_rnea_SZ_W];
  const double* arg[] = {x[0], x[1], x[2]};
  double* res[] = {tau};
  int i;
  for (i = 0; i < 3 * arm_nq; ++i)
    if (scanf("%lf", &x[i / arm_nq][i % arm_nq]) != 1) return 1;
  if (arm_rnea(arg, res, 0, w, 0) != 0) return 1;
  for (i = 0; i < arm_nv; ++i) printf("%s%.12g", i ? "," : "", tau[i]);
  printf("\n");
  return 0;
}
