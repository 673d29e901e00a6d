#!/usr/bin/env bash
# Guided fuzzing of every target, two at a time: builds the preset fuzz into a folder of its own, beside a
# build whose libraries it links, and gives each target FLEXSPLINE_FUZZ_SECONDS (60).
# usage: run.sh SOURCE BUILD WORK
set -euo pipefail

source=$1 build=$2 work=$3
here=$source/tests/fuzz
atonce=2
skip() { echo "skipped: $*"; exit 77; }

command -v clang++-19 >/dev/null || skip "clang++-19 is not installed (cmake/debian-packages.txt)"
echo 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }' |
  clang++-19 -x c++ -fsanitize=fuzzer,address,undefined - -o /dev/null 2>/dev/null ||
  skip "clang 19 has no libFuzzer here (libclang-rt-19-dev)"
echo 'int main() { return 0; }' | clang++-19 -x c++ -fopenmp - -o /dev/null 2>/dev/null ||
  skip "clang 19 has no OpenMP here (libomp-19-dev), which SUNDIALS asks for"
grep -q -- '-fsanitize=' "$build/CMakeCache.txt" && skip "this build has sanitizers of its own"

cmake --preset fuzz -S "$source" -B "$work" "-DFLEXSPLINE_FUZZ_REST=$build" >"$work.log" 2>&1 ||
  { tail -n 30 "$work.log"; exit 1; }
cmake --build "$work" --target flexspline_fuzz --parallel "$atonce" >"$work.log" 2>&1 ||
  { grep -v '^\[' "$work.log" | tail -n 60; exit 1; }
times >"$work.log"
printf 'built in %d s, %s of processors\n' "$SECONDS" "$(sed -n '2s/ .*//p' "$work.log")"

# The exit status of xargs tells whether any of them failed; what each says comes in one piece.
find "$here" -maxdepth 1 -name '*.cpp' -printf '%f\n' | sort | sed 's/\.cpp$//' |
  xargs -P "$atonce" -I '{}' bash -c 'said=$("$0" "$1/flexspline_fuzz_$3" "$2/$3" "$4" 2>&1); status=$?; echo "$said"; exit $((status != 0))' \
    "$here/guided/one.sh" "$work/bin" "$here/corpus" '{}' "$work/findings"
