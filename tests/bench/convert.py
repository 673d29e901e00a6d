#!/usr/bin/env python3
"""convert.py BENCH OUT: a folder of the peers' benchmark (loops.csv, samples.csv, meta.json) as a
data set that flexspline reads. Units there: torsion in 0.2 deg, torque in 20 Nm, time in s."""
import csv
import json
import pathlib
import sys

TORSION_DEG = 0.2
TORQUE_NM = 20.0


def main(bench, out):
    bench, out = pathlib.Path(bench), pathlib.Path(out)
    out.mkdir(parents=True, exist_ok=True)
    meta = json.loads((bench / "meta.json").read_text())
    loops = list(csv.DictReader(open(bench / "loops.csv")))
    tables = {loop["loop"]: [] for loop in loops}
    for row in csv.DictReader(open(bench / "samples.csv")):
        tables[row["loop"]].append(
            "%s,%.17g,%.17g\n"
            % (row["t"], float(row["phi"]) * TORSION_DEG, float(row["tau"]) * TORQUE_NM)
        )
    text = [
        'schema = "flexspline-dataset/1"',
        'name = "%s"' % bench.name,
        'rig = "specimen"',
        'license = "CC0-1.0"',
        "",
        "[channels]",
        't = { quantity = "time", unit = "s" }',
        'torsion = { quantity = "torsion", unit = "deg" }',
        'torque = { quantity = "torque", unit = "Nm" }',
    ]
    for loop in loops:
        name = "loop%s" % loop["loop"]
        (out / (name + ".csv")).write_text("t,torsion,torque\n" + "".join(tables[loop["loop"]]))
        text += [
            "",
            "[[recording]]",
            'id = "%s"' % name,
            'file = "%s.csv"' % name,
            "amplitude_deg = %.17g" % (float(loop["amp"]) * TORSION_DEG),
            "frequency_hz = %.17g" % float(loop["f"]),
            'split = "train"',
        ]
    (out / "dataset.toml").write_text("\n".join(text) + "\n")
    (out / "bench.json").write_text(json.dumps({"sizes": meta["sizes"]}))


if __name__ == "__main__":
    main(*sys.argv[1:3])
