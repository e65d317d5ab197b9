#!/bin/bash
# docs/farm/parallel.sh: one part is killed, then all is stopped, then goes on. Read by tests/farm/run.
# shellcheck disable=SC2154 # what is the reader's
needs parallel parallel

options=(--size 64x64 --spp 16384) # seconds of work for every part

# The process that renders part $1: no other names this folder.
renderer() { pgrep -f "^parhelion render .*--output $work/frame.exr.parts/part-$1.film"; }

parallel_frame() { JOBS=2 exec "$scripts/parallel.sh" 4 "$scene" "$work/frame.exr" "${options[@]}"; }

# What runs in the folder of this test.
finish() { pkill -KILL -f "$work/frame.exr"; }

parallel_group() {
    local first
    parhelion render "$scene" "${options[@]}" --output one.exr --quiet || wrong "one render"
    (parallel_frame) >first.log 2>&1 &
    first=$!
    until_true 30 "a checkpoint" test -f frame.exr.parts/part-1.checkpoint
    kill -KILL "$(renderer 1)" || wrong "part 1 was done before it could be killed"
    until_true 60 "a part in the place of another" test -f frame.exr.parts/part-3.checkpoint
    pkill -TERM -P "$first" # parallel starts no more parts
    sleep 0.2
    pkill -TERM -P "$first" # and ends those that it has
    wait "$first" && wrong "what was stopped ends with 0"
    [[ ! -e frame.exr ]] || wrong "a frame before its time"
    parhelion merge frame.exr.parts/*.film --partial -o look.png 2>&1 | grep -q '; not finished: ' ||
        wrong "no part kept what it had: $(ls frame.exr.parts)"
    (parallel_frame) || wrong "the same command again: exit code $?"
    cmp frame.exr one.exr || wrong "the merged image is not that of one render"
}
