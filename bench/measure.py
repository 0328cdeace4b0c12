#!/usr/bin/env python3
"""Writes the measured tables and plots of bench/ and docs/ from what `arboc bench` prints.

  bench/measure.py compile              bench/compile/compile.txt, by g++ and clang++
  bench/measure.py peers NAME MODEL ... bench/time/NAME.json; what follows MODEL goes to arboc bench
  bench/measure.py table                bench/time/peers.md from all bench/time/*.json, and the ratios
                                        in docs/performance.md
  bench/measure.py plot                 docs/bench/*.svg from the same

Standard library only.  ARBOC names the program (build/release/bin/arboc).
"""
import json
import os
import platform
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
ARBOC = os.environ.get("ARBOC", str(ROOT / "build/release/bin/arboc"))
FLAGS = "-std=c++17 -O2 -march=native -fno-tree-vectorize"

RUNS = 4  # processes of a measurement against peers; of each competitor the least counts

# The models of bench/compile: a name, the file, options, functions.
BASIC = "fk,rnea,crba,minv,aba,rnea_derivatives,aba_derivatives,rnea_hessian"
MASSLESS = "fk,rnea,crba,rnea_derivatives,rnea_hessian"  # its inertia is singular
COMPILED = [
    ("ur5", "models/ur5/ur5.urdf", [], BASIC),
    ("quadruped", "models/quadruped/quadruped.urdf", ["--base", "floating"], BASIC),
    ("humanoid", "models/humanoid/humanoid.urdf", ["--base", "floating"], BASIC),
    ("humanoid", "models/humanoid/humanoid.urdf",
     ["--base", "floating", "--jacobian", "minv.Minv:q"], ""),
    ("santos", "models/santos/santos.dh.toml", [], MASSLESS),
]


