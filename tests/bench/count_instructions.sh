#!/usr/bin/env bash
# count_instructions.sh PROGRAM GOLDEN [--record]: instructions of the base fit by callgrind, against
# the number in GOLDEN; more than 10 % above it fails. --record writes the number down instead.
set -euo pipefail

program=$1
golden=$2
if ! command -v valgrind >/dev/null; then
  if [[ -n ${CI:-} ]]; then
    echo "valgrind is not installed: continuous integration must not pass without the count" >&2
    exit 1
  fi
  echo "skipped: valgrind is not installed"
  exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
valgrind --tool=callgrind --toggle-collect='*counted_base_fit*' \
  --callgrind-out-file="$folder/out" "$program" >"$folder/says" 2>&1 || {
  cat "$folder/says" >&2
  exit 1
}
count=$(sed -n 's/^summary: \([0-9]*\).*/\1/p; s/^totals: \([0-9]*\).*/\1/p' "$folder/out" | head -n 1)
# A count of nothing (no such function, another format) would pass any limit.
if ! [[ $count =~ ^[0-9]+$ ]] || ((count < 1000000)); then
  echo "callgrind counted '$count' instructions of counted_base_fit: the count itself is broken" >&2
  exit 1
fi
if [[ ${3:-} == --record ]]; then
  echo "$count" >"$golden"
  echo "recorded $count instructions"
  exit 0
fi
recorded=$(cat "$golden")
if ! [[ $recorded =~ ^[0-9]+$ ]]; then
  echo "$golden holds no number: record one" >&2
  exit 1
fi
echo "$count instructions, recorded $recorded"
if ((count * 10 > recorded * 11)); then
  echo "the base fit takes more than 10 % more instructions than recorded;" \
    "find out why, or record the new number: $0 $program $golden --record" >&2
  exit 1
fi
if ((count * 10 < recorded * 9)); then
  echo "more than 10 % fewer than recorded: record the new number, so that growing back is noticed:" \
    "$0 $program $golden --record" >&2
  exit 1
fi
