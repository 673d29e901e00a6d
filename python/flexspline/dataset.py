"""Recordings: data sets on disk and in memory."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from . import _core

if TYPE_CHECKING:
    import xarray

Array = npt.NDArray[np.float64]

_UNITS = {
    "motor_angle": "rad", "load_angle": "rad", "torsion": "rad", "angle": "rad",
    "commanded_angle": "rad", "displacement": "m", "transmitted_torque": "N m", "torque": "N m",
    "motor_torque": "N m", "commanded_torque": "N m", "force": "N", "current": "A",
    "supply_voltage": "V", "temperature": "degC",
}


class Recording:
    """One measured time series in SI units (angles in rad, torques in N m, time in s).

    Args:
        id: name within its data set.
        time: instants in s, strictly increasing, shape (n,).
        channels: by quantity (``motor_angle``, ``transmitted_torque``, ...), each of shape (n,).
        split: ``"train"``, ``"holdout"`` or ``""``.
        excitation: ``"sine"``, ``"trajectory"`` or any other word.
        start_s: of its first sample, on the clock that all recordings of a data set share.

    Raises:
        flexspline.Error: a quantity that does not exist, or channels of unequal length.
    """

    def __init__(
        self,
        id: str,
        time: npt.ArrayLike,
        channels: Mapping[str, npt.ArrayLike],
        split: str = "",
        excitation: str = "",
        start_s: float = 0.0,
    ) -> None:
        self._core = _core.Recording(id, time, dict(channels), split, excitation, start_s)

    @classmethod
    def _of(cls, core: _core.Recording) -> Recording:
        recording = cls.__new__(cls)
        recording._core = core
        return recording

    @property
    def id(self) -> str:
        return self._core.id

    @property
    def split(self) -> str:
        return self._core.split

    @property
    def excitation(self) -> str:
        return self._core.excitation

    @property
    def time(self) -> Array:
        return self._core.time

    @property
    def channels(self) -> dict[str, Array]:
        return self._core.channels

    def to_xarray(self) -> xarray.Dataset:
        """The channels over time, with units as attributes."""
        import xarray

        variables = {
            name: ("time", values, {"units": _UNITS.get(name, "1")})
            for name, values in self.channels.items()
        }
        return xarray.Dataset(
            variables, coords={"time": ("time", self.time, {"units": "s"})}, attrs={"id": self.id}
        )

    def __repr__(self) -> str:
        return f"Recording({self.id!r}, {len(self.time)} samples, {sorted(self.channels)})"


class Dataset:
    """All recordings of one bench.

    Args:
        name: of the data set.
        rig: ``"locked"``, ``"free"``, ``"specimen"`` or ``"servo"``.
        recordings: in any order.
        constants: of the bench, by the keys of dataset.toml (``gear_ratio``, ...).
    """

    def __init__(
        self,
        name: str,
        rig: str,
        recordings: list[Recording],
        constants: Mapping[str, float] | None = None,
    ) -> None:
        self._core = _core.RecordingSet(
            name, rig, dict(constants or {}), [one._core for one in recordings]
        )

    @classmethod
    def read(cls, folder: str | os.PathLike[str]) -> Dataset:
        """Reads a folder with dataset.toml. Raises flexspline.Error with every finding at once."""
        dataset = cls.__new__(cls)
        dataset._core = _core.read_dataset(os.fspath(folder))
        return dataset

    def write(self, folder: str | os.PathLike[str]) -> None:
        """Writes dataset.toml and one CSV a recording. Raises FileExistsError where the folder holds
        a data set already."""
        if os.path.exists(os.path.join(folder, "dataset.toml")):
            raise FileExistsError(f"{os.fspath(folder)} holds a data set already")
        _core.write_dataset(os.fspath(folder), self._core)

    @property
    def name(self) -> str:
        return self._core.name

    @property
    def rig(self) -> str:
        return self._core.rig

    @property
    def constants(self) -> dict[str, float]:
        return self._core.constants

    @property
    def notes(self) -> list[str]:
        """What had to be decided in reading."""
        return self._core.notes

    @property
    def recordings(self) -> dict[str, Recording]:
        """By id."""
        return {one.id: Recording._of(one) for one in self._core.recordings}

    def __repr__(self) -> str:
        return f"Dataset({self.name!r}, rig {self.rig}, {len(self._core.recordings)} recordings)"
