#!/bin/sh
# A study by GNU parallel: parallel.sh STUDY.toml DIR SHARDS [options of parallel, e.g. --sshlogin …]
set -e
study=$1 out=$2 shards=$3
shift 3
flexspline=${FLEXSPLINE:-flexspline}
seq "$shards" | parallel "$@" "$flexspline" run "$study" --out "$out" --jobs 1 --pull --shard "{}/$shards"
exec "$flexspline" run "$study" --out "$out" --gather
