#!/bin/bash
# tables_test.sh CHECKOUT: the scripts of cases/library make the tables that stand beside them, to the byte: a row that was written by
# hand, or a model that was changed without its table, shows. Exit code 77: cannot be run here, with the reason.
set -euo pipefail
source=$1
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$scratch/cases"
ln -s "$source/shaders" "$scratch/shaders"
cp "$source/cases/float_exr.py" "$scratch/cases"
# Only what cannot be made goes along, so that a file which the scripts no longer make is missed.
mkdir -p "$scratch/cases/library/data"
cp "$source"/cases/library/*.py "$source/cases/library/presets.toml" "$scratch/cases/library"
python3 "$scratch/cases/library/tables.py" >"$scratch/log" || { cat "$scratch/log"; exit 1; }
diff -rq --exclude=__pycache__ "$source/cases/library" "$scratch/cases/library"
echo "$(find "$scratch/cases/library" -name '*.toml' | wc -l) tables are as their scripts make them"
