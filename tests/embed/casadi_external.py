"""Loads the functions of ur5 as CasADi externals: values, Jacobians, a gradient through both."""
import sys

import casadi as ca
import numpy as np

library = sys.argv[1]
rnea = ca.external("ur5_rnea", library)
crba = ca.external("ur5_crba", library)
assert rnea.name_in() == ["q", "v", "a"] and rnea.name_out() == ["tau"]

rng = np.random.default_rng(1)
q, v, a = (rng.uniform(-1, 1, 6) for _ in range(3))
M = np.array(crba(q))
assert np.allclose(M, M.T, atol=0)
tau = np.array(rnea(q, v, a)).ravel()
assert np.allclose(tau - np.array(rnea(q, v, 0 * a)).ravel(), M @ a, atol=1e-12)

Q, V, A = (ca.MX.sym(name, 6) for name in "qva")
jacobian = ca.Function("J", [Q, V, A], [ca.jacobian(rnea(Q, V, A), x) for x in (Q, V, A)])
blocks = [np.array(block) for block in jacobian(q, v, a)]
assert np.allclose(blocks[2], M, atol=1e-12)
h = 1e-6
for block, k in zip(blocks, range(3)):
    for j in range(6):
        ahead, behind = [q.copy(), v.copy(), a.copy()], [q.copy(), v.copy(), a.copy()]
        ahead[k][j] += h
        behind[k][j] -= h
        column = (np.array(rnea(*ahead)) - np.array(rnea(*behind))).ravel() / (2 * h)
        assert np.allclose(block[:, j], column, atol=1e-6)

cost = ca.Function("c", [Q, V, A], [ca.gradient(ca.sumsqr(rnea(Q, V, A)), Q)])
assert np.allclose(np.array(cost(q, v, a)).ravel(), 2 * blocks[0].T @ tau, atol=1e-9)
print("ok")
