#!/usr/bin/env bash
# One target under libFuzzer, from its kept corpus, for FLEXSPLINE_FUZZ_SECONDS (60): says how many inputs it
# saw; fails where one of them is a finding, which is kept.
# usage: one.sh PROGRAM CORPUS FINDINGS
set -euo pipefail

program=$1 corpus=$2 findings=$3
name=${program##*flexspline_fuzz_}
seconds=${FLEXSPLINE_FUZZ_SECONDS:-60}
[[ $seconds =~ ^[1-9][0-9]{0,5}$ ]] || {
  echo "FLEXSPLINE_FUZZ_SECONDS = '$seconds' is no number of seconds from 1 to 999999"
  exit 2
}

scratch=$(mktemp -d -p "$([[ -w /dev/shm ]] && echo /dev/shm || echo "${TMPDIR:-/tmp}")")
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$scratch/tmp" "$scratch/corpus" "$findings"
status=0
# A run ends by itself; one that does not, hangs where libFuzzer does not look.
TMPDIR="$scratch/tmp" timeout --kill-after=10 $((seconds + 120)) "$program" \
  -max_total_time="$seconds" -timeout=20 -rss_limit_mb=4096 -print_final_stats=1 \
  -artifact_prefix="$findings/$name-" "$scratch/corpus" "$corpus" >"$scratch/log" 2>&1 || status=$?
runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$scratch/log" | tail -n 1)
if ((status == 0)); then
  echo "$name: ${runs:?} inputs in $seconds s, no finding"
  exit 0
fi
grep -v '^#[0-9]' "$scratch/log" | tail -n 60
grep -E 'ERROR: |runtime error: ' "$scratch/log" | head -n 5 || true
case $status in
  124 | 137) echo "$name: it did not end within $((seconds + 120)) s" ;;
  *) echo "$name: a finding (status $status); the input is kept in $findings/$name-*" ;;
esac
exit 1
