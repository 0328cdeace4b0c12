#!/usr/bin/env python3
"""Runs the sixteen tasks of the human and those of the plane model, and prints the tables of
docs/posture.md: objectives, dominance, times, random starts.

    apps/posture/tables.py build/release/bin/posture [RANDOM STARTS]
"""
import json
import pathlib
import subprocess
import sys
import tempfile

TASKS = pathlib.Path(__file__).parent / "tasks"
MEASURES = ["displacement", "torque", "normalised", "norm"]


def solve(program, task, *options):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, TASKS / (task + ".toml"), "-o", folder, *options],
                       stdout=subprocess.DEVNULL)
        return json.loads((pathlib.Path(folder) / "result.json").read_text())


def quantile(values, part):
    values = sorted(values)
    return values[round(part * (len(values) - 1))]


def row(cells):
    print("| " + " | ".join(str(c) for c in cells) + " |")


def objectives(results, model, trials):
    print(f"\n{model}: objective, largest normalised torque, KKT error, violation\n")
    row(["trial", "Obj1", "Obj2", "Obj3", "Obj4"])
    row(["---"] * 5)
    for trial in trials:
        cells = []
        for r in results[trial]:
            cells.append(f"{r['objective']:.5g} ({r['max_normalised_torque']:.3f})"
                         if r["status"] == "optimal" else r["reason"])
        row([trial] + cells)
    solved = [r for trial in trials for r in results[trial] if r["status"] == "optimal"]
    print(f"\n{len(solved)} optimal; largest KKT error {max(r['kkt_error'] for r in solved):.1e}, "
          f"violation {max(r['max_violation'] for r in solved):.1e}")


def dominance(results, trials):
    for trial in trials:
        matrix = [[r["measures"][m] for r in results[trial]] for m in MEASURES]
        good = all(matrix[k][k] <= min(matrix[k]) * (1 + 1e-3) for k in range(4))
        print(f"\ntrial {trial}: measure k of the posture that objective j gives; least on the "
              f"diagonal: {good}\n")
        row(["", "Obj1", "Obj2", "Obj3", "Obj4"])
        row(["---"] * 5)
        for k, name in enumerate(MEASURES):
            row([name] + [f"{x:.5g}" for x in matrix[k]])


def times(results, trials):
    starts = [s for trial in trials for r in results[trial] for s in r["starts"]
              if s["status"] == "optimal"]
    cpu = [1e3 * s["cpu_seconds"] for s in starts]
    wall = [1e3 * s["seconds"] for s in starts]
    functions = sum(s["derivative_seconds"] for s in starts) / sum(s["seconds"] for s in starts)
    hessians = sum(s["hessian_seconds"] for s in starts) / sum(s["seconds"] for s in starts)
    print(f"\n{len(starts)} solved starts: CPU median {quantile(cpu, .5):.1f} ms, 95 % "
          f"{quantile(cpu, .95):.1f} ms, worst {max(cpu):.1f} ms; wall median "
          f"{quantile(wall, .5):.1f} ms, worst {max(wall):.1f} ms")
    steps = [s["iterations"] for s in starts]
    print(f"iterations median {quantile(steps, .5)}, {min(steps)} to {max(steps)}")
    print(f"share of functions and derivatives {functions:.1%}, of Hessians {hessians:.1%}")
    again = [1e3 * r["again"]["cpu_seconds"] for trial in trials for r in results[trial]]
    steps = [r["again"]["iterations"] for trial in trials for r in results[trial]]
    print(f"target moved by 2 cm, warm: CPU median {quantile(again, .5):.1f} ms, worst "
          f"{max(again):.1f} ms; iterations median {quantile(steps, .5)}, worst {max(steps)}")


def random_starts(program, count):
    print(f"\n{count} random starts, Obj3\n")
    row(["trial", "solved", "without restart", "best", "CPU median"])
    row(["---"] * 5)
    for trial in range(1, 5):
        r = solve(program, f"santos_trial{trial}_obj3", "--random", "--starts", str(count))
        solved = [s for s in r["starts"] if s["status"] == "optimal"]
        row([trial, len(solved), sum(s["restarts"] == 0 for s in solved), f"{r['objective']:.4f}",
             f"{1e3 * quantile([s['cpu_seconds'] for s in solved], .5):.0f} ms"])


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    human, plane = {}, {}
    for trial in range(1, 5):
        human[trial] = [solve(program, f"santos_trial{trial}_obj{k}", "--move", "0.02", "0", "0")
                        for k in range(1, 5)]
        plane[trial] = [solve(program, f"nine_dof_trial{trial}_obj{k}") for k in range(1, 5)]
    objectives(human, "santos", human)
    dominance(human, human)
    times(human, human)
    random_starts(program, int(sys.argv[2]) if len(sys.argv) > 2 else 100)
    objectives(plane, "nine_dof", plane)
    dominance(plane, [1, 2, 3])


main()
