"""MCAP files and rosbag2 databases by small writers of their own, from the public description of MCAP 0, the
schema of rosbag2's storage and the CDR of the OMG."""
import sqlite3
import struct
import zlib

import lz4.frame
import zstandard

from corpus import COUNTS, FILES, ROWS, T, TAU, THETA, column, expect, refuse, write

START = 1_700_000_000_000_000_000
LOGGED = [START + 10_000_000 * i for i in range(ROWS)]
STAMPS = [at - 1_500_000 for at in LOGGED]

HEADER = """MSG: std_msgs/Header
# two-integer timestamp
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"""
RULE = "=" * 80 + "\n"
JOINTS = "# the state of a set of joints\nstd_msgs/Header header\n\nstring[] name\nfloat64[] position\n" \
         "float64[] velocity\nfloat64[] effort\n" + RULE + HEADER
OWN = "uint8 READY=1  # a constant\nfloat32 tau 0.5\nint16[2] counts\nstring<=8 note\nbool on\nInner inner\n" \
      + RULE + "MSG: bench_msgs/Inner\nint64 big\nuint8 small\n"

WRENCH = "std_msgs/Header header\nWrench wrench\n" + RULE + "MSG: geometry_msgs/Wrench\nVector3 force\nVector3 torque\n" \
         + RULE + "MSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n" + RULE + HEADER


class Cdr:
    """A message: what is aligned, is so from behind the first four bytes."""

    def __init__(self, order="<"):
        self.order = order
        self.bytes = bytearray()

    def put(self, form, *values):
        for value in values:
            size = struct.calcsize(form)
            self.bytes += bytes(-len(self.bytes) % size) + struct.pack(self.order + form, value)
        return self

    def text(self, text):
        raw = text.encode() + b"\0"
        self.put("I", len(raw))
        self.bytes += raw
        return self

    def list(self, form, values):
        return self.put("I", len(values)).put(form, *values)

    def done(self):
        return bytes([0, 1 if self.order == "<" else 0, 0, 0]) + bytes(self.bytes)


