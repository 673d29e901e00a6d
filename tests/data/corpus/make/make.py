#!/usr/bin/env python3
"""Makes every file of the corpus anew, and the list of what must come out of each.

Needs what the tests do not: python3-scipy, python3-h5py, python3-netcdf4, python3-lz4,
python3-zstandard, octave and r-base-core."""
import json
import subprocess

import make_hdf5
import make_matlab
import make_mdf
import make_ros
import make_text
from corpus import FILES, ROWS, T, TAU, column, expect, expected

FILES.mkdir(exist_ok=True)
for old in FILES.iterdir():
    old.unlink()
make_text.make()
subprocess.run(["Rscript", str(FILES.parent / "make" / "make_text.R"), str(FILES)], check=True)
expect("r.csv", "csv", ("", [column("t", T), column("tau", TAU)]))
numbered = [column("column 1", range(1, ROWS + 1)), column("t", T), column("tau", TAU)]
expect("r_csv2.csv", "csv", ("", numbered), notes=["decimal comma"])
expect("r_table.txt", "csv", ("", numbered), notes=["separated by blanks"])
make_hdf5.make(), make_matlab.make(), make_mdf.make(), make_ros.make()
names = {path.name for path in FILES.iterdir()}
assert names == set(expected), names ^ set(expected)
(FILES.parent / "expected.json").write_text(json.dumps(expected, ensure_ascii=False).replace("}, \"", "},\n\"") + "\n")
print(len(expected), "files")
