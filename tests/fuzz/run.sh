#!/usr/bin/env bash
# Runs the fuzzer: run.sh FUZZER ROLLWAVE PRM-DIRECTORY [OPTIONS of libFuzzer]
set -euo pipefail
fuzzer=$1 rollwave=$2 prm=$3
shift 3
here=$(cd "$(dirname "$0")" && pwd)
# libFuzzer adds what it finds to its first directory; kept, that would change the next run.
found=$(mktemp -d)
trap 'rm -rf "$found"' EXIT
"$rollwave" --parameters >"$found/every-key.prm"
# Most of the time goes into allocations; short records of where they were made suffice.
export ASAN_OPTIONS=${ASAN_OPTIONS:-}:malloc_context_size=3:quarantine_size_mb=16
# Within the limits, a hang or a large allocation is a failure too.
"$fuzzer" "$found" "$here/corpus" "$prm" -dict="$here/dictionary.txt" -max_len=2048 -timeout=5 \
  -rss_limit_mb=2048 -malloc_limit_mb=256 -artifact_prefix="$(dirname "$fuzzer")/" \
  -print_final_stats=1 "$@"
