#!/bin/sh
# Runs one test of the pages in a browser: run.sh BUILD_FOLDER FILE.test.mjs
# Exit code 77, "skipped": chromium, node or npm is not installed (./test installs them on Debian).
set -u
build=$1 file=$2
here=$(cd "$(dirname "$0")" && pwd)
skip() { echo "skipped: $1 is not installed"; exit 77; }
# A stub that only says how to install the program counts as none.
for program in node chromium; do "$program" --version >/dev/null 2>&1 || skip "$program"; done

# playwright-core and axe-core, pinned by package-lock.json. Tests start side by side: one installs, the others wait.
modules=$build/browser
mkdir -p "$modules"
exec 9>"$modules/lock"
flock 9
if ! cmp -s "$here/package-lock.json" "$modules/installed"; then
    npm --version >/dev/null 2>&1 || skip npm
    rm -f "$modules/installed"
    cp "$here/package.json" "$here/package-lock.json" "$modules"
    # No network is a reason to skip, as a missing program is; said once, and not waited for by each test.
    if [ -n "$(find "$modules/unreachable" -mmin -10 2>/dev/null)" ] ||
        ! (cd "$modules" && npm ci --ignore-scripts --no-audit --no-fund --fetch-retries=1 --fetch-retry-maxtimeout=5000) >"$modules/npm.log" 2>&1; then
        touch "$modules/unreachable"
        tail -n 5 "$modules/npm.log"
        echo "skipped: npm ci could not fetch playwright-core and axe-core; without a network they can be installed elsewhere: $modules/node_modules"
        exit 77
    fi
    cp "$here/package-lock.json" "$modules/installed"
fi
exec 9>&-

CROSSRAY_BUILD=$build CROSSRAY_CHROMIUM=$(command -v chromium) exec node "$here/$file"
