#!/bin/bash
# One run of the parts that slurm.sh left in OUT: OUT/run.json, OUT/junit.xml, OUT/report/index.html. Fails when a case did.
#SBATCH --job-name=crossray-merge
set -u
out=$1
exec "${CROSSRAY:-crossray}" merge "$out" --output "$out" --junit "$out/junit.xml"
