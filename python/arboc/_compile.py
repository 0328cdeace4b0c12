"""From a model file to a loaded library: runs arboc, then the C++ compiler, once per content.

The cache is addressed by content: arboc writes the code anew each time, which takes milliseconds,
and what is looked up is the hash of all it wrote (its manifest has one of every file, the options
and the version) and of the C++ compiler, its flags and what they mean on this processor.  A model,
a file it refers to, an option or an arboc that has changed therefore never finds an old library.
"""

import concurrent.futures
import functools
import hashlib
import json
import os
import pathlib
import shlex
import shutil
import subprocess
import tempfile
import warnings

from arboc._model import Model

CXXFLAGS = "-std=c++17 -O2 -march=native -fno-tree-vectorize"
_CALL = pathlib.Path(__file__).with_name("call.hpp")
_REPEATED = {"jacobian", "gradient", "vjp", "hessian", "lock"}


class CompileError(RuntimeError):
    """arboc or the C++ compiler refused; the text is what it said."""


def find_arboc():
    """Path of the program: $ARBOC, that of the tree in which this package stands, or in $PATH."""
    given = os.environ.get("ARBOC")
    if given:
        return given
    for folder in pathlib.Path(__file__).resolve().parents:
        program = folder / "bin" / "arboc"
        if program.is_file() and os.access(program, os.X_OK):
            return str(program)
    program = shutil.which("arboc")
    if program is None:
        raise CompileError("there is no program arboc: install it, or name it in $ARBOC")
    return program


def compile(model, functions=None, *, cxx=None, cxxflags=CXXFLAGS, threads=None, cache=None,
            verbose=False, **options):
    """Compiles the model file to a Model with a method a function.

    functions  names as in `arboc compile --functions`, a list or "all"; None: the usual dynamics
    options    any other option of `arboc compile`, with _ for -: base="floating",
               frames=["flange"], jacobian=["rnea.tau:q,v"], lock={"elbow": 0.5}, expand=True
    threads    for batches; None: as many as there are processors
    cxx        the C++ compiler; None: $CXX, then c++
    cache      folder of compiled libraries; None: $ARBOC_CACHE, then ~/.cache/arboc

    Warnings of arboc about the model become Python warnings; what it or the C++ compiler refuses
    is a CompileError.
    """
    cache = pathlib.Path(cache or os.environ.get("ARBOC_CACHE") or
                         pathlib.Path(os.environ.get("XDG_CACHE_HOME") or
                                      pathlib.Path.home() / ".cache") / "arboc")
    cache.mkdir(mode=0o700, parents=True, exist_ok=True)
    compiler = shlex.split(cxx or os.environ.get("CXX") or "c++") + shlex.split(cxxflags)
    with tempfile.TemporaryDirectory(prefix=".new-", dir=cache) as work:
        work = pathlib.Path(work)
        folder = _generate(model, functions, options, work, verbose)
        text = (folder / "manifest.json").read_bytes()
        manifest = json.loads(text)
        glue = {f["name"]: _glue(manifest["name"], f) for f in manifest["functions"]}
        key = _key(text, glue, compiler)
        place = cache / key
        if not (place / "lib.so").is_file():
            _build(work, folder, glue, compiler, verbose)
            _publish(work, place)
    return Model(manifest, str(place / "lib.so"), threads or len(os.sched_getaffinity(0)))


def _words(functions, options):
    """Options of the command line."""
    words = []
    if functions is not None:
        names = [functions] if isinstance(functions, str) else list(functions)
        words += ["--functions", ",".join(names)]
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if value is None or value is False:
            continue
        if value is True:
            words.append(option)
            continue
        if isinstance(value, dict):
            value = [f"{key}={_text(x)}" for key, x in value.items()]
        if isinstance(value, (list, tuple)):
            items = [_text(item) for item in value]
            for item in items if name in _REPEATED else [",".join(items)]:
                words += [option, item]
        else:
            words += [option, _text(value)]
    return words


