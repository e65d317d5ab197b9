#!/bin/bash
# slurm-frame.sh PARTS SCENE IMAGE [OPTION...]: a frame on Slurm: an array of PARTS tasks, and the job that merges what they
# have rendered when all of them are done. Prints the numbers of both jobs. OPTIONs are those of `parhelion render`:
#
#   slurm-frame.sh 8 scene.xml frame.exr --spp 4096
#
# Parts, checkpoints and messages lie in IMAGE.parts, which every node must see; when IMAGE is there, it may be deleted.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
parts=$1 scene=$2 image=$3
shift 3
folder=$image.parts
mkdir -p -- "$folder"
array=$(sbatch --parsable --array="1-$parts" --output="$folder/part-%a.log" \
    "$here/slurm-part.sh" "$parts" "$folder" "$scene" "$@")
merge=$(sbatch --parsable --dependency="afterok:${array%%;*}" --output="$folder/merge.log" \
    "$here/slurm-merge.sh" "$parts" "$folder" "$image")
echo "${array%%;*} ${merge%%;*}"
