#!/bin/bash
# slurm-merge.sh PARTS FOLDER IMAGE: the picture of a frame whose parts slurm-part.sh has rendered; of all of them or none:
#
#   sbatch --dependency=afterok:ARRAY slurm-merge.sh 8 frame.parts frame.exr
#SBATCH --job-name=parhelion-merge
#SBATCH --kill-on-invalid-dep=yes
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail
parts=$1 folder=$2 image=$3
films=()
for ((part = 1; part <= parts; ++part)); do films+=("$folder/part-$part.film"); done
exec parhelion merge "${films[@]}" --output "$image" --force --quiet
