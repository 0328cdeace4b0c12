"""A compiled model: its functions on numpy arrays, and what the model file says of it."""

import ctypes
import inspect
import threading
import warnings
from collections import namedtuple

import numpy as np

_POINTER = ctypes.c_void_p


class Model:
    """A robot's functions, made by arboc.compile.

    name                     of the generated code
    nq, nv                   entries of a configuration q, and of v, a, tau
    joint_names              moving joints in the order of their coordinates
    frame_names              rows of fk and of the functions of frames
    q_lower, q_upper         limits as the model states them (rad, m), infinite where it has none
    v_limit                  (rad/s, m/s)
    tau_lower, tau_upper     (N m, N)
    functions                names; each is a method
    manifest                 all that arboc says of the model and its functions
    """

    def __init__(self, manifest, library, threads):
        self.manifest = manifest
        self.name, self.nq, self.nv = manifest["name"], manifest["nq"], manifest["nv"]
        self.joint_names = [j["name"] for j in manifest["joints"] if "mimic" not in j]
        self.frame_names = list(manifest["frames"])
        self.parameters = {p["name"]: np.array(p["nominal"]) for p in manifest["parameters"]}
        for name, sign in (("q_lower", -1), ("q_upper", 1), ("v_limit", 1), ("tau_lower", -1),
                           ("tau_upper", 1)):
            values = manifest["limits"][name]
            setattr(self, name, np.array([sign * np.inf if x is None else x for x in values]))
        self.functions = [f["name"] for f in manifest["functions"]]
        self.library = library
        loaded = ctypes.CDLL(library)
        for function in manifest["functions"]:
            setattr(self, function["name"], _function(function, loaded, threads))

    def neutral(self):
        """The configuration of zeros, quaternions of no turn."""
        q = np.zeros(self.nq)
        for joint in self.manifest["joints"]:
            if joint["type"] in ("floating", "spherical") and joint["nq"] > joint["nv"]:
                q[joint["q"] + joint["nq"] - 1] = 1
            elif joint["nq"] == 2 and joint["nv"] == 1:
                q[joint["q"]] = 1  # cosine, sine
        return q

    def __repr__(self):
        return f"<arboc.Model {self.name}: nv {self.nv}; {', '.join(self.functions)}>"


def _shape(argument):
    return "(" + ", ".join(map(str, argument["shape"])) + ("," if len(argument["shape"]) == 1 else "") + ")"


def _document(function):
    def lines(arguments):
        return "".join(f"    {a['name']}  {_shape(a)}  {a['unit']}\n        {a['meaning']}\n"
                       for a in arguments)

    text = f"{function['meaning']}\n\nInputs\n{lines(function['inputs'])}"
    text += f"\nOutputs\n{lines(function['outputs'])}"
    if function["returns"]:
        text += "\nWhere the result does not exist it is nan, with a RuntimeWarning.\n"
    return text + ("\nOne state; or many, with inputs of shape (N, ...), in lanes and threads: inputs"
                   "\nthat are the same for all may stay those of one state. `out` receives the"
                   "\nresults in place of new arrays.\n")


