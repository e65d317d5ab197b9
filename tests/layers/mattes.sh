#!/bin/bash
# Cryptomatte: as other programs read it, with hashes that are not ours; parts of a render make the same bytes. Read by tests/layers/run.
# shellcheck disable=SC2154 # what is the reader's
cat >mattes.xml <<'XML'
<scene version="3.0.0">
    <integrator type="path"><integer name="max_depth" value="3"/></integrator>
    <sensor type="perspective"><film type="hdrfilm"><integer name="width" value="61"/><integer name="height" value="47"/>
        <rfilter type="$filter"/></film></sensor>
    <bsdf type="diffuse" id="paint"/>
    <shape type="sphere" id="ball"><point name="center" x="0.4" y="0" z="4"/><ref id="paint"/></shape>
    <shape type="sphere" id="b&#228;ll/2"><point name="center" x="-0.9" y="0.3" z="5"/><ref id="paint"/></shape>
    <shape type="cylinder" id="pole"><point name="p0" x="-1" y="-2" z="3.5"/><point name="p1" x="1" y="2" z="3.5"/>
        <float name="radius" value="0.02"/></shape>
    <shape type="disk" id="far"><transform name="to_world"><scale value="0.05"/><translate x="1.2" y="-0.9" z="4"/>
        </transform><bsdf type="conductor" id="tin"/></shape>
    <emitter type="constant"/>
</scene>
XML
for filter in box gaussian lanczos; do
    scene=(mattes.xml -D "filter=$filter" --quiet --cryptomatte "object,material" --aov shape_index)
    mattes=("${scene[@]}" --spp 40)
    expect 0 render "${mattes[@]}" -o whole.exr --force
    read_by_others mattes whole.exr "$filter" ball 'bäll/2' pole far
    for by in blocks samples; do
        rm -f part*.film
        for part in 1 2 3; do
            expect 0 render "${mattes[@]}" -o "part$part.film" --shard "$part/3" --shard-by "$by" \
                --pool-paths $((4096 * part)) --streams $((4 - part)) --lanes "$((8 * (part - 1)))"
        done
        expect 0 merge part3.film part1.film -o some.film --force --quiet
        expect 0 merge part2.film some.film -o merged.exr --force --quiet
        same whole.exr merged.exr "mattes by $by, $filter"
    done
    expect 0 render "${scene[@]}" --spp 16 -o few.exr --checkpoint few.film --force
    expect 0 render "${mattes[@]}" -o more.exr --resume few.film --force
    read_by_others same_values more.exr whole.exr
    expect 0 render "${mattes[@]}" -o crop.exr --crop 20,10,30,20 --force
    read_by_others crop crop.exr whole.exr 20 10 30 20
done
# A damaged row of them is told, and leaves nothing.
size=$(stat -c %s few.film)
printf '\377' | dd of=few.film bs=1 seek=$((size - 40)) conv=notrunc 2>/dev/null
expect 2 merge few.film --partial -o none.exr --quiet
expect 2 render "${mattes[@]}" -o none.exr --exr-compression dwaa
expect 2 render "${mattes[@]}" -o none.exr --layer-format CryptoObject00=half
expect 2 render mattes.xml -D filter=box -o none.exr --cryptomatte asset
expect 2 render mattes.xml -D filter=box -o none.png --cryptomatte object
[[ ! -e none.exr && ! -e none.png ]] || wrong "something is left of what cannot be"
