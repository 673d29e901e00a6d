#!/usr/bin/env python3
"""two_workers.py FLEXSPLINE STUDY.toml [REPEATS]: what a second worker gives a study, on a machine
that others may be using. Each repeat runs, one right after the other, the study on one worker, on
two, and as two processes of one worker each at the same time, which share nothing: what the
machine has to give just then. One line of JSON: medians of the seconds that the runs state
(cases alone, without table and report), of `speedup` (one worker over two) and of `machine` (twice
one process over the pair), and their ratio, 1 where workers cost each other nothing."""
import json
import statistics
import subprocess
import sys
import tempfile


def start(program, study, folder, jobs):
    command = [program, "--json", "--quiet", "run", study, "--out", folder, "--jobs", str(jobs)]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)


def seconds(process):
    return json.loads(process.communicate()[0])["seconds"]


def main(program, study, repeats=5):
    rows = []
    for _ in range(int(repeats)):
        with tempfile.TemporaryDirectory() as folder:
            one = seconds(start(program, study, folder + "/1", 1))
            two = seconds(start(program, study, folder + "/2", 2))
            pair = [start(program, study, f"{folder}/{name}", 1) for name in "ab"]
            both = max([seconds(process) for process in pair])
        rows.append((one, two, both, one / two, 2.0 * one / both, 0.5 * both / two))
    names = ("one", "two", "pair", "speedup", "machine", "ratio")
    print(json.dumps({n: round(statistics.median(c), 3) for n, c in zip(names, zip(*rows))}))


if __name__ == "__main__":
    main(*sys.argv[1:])
