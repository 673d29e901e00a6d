"""MATLAB files, by scipy, Octave and, for v7.3, h5py with MATLAB's attributes."""
import pathlib
import subprocess

import h5py
import numpy as np
from scipy.io import savemat

from corpus import COUNTS, FILES, ROWS, T, TAU, THETA, column, expect, refuse

HERE = pathlib.Path(__file__).resolve().parent
VECTORS = [column("t", T), column("tau", TAU)]


def up(values):
    return np.array(values, dtype=float).reshape(-1, 1)


def by_scipy():
    vectors = {"t": up(T), "tau": up(TAU)}
    savemat(FILES / "scipy5.mat", vectors)
    expect("scipy5.mat", "matlab", ("", VECTORS))
    savemat(FILES / "scipy7.mat", vectors, do_compression=True)
    expect("scipy7.mat", "matlab", ("", VECTORS))
    savemat(FILES / "rows.mat", {"t": np.array([T]), "tau": np.array([TAU])})
    expect("rows.mat", "matlab", ("", VECTORS))
    kinds = {"i1": (np.array(COUNTS) // 64).astype("i1"), "u2": (np.array(COUNTS) + 6000).astype("u2"),
             "i4": np.array(COUNTS, dtype="i4"), "f4": np.array(TAU, dtype="f4")}
    savemat(FILES / "kinds.mat", {k: v.reshape(-1, 1) for k, v in kinds.items()})
    expect("kinds.mat", "matlab", ("", [column(k, [float(x) for x in v]) for k, v in kinds.items()]))
    savemat(FILES / "matrix.mat", {"data": np.array([T, THETA, TAU]).T})
    expect("matrix.mat", "matlab", ("data", [column(f"data(:,{i + 1})", s) for i, s in enumerate((T, THETA, TAU))]))
    savemat(FILES / "nested.mat", {"bench": {"run": {"t": up(T), "tau": up(TAU), "units": {"tau": "Nm"}}, "gear": "HFUC"}})
    expect("nested.mat", "matlab", ("bench/run", [column("t", T), column("tau", TAU, "Nm")]))
    savemat(FILES / "beside.mat", {"Messung": {"Info": {"Name": "7"}, "Daten": {
        "Zeit": up(T), "Antrieb": {"Winkel_deg": up(THETA)}, "Abtrieb": {"Drehmoment_Nm": up(TAU)}}}})
    expect("beside.mat", "matlab", ("Messung/Daten", [column("Zeit", T), column("Antrieb.Winkel_deg", THETA),
                                                      column("Abtrieb.Drehmoment_Nm", TAU)]))
    runs = np.zeros((2,), dtype=[("t", "O"), ("tau", "O")])
    for k in range(2):
        runs[k] = (up(T), up([(k + 1) * v for v in TAU]))
    savemat(FILES / "struct_array.mat", {"runs": runs})
    expect("struct_array.mat", "matlab", ("runs(1)", VECTORS),
           ("runs(2)", [column("t", T), column("tau", [2 * v for v in TAU])]))
    savemat(FILES / "series.mat", {"log": {
        "tau": {"Name": "tau", "Time": up(T), "Data": up(TAU), "DataInfo": {"Units": "Nm"}, "TimeInfo": {"Units": "seconds"}},
        "theta_m": {"Name": "theta_m", "Time": up(T), "Data": up(THETA), "DataInfo": {"Units": "deg"}}}})
    expect("series.mat", "matlab", ("log", [column("Time", T, "seconds", True), column("tau", TAU, "Nm"),
                                            column("theta_m", THETA, "deg")]))
    channel = np.zeros((2,), dtype=[("Name", "O"), ("Data", "O"), ("Unit", "O"), ("XIndex", "O")])
    channel[0] = ("Torque", np.array([TAU]), "Nm", 1.0)
    channel[1] = ("MotorPos", np.array([THETA]), "deg", 1.0)
    savemat(FILES / "dspace.mat", {"exp1": {"X": {"Name": "", "Data": np.array([T]), "Unit": "s"}, "Y": channel,
                                            "Description": {"General": {"Version": 1.0}}}})
    expect("dspace.mat", "matlab", ("exp1", [column("Time", T, "s", True), column("Torque", TAU, "Nm"),
                                             column("MotorPos", THETA, "deg")]))
    signals = np.zeros((2,), dtype=[("values", "O"), ("label", "O")])
    signals[0], signals[1] = (up(TAU), "tau"), (np.array([THETA, COUNTS], dtype=float).T, "pos")
    savemat(FILES / "simulink.mat", {"out": {"time": up(T), "signals": signals, "blockName": "m/To Workspace"}})
    expect("simulink.mat", "matlab", ("out", [column("time", T, "s", True), column("tau", TAU), column("pos(:,1)", THETA),
                                              column("pos(:,2)", COUNTS)]))
    mixed = dict(vectors, note="a text", z=np.array([1 + 2j, 3j]), scalar=3.0, flag=np.array([True] * ROWS),
                 cell=np.array([1, "x"], dtype=object))
    savemat(FILES / "mixed.mat", mixed)
    expect("mixed.mat", "matlab", ("", VECTORS + [column("flag", [1] * ROWS)]),
           notes=["variable 'z' is of a class that is not read"])
    whole = (FILES / "scipy5.mat").read_bytes()
    (FILES / "cut.mat").write_bytes(whole[:140])
    refuse("cut.mat", "it has no variable that can be read")


def by_octave():
    subprocess.run(["octave", "--no-gui", "--quiet", "--norc", str(HERE / "make_matlab.m"), str(FILES)], check=True)
    for name in ("octave6.mat", "octave7.mat"):
        expect(name, "matlab", ("", VECTORS))
    expect("octave_struct.mat", "matlab", ("run", [column("t", T), column("theta_m", THETA), column("tau", TAU)]))
    expect("octave.h5", "hdf5", ("t", [column("value", T)]), ("tau", [column("value", TAU)]))
    expect("octave.csv", "csv", ("", [column("column 1", T), column("column 2", TAU)]))


def by_hand():
    """v7.3 as MATLAB lays it out: HDF5 behind a block of its own, arrays transposed, classes as attributes."""
    path = FILES / "seven_three.mat"
    with h5py.File(path, "w", userblock_size=512, libver="earliest") as f:
        def put(group, name, values):
            group.create_dataset(name, data=np.array([values], dtype=float)).attrs["MATLAB_class"] = np.bytes_("double")
        put(f, "t", T), put(f, "tau", TAU)
        run = f.create_group("run")
        run.attrs["MATLAB_class"] = np.bytes_("struct")
        put(run, "t", T), put(run, "theta_m", THETA)
        runs, refs = f.create_group("runs"), f.create_group("#refs#")
        runs.attrs["MATLAB_class"] = np.bytes_("struct")
        for field, values in (("t", T), ("tau", TAU)):
            for k in (1, 2):
                put(refs, f"{field}{k}", [k * v for v in values])
            runs.create_dataset(field, data=np.array([[refs[f"{field}{k}"].ref] for k in (1, 2)], dtype=h5py.ref_dtype))
        text = f.create_dataset("note", data=np.array([[104], [105]], dtype="u2"))
        text.attrs["MATLAB_class"] = np.bytes_("char")
    head = b"MATLAB 7.3 MAT-file, Platform: GLNXA64, Created on: Fri May 03 12:00:00 2024 HDF5 schema 1.00 ."
    with open(path, "r+b") as f:
        f.write(head.ljust(116, b" ") + b"\0" * 8 + b"\x00\x02IM")
    expect("seven_three.mat", "hdf5", ("", VECTORS), ("run", [column("t", T), column("theta_m", THETA)]),
           ("runs(1)", VECTORS), ("runs(2)", [column(n, [2 * v for v in s]) for n, s in (("t", T), ("tau", TAU))]))


def make():
    by_scipy(), by_octave(), by_hand()
