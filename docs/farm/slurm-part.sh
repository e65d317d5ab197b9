#!/bin/bash
# slurm-part.sh PARTS FOLDER SCENE [OPTION...]: one task of a Slurm array renders one of PARTS parts of a frame:
#
#   sbatch --array=1-8 slurm-part.sh 8 frame.parts scene.xml --spp 4096
#
# The task goes on from its checkpoint whenever it starts again: after preemption, a lost node, a time limit, a kill.
# Partition, time, memory and processors: options of sbatch, or SBATCH_PARTITION, SBATCH_TIMELIMIT, ...
#SBATCH --job-name=parhelion-part
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --signal=B:USR1@60
set -uo pipefail
parts=$1 folder=$2 scene=$3
shift 3
part=$SLURM_ARRAY_TASK_ID starts=$((${SLURM_RESTART_COUNT:-0} + 1))
most_starts=5 # of a task that is killed or fails on its machine; one that is stopped starts as often as it takes

# Slurm sends TERM to every process of a job that it preempts or cancels: parhelion has it already (a further one would end
# it at once), and whether the job comes back is decided. USR1 comes to this shell alone, a minute before the time limit.
heard='' ended_by_slurm=''
trap 'heard=1; kill -TERM "$render"' USR1
trap 'heard=1; ended_by_slurm=1' TERM

parhelion render "$scene" "$@" --quiet --threads "${SLURM_CPUS_ON_NODE:-0}" --shard "$part/$parts" --force \
    --output "$folder/part-$part.film" \
    --checkpoint "$folder/part-$part.checkpoint" --checkpoint-every "${CHECKPOINT_EVERY:-60s}" --continue &
render=$!
wait "$render"
code=$?
while [[ $heard ]]; do # a signal has ended the wait, not the render
    heard=''
    wait "$render"
    code=$?
done

if [[ ! $ended_by_slurm ]] && ((code == 99 || (code == 3 || code > 128) && starts < most_starts)); then
    echo "part $part of $parts: exit code $code after start $starts; once more" >&2
    scontrol requeue "${SLURM_ARRAY_JOB_ID}_$part" # which ends this shell, too
fi
exit "$code"
