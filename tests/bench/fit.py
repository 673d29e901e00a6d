#!/usr/bin/env python3
"""fit.py FLEXSPLINE BENCH [NAME=VALUE ...] [--jobs N]: flexspline fit --estimator torque_driven on
the data set that convert.py left in BENCH/dataset, and one line of JSON as the peers print it:
wall_s (the fit alone, as the estimate states it), written_s (from the start of the command to the
estimate on disk), process_s (to its end, with the report) and theta in the benchmark's units. NAME=VALUE are options of the method. With --jobs 1 nothing else
of the command runs beside the fit."""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import time

TORSION = math.radians(0.2)
TORQUE = 20.0


def theta(model):
    f, g, h = model["f"], model["g_inverse"], model["h"]
    ratio = TORSION / f["scale"]
    k = [c * ratio ** (2 * i + 1) / TORQUE for i, c in enumerate(f["coefficients"])]
    rate = [c * g["scale"] / TORSION * TORQUE ** (2 * i + 1) for i, c in enumerate(g["coefficients"])]
    ratio = TORSION / h["scale"]
    return k + rate + [c * ratio ** (2 * i + 2) for i, c in enumerate(h["coefficients"])]


def main(program, bench, options):
    data = pathlib.Path(bench) / "dataset"
    sizes = json.loads((data / "bench.json").read_text())["sizes"]
    others = [word for word in options if "=" not in word]
    options = [word for word in options if "=" in word]
    options = ["%s_terms=%d" % pair for pair in zip("fgh", sizes)] + options
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "--quiet", "fit", str(data), "--estimator", "torque_driven"]
        command += ["--out", folder] + [word for o in options for word in ("--option", o)]
        command += others
        started = time.time()
        done = subprocess.run(command, capture_output=True, text=True)
        seconds = time.time() - started
        if done.returncode != 0:
            sys.exit(done.stderr)
        file = pathlib.Path(folder) / "estimate.json"
        written = file.stat().st_mtime - started
        estimate = json.loads(file.read_text())
    print(
        json.dumps(
            {
                "peer": " ".join(["flexspline"] + options[3:] + others),
                "wall_s": estimate["seconds"],
                "written_s": written,
                "process_s": seconds,
                "evaluations": estimate["evaluations"],
                "termination": estimate["termination"],
                "verdict": estimate["identifiability"]["verdict"],
                "theta": theta(estimate["model"]),
            }
        )
    )


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], sys.argv[3:])
