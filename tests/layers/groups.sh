#!/bin/bash
# Light groups: as another program reads them, they add up to the image; parts of a render make the same bytes. Read by tests/layers/run.
# shellcheck disable=SC2154 # what is the reader's
cat >lamps.xml <<'XML'
<scene version="3.0.0">
    <integrator type="path"><integer name="max_depth" value="5"/></integrator>
    <sensor type="perspective"><film type="hdrfilm"><integer name="width" value="48"/><integer name="height" value="40"/>
        <rfilter type="$filter"/></film></sensor>
    <shape type="sphere"><point name="center" x="0" y="0" z="4"/></shape>
    <shape type="rectangle"><transform name="to_world"><scale value="4"/><rotate y="1" angle="180"/><translate z="6"/>
        </transform></shape>
    <shape type="sphere" id="bulb"><point name="center" x="1.5" y="1" z="4"/><float name="radius" value="0.3"/>
        <emitter type="area"><rgb name="radiance" value="9 5 1"/></emitter></shape>
    <emitter type="point" id="flash"><point name="position" x="-2" y="2" z="0"/><rgb name="intensity" value="9 8 7"/></emitter>
    <emitter type="constant" id="sky"><rgb name="radiance" value="0.2 0.3 0.5"/></emitter>
</scene>
XML
for filter in box gaussian; do
    scene=(lamps.xml -D "filter=$filter" --quiet)
    lamps=("${scene[@]}" --spp 40)
    expect 0 render "${lamps[@]}" -o plain.exr --force
    expect 0 render "${lamps[@]}" --light-groups -o each.exr --force
    read_by_others groups each.exr plain.exr bulb flash sky
    expect 0 render "${lamps[@]}" --light-group warm=bulb,flash -o warm.exr --force
    read_by_others groups warm.exr plain.exr warm rest
    for by in blocks samples; do
        rm -f part*.film
        for part in 1 2 3; do
            expect 0 render "${lamps[@]}" --light-groups -o "part$part.film" --shard "$part/3" --shard-by "$by" \
                --pool-paths $((4096 * part))
        done
        expect 0 merge part3.film part1.film part2.film -o merged.exr --force --quiet
        same each.exr merged.exr "groups by $by, $filter"
    done
    # Stopped, and gone on with, in one go or not.
    expect 0 render "${scene[@]}" --light-groups --spp 16 -o few.exr --checkpoint few.film --force
    expect 0 render "${lamps[@]}" --light-groups -o more.exr --resume few.film --force
    read_by_others same_values more.exr each.exr
done
expect 2 render "${lamps[@]}" -o none.exr --light-group nobody
expect 2 render "${lamps[@]}" -o none.exr --light-group a=bulb --light-group b=bulb
expect 2 render "${lamps[@]}" -o none.png --light-groups
expect 2 render "${lamps[@]}" -o none.exr --light-groups --integrator normals
expect 2 render "${lamps[@]}" --light-group bulb -o none.exr --resume few.film
[[ ! -e none.exr && ! -e none.png ]] || wrong "something is left of what cannot be"