def joint_state(i, names=("motor", "load"), order="<"):
    cdr = Cdr(order).put("i", STAMPS[i] // 10**9).put("I", STAMPS[i] % 10**9).text("base")
    cdr.put("I", len(names))
    for name in names:
        cdr.text(name)
    return cdr.list("d", [THETA[i], THETA[i] / 50][:len(names)]).list("d", []).list("d", [0.5, TAU[i]][:len(names)]).done()


def own(i):
    cdr = Cdr().put("f", i / 4).put("h", COUNTS[i], -i).text("x" * (i % 5)).put("?", i % 2 == 1)
    return cdr.put("q", 10**12 + i).put("B", i).done()


def text(value):
    raw = value.encode()
    return struct.pack("<I", len(raw)) + raw


def record(kind, content):
    return struct.pack("<BQ", kind, len(content)) + content


def schema(number, name, definition, encoding="ros2msg"):
    return record(3, struct.pack("<H", number) + text(name) + text(encoding) + text(definition))


def channel(number, of, topic, encoding="cdr"):
    return record(4, struct.pack("<HH", number, of) + text(topic) + text(encoding) + struct.pack("<I", 0))


def message(number, i, data):
    return record(5, struct.pack("<HIQQ", number, i, LOGGED[i], LOGGED[i]) + data)


def chunk(records, packing="", sum_of=zlib.crc32):
    packed = {"": bytes, "lz4": lz4.frame.compress, "zstd": zstandard.ZstdCompressor().compress}[packing](records)
    return record(6, struct.pack("<QQQI", LOGGED[0], LOGGED[-1], len(records), sum_of(records)) + text(packing)
                  + struct.pack("<Q", len(packed)) + packed)


def mcap(*records):
    mark = b"\x89MCAP0\r\n"
    return (mark + record(1, text("ros2") + text("corpus")) + b"".join(records) + record(15, struct.pack("<I", 0))
            + record(2, struct.pack("<QQI", 0, 0, 0)) + mark)


STAMPED = column("header.stamp", T, "s", True)
JOINT_COLUMNS = [STAMPED, column("position.motor", THETA, "rad"), column("position.load", [x / 50 for x in THETA], "rad"),
                 column("effort.motor", [0.5] * ROWS, "Nm"), column("effort.load", TAU, "Nm")]
OWN_COLUMNS = [column("log_time", T, "s", True), column("tau", [i / 4 for i in range(ROWS)]),
               column("counts[1]", COUNTS), column("counts[2]", [-i for i in range(ROWS)]),
               column("on", [i % 2 for i in range(ROWS)]), column("inner.big", [10**12 + i for i in range(ROWS)]),
               column("inner.small", range(ROWS))]
HEADS = schema(1, "sensor_msgs/msg/JointState", JOINTS) + channel(7, 1, "/joint_states") \
        + schema(2, "bench_msgs/msg/Own", OWN) + channel(8, 2, "/bench/own")


def both(i):
    return message(7, i, joint_state(i)) + message(8, i, own(i))


BOTH = b"".join(both(i) for i in range(ROWS))
TABLES = (("/joint_states", JOINT_COLUMNS), ("/bench/own", OWN_COLUMNS))


def mcap_files():
    write("plain.mcap", mcap(HEADS, BOTH))
    expect("plain.mcap", "mcap", *TABLES)
    halves = [b"".join(both(i) for i in half) for half in (range(ROWS // 2), range(ROWS // 2, ROWS))]
    write("chunks.mcap", mcap(chunk(HEADS + halves[0]), chunk(halves[1])))
    expect("chunks.mcap", "mcap", *TABLES)
    for packing in ("lz4", "zstd"):
        write(f"{packing}.mcap", mcap(chunk(HEADS + BOTH, packing)))
        expect(f"{packing}.mcap", "mcap", *TABLES)
    big_end = b"".join(message(7, i, joint_state(i, order=">")) for i in range(ROWS))
    write("big_end.mcap", mcap(HEADS, big_end))
    expect("big_end.mcap", "mcap", TABLES[0], notes=["topic '/bench/own' has no message"])
    other = b"".join(message(7, i, joint_state(i, ("motor",) if i == 5 else ("motor", "load"))) for i in range(ROWS))
    write("changing.mcap", mcap(HEADS, other, schema(3, "x/Y", "{}", "jsonschema"), channel(9, 3, "/json", "json")))
    expect("changing.mcap", "mcap", ("/joint_states", [
        {**c, "values": [v for i, v in enumerate(c["values"]) if i != 5]} for c in JOINT_COLUMNS]),
        notes=["1 of 40 messages of another shape", "topic '/json' is serialised as 'json'"])
    write("cut.mcap", mcap(HEADS, BOTH)[:4000])
    refuse("cut.mcap", "ends behind the file", "mcap recover")
    write("wrong_sum.mcap", mcap(chunk(HEADS + BOTH, "zstd", lambda records: 12345)))
    refuse("wrong_sum.mcap", "checksum of a chunk")
    bomb = record(6, struct.pack("<QQQI", 0, 0, 2**40, 0) + text("zstd") + struct.pack("<Q", 4) + b"\x28\xb5\x2f\xfd")
    write("bomb.mcap", mcap(bomb))
    refuse("bomb.mcap", "a chunk that is no chunk")
    write("circle.mcap", mcap(schema(1, "a/msg/A", "A again\n"), channel(7, 1, "/a"), message(7, 0, bytes(64))))
    refuse("circle.mcap", "lies in itself")


def two_topics():
    """A motor's state, and a sensor's wrench behind the gear, which logs every second one."""
    heads = schema(1, "sensor_msgs/msg/JointState", JOINTS) + channel(7, 1, "/motor/joint_state")
    heads += schema(2, "geometry_msgs/msg/WrenchStamped", WRENCH) + channel(8, 2, "/ft")
    every = b"".join(message(7, i, joint_state(i, ("motor",))) + (message(8, i, wrench(i)) if i % 2 == 0 else b"")
                     for i in range(ROWS))
    write("two_topics.mcap", mcap(heads, every))
    none = [0] * (ROWS // 2)
    torque = [column("header.stamp", T[::2], "s", True)]
    torque += [column(f"wrench.force.{a}", [1] * (ROWS // 2) if a == "z" else none, "N") for a in "xyz"]
    torque += [column(f"wrench.torque.{a}", TAU[::2] if a == "z" else none, "Nm") for a in "xyz"]
    expect("two_topics.mcap", "mcap", ("/motor/joint_state", [STAMPED, column("position.motor", THETA, "rad"),
                                                              column("effort.motor", [0.5] * ROWS, "Nm")]), ("/ft", torque))


def database(name, definitions, *topics):
    path = FILES / name
    db = sqlite3.connect(path)
    db.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
               "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)")
    db.execute("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, "
               "data BLOB NOT NULL)")
    if definitions:
        db.execute("CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL, "
                   "encoding TEXT NOT NULL, encoded_message_definition TEXT NOT NULL, type_description_hash TEXT NOT NULL)")
    for number, (topic, kind, definition, make) in enumerate(topics, 1):
        db.execute("INSERT INTO topics VALUES(?, ?, ?, 'cdr', '')", (number, topic, kind))
        if definitions:
            db.execute("INSERT INTO message_definitions(topic_type, encoding, encoded_message_definition, "
                       "type_description_hash) VALUES(?, 'ros2msg', ?, '')", (kind, definition))
        db.executemany("INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)",
                       [(number, LOGGED[i], make(i)) for i in range(ROWS)])
    db.commit()
    db.close()


def number(i):
    return Cdr().put("d", TAU[i]).done()


def array(i):
    return Cdr().put("I", 0, 0).list("f", [i, 0.5 * i]).done()


def wrench(i):
    stamp = Cdr().put("i", STAMPS[i] // 10**9).put("I", STAMPS[i] % 10**9).text("ft")
    return stamp.put("d", 0, 0, 1, 0, 0, TAU[i]).done()


def rosbags():
    joints = ("/joint_states", "sensor_msgs/msg/JointState", JOINTS, joint_state)
    database("jazzy.db3", True, joints, ("/bench/own", "bench_msgs/msg/Own", OWN, own))
    expect("jazzy.db3", "rosbag2", *TABLES)
    database("humble.db3", False, joints, ("/tau", "std_msgs/msg/Float64", "", number),
             ("/pair", "std_msgs/msg/Float32MultiArray", "", array),
             ("/ft", "geometry_msgs/msg/WrenchStamped", "", wrench), ("/odd", "my_msgs/msg/Odd", "", number))
    axes = [column(f"wrench.{what}.{axis}", values, unit) for what, unit, list_of in (
        ("force", "N", ([0] * ROWS, [0] * ROWS, [1] * ROWS)), ("torque", "Nm", ([0] * ROWS, [0] * ROWS, TAU)))
        for axis, values in zip("xyz", list_of)]
    expect("humble.db3", "rosbag2", TABLES[0], ("/tau", [column("log_time", T, "s", True), column("data", TAU)]),
           ("/pair", [column("log_time", T, "s", True), column("layout.data_offset", [0] * ROWS),
                      column("data[1]", range(ROWS)), column("data[2]", [0.5 * i for i in range(ROWS)])]),
           ("/ft", [STAMPED] + axes), notes=["topic '/odd' is of type 'my_msgs/msg/Odd', whose definition is not"])
    whole = (FILES / "humble.db3").read_bytes()
    write("cut.db3", whole[:len(whole) // 2])
    refuse("cut.db3", "SQLite cannot read it")
    db = sqlite3.connect(FILES / "other.db3")
    db.execute("CREATE TABLE numbers(a, b)")
    db.commit()
    db.close()
    refuse("other.db3", "no rosbag2", "sqlite3 -header -csv")


def make():
    mcap_files(), two_topics(), rosbags()
