"""Models: read, simulate, write."""

from __future__ import annotations

import os

import numpy as np
import numpy.typing as npt

from . import _core

Array = npt.NDArray[np.float64]


class Model:
    """The torsion law tau = f(phi) + g^-1(phi'/h(phi)) of Dhaouadi and Ghorbel (2003), with effects."""

    def __init__(self, core: _core.Model) -> None:
        self._core = core

    @classmethod
    def read(cls, file: str | os.PathLike[str]) -> Model:
        """Reads a MODEL.toml. Raises flexspline.Error with every finding at once."""
        return cls(_core.read_model(os.fspath(file)))

    @classmethod
    def parse(cls, text: str) -> Model:
        """The same from the text of a MODEL.toml."""
        return cls(_core.parse_model(text))

    def write(self, file: str | os.PathLike[str]) -> None:
        """Writes a MODEL.toml; numbers read back to the same bits."""
        _core.write_model(os.fspath(file), self._core)

    @property
    def toml(self) -> str:
        return self._core.toml

    @property
    def rig(self) -> str:
        """The bench that the model simulates; a torsion law alone is a specimen."""
        return str(self._core.rig)

    @property
    def effects(self) -> dict[str, dict[str, float]]:
        """Parameters in SI units by effect."""
        return self._core.effects

    def torque(
        self,
        time: npt.ArrayLike,
        torsion: npt.ArrayLike,
        rate: npt.ArrayLike | None = None,
        acceleration: npt.ArrayLike | None = None,
    ) -> Array:
        """Displacement-driven, eq. (4): the torque in N m along a torsion in rad at instants in s.

        Args:
            time, torsion: shape (n,).
            rate: in rad/s; by second-order differences of the torsion where it is not given.
            acceleration: in rad/s^2; by differences of the rate where it is not given.
        """
        instants = np.asarray(time, dtype=float)
        if rate is None:
            rate = np.gradient(np.asarray(torsion, dtype=float), instants)
        if acceleration is None:
            acceleration = np.gradient(np.asarray(rate, dtype=float), instants)
        return self._core.torque(instants, torsion, rate, acceleration)

    def torsion(self, time: npt.ArrayLike, torque: npt.ArrayLike, initial: float = 0.0) -> Array:
        """Torque-driven, eq. (3): the torsion in rad by CVODES, from `initial` at the first instant."""
        return self._core.torsion(time, torque, initial)
