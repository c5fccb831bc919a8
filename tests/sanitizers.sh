#!/usr/bin/env bash
# Everything under the address and undefined-behaviour sanitizers (preset sanitize), and its tests.
#   sanitizers.sh [SECONDS]   no longer than that: what it has not come to by then is said, and counts as skipped
# Left out: what builds or fuzzes by itself, plants bugs, packs, or drives a browser. The last line: N passed, N failed, N skipped.
set -uo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$source/build-sanitize
limit=${1-86400}
log=$(mktemp)
trap 'rm -f "$log"' EXIT
# Drivers that have been closed leave memory behind, which by then has no name that a suppression could tell from ours; the fuzz
# targets, which open none, look for leaks.
export ASAN_OPTIONS=detect_leaks=0

cd "$source" || exit 1
free=$(($(df --output=avail -k . | tail -n 1) / 1048576))
if [ ! -d "$build" ] && [ "$free" -lt 8 ]; then
    echo "skipped: the sanitized build takes 4 GiB, of which $free are free"
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
fi
cmake --preset sanitize >"$log" 2>&1 || { tail -n 40 "$log"; echo "0 passed, 1 failed, 0 skipped"; exit 1; }
timeout -k 10 "$((limit > SECONDS ? limit - SECONDS : 1))" cmake --build --preset sanitize >"$log" 2>&1
code=$?
if [ "$code" -ge 124 ]; then
    echo "skipped: the sanitized build was not done after $limit s: $(grep -o '^\[[0-9]*/[0-9]*\]' "$log" | tail -n 1)"
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
fi
[ "$code" = 0 ] || { grep -E -A 20 'error|FAILED' "$log" | head -n 80; echo "0 passed, 1 failed, 0 skipped"; exit 1; }
built=$SECONDS

# What holds times to bounds has bounds for a program without sanitizers. The naive forms come last: they take a third of the time, and
# ask more of the drivers than of this code. A test that fails is run once more, for instrumented code is slow and some tests wait for
# each other; but what a sanitizer has reported stays a failure.
left_out='^(fuzz\.(build|smoke|sanitized)|mutation\.|scale\.|consumer\.|browser\.|LatencyTest\.)'
run_tests() { # ARGUMENTS OF ctest
    timeout -k 10 "$((limit > SECONDS ? limit - SECONDS : 1))" ctest --test-dir "$build" -j "$(nproc)" --output-on-failure --repeat until-pass:2 "$@" \
        >>"$log" 2>&1
    local ended=$?
    [ "$ended" -ge 124 ] && echo "skipped: tests that had not run after $limit s ($*)"
    [ "$code" != 0 ] || code=$ended
}
: >"$log"
code=0
run_tests -E "$left_out|^stability\."
run_tests -R '^stability\.'
# How each test ended the last time that it ran. By number and name, since the two runs number them differently.
ends=$(sed -nE 's/^ *([0-9]+\/[0-9]+)? +Test +#([0-9]+):/\2/p' "$log" | awk '{ last[$1 " " $2] = $0 } END { for (test in last) print last[test] }')
counted() { grep -cE "$1" <<<"$ends"; }
passed=$(counted ' Passed +[0-9.]+ sec') skipped=$(counted '\*\*\*(Skipped|Not Run)')
failed=$(($(counted .) - passed - skipped))
reports=$(grep -acE '(ERROR|WARNING): [A-Za-z]+Sanitizer|runtime error: ' "$log")
[ "$failed" -ge "$reports" ] || failed=$reports
if [ "$code" -ge 124 ]; then
    skipped=$((skipped + 1))
elif [ "$code" != 0 ] && [ "$failed" = 0 ]; then
    failed=1
fi
[ "$failed" = 0 ] || grep -avE '^ *Start +[0-9]+:| Passed +[0-9.]+ sec|Skipped +[0-9.]+ sec' "$log"
echo "built in $built s, tested in $((SECONDS - built)) s"
echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" = 0 ]
