#!/bin/bash
# sge-part.sh PARTS FOLDER SCENE [OPTION...]: one task of an SGE array renders one of PARTS parts of a frame, and goes on from
# its checkpoint whenever it starts again; then all parts are merged:
#
#   mkdir -p frame.parts
#   qsub -N frame -t 1-8 sge-part.sh 8 frame.parts scene.xml --spp 4096
#   qsub -cwd -V -b y -hold_jid frame parhelion merge frame.parts/part-{1..8}.film -o frame.exr
#
#$ -cwd -V
#$ -r y
#$ -notify
set -uo pipefail
parts=$1 folder=$2 scene=$3
shift 3
part=$SGE_TASK_ID

# Before it kills a job SGE sends USR2 (with -notify) to all of its processes, which means the end of a render that does not
# ignore it. Exit code 99 asks SGE to start the task again.
heard=''
trap 'heard=1; kill -TERM "$render"' USR2
(
    trap '' USR2
    exec parhelion render "$scene" "$@" --quiet --threads "${NSLOTS:-0}" --shard "$part/$parts" --force \
        --output "$folder/part-$part.film" \
        --checkpoint "$folder/part-$part.checkpoint" --checkpoint-every "${CHECKPOINT_EVERY:-60s}" --continue
) &
render=$!
wait "$render"
code=$?
while [[ $heard ]]; do # a signal has ended the wait, not the render
    heard=''
    wait "$render"
    code=$?
done
exit "$code"
