"""The Python package: numbers of `arboc eval`, batches, messages, and a cache that is never stale.

Run with ARBOC (the program), PYTHONPATH (python/) and ARBOC_MODELS (models/) in the environment.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings

import numpy as np

import arboc

MODELS = pathlib.Path(os.environ["ARBOC_MODELS"])
SCRATCH = tempfile.TemporaryDirectory()
os.environ["ARBOC_CACHE"] = SCRATCH.name + "/cache"
FAST = "-std=c++17 -O2 -march=native -fno-tree-vectorize"
QUICK = "-std=c++17 -O0"  # where only behaviour is looked at


def urdf(name):
    return MODELS / name / f"{name}.urdf"


def states(n, *sizes):
    rng = np.random.default_rng(3)
    return [rng.uniform(-1, 1, (n, size)) for size in sizes]


def evaluated(model, function, inputs, *options):
    """What `arboc eval` prints, by the generic engine: a row a state."""
    with tempfile.TemporaryDirectory() as folder:
        command = [os.environ["ARBOC"], "eval", str(model), "--function", function,
                   "--engine", "generic", *options]
        for name, rows in inputs.items():
            np.savetxt(f"{folder}/{name}", rows, delimiter=",", fmt="%.17g")
            command += ["--input", f"{name}={folder}/{name}"]
        text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return np.array([[float(x) for x in line.split(",")] for line in text.splitlines()])


class Numbers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.ur5 = arboc.compile(urdf("ur5"), ["rnea", "crba", "energy", "rnea_derivatives"],
                                cxxflags=FAST)
        cls.walker = arboc.compile(urdf("quadruped"), ["rnea", "integrate", "minv", "fk"],
                                   base="floating", frames=["trunk", "left_front_foot"],
                                   jacobian=["com.c:q"], cxxflags=QUICK)

    def test_one_state_and_many_are_those_of_eval(self):
        n = 37  # no multiple of the lanes
        q, v, a = states(n, 6, 6, 6)
        many = self.ur5.rnea(q, v, a)
        expected = evaluated(urdf("ur5"), "rnea", {"q": q, "v": v, "a": a})
        np.testing.assert_allclose(many, expected, rtol=0, atol=1e-12 * abs(expected).max())
        np.testing.assert_allclose(self.ur5.rnea(q[5], v[5], a[5]), expected[5], atol=1e-11)
        M = self.ur5.crba(q)
        np.testing.assert_allclose(M.reshape(n, 36), evaluated(urdf("ur5"), "crba", {"q": q}),
                                   atol=1e-13 * abs(M).max())
        self.assertEqual(abs(M - M.transpose(0, 2, 1)).max(), 0)
        np.testing.assert_allclose(self.ur5.crba(q[7]), M[7], atol=1e-14 * abs(M).max())

    def test_outputs_have_names_and_their_shapes(self):
        q, v, a = states(4, 6, 6, 6)
        d = self.ur5.rnea_derivatives(q, v, a)
        self.assertEqual([x.shape for x in d], [(4, 6, 6)] * 3)
        h = 1e-6
        column = (self.ur5.rnea(q + h * np.eye(6)[2], v, a) -
                  self.ur5.rnea(q - h * np.eye(6)[2], v, a)) / (2 * h)
        np.testing.assert_allclose(d.dtau_dq[:, :, 2], column, atol=1e-6)
        T = self.ur5.energy(q[0], v[0]).T
        self.assertIsInstance(float(T), float)
        self.assertEqual(np.shape(T), ())
        self.assertAlmostEqual(T, v[0] @ self.ur5.crba(q[0]) @ v[0] / 2, places=12)
        self.assertEqual(self.ur5.energy(q, v).V.shape, (4,))

    def test_many_states_over_threads(self):
        n = 10007
        q, v, a = states(n, 6, 6, 6)
        tau = self.ur5.rnea(q, v, a)
        for k in (0, 1, 4999, 5000, n - 1):
            np.testing.assert_allclose(tau[k], self.ur5.rnea(q[k], v[k], a[k]), atol=1e-11)

    def test_what_is_the_same_for_all_is_given_once(self):
        q, v, a = states(50, 6, 6, 6)
        np.testing.assert_array_equal(self.ur5.rnea(q, v[0], np.zeros(6)),
                                      self.ur5.rnea(q, np.tile(v[0], (50, 1)), np.zeros((50, 6))))

    def test_any_array_will_do(self):
        q, v, a = states(20, 6, 6, 6)
        expected = self.ur5.rnea(q[::2], v[::2], a[::2])
        wide = np.concatenate([q, v, a], axis=1)  # rows that lie apart
        np.testing.assert_array_equal(
            self.ur5.rnea(wide[::2, :6], wide[::2, 6:12], wide[::2, 12:]), expected)
        np.testing.assert_array_equal(
            self.ur5.rnea(np.asfortranarray(q[::2]), v[::2].tolist(), a[::2]), expected)
        np.testing.assert_allclose(self.ur5.rnea(q[0].astype(np.float32), v[0], a[0]), expected[0],
                                   atol=1e-5)
        np.testing.assert_array_equal(self.ur5.rnea(v=v[0], a=a[0], q=q[0]),
                                      self.ur5.rnea(q[0], v[0], a[0]))
        out = np.empty((10, 6))
        self.assertIs(self.ur5.rnea(q[::2], v[::2], a[::2], out=out), out)
        np.testing.assert_array_equal(out, expected)
        self.assertEqual(self.ur5.rnea(q[:0], v[:0], a[:0]).shape, (0, 6))

    def test_a_floating_base(self):
        q = self.walker.neutral()
        self.assertEqual((self.walker.nq, self.walker.nv, q[6]), (19, 18, 1))
        forces = self.walker.rnea(q, np.zeros(18), np.zeros(18))
        self.assertGreater(forces[2], 100)  # its weight
        self.assertEqual(self.walker.frame_names, ["trunk", "left_front_foot"])
        self.assertEqual(self.walker.fk(q).shape, (2, 12))
        self.assertEqual(self.walker.com_c_jacobian_q(q, np.zeros(18)).shape, (3, 18))
        np.testing.assert_allclose(self.walker.integrate(q, np.zeros(18)), q)

    def test_threads_may_call_at_the_same_time(self):
        q, v, a = states(5000, 6, 6, 6)
        expected, got = self.ur5.rnea(q, v, a), [None] * 4

        def call(k):
            got[k] = self.ur5.rnea(q, v, a)

        threads = [threading.Thread(target=call, args=(k,)) for k in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for tau in got:
            np.testing.assert_array_equal(tau, expected)

    def test_says_what_it_is(self):
        text = self.ur5.rnea.__doc__
        for words in ("Inverse dynamics", "q  (6,)  rad, m", "tau  (6,)  N m, N", "(N, ...)"):
            self.assertIn(words, text)
        self.assertEqual(self.ur5.joint_names[1], "shoulder_lift")
        np.testing.assert_allclose(self.ur5.tau_upper, [150, 150, 150, 28, 28, 28])
        self.assertIn("rnea", repr(self.ur5))

    def test_a_batch_costs_what_it_costs_in_cpp(self):
        """Against the very same arboc::Batch, called with arrays that are ready; CPU time of one
        thread, which other programs of the machine disturb least."""
        n = 100000
        q, v, a = states(n, 6, 6, 6)
        rnea = arboc.compile(urdf("ur5"), self.ur5.functions, cxxflags=FAST, threads=1).rnea
        caller = rnea.__closure__[rnea.__code__.co_freevars.index("caller")].cell_contents
        tau = rnea(q, v, a)
        ins = caller.arrays_in(*[x.ctypes.data for x in (q, v, a)])
        outs, steps = caller.arrays_out(tau.ctypes.data), caller.steps(6, 6, 6)
        cpp = python = ratio = 1e9
        for attempt in range(400):
            start = time.thread_time()
            caller.many(caller.batch, n, ins, steps, outs, None)
            middle = time.thread_time()
            rnea(q, v, a)
            cpp = min(cpp, middle - start)
            python = min(python, time.thread_time() - middle)
            ratio = python / cpp
            if attempt > 20 and ratio < 1.3:
                break
        print(f"\n100000 states of rnea: {python * 1e3:.2f} ms, in C++ {cpp * 1e3:.2f} ms, "
              f"ratio {ratio:.2f}")
        self.assertLess(ratio, 1.3)


class Complaints(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = arboc.compile(urdf("double_pendulum"), ["rnea", "minv"], cxxflags=QUICK,
                                  parameters=["masses"])

    def test_wrong_shapes_name_the_argument(self):
        with self.assertRaisesRegex(ValueError, r"rnea: v has shape \(3,\); expected \(2,\)"):
            self.robot.rnea(np.zeros(2), np.zeros(3), np.zeros(2), np.ones(3))
        with self.assertRaisesRegex(ValueError, "v has 4 states, the inputs before it 5"):
            self.robot.rnea(np.zeros((5, 2)), np.zeros((4, 2)), np.zeros(2), np.ones(3))
        with self.assertRaises(TypeError):
            self.robot.rnea(np.zeros(2))
        with self.assertRaisesRegex(ValueError, "out has to be"):
            self.robot.rnea(*[np.zeros(2)] * 3, np.ones(3), out=np.zeros(3))

    def test_what_has_no_result_is_nan_and_warns(self):
        singular = np.full(3, -1e3)
        for q in (np.zeros(2), np.zeros((9, 2))):
            with self.assertWarnsRegex(RuntimeWarning, "pivot"):
                self.assertTrue(np.isnan(self.robot.minv(q, singular)).all())
        nominal = self.robot.parameters["masses"]
        self.assertTrue(np.isfinite(self.robot.minv(np.zeros(2), nominal)).all())

    def test_diagnostics_of_arboc_are_the_exception(self):
        with self.assertRaisesRegex(arboc.CompileError, r"bad\.urdf:1:\d+: error"):
            bad = pathlib.Path(SCRATCH.name) / "bad.urdf"
            bad.write_text("<robot name='r'><link/></robot>")
            arboc.compile(bad)
        with self.assertRaisesRegex(arboc.CompileError, "there is no function 'rnae'"):
            arboc.compile(urdf("ur5"), ["rnae"])
        with self.assertRaisesRegex(arboc.CompileError, "--nonsense"):
            arboc.compile(urdf("ur5"), nonsense=3)
        with self.assertRaisesRegex(arboc.CompileError, "flag-that-does-not-exist"):
            arboc.compile(urdf("ur5"), ["fk"], cxxflags="-flag-that-does-not-exist")

    def test_warnings_are_warnings(self):
        light = pathlib.Path(SCRATCH.name) / "light.urdf"
        text = urdf("double_pendulum").read_text()
        light.write_text(re.sub(r'ixx="[^"]*"', 'ixx="5000"', text, count=1))
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            arboc.compile(light, ["gravity"], cxxflags=QUICK)
        self.assertTrue(any("warning" in str(w.message) for w in caught))


class Cache(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(dir=SCRATCH.name))
        self.model = self.folder / "robot.urdf"
        shutil.copy(urdf("double_pendulum"), self.model)

    def compile(self, functions=("gravity",), **options):
        options.setdefault("cxxflags", QUICK)
        return arboc.compile(self.model, list(functions), cache=self.folder / "cache", **options)

    def entries(self):
        return sorted(p.name for p in (self.folder / "cache").iterdir())

    def test_the_same_is_built_once(self):
        first = self.compile()
        time_of = os.stat(first.library).st_mtime_ns
        self.assertEqual(self.compile().library, first.library)
        self.assertEqual(os.stat(first.library).st_mtime_ns, time_of)
        self.assertEqual(len(self.entries()), 1)  # nothing left over

    def test_everything_that_matters_is_in_the_key(self):
        libraries = {self.compile().library}
        q = np.array([0.3, 0.4])
        before = self.compile().gravity(q)
        text = self.model.read_text()
        self.model.write_text(re.sub(r'mass value="[^"]*"', 'mass value="17"', text))
        changed = self.compile()
        self.assertGreater(abs(changed.gravity(q) - before).max(), 1)
        libraries.add(changed.library)
        for change in ({"snap": 0}, {"cxxflags": QUICK + " -DSOMETHING"}, {"parameters": ["gravity"]},
                       {"functions": ["gravity", "nle"]}, {"name": "other"}):
            libraries.add(self.compile(**change).library)
        if shutil.which("clang++"):
            libraries.add(self.compile(cxx="clang++").library)
        self.assertEqual(len(libraries), len(self.entries()))
        self.assertGreaterEqual(len(libraries), 7)

    def test_a_model_that_changes_back_finds_its_library(self):
        text = self.model.read_text()
        first = self.compile().library
        self.model.write_text(text.replace("</robot>", "<!-- more --></robot>"))
        self.assertNotEqual(self.compile().library, first)
        self.model.write_text(text)
        self.assertEqual(self.compile().library, first)

    def test_processes_may_build_the_same_at_once(self):
        script = (f"import arboc; print(arboc.compile({str(self.model)!r}, ['gravity'], "
                  f"cxxflags={QUICK!r}, cache={str(self.folder / 'cache')!r}).gravity([1, 2])[0])")
        running = [subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
                   for _ in range(3)]
        printed = {process.communicate()[0] for process in running}
        self.assertEqual([process.returncode for process in running], [0] * 3)
        self.assertEqual(len(printed), 1)
        self.assertEqual(len(self.entries()), 1)


if __name__ == "__main__":
    unittest.main()
