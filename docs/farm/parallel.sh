#!/bin/bash
# parallel.sh PARTS SCENE IMAGE [OPTION...]: a frame by GNU parallel, here or on machines that ssh reaches; the same command
# again goes on where it stopped, with what failed or was stopped. OPTIONs are those of `parhelion render`:
#
#   parallel.sh 8 scene.xml frame.exr --spp 4096
#   HOSTS=farm.txt parallel.sh 64 scene.xml frame.exr --spp 4096     # farm.txt: a machine a line, as for --sshloginfile
#
# Machines have parhelion on their PATH and see the files at the same place. Each renders JOBS parts at once (1: a render
# uses all processors). Parts, checkpoints and parallel's log lie in IMAGE.parts; when IMAGE is there, it may be deleted.
set -euo pipefail
parts=$1 scene=$2 image=$3
shift 3
folder=$image.parts
mkdir -p -- "$folder"

# A stopped render needs its time to keep what it has: ten seconds from the first signal on, and no second one.
parallel --quote --jobs "${JOBS:-1}" ${HOSTS:+--sshloginfile "$HOSTS" --workdir "$PWD"} --retries 3 \
    --joblog "$folder/log" --resume-failed --termseq TERM,10000,KILL \
    parhelion render "$scene" "$@" --quiet --shard "{}/$parts" --force --output "$folder/part-{}.film" \
    --checkpoint "$folder/part-{}.checkpoint" --checkpoint-every "${CHECKPOINT_EVERY:-60s}" --continue \
    ::: $(seq "$parts") </dev/null

films=()
for ((part = 1; part <= parts; ++part)); do films+=("$folder/part-$part.film"); done
exec parhelion merge "${films[@]}" --output "$image" --force --quiet