class _Caller:
    """One function of a library."""

    def __init__(self, function, library, threads):
        self.function = function
        self.inputs = [(a["name"], int(np.prod(a["shape"], dtype=int))) for a in function["inputs"]]
        self.outputs = [(a["name"], tuple(a["shape"])) for a in function["outputs"]]
        name = function["name"]
        self.result = namedtuple(name, [n for n, _ in self.outputs], rename=True)
        self.one = getattr(library, name + "_one")
        self.one.argtypes = [_POINTER, _POINTER]
        self.many = getattr(library, name + "_many")
        self.many.argtypes = [_POINTER, ctypes.c_size_t] + [_POINTER] * 4
        self.many.restype = None
        self.destroy = getattr(library, name + "_destroy")
        self.destroy.argtypes, self.destroy.restype = [_POINTER], None
        self.create = getattr(library, name + "_create")
        self.create.argtypes, self.create.restype = [ctypes.c_int], _POINTER
        self.threads = threads
        self.batch = None
        self.lock = threading.Lock()
        self.checked = function["returns"] is not None
        self.arrays_in = _POINTER * len(self.inputs)
        self.arrays_out = _POINTER * len(self.outputs)
        self.steps = ctypes.c_ssize_t * len(self.inputs)

    def __del__(self):
        if getattr(self, "batch", None):
            self.destroy(self.batch)

    def __call__(self, values, out):
        arrays, n = self.prepare(values)
        results = self.results(n, out)
        into = self.arrays_out(*[y.__array_interface__["data"][0] for y in results])
        if n is None:
            ins = self.arrays_in(*[x.__array_interface__["data"][0] for x in arrays])
            failed = self.one(ins, into) != 0
        else:
            failed = self.evaluate(arrays, n, into)
        if failed:
            warnings.warn(f"{self.function['name']}: {self.function['returns']}; "
                          "the result is nan", RuntimeWarning, stacklevel=3)
        results = [y if y.ndim or out is not None else y[()] for y in results]
        return results[0] if len(results) == 1 else self.result(*results)

    def prepare(self, values):
        """Contiguous rows, and how many there are (None: one state)."""
        arrays, n = [], None
        for (name, size), value in zip(self.inputs, values):
            x = np.asarray(value, dtype=np.float64)
            if x.ndim not in (1, 2) or x.shape[-1] != size:
                raise ValueError(f"{self.function['name']}: {name} has shape {x.shape}; expected "
                                 f"({size},) or (N, {size})")
            if x.strides[-1] != 8 or (x.ndim == 2 and x.strides[0] % 8):
                x = np.ascontiguousarray(x)
            if x.ndim == 2:
                if n is not None and len(x) != n:
                    raise ValueError(f"{self.function['name']}: {name} has {len(x)} states, the "
                                     f"inputs before it {n}")
                n = len(x)
            arrays.append(x)
        return arrays, n

    def results(self, n, out):
        shapes = [shape if n is None else (n,) + shape for _, shape in self.outputs]
        if out is None:
            return [np.empty(shape) for shape in shapes]
        given = [out] if isinstance(out, np.ndarray) else list(out)
        if len(given) != len(shapes):
            raise ValueError(f"{self.function['name']}: out has {len(given)} arrays, expected {len(shapes)}")
        for y, shape in zip(given, shapes):
            if y.shape != shape or y.dtype != np.float64 or not y.flags.c_contiguous or \
                    not y.flags.writeable:
                raise ValueError(f"{self.function['name']}: out has to be a contiguous float64 "
                                 f"array of shape {shape}")
        return given

    def evaluate(self, arrays, n, into):
        """Whether a state failed."""
        if n == 0:
            return False
        steps = self.steps(*[x.strides[0] // 8 if x.ndim == 2 else 0 for x in arrays])
        ins = self.arrays_in(*[x.__array_interface__["data"][0] for x in arrays])
        status = np.empty(n, dtype=np.intc) if self.checked else None
        with self.lock:  # a batch serves one call at a time
            if self.batch is None:
                self.batch = self.create(self.threads)
            self.many(self.batch, n, ins, steps, into,
                      status.ctypes.data if self.checked else None)
        return self.checked and bool(status.any())


def _function(function, library, threads):
    """A function with names and documentation for people."""
    caller = _Caller(function, library, threads)
    names = [name for name, _ in caller.inputs]

    def call(*values, out=None, **named):
        if named or len(values) != len(names):
            values = signature.bind(*values, **named).args
        return caller(values, out)

    kind = inspect.Parameter.POSITIONAL_OR_KEYWORD
    signature = inspect.Signature([inspect.Parameter(name, kind) for name in names])
    call.__name__ = call.__qualname__ = function["name"]
    call.__signature__ = signature.replace(
        parameters=list(signature.parameters.values()) +
        [inspect.Parameter("out", inspect.Parameter.KEYWORD_ONLY, default=None)])
    call.__doc__ = _document(function)
    return call
