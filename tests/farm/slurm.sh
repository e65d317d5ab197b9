#!/bin/bash
# docs/farm/slurm-*.sh on a cluster of the test's own (cluster.sh): tasks of an array are killed, requeued, told that their time
# is nearly over, and preempted. Read by tests/farm/run.
# shellcheck disable=SC2154,SC2034 # what is the reader's
((EUID == 0)) || { echo "skipped: slurmd is to be started by root"; exit 77; }
needs munged munge
needs slurmctld slurm-wlm
needs slurmd slurm-wlm
# shellcheck source=/dev/null
. "$here/cluster.sh"
finish() { stop_cluster; }

parts=8 struck=4
options=(--size 64x64 --spp 9216)

# The program as the scripts find it: it tells what process renders a part, and keeps what a later start finds. The first start
# of a part that something is to happen to stops at its third checkpoint, by when a render from the beginning would be well
# behind, and waits there: however slow this machine is, it is not done before.
install_program() {
    mkdir started kept held
    rm bin/parhelion
    cat >bin/hold <<SCRIPT
#!/bin/bash
# hold PROCESS CHECKPOINT FILE
sums=''
while kill -0 "\$1" 2>/dev/null; do
    sum=\$(sha256sum 2>/dev/null <"\$2") && [[ \$sums != *"\$sum"* ]] && sums+=\$sum
    ((\${#sums} < 3 * 67)) || { kill -STOP "\$1" && touch "\$3"; exit; }
    sleep 0.02
done
SCRIPT
    cat >bin/parhelion <<SCRIPT
#!/bin/bash
part=\${SLURM_ARRAY_TASK_ID:-0} start=\${SLURM_RESTART_COUNT:-0}
file=$work/frame.exr.parts/part-\$part.checkpoint
if [[ \$1 == render ]] && ((start)) && [[ -f \$file ]]; then cp "\$file" "$work/kept/\$part-\$start.film"; fi
[[ \$1 != render ]] || echo \$\$ >"$work/started/\$part-\$start"
[[ \$1 != render ]] || ((start || part > $struck)) || "$work/bin/hold" \$\$ "\$file" "$work/held/\$part" &
exec "$program" "\$@"
SCRIPT
    chmod +x bin/parhelion bin/hold
}

# The first checkpoint that a task writes after it has started again.
note_checkpoints() {
    local kept next
    for kept in kept/*-*.film; do
        [[ -f $kept ]] || continue
        next=frame.exr.parts/part-${kept//[!0-9-]/}
        next=${next%-*}.checkpoint
        [[ -f $kept.next ]] || cmp -s "$kept" "$next" || cp "$next" "$kept.next"
    done
}

meanwhile() {
    hurry_requeued
    note_checkpoints
}

# Whether a process that is held has a signal waiting for it, or has been woken by who sent it.
signalled() { ! grep -q '^State:.T' "/proc/$1/status" || ! grep -q '^ShdPnd:.0*$' "/proc/$1/status"; }

# strike PART COMMAND...: which is to end its first start, or to have it end.
strike() {
    local part=$1 process
    shift
    until_true 120 "part $part at work" test -f "held/$part"
    [[ $(squeue -h -o %T -j "${array}_$part") == RUNNING ]] || wrong "part $part does not run"
    process=$(<"started/$part-0")
    "$@" || wrong "$*"
    until_true 60 "$1 to part $part" signalled "$process"
    kill -CONT "$process" 2>/dev/null
}

# As a minute before the time limit. It waits for the shell, and complains of one that ends meanwhile.
warn() { scancel --batch --signal=USR1 "${array}_$1" 2>/dev/null & }
kill_render() { kill -KILL "$(<"started/$1-0")"; }
requeued() { until_true 30 "part $1 requeued after $2" test -f "started/$1-1"; }

# Per cent of the samples that a film lacks.
lacks() { parhelion merge "$1" --partial -o lacks.png --force 2>&1 | sed -n 's/.* \([0-9.]*\) % of the samples are missing.*/\1/p'; }

went_on() {
    local kept before after
    for kept in kept/*-*.film; do
        cp "$kept.next" next.film 2>/dev/null || { wrong "$kept: no checkpoint followed"; continue; }
        before=$(lacks "$kept") after=$(lacks next.film)
        awk -v before="${before:-0}" -v after="${after:-0}" 'BEGIN { exit !(after <= before) }' ||
            wrong "${kept#*/}: a restarted task lacks $after % of the frame, its checkpoint lacked $before: it did not go on"
    done
}

frame() {
    local ids part
    ids=$("$scripts/slurm-frame.sh" "$parts" "$scene" frame.exr "${options[@]}") || { wrong "slurm-frame.sh: $ids"; return; }
    array=${ids% *}
    strike 1 kill_render 1
    strike 2 scontrol requeue "${array}_2"
    strike 3 warn 3
    strike 4 sbatch --quiet --partition=urgent --ntasks=2 --output=/dev/null --wrap true
    for ((part = 1; part <= struck; part++)); do requeued "$part" "its turn"; done
    until_true 180 "the frame" test -f frame.exr
    cmp frame.exr one.exr || wrong "the merged image is not that of one render"
    grep -q 'exit code 137 after start 1; once more' frame.exr.parts/part-1.log || wrong "a killed task does not say so"
    grep -q 'DUE TO JOB REQUEUE' frame.exr.parts/part-2.log || wrong "part 2 was not requeued"
    grep -q 'exit code 99 after start 1; once more' frame.exr.parts/part-3.log || wrong "a task at its time limit does not say so"
    grep -q 'DUE TO PREEMPTION' frame.exr.parts/part-4.log || wrong "part 4 was not preempted"
    went_on
}

restarted() { scontrol show job "$1" | grep -q Restarts=1; }
gone() { [[ -z $(squeue -h -j "$1") ]]; }

# What was cancelled stays so, though it ends with 99; a part that fails takes the merge with it.
refused() {
    local ids job
    ids=$("$scripts/slurm-frame.sh" 1 "$scene" other.exr --size 64x64 --spp 1000000)
    until_true 30 "a checkpoint" test -f other.exr.parts/part-1.checkpoint
    scancel "${ids% *}"
    until_true 20 "cancelled" gone "${ids% *}"
    until_true 20 "no merge of what was cancelled" gone "${ids#* }"
    ids=$("$scripts/slurm-frame.sh" 1 missing.xml none.exr)
    until_true 20 "no merge of what failed" gone "${ids#* }"
    [[ ! -e other.exr && ! -e none.exr ]] || wrong "an image of nothing"
    sed -i '1i RequeueExit=99' slurm.conf
    scontrol reconfigure
    job=$(sbatch --parsable --output=exec.log "$scripts/slurm-exec.sh" "$scene" exec.exr --size 64x64 --spp 1000000)
    until_true 30 "a checkpoint" test -f exec.exr.checkpoint
    scancel --batch --signal=TERM "$job"
    until_true 30 "requeued by its exit code" restarted "$job"
}

slurm_group() {
    local one
    install_program
    parhelion render "$scene" "${options[@]}" --output one.exr --quiet &
    one=$!
    start_cluster
    wait "$one" || wrong "one render"
    frame
    refused
}
