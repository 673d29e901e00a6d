"""HDF5, netCDF-4 and classic netCDF, by h5py, netCDF4 and scipy."""
import h5py
import netCDF4
import numpy as np
from scipy.io import netcdf_file

from corpus import COUNTS, FILES, ROWS, T, TAU, THETA, column, expect, refuse


def new(name):
    return h5py.File(FILES / name, "w", libver="earliest")


def hdf5():
    with new("flat.h5") as f:
        for name, values, unit in (("t", T, "s"), ("tau", TAU, "Nm"), ("theta_m", THETA, "deg")):
            f.create_dataset(name, data=np.array(values)).attrs["unit"] = unit
    flat = [column("t", T, "s"), column("tau", TAU, "Nm"), column("theta_m", THETA, "deg")]
    expect("flat.h5", "hdf5", ("", flat))
    with new("groups.h5") as f:
        for run in ("run1", "run2"):
            f[f"bench/{run}/t"] = np.array(T)
            f[f"bench/{run}/tau"] = np.array(TAU) * (1 if run == "run1" else 2)
    expect("groups.h5", "hdf5", ("bench/run1", [column("t", T), column("tau", TAU)]),
           ("bench/run2", [column("t", T), column("tau", [2 * v for v in TAU])]))
    with new("records.h5") as f:
        rows = np.zeros(ROWS, dtype=[("t", "f8"), ("counts", "i4"), ("mark", "S4"), ("tau", "f4")])
        rows["t"], rows["counts"], rows["tau"] = T, COUNTS, TAU
        f["log"] = rows
    single = [float(np.float32(v)) for v in TAU]
    expect("records.h5", "hdf5", ("log", [column("t", T), column("counts", COUNTS), column("tau", single)]))
    with new("packed.h5") as f:
        raw = f.create_dataset("tau", data=np.array(COUNTS, dtype="i2"), compression="gzip", shuffle=True, chunks=(16,))
        raw.attrs["scale_factor"], raw.attrs["add_offset"], raw.attrs["_FillValue"] = 0.5, 10.0, np.int16(COUNTS[3])
        raw.attrs["units"] = np.bytes_("mNm")
        f["t"] = np.array(T)
    values = [None if v == COUNTS[3] else 0.5 * v + 10.0 for v in COUNTS]
    expect("packed.h5", "hdf5", ("", [column("t", T), column("tau", values, "mNm")]))
    with new("matrix.h5") as f:
        f["tall"] = np.array([T, TAU]).T
        f["wide"] = np.array([T, TAU])
    both = [column(f"{n}[{i + 1}]", s) for n in ("tall", "wide") for i, s in enumerate((T, TAU))]
    expect("matrix.h5", "hdf5", ("", both))
    with new("links.h5") as f:
        f["t"], f["tau"] = np.array(T), np.array(TAU)
        f["elsewhere"] = h5py.ExternalLink("/etc/passwd", "/x")
        f["again"] = h5py.SoftLink("/t")
        f["loop"] = f["/"]
    expect("links.h5", "hdf5", ("", [column("t", T), column("tau", TAU)]), notes=["'elsewhere' is a link", "'again' is a link"])
    with new("outside.h5") as f:
        f["t"] = np.array(T)
        f.create_dataset("tau", (ROWS,), dtype="f8", external=[("other.bin", 0, h5py.h5f.UNLIMITED)])
    (FILES / "other.bin").unlink(missing_ok=True)
    expect("outside.h5", "hdf5", ("", [column("t", T)]), notes=["'tau' lies in another file"])
    whole = (FILES / "flat.h5").read_bytes()
    (FILES / "cut.h5").write_bytes(whole[: len(whole) // 2])
    refuse("cut.h5", "HDF5 cannot open it")
    many = new("deep.h5")
    group = many
    for _ in range(40):
        group = group.create_group("g")
    many.close()
    refuse("deep.h5", "groups deeper than 32")


def netcdf():
    def fill(f, kind):
        f.createDimension("time", ROWS)
        for name, values, unit in (("time", T, "s"), ("tau", TAU, "Nm")):
            variable = f.createVariable(name, kind, ("time",))
            variable[:] = np.array(values)
            variable.units = unit

    table = [column("time", T, "s"), column("tau", TAU, "Nm")]
    with netCDF4.Dataset(FILES / "four.nc", "w") as f:
        fill(f, "f8")
    expect("four.nc", "hdf5", ("", [table[1], table[0]]))
    with netCDF4.Dataset(FILES / "offset64.nc", "w", format="NETCDF3_64BIT_OFFSET") as f:
        fill(f, "f8")
        packed = f.createVariable("counts", "i2", ("time",), fill_value=COUNTS[5])
        packed.set_auto_maskandscale(False)
        packed.scale_factor, packed.add_offset = 0.25, -3.0
        packed[:] = np.array(COUNTS, dtype="i2")
    values = [None if v == COUNTS[5] else 0.25 * v - 3.0 for v in COUNTS]
    expect("offset64.nc", "netcdf", ("time", table + [column("counts", values)]))
    with netCDF4.Dataset(FILES / "data64.nc", "w", format="NETCDF3_64BIT_DATA") as f:
        fill(f, "f8")
    expect("data64.nc", "netcdf", ("time", table))
    f = netcdf_file(FILES / "classic.nc", "w")
    fill(f, "f8")
    f.close()
    expect("classic.nc", "netcdf", ("time", table))
    whole = (FILES / "classic.nc").read_bytes()
    (FILES / "cut.nc").write_bytes(whole[:-100])
    refuse("cut.nc", "shorter than its variables")
    (FILES / "cut_head.nc").write_bytes(whole[:40])
    refuse("cut_head.nc", "shorter than its variables")


def make():
    hdf5(), netcdf()
