"""MDF4 files by a small writer of its own, from the public description of ASAM MDF 4.1."""
import struct
import zlib

from corpus import COUNTS, FILES, ROWS, T, TAU, THETA, column, expect, refuse


class Writer:
    """Blocks one after the other; a link is the place of a block that is there already."""

    def __init__(self):
        self.bytes = bytearray(b"MDF     4.10    corpus  " + bytes(4) + struct.pack("<H", 410) + bytes(34))
        self.bytes += bytes(104)  # the head, at 64, once its links are known

    def block(self, kind, links, data):
        while len(self.bytes) % 8:
            self.bytes.append(0)
        at = len(self.bytes)
        size = 24 + 8 * len(links) + len(data)
        self.bytes += b"##" + kind + bytes(4) + struct.pack("<QQ", size, len(links))
        self.bytes += struct.pack(f"<{len(links)}Q", *links) + data
        return at

    def text(self, text, kind=b"TX"):
        return self.block(kind, [], text.encode() + b"\0") if text else 0

    def conversion(self, kind, values):
        return self.block(b"CC", [0] * 4, struct.pack("<BBHHHdd", kind, 0, 0, 0, len(values), 0, 0)
                          + struct.pack(f"<{len(values)}d", *values))

    def channel(self, after, name, unit, byte, bits, data_type, kind=0, sync=0, bit=0, conversion=0, flags=0, mark=0):
        links = [after, 0, self.text(name), 0, conversion, 0, self.text(unit), 0]
        return self.block(b"CN", links, struct.pack("<BBBBIIII", kind, sync, data_type, bit, byte, bits, flags, mark)
                          + bytes(52))

    def group(self, channel, cycles, data_bytes, name="", record_id=0, after=0, invalid=0):
        return self.block(b"CG", [after, channel, self.text(name), 0, 0, 0],
                          struct.pack("<QQHHIII", record_id, cycles, 0, 0, 0, data_bytes, invalid))

    def data_group(self, group, data, after=0, id_bytes=0):
        return self.block(b"DG", [after, group, data, 0], bytes([id_bytes]) + bytes(7))

    def save(self, name, first):
        head = b"##HD" + bytes(4) + struct.pack("<QQ", 104, 6) + struct.pack("<6Q", first, 0, 0, 0, 0, 0) + bytes(32)
        self.bytes[64:168] = head
        (FILES / name).write_bytes(self.bytes)


REAL = 4
RECORDS = b"".join(struct.pack("<dff", t, x, y) for t, x, y in zip(T, TAU, THETA))


def single(values):
    return [struct.unpack("<f", struct.pack("<f", v))[0] for v in values]


COLUMNS = [column("time", T, "s", True), column("tau", single(TAU), "Nm"), column("theta_m", single(THETA), "deg")]


def three_channels(w):
    last = w.channel(0, "theta_m", "deg", 12, 32, REAL)
    middle = w.channel(last, "tau", "Nm", 8, 32, REAL)
    return w.channel(middle, "time", "s", 0, 64, REAL, kind=2, sync=1)


def transposed(data, width):
    rows = len(data) // width
    turned = bytes(data[r * width + c] for c in range(width) for r in range(rows))
    return turned + data[rows * width:]


def packed(w, data, turn=0):
    raw = zlib.compress(transposed(data, turn) if turn else data)
    return w.block(b"DZ", [], b"DT" + bytes([1 if turn else 0, 0]) + struct.pack("<IQQ", turn, len(data), len(raw)) + raw)


def listed(w, blocks):
    return w.block(b"DL", [0] + blocks, bytes(4) + struct.pack("<I", len(blocks)) + bytes(8 * len(blocks)))


def sorted_files():
    def one(name, data_of, path="group 1", title=""):
        w = Writer()
        group = w.group(three_channels(w), ROWS, 16, title)
        w.save(name, w.data_group(group, data_of(w)))
        expect(name, "mdf4", (path, COLUMNS))

    one("plain.mf4", lambda w: w.block(b"DT", [], RECORDS), "Bench/HFUC", "Bench/HFUC")
    one("deflated.mf4", lambda w: packed(w, RECORDS))
    one("transposed.mf4", lambda w: packed(w, RECORDS, 16))
    pieces = [RECORDS[:100], RECORDS[100:333], RECORDS[333:]]
    one("listed.mf4", lambda w: listed(w, [w.block(b"DT", [], p) for p in pieces]))
    one("packed_list.mf4", lambda w: w.block(b"HL", [listed(w, [packed(w, p, 16) for p in pieces])],
                                             struct.pack("<HBB4x", 1, 1, 0)))


