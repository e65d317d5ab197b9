#!/bin/bash
# slurm-exec.sh SCENE IMAGE [OPTION...]: a whole frame as one job that is stopped and goes on as often as it takes, where the
# cluster's slurm.conf has RequeueExit=99 (scontrol show config | grep RequeueExit):
#
#   sbatch --time=60 slurm-exec.sh scene.xml frame.exr --spp 4096
#
# The program takes the shell's place, so that each signal reaches it, and reaches it once.
#SBATCH --job-name=parhelion
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --signal=B:TERM@60
set -euo pipefail
scene=$1 image=$2
shift 2
exec parhelion render "$scene" "$@" --quiet --threads "${SLURM_CPUS_ON_NODE:-0}" --output "$image" --force \
    --checkpoint "$image.checkpoint" --checkpoint-every "${CHECKPOINT_EVERY:-60s}" --continue
