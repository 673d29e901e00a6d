"""flexspline: identification and diagnosis of harmonic drive hysteresis.

>>> import flexspline
>>> gear = flexspline.Dataset.read("my-gear")
>>> estimate = flexspline.fit(gear)
>>> diagnosis = flexspline.diagnose(gear)
"""

from .dataset import Dataset, Recording
from .errors import Error
from .fitting import Diagnosis, Estimate, Parameter, diagnose, estimators, fit
from .model import Model
from .study import results, run

__all__ = [
    "Dataset", "Diagnosis", "Error", "Estimate", "Model", "Parameter", "Recording", "diagnose",
    "estimators", "fit", "results", "run",
]