def bench(*arguments):
    out = subprocess.run([ARBOC, "bench", *arguments, "--json"], cwd=ROOT, check=True,
                         stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout
    return json.loads(out)


def processor():
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.machine()


def version(compiler):
    out = subprocess.run([compiler, "--version"], stdout=subprocess.PIPE, text=True, check=True)
    return out.stdout.splitlines()[0]


def write_compile():
    """CPU seconds, memory and size of each function's translation unit, with two compilers."""
    lines = [f"# {processor()}; {FLAGS}; CPU seconds of one process a function"]
    compilers = ["g++", "clang++"]
    lines += [f"# {c}: {version(c)}" for c in compilers]
    lines.append(f"{'model':<10} {'function':<20} {'operations':>10}" + "".join(
        f" {c + ' s':>9} {'ms/op':>6} {'MB':>5} {'text kB':>8}" for c in compilers))
    for name, model, options, functions in COMPILED:
        asked = ["--functions", functions] if functions else []
        rows = [bench(model, *options, "--compile", *asked, "--cxx", c) for c in compilers]
        for both in zip(*rows):
            n = both[0]["operations"]
            lines.append(f"{name:<10} {both[0]['function']:<20} {n:>10}" + "".join(
                f" {r['cpu_s']:>9.2f} {1e3 * r['cpu_s'] / max(n, 1):>6.3f} {r['mb']:>5.0f}"
                f" {r['text_kb']:>8.1f}" for r in both))
    (ROOT / "bench/compile/compile.txt").write_text("\n".join(lines) + "\n")


def least(runs):
    """Of each function and competitor the least time of all runs, with the ratios of these."""
    functions = runs[0]
    for k, f in enumerate(functions):
        for i, by in enumerate(f["by"]):
            by["ns"] = min(run[k]["by"][i]["ns"] for run in runs)
            by["difference"] = max(run[k]["by"][i]["difference"] for run in runs)
        for by in f["by"]:
            by["ratio"] = by["ns"] / f["by"][0]["ns"]
    return functions


def shown(arguments):
    """Without folders, and without the options that they belong to."""
    return [a for k, a in enumerate(arguments)
            if "/" not in a and "/" not in (arguments[k + 1:k + 2] or [""])[0]]


def write_peers(name, model, arguments):
    data = {"model": name, "file": Path(model).name, "processor": processor(),
            "compiler": version(os.environ.get("CXX", "c++")), "flags": FLAGS,
            "options": shown(arguments),
            "functions": least([bench(model, "--peers", *arguments) for _ in range(RUNS)])}
    folder = ROOT / "bench/time"
    folder.mkdir(exist_ok=True)
    (folder / f"{name}.json").write_text(json.dumps(data, indent=1) + "\n")


def recorded():
    return [json.loads(p.read_text()) for p in sorted((ROOT / "bench/time").glob("*.json"))]


PLAIN, LANES = "generated, no limbs in lanes", "generated, 8 doubles in lanes"


def ratio_lines():
    """How many times as long as generated code others take, for one state and in lanes."""
    lines = ["| robot, function | as compiled: ns | generic | Pinocchio | + CppADCodeGen"
             " | plain text: ns | Pinocchio | + CppADCodeGen"
             " | 8 states in lanes: ns | Pinocchio | + CppADCodeGen |", "|---" * 11 + "|"]
    for data in recorded():
        for f in data["functions"]:
            ns = {b["name"]: b["ns"] for b in f["by"]}
            peers = [ns["Pinocchio"], ns["Pinocchio+CppADCodeGen"]]
            cells = [f"`{data['model']}` `{f['function']}`"]
            for kind, others in (("generated", [ns["generic"], *peers]), (PLAIN, peers),
                                 (LANES, peers)):
                own = ns.get(kind)
                cells += [f"{own:.1f}"] + [f"{x / own:.1f}" for x in others] if own else (
                    ["–"] * (1 + len(others)))
            lines.append("| " + " | ".join(cells) + " |")
    return lines + [""]


def write_table():
    """One line a model and function, one column a competitor: ns, and how many times as long."""
    lines = []
    for data in recorded():
        names = []
        for f in data["functions"]:
            names += [b["name"] for b in f["by"] if b["name"] not in names]
        lines.append(f"**{data['model']}** ({data['processor']}; {data['compiler']}), ns a state:\n")
        lines.append("| function | " + " | ".join(names) + " |")
        lines.append("|---" * (len(names) + 1) + "|")
        for f in data["functions"]:
            by = {b["name"]: b for b in f["by"]}
            cells = [f"{by[n]['ns']:.1f} ({by[n]['ratio']:.2f}×)" if n in by else "–"
                     for n in names]
            lines.append(f"| `{f['function']}` | " + " | ".join(cells) + " |")
        lines.append("")
    (ROOT / "bench/time/peers.md").write_text("\n".join(lines))
    page = ROOT / "docs/performance.md"
    begin, end = "<!-- bench/measure.py table -->\n", "<!-- end of table -->"
    before, rest = page.read_text().split(begin)
    page.write_text(before + begin + "\n".join(ratio_lines()) + "\n" + end + rest.split(end)[1])


COLOURS = ["#1b6ca8", "#6fb1e0", "#8a8a8a", "#c9b458", "#c98758", "#b35c8c", "#5c9a5c", "#3f3f3f"]


def bars(function):
    """SVG of the models' times of one function: bars, logarithmic, each with its number."""
    groups = [(d["model"], f["by"]) for d in recorded() for f in d["functions"]
              if f["function"] == function]
    names = []
    for _, by in groups:
        names += [b["name"] for b in by if b["name"] not in names]
    low, high = 1.0, 10.0
    while high < max(b["ns"] for _, by in groups for b in by):
        high *= 10
    width, left, row, y, out = 720, 190, 15, 34, []
    decades = len(str(int(high / low))) - 1

    def x(ns):
        from math import log10
        return left + (width - left - 70) * log10(max(ns, low) / low) / decades

    for model, by in groups:
        out.append(f'<text x="8" y="{y}" font-weight="bold">{model}</text>')
        for b in by:
            y += row
            colour = COLOURS[names.index(b["name"]) % len(COLOURS)]
            out.append(f'<text x="{left - 6}" y="{y}" text-anchor="end">{b["name"]}</text>')
            out.append(f'<rect x="{left}" y="{y - 10}" width="{x(b["ns"]) - left:.1f}" '
                       f'height="11" fill="{colour}"/>')
            out.append(f'<text x="{x(b["ns"]) + 4:.1f}" y="{y}">{b["ns"]:.4g}</text>')
        y += row + 8
    grid = [f'<line x1="{x(10 ** k):.1f}" y1="22" x2="{x(10 ** k):.1f}" y2="{y - 12}" '
            f'stroke="#ddd"/><text x="{x(10 ** k):.1f}" y="18" text-anchor="middle">'
            f'{10 ** k} ns</text>' for k in range(decades + 1)]
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{y}" '
            f'font-family="sans-serif" font-size="11">\n<rect width="100%" height="100%" '
            f'fill="white"/>\n<text x="8" y="18" font-weight="bold">{function}</text>\n'
            + "\n".join(grid + out) + "\n</svg>\n")


def write_plots():
    folder = ROOT / "docs/bench"
    folder.mkdir(exist_ok=True)
    functions = {f["function"] for d in recorded() for f in d["functions"]}
    for function in sorted(functions):
        (folder / f"{function}.svg").write_text(bars(function))


def main(arguments):
    actions = {"compile": write_compile, "table": write_table, "plot": write_plots}
    if arguments and arguments[0] == "peers" and len(arguments) > 2:
        write_peers(arguments[1], arguments[2], arguments[3:])
    elif len(arguments) == 1 and arguments[0] in actions:
        actions[arguments[0]]()
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
