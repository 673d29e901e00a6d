"""From a concealed effect to a diagnosis, in Python.

The virtual bench hides an effect of 5 % of the peak torque; a baseline is fitted, the recordings are
diagnosed, and the model with what was missing predicts a loop.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import flexspline
from flexspline.study import program

folder = Path(tempfile.mkdtemp())
subprocess.run([program(), "init", "bench", str(folder / "bench")], check=True, stdout=subprocess.DEVNULL)
subprocess.run(
    [program(), "conceal", str(folder / "bench.toml"), "--out", str(folder / "concealed"), "--quiet"],
    check=True, stdout=subprocess.DEVNULL,
)

# %% The recordings
gear = flexspline.Dataset.read(folder / "concealed" / "dataset")
print(gear)
for recording in gear.recordings.values():
    torque = recording.channels["transmitted_torque"]
    print(f"  {recording.id}: {len(torque)} samples, peak {np.max(np.abs(torque)):.1f} Nm")

# %% The baseline, fitted by simulating whole recordings
estimate = flexspline.fit(gear, "trajectory_ceres")
print(estimate)

# %% What physics is missing
diagnosis = flexspline.diagnose(gear)
print(diagnosis.says)

if "--json" in sys.argv:
    print(json.dumps({"verdict": diagnosis.verdict,
                      "causes": [one["effect"] for one in diagnosis.causes]}))
