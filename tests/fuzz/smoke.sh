#!/bin/bash
# The libFuzzer targets of tests/fuzz/targets, built by clang with both sanitizers, for a short while each over their corpora.
#   smoke.sh build              configures and builds them into build-fuzz/
#   smoke.sh unit MODULE        runs a module's unit tests, built alike (docs/decisions/0012-sanitizers-in-test.md)
#   smoke.sh TARGET [SECONDS]   runs one of them: no crash, no hang, no leak, no more than 2 GiB
# Exit code 77: cannot be run here, with the reason. Longer, and with inputs that are new each time: CONTRIBUTING.md.
set -uo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$source/build-fuzz

skip() { echo "skipped: $1"; exit 77; }

command -v clang++ >/dev/null || skip "clang is not installed (Debian: clang libclang-rt-14-dev)"
probe=$(mktemp -d)
trap 'rm -rf "$probe"' EXIT
echo 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }' >"$probe/probe.cpp"
clang++ -fsanitize=fuzzer,address,undefined "$probe/probe.cpp" -o "$probe/probe" >"$probe/log" 2>&1 ||
    skip "clang links no libFuzzer (Debian: libclang-rt-14-dev): $(tail -n 1 "$probe/log")"

if [ "$1" = build ]; then
    cd "$source" || exit 1
    launcher=()
    command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
    { cmake --preset fuzz "${launcher[@]}" && cmake --build --preset fuzz; } >"$probe/log" 2>&1 && exit 0
    tail -n 60 "$probe/log"
    exit 1
fi

if [ "$1" = unit ]; then
    [ -x "$build/test_$2" ] || skip "test_$2 has not been built (smoke.sh build)"
    cd "$build" && exec "./test_$2" --gtest_brief=1
fi

target=$1
seconds=${2-20}
[ -x "$build/fuzz_$target" ] || skip "fuzz_$target has not been built (smoke.sh build)"
found=$build/found/
mkdir -p "$found" "$probe/new"
# The same inputs wherever it runs, so that it fails for what was changed. A reader that allocates more than a quarter of the bound
# at once is one that believes a header.
"$build/fuzz_$target" -seed=1 -max_total_time="$seconds" -timeout=25 -rss_limit_mb=2048 -malloc_limit_mb=1024 -max_len=8192 \
    -dict="$source/tests/fuzz/dictionaries/$target.dict" -artifact_prefix="$found" -print_final_stats=1 \
    "$probe/new" "$source/tests/fuzz/corpus/$target" >"$probe/log" 2>&1
code=$?
runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$probe/log")
inputs=$(find "$source/tests/fuzz/corpus/$target" -type f | wc -l)
if [ "$code" != 0 ]; then
    grep -a -v '^#[0-9]' "$probe/log" | tail -n 60
    echo "FAIL: fuzz_$target ended with exit code $code; the input is in $found, and fuzz_$target FILE runs it again"
    exit 1
fi
# One run for each file of the corpus comes first.
if [ -z "$runs" ] || [ "$runs" -le "$inputs" ]; then
    echo "FAIL: fuzz_$target took ${runs:-no} inputs, its corpus alone has $inputs"
    exit 1
fi
echo "fuzz_$target: $runs inputs, $(sed -n 's/^stat::peak_rss_mb: *//p' "$probe/log") MB"
