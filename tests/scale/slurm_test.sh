#!/bin/bash
# A Slurm cluster of two nodes on this machine, from Debian's packages, without root's services: an array of four over some cases
# by docs/scale/slurm.sh, one node killed while it runs its part, and the merged run against the unsharded one.
#   slurm_test.sh CROSSRAY SOURCE        exit code 77: cannot be run here, with the reason
# Everything lives in one folder and one set of processes that carry its name in their environment; both are gone at the end.
set -uo pipefail
crossray=$(realpath "$1")
source=$(realpath "$2")

skip() { echo "skipped: $1"; exit 77; }
failure=
fail() { echo "FAIL: $1"; failure=$1; exit 1; }

PATH=$PATH:/usr/sbin:/sbin
for program in munged slurmctld slurmd sbatch squeue sinfo scontrol; do
    command -v "$program" >/dev/null || skip "$program is not installed (Debian: slurmctld slurmd slurm-client munge)"
done
[ "$(id -u)" = 0 ] || skip "slurmd starts jobs as root alone"

dir=$(mktemp -d /tmp/crossray-slurm-XXXXXX) # short: the sockets' paths may have 108 characters
chmod 755 "$dir"                            # munged serves no socket in a folder that is closed to others
export SLURM_CONF=$dir/slurm.conf

