"""Estimates and diagnoses."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from . import _core
from .dataset import Dataset
from .model import Model


@dataclass(frozen=True)
class Parameter:
    """An estimated number; std and ci95 are None where there is none."""

    value: float
    std: float | None
    ci95: tuple[float, float] | None
    unit: str
    bound_active: bool


class Estimate:
    """What an estimator gives back; `artefact` is the whole flexspline-estimate/1."""

    def __init__(self, artefact: dict[str, Any], model: Model) -> None:
        self.artefact = artefact
        self.model = model

    @property
    def parameters(self) -> dict[str, Parameter]:
        result = {}
        for one in self.artefact["parameters"]:
            ci95 = one.get("ci95")
            known = ci95 is not None and None not in ci95
            result[one["name"]] = Parameter(
                one["value"], one["std"], tuple(ci95) if known else None, one["unit"],
                one["bound_active"],
            )
        return result

    @property
    def converged(self) -> bool:
        return bool(self.artefact["termination"] == "converged")

    @property
    def notes(self) -> list[str]:
        return list(self.artefact.get("notes", []))

    def __repr__(self) -> str:
        return (
            f"Estimate({self.artefact['estimator']}, {self.artefact['termination']}, "
            f"{len(self.artefact['parameters'])} parameters)"
        )


class Diagnosis:
    """What a diagnosis found; `artefact` is the whole flexspline-diagnosis/1."""

    def __init__(self, artefact: dict[str, Any], model: Model | None) -> None:
        self.artefact = artefact
        self.model = model

    @property
    def verdict(self) -> str:
        """adequate, explained, partly_explained, unexplained or undecided."""
        return str(self.artefact["verdict"])

    @property
    def says(self) -> str:
        return str(self.artefact.get("says", ""))

    @property
    def causes(self) -> list[dict[str, Any]]:
        return list(self.artefact["causes"])

    def __repr__(self) -> str:
        return f"Diagnosis({self.verdict}, {[one['effect'] for one in self.causes]})"


def fit(
    dataset: Dataset,
    estimator: str = "trajectory_ceres",
    train: list[str] | None = None,
    **options: float | str,
) -> Estimate:
    """Fits an estimator of the catalogue (`flexspline.estimators()`).

    Args:
        dataset: of a locked or free rig, or of a specimen.
        estimator: id.
        train: ids of the recordings to fit; all that are not marked as hold-out where not given.
        options: settings of the estimator, e.g. ``h="unity"``.

    Raises:
        flexspline.Error: recordings or options that the estimator cannot take, or numerics.
        KeyboardInterrupt: at once; the fit that is left behind ends by itself.
    """
    if train is None:
        train = [one.id for one in dataset.recordings.values() if one.split != "holdout"]
    unknown = sorted(set(train) - set(dataset.recordings))
    if unknown:
        raise KeyError(f"no recording {', '.join(unknown)}; there are {sorted(dataset.recordings)}")
    words = {key: value for key, value in options.items() if isinstance(value, str)}
    numbers = {key: float(value) for key, value in options.items() if not isinstance(value, str)}
    text, model = _core.fit(dataset._core, estimator, train, numbers, words)
    return Estimate(json.loads(text), Model(model))


def diagnose(
    dataset: Dataset,
    threads: int = 0,
    *,
    holdout: Iterable[str] = (),
    quick: bool = False,
) -> Diagnosis:
    """Where the baseline of the rig and the recordings differ, and what physics is missing.

    Args:
        threads: 0 for as many as the machine has. The result does not depend on it.
        holdout: ids of recordings that are taken away before the search and on which the result is
            judged once; none: the whole search is made again in outer folds, and judged on those.
        quick: no outer folds: less time, and a proof that is cross-validated, its
            selection not nested.

    Raises:
        flexspline.Error: recordings that cannot be used, an id that does not exist, or numerics.
    """
    text, model = _core.diagnose(dataset._core, threads, list(holdout), not quick)
    return Diagnosis(json.loads(text), None if model is None else Model(model))


def estimators() -> list[str]:
    """Ids of the catalogue of estimators."""
    return list(_core.estimators())
