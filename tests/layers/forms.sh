#!/bin/bash
# Components and compressions: what a file is written as, what it keeps, what parts of a render make of it. Read by tests/layers/run.
# shellcheck disable=SC2154 # what is the reader's
cat >scene.xml <<'XML'
<scene version="3.0.0">
    <integrator type="path"><integer name="max_depth" value="4"/></integrator>
    <sensor type="perspective"><film type="hdrfilm"><integer name="width" value="48"/><integer name="height" value="40"/>
        <rfilter type="box"/></film></sensor>
    <shape type="sphere"><point name="center" x="0" y="0" z="4"/></shape>
    <emitter type="constant"/>
</scene>
XML
scene=(scene.xml --spp 20 --aov "albedo,samples,depth" --quiet)

expect 0 render "${scene[@]}" -o plain.exr
for part in 1 2 3; do
    expect 0 render "${scene[@]}" -o "part$part.film" --shard "$part/3" --shard-by samples
done
for packed in none rle zips zip piz b44 b44a dwaa dwab; do
    form=(--exr-compression "$packed" --layer-format all=half --layer-format depth=float)
    expect 0 render "${scene[@]}" "${form[@]}" -o one.exr --force
    expect 0 merge part*.film "${form[@]}" -o merged.exr --force --quiet
    same one.exr merged.exr "$packed"
    read_by_others form "$packed" one.exr plain.exr
done
# What is said of the file has no say in what is rendered: a checkpoint goes on, and only a file that is as asked is left alone.
expect 0 render "${scene[@]}" -o kept.exr --checkpoint kept.film
expect 0 render "${scene[@]}" -o kept.exr --checkpoint kept.film --continue --exr-compression piz
read_by_others packed piz kept.exr
before=$(stat -c %i kept.exr)
expect 0 render "${scene[@]}" -o kept.exr --checkpoint kept.film --continue --exr-compression piz
[[ $(stat -c %i kept.exr) == "$before" ]] || wrong "what was there as asked is written again"
# What cannot be leaves nothing behind.
expect 2 render "${scene[@]}" -o none.exr --exr-compression lzw
expect 2 render "${scene[@]}" -o none.exr --layer-format uv=half
expect 2 render "${scene[@]}" -o none.exr --layer-format samples=half
expect 2 merge part*.film -o none.exr --layer-format uv=half
expect 2 merge part*.film -o none.film --exr-compression zip
[[ ! -e none.exr && ! -e none.film ]] || wrong "something is left of what cannot be"
