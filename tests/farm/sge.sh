#!/bin/bash
# docs/farm/sge-part.sh without SGE: a session of processes gets USR2, as qsub -notify would have it, ends with 99 and is started
# again; then the parts are merged. Read by tests/farm/run.
# shellcheck disable=SC2154 # what is the reader's
needs setsid util-linux

options=(--size 64x64 --spp 2048)

finish() { pkill -KILL -f "$work/parts"; }

part() { NSLOTS=1 SGE_TASK_ID=$1 exec setsid "$scripts/sge-part.sh" 2 "$work/parts" "$scene" "${options[@]}"; }

sge_group() {
    local first code=0
    mkdir parts
    (part 1) >first.log 2>&1 &
    first=$!
    until_true 30 "a checkpoint" test -f parts/part-1.checkpoint
    kill -USR2 -- "-$(pgrep -o -f "$work/parts")" || wrong "no process to be told"
    wait "$first" || code=$?
    ((code == 99)) || wrong "exit code $code, not 99: $(<first.log)"
    grep -q 'stopped by SIGTERM' first.log || wrong "not stopped: $(<first.log)"
    (part 1) || wrong "started again: exit code $?"
    (part 2) || wrong "part 2: exit code $?"
    parhelion merge parts/part-{1..2}.film -o frame.exr --quiet || wrong "merge"
    parhelion render "$scene" "${options[@]}" --output one.exr --quiet || wrong "one render"
    cmp frame.exr one.exr || wrong "the merged image is not that of one render"
}