# Processes of this cluster, jobs and their workers included: all have its configuration in their environment.
list_processes() { # [MORE]: another variable of theirs
    local file id
    for file in $(grep -lzxF "SLURM_CONF=$SLURM_CONF" /proc/[0-9]*/environ 2>/dev/null); do
        id=${file#/proc/} id=${id%/environ}
        [ "$id" != $$ ] && [ "$id" != "$BASHPID" ] || continue
        [ -z "${1-}" ] || grep -qzxF "$1" "$file" 2>/dev/null || continue
        echo "$id"
    done
}

clean_up() {
    local code=$? id round
    trap - EXIT INT TERM
    if [ -n "$failure" ]; then
        for log in "$dir"/*.log "$dir"/*.out; do echo "== $log"; tail -n 25 "$log"; done
        echo "FAIL: $failure"
    fi
    exec 2>/dev/null # the shell's words about jobs that it sees killed
    for round in 1 2 3 4 5; do # a daemon may start one more while the list is read
        for id in $(list_processes); do kill -KILL "$id"; done
        sleep 0.1
        [ -n "$(list_processes)" ] || break
    done
    wait
    rm -rf "$dir"
    exit "$code"
}
trap clean_up EXIT
trap 'exit 130' INT TERM

# Waits until a command succeeds.
until_true() { # SECONDS COMMAND...
    local end=$((SECONDS + $1))
    shift
    until "$@"; do
        [ "$SECONDS" -lt "$end" ] || return 1
        sleep 0.05
    done
}

is_free() { ! (exec 3<>"/dev/tcp/127.0.0.1/$1") 2>/dev/null; }
for attempt in 1 2 3 4 5 6 7 8; do
    port=$((20000 + RANDOM % 12000))
    is_free $port && is_free $((port + 1)) && is_free $((port + 2)) && break
done

# --- The cluster ---
host=$(hostname)
mkdir "$dir/state" "$dir/spool-near" "$dir/spool-far"
(umask 077 && head -c 1024 /dev/urandom >"$dir/munge.key")
cat >"$SLURM_CONF" <<END
ClusterName=crossray
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
# A job that is queued again waits until the credentials of its first run have ended.
AuthInfo=socket=$dir/munge.socket,cred_expire=5
CredType=cred/munge
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool-%n
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/%n.pid
SlurmctldLogFile=$dir/slurmctld.log
SlurmdLogFile=$dir/%n.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdTimeout=5
KillWait=1
SchedulerParameters=batch_sched_delay=0,sched_interval=1,bf_interval=1
MailProg=/bin/true
NodeName=near NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=1
NodeName=far NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1
PartitionName=main Nodes=near,far Default=YES MaxTime=INFINITE State=UP
END
munged -F --force --key-file="$dir/munge.key" --socket="$dir/munge.socket" --pid-file="$dir/munge.pid" \
    --log-file="$dir/munge.log" --seed-file="$dir/munge.seed" >"$dir/munged.out" 2>&1 &
until_true 10 test -S "$dir/munge.socket" || { cat "$dir"/munge*.out "$dir"/munge.log; skip "munged does not start here"; }
slurmctld -D -c >"$dir/slurmctld.out" 2>&1 &
slurmd -D -N near >"$dir/near.out" 2>&1 &
slurmd -D -N far >"$dir/far.out" 2>&1 &
far=$!
both_idle() { [ "$(sinfo -h -t idle -o %D 2>/dev/null)" = 2 ]; }
if ! until_true 30 both_idle; then
    tail -n 3 "$dir"/*.out "$dir"/*.log
    skip "Slurm's daemons do not come up here"
fi
echo "two nodes are up after $SECONDS s"

# --- The unsharded run, and the array ---
export CROSSRAY_CACHE=${CROSSRAY_CACHE:-$dir/cache} CROSSRAY=$dir/crossray
# On the node that is to die the tool halts once it has begun, so that the death comes on the way.
cat >"$CROSSRAY" <<END
#!/bin/bash
[ "\${SLURMD_NODENAME-}" = far ] || exec "$crossray" "\$@"
"$crossray" "\$@" &
until compgen -G "$dir/shards/shard-*-far.part/run.json" >/dev/null; do :; done
kill -STOP \$!
wait
END
chmod +x "$CROSSRAY"
cases=(--cases "$source/cases" -k "${SLURM_TEST_CASES:-proxy and (sphere or box)}" --backend cpu32,cpu64)
# In the tasks' folder: paths in run.json are as seen from there.
(cd "$dir" && "$crossray" run --no-cache "${cases[@]}" --output "$dir/whole" --no-report --progress none --jobs 1 >"$dir/whole.out" 2>&1) ||
    fail "the unsharded run ended with exit code $?"
tail -n 1 "$dir/whole.out"

mkdir "$dir/shards"
array=$(cd "$dir" && sbatch --parsable --array=1-4 --output="$dir/task-%a.out" "$source/docs/scale/slurm.sh" "$dir/shards" "${cases[@]}") ||
    fail "sbatch"

# --- A node dies on the way: its daemon, its step and its job at once, as when the power goes ---
on_far() { compgen -G "$dir/shards/shard-*-far.part/run.json" >/dev/null; }
until_true 60 on_far || fail "no task has begun on the node"
ours=$(list_processes)
victims=$(list_processes SLURMD_NODENAME=far)
# A step has the configuration, and the node's name only in its children. It goes first: it would report them.
for id in $(for id in $victims; do ps -o ppid= -p "$id"; done | sort -u); do
    if grep -qxF "$id" <<<"$ours"; then kill -KILL "$id"; fi
done 2>/dev/null
kill -KILL $far $victims 2>/dev/null
wait $far 2>/dev/null
died=$SECONDS
sleep 0.2
[ -z "$(list_processes SLURMD_NODENAME=far)" ] || fail "the node's processes live"
torn=$(compgen -G "$dir/shards/shard-*-far.part") || fail "the node's part ended before the node did"
echo "killed with the node: $(basename "$torn")"
"$crossray" merge "$dir/shards" -o "$dir/early" >"$dir/early.out" 2>&1
[ $? = 2 ] || fail "a merge before the end is to be refused"

array_ended() { [ -z "$(squeue -h -j "$array" 2>/dev/null)" ]; }
until_true 150 array_ended || { squeue; fail "the array has not ended"; }
echo "the array ended $((SECONDS - died)) s later"
grep -q "due to failure of node far" "$dir/slurmctld.log" || fail "Slurm has not queued the part again"

# --- One run ---
merge=$(sbatch --parsable --wait --output="$dir/merge.out" "$source/docs/scale/slurm_merge.sh" "$dir/shards")
code=$?
cat "$dir/merge.out"
[ $code = 0 ] || fail "the merge (job $merge) ended with exit code $code"
[ "$(compgen -G "$dir/shards/shard-*.part")" = "$torn" ] || fail "other parts than the killed one are not whole"
[ "$(find "$dir/shards" -maxdepth 1 -name 'shard-*-of-4.*' ! -name '*.part' | wc -l)" = 4 ] || fail "there are not four shards"
[ -s "$dir/shards/junit.xml" ] && [ -s "$dir/shards/report/index.html" ] || fail "JUnit or the pages are missing"
python3 "$source/tests/scale/same_run.py" "$dir/whole/run.json" "$dir/shards/run.json" || fail "the merged run is another"
echo "ok: the merged run is the unsharded one, in $SECONDS s"