def unsorted_file():
    w = Writer()
    slow = w.group(w.channel(w.channel(0, "temp", "degC", 8, 16, 2), "time", "s", 0, 64, REAL, kind=2, sync=1),
                   ROWS // 4, 10, "slow", record_id=2)
    fast = w.group(three_channels(w), ROWS, 16, "fast", record_id=1, after=slow)
    data = b""
    for i in range(ROWS):
        data += b"\x01" + RECORDS[16 * i:16 * i + 16]
        if i % 4 == 0:
            data += b"\x02" + struct.pack("<dh", T[i], 20 + i)
    w.save("unsorted.mf4", w.data_group(fast, w.block(b"DT", [], data), id_bytes=1))
    expect("unsorted.mf4", "mdf4", ("fast", COLUMNS),
           ("slow", [column("time", T[::4], "s", True), column("temp", [20 + i for i in range(0, ROWS, 4)], "degC")]))


def two_rates_file():
    """The angle at 100 Hz, the torque at 50 Hz, between samples of the angle."""
    w = Writer()
    angle = w.group(w.channel(w.channel(0, "theta_m", "deg", 8, 32, REAL), "time", "s", 0, 64, REAL, kind=2, sync=1),
                    ROWS, 12, "encoder")
    torque = w.group(w.channel(w.channel(0, "tau", "Nm", 8, 32, REAL), "time", "s", 0, 64, REAL, kind=2, sync=1),
                     ROWS // 2, 12, "sensor")
    later = [t + 0.005 for t in T[::2]]
    second = w.data_group(torque, w.block(b"DT", [], b"".join(struct.pack("<df", t, x) for t, x in zip(later, TAU[::2]))))
    first = w.data_group(angle, w.block(b"DT", [], b"".join(struct.pack("<df", t, x) for t, x in zip(T, THETA))), second)
    w.save("two_rates.mf4", first)
    expect("two_rates.mf4", "mdf4", ("encoder", [column("time", T, "s", True), column("theta_m", single(THETA), "deg")]),
           ("sensor", [column("time", later, "s", True), column("tau", single(TAU[::2]), "Nm")]))


def number_forms():
    w = Writer()
    linear = w.conversion(1, [10.0, 0.25])
    rational = w.conversion(2, [0, 2.0, 1.0, 0, 0, 4.0])
    table = w.conversion(4, [-5000, -1, 0, 0, 5000, 1])
    last = w.channel(0, "signed12", "", 2, 12, 2, bit=4)
    last = w.channel(last, "big", "", 4, 16, 3)
    last = w.channel(last, "table", "Nm", 6, 16, 2, conversion=table)
    last = w.channel(last, "rational", "", 6, 16, 2, conversion=rational)
    last = w.channel(last, "linear", "mNm", 0, 16, 2, conversion=linear)
    last = w.channel(last, "double_big", "", 8, 64, 5)
    first = w.channel(last, "index", "s", 0, 0, 0, kind=3, sync=1, conversion=w.conversion(1, [0.0, 0.01]))
    small = [v // 4 for v in COUNTS]
    data = b"".join(struct.pack("<hHHhd", c, (s & 0xFFF) << 4 | 0xF, 0, c, 0.0) for c, s in zip(COUNTS, small))
    data = bytearray(data)
    for i, (c, v) in enumerate(zip(COUNTS, TAU)):
        data[16 * i + 4:16 * i + 6] = struct.pack(">h", c)
        data[16 * i + 8:16 * i + 16] = struct.pack(">d", v)
    w.save("numbers.mf4", w.data_group(w.group(first, ROWS, 16), w.block(b"DT", [], bytes(data))))
    expect("numbers.mf4", "mdf4", ("group 1", [
        column("index", [0.01 * i for i in range(ROWS)], "s", True), column("double_big", TAU),
        column("linear", [10 + 0.25 * c for c in COUNTS], "mNm"),
        column("rational", [(2 * c + 1) / 4 for c in COUNTS]),
        column("table", [-1 + (c + 5000) / 5000 if c <= 0 else c / 5000 for c in COUNTS], "Nm"),
        column("big", COUNTS), column("signed12", small)]))


def invalid_samples():
    w = Writer()
    tau = w.channel(0, "tau", "Nm", 8, 64, REAL, flags=2, mark=3)
    time = w.channel(tau, "time", "s", 0, 64, REAL, kind=2, sync=1)
    data = b"".join(struct.pack("<ddB", t, v, 8 if i % 10 == 3 else 0) for i, (t, v) in enumerate(zip(T, TAU)))
    w.save("invalid.mf4", w.data_group(w.group(time, ROWS, 16, invalid=1), w.block(b"DT", [], data)))
    expect("invalid.mf4", "mdf4", ("group 1", [column("time", T, "s", True),
                                               column("tau", [None if i % 10 == 3 else v for i, v in enumerate(TAU)], "Nm")]))


def texts_between():
    w = Writer()
    remark = w.channel(0, "remark", "", 16, 64, 7)
    unit = w.text("<CNunit><TX>Nm</TX></CNunit>", b"MD")
    tau = w.block(b"CN", [remark, 0, w.text("tau"), 0, 0, 0, unit, 0],
                  struct.pack("<BBBBIIII", 0, 0, REAL, 0, 8, 64, 0, 0) + bytes(52))
    time = w.channel(tau, "time", "", 0, 64, REAL, kind=2, sync=1)
    data = b"".join(struct.pack("<dd8s", t, v, b"text") for t, v in zip(T, TAU))
    w.save("texts.mf4", w.data_group(w.group(time, ROWS, 24), w.block(b"DT", [], data)))
    expect("texts.mf4", "mdf4", ("group 1", [column("time", T, "s", True), column("tau", TAU, "Nm")]),
           notes=["channel 'remark' of 'group 1' holds no plain numbers"])


def refused():
    whole = (FILES / "plain.mf4").read_bytes()
    (FILES / "cut.mf4").write_bytes(whole[:-200])
    refuse("cut.mf4", "at byte")
    w = Writer()
    group = w.group(three_channels(w), ROWS, 16)
    at = w.data_group(group, 0)
    struct.pack_into("<Q", w.bytes, at + 24, at)
    w.save("circle.mf4", at)
    refuse("circle.mf4", "round in a circle")
    w = Writer()
    group = w.group(three_channels(w), ROWS, 16)
    bomb = w.block(b"DZ", [], b"DT" + bytes(2) + struct.pack("<IQQ", 0, 1 << 40, 16) + bytes(16))
    w.save("bomb.mf4", w.data_group(group, bomb))
    refuse("bomb.mf4", "not as long as they say")
    (FILES / "three.mdf").write_bytes(b"MDF     3.30    " + bytes(200))
    refuse("three.mdf", "MDF 3")


def make():
    sorted_files(), unsorted_file(), two_rates_file(), number_forms(), invalid_samples(), texts_between(), refused()