def _text(value):
    return ",".join(map(_text, value)) if isinstance(value, (list, tuple)) else str(value)


def _run(command, verbose):
    if verbose:
        print(shlex.join(map(str, command)))
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True,
                          stdin=subprocess.DEVNULL)
    if done.returncode != 0:
        raise CompileError(done.stderr.strip() or f"{command[0]} failed")
    return done


def _generate(model, functions, options, work, verbose):
    """Runs arboc; returns the folder that it wrote."""
    out = work / "code"
    done = _run([find_arboc(), "compile", os.fspath(model), "-o", out] +
                _words(functions, options), verbose)
    for line in done.stderr.splitlines():
        if ": warning: " in line:
            warnings.warn(line, stacklevel=3)
    (folder,) = out.iterdir()
    return folder


def _glue(name, function):
    """C++ that exports the function for ctypes (call.hpp)."""
    f, outputs = function["name"], function["outputs"]
    sizes, sparse, cases = [], [], ""
    for k, output in enumerate(outputs):
        size = 1
        for extent in output["shape"]:
            size *= extent
        sizes.append(str(size))
        sparse.append("true" if "sparsity" in output else "false")
        if "sparsity" in output:
            cases += f"    if (k == {k}) {name}::raw::scatter_{f}_{output['name']}(entries, dense);\n"
    return f"""#include "{name}/{name}_batch.hpp"
#include "{name}/{name}_{f}.hpp"

#include "call.hpp"

namespace {{
struct Outputs {{
  static constexpr int size[] = {{{", ".join(sizes)}}};
  static constexpr bool sparse[] = {{{", ".join(sparse)}}};
  static void scatter([[maybe_unused]] int k, [[maybe_unused]] const double* entries,
                      [[maybe_unused]] double* dense) {{
{cases}  }}
}};
}}  // namespace
ARBOC_PYTHON({f}, {name}::{f}_fn, Outputs)
"""


@functools.lru_cache(maxsize=None)
def _compiler_identity(compiler):
    """What the compiler is and what its flags mean here: -march=native is a matter of the
    processor."""
    version = _run([compiler[0], "--version"], False).stdout
    macros = _run(list(compiler) + ["-dM", "-E", "-x", "c++", os.devnull], False).stdout
    return [shutil.which(compiler[0]), version, sorted(macros.splitlines())]


def _key(manifest, glue, compiler):
    everything = [hashlib.sha256(manifest).hexdigest(), sorted(glue.items()), _CALL.read_text(),
                  compiler, _compiler_identity(tuple(compiler))]
    return hashlib.sha256(json.dumps(everything).encode()).hexdigest()[:40]


def _build(work, folder, glue, compiler, verbose):
    """work/lib.so of the glue, a translation unit a function, as many at a time as there are
    processors."""
    common = compiler + ["-fPIC", "-I", folder.parent, "-I", folder, "-I", _CALL.parent]
    objects = []
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        jobs = []
        for name, text in glue.items():
            source = work / f"{name}.cpp"
            source.write_text(text)
            objects.append(work / f"{name}.o")
            jobs.append(pool.submit(_run, common + ["-c", source, "-o", objects[-1]], verbose))
        # The functions themselves, instantiated for double.
        for source in sorted(folder.glob("*_double.cpp")):
            objects.append(work / (source.stem + ".o"))
            jobs.append(pool.submit(_run, common + ["-c", source, "-o", objects[-1]], verbose))
        for job in jobs:
            job.result()
    _run(compiler + ["-shared", "-pthread"] + objects + ["-o", work / "lib.so"], verbose)


def _publish(work, place):
    """Whole or not at all, whoever else is building the same."""
    with tempfile.TemporaryDirectory(prefix=".done-", dir=place.parent) as done:
        ready = pathlib.Path(done) / "entry"
        ready.mkdir()
        shutil.move(str(work / "lib.so"), str(ready / "lib.so"))
        try:
            ready.rename(place)
        except OSError:
            if not (place / "lib.so").is_file():
                raise
