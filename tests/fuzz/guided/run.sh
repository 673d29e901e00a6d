#!/usr/bin/env bash
# Guided fuzzing for a minute a target: builds the preset fuzz into a folder of its own, beside a build
# whose libraries it links, and runs its tests.
# usage: guided.sh SOURCE BUILD WORK
set -euo pipefail

source=$1 build=$2 work=$3
skip() { echo "skipped: $*"; exit 77; }

command -v clang++-19 >/dev/null || skip "clang++-19 is not installed (cmake/debian-packages.txt)"
echo 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }' |
  clang++-19 -x c++ -fsanitize=fuzzer,address,undefined - -o /dev/null 2>/dev/null ||
  skip "clang 19 has no libFuzzer here (libclang-rt-19-dev)"
grep -q -- '-fsanitize=' "$build/CMakeCache.txt" && skip "this build has sanitizers of its own"

jobs=$(nproc)
cmake --preset fuzz -S "$source" -B "$work" "-DFLEXSPLINE_FUZZ_REST=$build" >/dev/null
cmake --build "$work" --target flexspline_fuzz --parallel "$jobs" | tail -n 3
ctest --test-dir "$work" -R '^Fuzz\.' --parallel "$jobs" --output-on-failure --no-tests=error
