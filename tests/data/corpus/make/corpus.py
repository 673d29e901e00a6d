"""What every maker of the corpus shares: the numbers that its files hold, and the list of what must
come out of each."""
import math
import pathlib

ROWS = 40
FILES = pathlib.Path(__file__).resolve().parent.parent / "files"

T = [i / 100 for i in range(ROWS)]
T_MS = [10 * i for i in range(ROWS)]
THETA = [round(400 * math.sin(0.3 * i), 3) for i in range(ROWS)]
TAU = [round(25.5 * math.sin(0.3 * i + 0.2), 4) for i in range(ROWS)]
BIG = [round(1000 + 123456.5 * math.cos(0.3 * i), 1) for i in range(ROWS)]
COUNTS = [int(5000 * math.sin(0.3 * i)) for i in range(ROWS)]

expected = {}


def column(name, values, unit="", clock=False):
    return {"name": name, "unit": unit, "clock": clock, "values": list(values)}


def expect(file, reader, *tables, notes=()):
    """tables: (path, columns) as they must come out, in their order; None stands for an absent cell.
    notes: pieces of what must be said."""
    expected[file] = {
        "reader": reader,
        "tables": [{"path": path, "columns": columns} for path, columns in tables],
        "notes": list(notes),
    }


def refuse(file, *pieces):
    """The file must be refused, in words that hold these pieces."""
    expected[file] = {"refused": list(pieces)}


def write(file, content, encoding="utf-8"):
    data = content if isinstance(content, bytes) else content.encode(encoding)
    (FILES / file).write_bytes(data)
