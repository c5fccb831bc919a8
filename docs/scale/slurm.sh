#!/bin/bash
# The cases as a Slurm array: one part a task. OUT lies where all nodes and the merge see it; slurm_merge.sh makes one run of it.
#   array=$(sbatch --parsable --array=1-4 slurm.sh OUT [ARGUMENTS of crossray run])
#   sbatch --dependency=afterany:$array slurm_merge.sh OUT
# A part whose node died is queued again by Slurm and writes to a folder of its own. To run part 3 of 4 once more by hand:
#   SHARD=3/4 sbatch slurm.sh OUT [the same ARGUMENTS]
#SBATCH --job-name=crossray
#SBATCH --requeue
#SBATCH --open-mode=append
set -u
out=$1
shift
export CROSSRAY_CACHE=${CROSSRAY_CACHE:-${TMPDIR:-/tmp}/crossray-cache-$(id -u)} # of the node: drivers' caches are no good over a network
"${CROSSRAY:-crossray}" run --shard "${SHARD:-auto}" --attempt "job-$SLURM_JOB_ID-${SLURM_RESTART_COUNT:-0}-${SLURMD_NODENAME:-node}" \
    --output "$out" --jobs "${SLURM_CPUS_ON_NODE:-1}" --no-report --progress none "$@"
code=$?
[ "$code" -le 1 ] && exit 0 # a case that failed is a result, which the merge tells
exit "$code"
