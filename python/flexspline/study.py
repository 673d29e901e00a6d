"""Studies, by the program, and their results as xarray."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray

from .errors import Error


def program() -> str:
    """The flexspline program: FLEXSPLINE_PROGRAM of the environment, else the one on the path."""
    found = os.environ.get("FLEXSPLINE_PROGRAM") or shutil.which("flexspline")
    if not found:
        raise FileNotFoundError("no program flexspline on the path; set FLEXSPLINE_PROGRAM")
    return found


def run(
    study: str | os.PathLike[str], out: str | os.PathLike[str], jobs: int | None = None
) -> xarray.Dataset:
    """Runs a study file into a folder, or goes on where an earlier run stopped, and gives its results.

    Raises:
        flexspline.Error: with the program's message and exit code; a study in which single cases
            failed is none of these: its results hold NaN there.
        KeyboardInterrupt: the program finishes the cases at hand; the same call goes on from there.
    """
    line = [program(), "run", os.fspath(study), "--out", os.fspath(out), "--quiet"]
    if jobs is not None:
        line += ["--jobs", str(jobs)]
    done = subprocess.run(line, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode > 1:
        message = done.stderr.strip()
        raise Error(done.returncode, message, "", message)
    return results(out)


def results(folder: str | os.PathLike[str]) -> xarray.Dataset:
    """results.nc of a study's folder."""
    import xarray

    return xarray.open_dataset(Path(folder) / "results.nc")
