"""The Python package against closed forms and against the program."""

import json
import os
import signal
import subprocess
import sys
import textwrap
import threading
import time

import numpy as np
import pytest

import flexspline

CUBIC = textwrap.dedent(
    """
    schema = "flexspline-model/1"
    [f]
    law = "odd_polynomial"
    scale = 1.0
    coefficients = [10.0, 5.0]
    [g_inverse]
    law = "odd_polynomial"
    scale = 1.0
    coefficients = [3.0]
    """
)


def sine(amplitude, frequency, samples=400, cycles=2):
    t = np.linspace(0.0, cycles / frequency, samples)
    w = 2 * np.pi * frequency
    return t, amplitude * np.sin(w * t), amplitude * w * np.cos(w * t)


def gear(noise=0.0):
    """A specimen with f = 10 x + 5 x^3 and g^-1 = 3 v, on four loops."""
    random = np.random.default_rng(1)
    recordings = []
    for amplitude, frequency in [(1.0, 0.05), (0.6, 0.05), (1.0, 0.02), (0.8, 0.1)]:
        t, phi, rate = sine(amplitude, frequency)
        tau = 10 * phi + 5 * phi**3 + 3 * rate + noise * random.standard_normal(t.size)
        recordings.append(
            flexspline.Recording(
                f"a{amplitude}-f{frequency}", t, {"torsion": phi, "torque": tau}, excitation="sine"
            )
        )
    return flexspline.Dataset("cubic", "specimen", recordings)


def test_torque_is_the_closed_form():
    t, phi, rate = sine(0.7, 0.1)
    model = flexspline.Model.parse(CUBIC)
    torque = model.torque(t, phi, rate, np.zeros_like(t))
    np.testing.assert_allclose(torque, 10 * phi + 5 * phi**3 + 3 * rate, rtol=1e-12, atol=1e-12)


def test_torsion_undoes_torque():
    t, phi, rate = sine(0.7, 0.1, samples=2000)
    model = flexspline.Model.parse(CUBIC)
    torque = model.torque(t, phi, rate)
    np.testing.assert_allclose(model.torsion(t, torque, phi[0]), phi, atol=1e-5)


def test_a_model_survives_its_file(tmp_path):
    model = flexspline.Model.parse(CUBIC)
    model.write(tmp_path / "model.toml")
    assert flexspline.Model.read(tmp_path / "model.toml").toml == model.toml


def test_a_data_set_survives_its_folder(tmp_path):
    written = gear()
    written.write(tmp_path / "gear")
    read = flexspline.Dataset.read(tmp_path / "gear")
    assert read.rig == "specimen"
    assert sorted(read.recordings) == sorted(written.recordings)
    for id, recording in written.recordings.items():
        np.testing.assert_allclose(read.recordings[id].time, recording.time, rtol=1e-12)
        for name, values in recording.channels.items():
            np.testing.assert_allclose(read.recordings[id].channels[name], values, rtol=1e-9)
    with pytest.raises(FileExistsError):
        written.write(tmp_path / "gear")


def test_a_recording_becomes_xarray():
    one = gear().recordings["a1.0-f0.05"].to_xarray()
    assert one["torque"].attrs["units"] == "N m"
    assert one["torque"].dims == ("time",)


def test_a_fit_of_exact_data_predicts_another_loop():
    estimate = flexspline.fit(gear(), "trajectory_ceres", h="unity")
    assert estimate.converged
    t, phi, rate = sine(0.9, 0.04)
    truth = 10 * phi + 5 * phi**3 + 3 * rate
    error = estimate.model.torque(t, phi, rate, np.zeros_like(t)) - truth
    assert np.sqrt(np.mean(error**2)) < 2e-3 * np.max(np.abs(truth))
    assert all(isinstance(one, flexspline.Parameter) for one in estimate.parameters.values())


def test_nothing_is_missing_from_a_gear_of_the_baseline():
    diagnosis = flexspline.diagnose(gear(noise=0.05), threads=2)
    assert diagnosis.verdict == "adequate"
    assert diagnosis.causes == []
    assert diagnosis.artefact["holdout"]["nested"]
    quick = flexspline.diagnose(gear(noise=0.05), quick=True)
    assert not quick.artefact["holdout"]["nested"]
    with pytest.raises(flexspline.Error, match="there is no recording 'nothing'"):
        flexspline.diagnose(gear(noise=0.05), holdout=["nothing"])


def test_errors_say_what_is_wrong(tmp_path):
    with pytest.raises(flexspline.Error) as missing:
        flexspline.Dataset.read(tmp_path / "nowhere")
    assert missing.value.code == 66
    with pytest.raises(flexspline.Error, match="there is no rig"):
        flexspline.Dataset("x", "lockd", [])
    with pytest.raises(flexspline.Error, match="has 3 samples"):
        flexspline.Recording("x", [0.0, 1.0], {"torque": [1.0, 2.0, 3.0]})
    with pytest.raises(flexspline.Error):
        flexspline.fit(gear(), "no_such_method")
    with pytest.raises(KeyError, match="no recording nothing"):
        flexspline.fit(gear(), train=["nothing"])


def test_a_fit_is_interrupted_at_once():
    many = flexspline.Dataset(
        "long",
        "specimen",
        [
            flexspline.Recording(
                "long",
                np.arange(200000) * 0.01,
                {
                    "torsion": np.sin(np.arange(200000) * 0.003),
                    "torque": np.sin(np.arange(200000) * 0.003 + 0.1),
                },
            )
        ],
    )
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        while True:
            flexspline.fit(many, "trajectory_ceres")
    assert time.monotonic() - began < 3.0


def test_a_study_runs_and_opens_in_xarray(tmp_path):
    study = tmp_path / "study.toml"
    subprocess.run([os.environ["FLEXSPLINE_PROGRAM"], "init", "study", str(study)], check=True)
    results = flexspline.run(study, tmp_path / "out", jobs=2)
    assert {"estimator", "amplitude", "frequency"} <= set(results.dims)
    with pytest.raises(flexspline.Error) as missing:
        flexspline.run(tmp_path / "none.toml", tmp_path / "other")
    assert missing.value.code == 66


def test_the_example_runs(tmp_path):
    example = os.path.join(os.path.dirname(__file__), "..", "examples", "first_steps.py")
    done = subprocess.run(
        [sys.executable, example, "--json"], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    told = json.loads(done.stdout.splitlines()[-1])
    assert told["verdict"] == "explained"
    assert told["causes"] == ["presliding_hysteresis"]
