#!/bin/bash
# What surrounds the program is broken, and it neither aborts nor changes a bit of the image nor names the wrong cause.
# Usage: run.sh PARHELION GROUP [LAYER]; a group that this machine does not allow ends with 77, which ctest takes for skipped.
#
# caches   the folder of compiled programs: cold, warm, damaged in every way, not to be made, unset, bounded, shared
# disks    full, read-only and noexec file systems (needs to mount some)
# drivers  no driver, one that cannot be loaded, devices that PoCL is told to offer
# memory   `ulimit -v` from nothing to enough
# doctor   what it says of all of these, and that it says nothing else of the environment
# full_device, lost_device, slow_device  LAYER, a layer of OpenCL's (faulty_driver.cpp), has the device be so
# children processes that compile beside end with the one that started them
# shellcheck disable=SC2317 # functions that are called by the name they are given
set -uo pipefail
parhelion=$(readlink -f -- "$1")
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd)
scene=scene.xml
group=$2 layer=${3:+$(readlink -f -- "$3")}
work=$(mktemp -d)
mounted=()
finish() {
    for folder in "${mounted[@]}"; do umount "$folder"; done
    rm -rf -- "$work"
}
trap finish EXIT
cd -- "$work" || exit 1
failed=0 left_out=0
unset POCL_DEVICES POCL_CACHE_DIR PARHELION_CACHE_SIZE XDG_CACHE_HOME
export PARHELION_CACHE_DIR=$work/cache TMPDIR=$work/tmp HOME=$work/home POCL_MAX_PTHREAD_COUNT=2
mkdir -p "$TMPDIR" "$HOME"

cat >scene.xml <<'SCENE'
<scene version="3.0.0">
    <integrator type="depth"/>
    <sensor type="perspective">
        <transform name="to_world"><lookat origin="0,0,3" target="0,0,0" up="0,1,0"/></transform>
        <film type="hdrfilm">
            <integer name="width" value="8"/><integer name="height" value="8"/><rfilter type="box"/>
        </film>
        <sampler type="independent"><integer name="sample_count" value="2"/></sampler>
    </sensor>
    <emitter type="constant"/>
    <shape type="rectangle"/>
</scene>
SCENE

fail() {
    printf '%s: FAILED: %s\n' "$1" "$2"
    [[ -z ${3:-} ]] || sed 's/^/    /' "$3"
    failed=1
}

# renders NAME CODE TEXT COMMAND...: runs `COMMAND render ...` with its time limited; the exit code is CODE, its messages match
# TEXT (an extended regular expression; "-": there is no note), and where it is 0 the image has the bits of the first one.
renders() {
    local name=$1 code=$2 text=$3 status
    shift 3
    rm -f image.exr
    timeout -k 5 120 "$@" "$parhelion" render "$scene" --size 8x8 --spp 2 -o image.exr >messages 2>&1 </dev/null
    status=$?
    [[ $status == "$code" ]] || { fail "$name" "exit code $status, not $code" messages; return; }
    if [[ $text == - ]]; then
        ! grep -q 'note:' messages || { fail "$name" "a note" messages; return; }
    else
        grep -Eq -- "$text" messages || { fail "$name" "nothing like '$text' is said" messages; return; }
    fi
    if [[ $code == 0 ]]; then
        [[ -f first.exr ]] || cp image.exr first.exr
        "$parhelion" compare image.exr first.exr --max 0 >difference 2>&1 ||
            { fail "$name" "another image" difference; return; }
    fi
    [[ -z $(ls -A "$TMPDIR") ]] || { fail "$name" "left $(ls "$TMPDIR")"; rm -rf "${TMPDIR:?}"/*; return; }
    printf '%s: passed\n' "$name"
}

rounds=0

# damaged NAME COMMAND: COMMAND is run for one file of a warm cache, each time for another; it is set aside and made again.
damaged() {
    local name=$1 files
    mapfile -t files < <(find "$work/cache" -maxdepth 1 -name '*.program' | sort)
    "$2" "${files[rounds++ % ${#files[@]}]}"
    renders "cache damaged: $name" 0 'is damaged .* and set aside; its kernels are compiled again' env
    renders "cache damaged: $name, run again" 0 'kernels: .*, cached' env
    rm -rf "$work"/cache/*.damaged
}

cut_short() { truncate -s "$(($(stat -c %s "$1") / 2))" "$1"; }
one_short() { truncate -s -1 "$1"; }
empty() { : >"$1"; }
sparse() { truncate -s 1T "$1"; }
garbled() {
    local size
    size=$(stat -c %s "$1")
    head -c "$size" /dev/urandom >"$1"
}
garbled_inside() { printf 'garbage' | dd of="$1" bs=1 seek="$(($(stat -c %s "$1") - 30000))" conv=notrunc status=none; }
folder_instead() { rm "$1" && mkdir -p "$1/in the way"; }
pipe_instead() { rm "$1" && mkfifo "$1"; }

caches() {
    renders "cold cache" 0 'kernels: .*, compiled' env
    renders "warm cache" 0 'kernels: .*, cached' env
    damaged "cut short" cut_short
    damaged "a byte short" one_short
    damaged "empty" empty
    damaged "sparse, 1 TB" sparse
    damaged "garbage" garbled
    damaged "garbage inside" garbled_inside
    damaged "folders" folder_instead
    damaged "pipes" pipe_instead
    # The driver's own folder is not used, whatever is in it.
    mkdir -p pocl/HJ && echo garbage >pocl/HJ/program.bc
    renders "the driver's cache damaged" 0 - env POCL_CACHE_DIR="$work/pocl"
    : >file
    renders "cache folder below a file" 0 'note: the cache folder .*/file/below cannot be written \(Not a directory\)' \
        env PARHELION_CACHE_DIR="$work/file/below"
    renders "no cache folder" 0 'note: no cache folder: PARHELION_CACHE_DIR, XDG_CACHE_HOME and HOME are not set' \
        env -u PARHELION_CACHE_DIR -u HOME
    renders "HOME" 0 - env -u PARHELION_CACHE_DIR
    [[ $(find home/.cache/parhelion -name '*.program' | wc -l) == 2 ]] || fail "HOME" "no programs in ~/.cache/parhelion"
    renders "a bound of nothing" 0 'note: PARHELION_CACHE_SIZE allows 0 MB' env PARHELION_CACHE_DIR="$work/none" PARHELION_CACHE_SIZE=0
    renders "a bound that is no number" 2 "PARHELION_CACHE_SIZE is '1 GB': accepted are whole megabytes" env PARHELION_CACHE_SIZE="1 GB"
    renders "no such temporary folder" 0 - env TMPDIR=/no/such/folder
    bounded
    shared
}

# Files that were not asked for the longest make room.
bounded() {
    local file
    rm -rf bound && mkdir bound
    for file in 0123456789abcde{0,1,2,3}.program; do
        head -c 800000 /dev/urandom >"bound/$file"
        touch -d "2020-01-01 +${#file} days" "bound/$file"
    done
    touch -d 2019-01-01 bound/0123456789abcde3.program
    renders "a bound of 2 MB" 0 - env PARHELION_CACHE_DIR="$work/bound" PARHELION_CACHE_SIZE=2
    (($(du -sb --apparent-size bound | cut -f1) < 2200000)) || fail "a bound of 2 MB" "$(du -sb bound)"
    [[ ! -e bound/0123456789abcde3.program ]] || fail "a bound of 2 MB" "the oldest file is still there"
    renders "a bound of 2 MB, run again" 0 'kernels: .*, cached' env PARHELION_CACHE_DIR="$work/bound" PARHELION_CACHE_SIZE=2
}

# Several processes on one cold cache, and a run that was killed and left its temporary folder.
shared() {
    local i killed ids=()
    rm -rf "$work/cache"
    for i in 1 2 3; do
        "$parhelion" render scene.xml -o "shared$i.exr" --quiet >"shared$i" 2>&1 &
        ids+=($!)
    done
    for i in 1 2 3; do
        wait "${ids[i - 1]}" || fail "three processes" "exit code $?" "shared$i"
        "$parhelion" compare "shared$i.exr" first.exr --max 0 >difference 2>&1 || fail "three processes" "another image" difference
    done
    rm -rf "$work/cache"
    "$parhelion" render scene.xml -o killed.exr --quiet >/dev/null 2>&1 &
    killed=$!
    for i in {1..200}; do [[ -z $(ls -A "$TMPDIR") ]] || break; sleep 0.02; done
    kill -KILL "$killed"
    wait "$killed" 2>/dev/null
    renders "after one that was killed" 0 - env
}

# mount_here NAME OPTIONS: a file system of its own, or the group is skipped.
mount_here() {
    mkdir -p "$1"
    mount -t tmpfs -o "$2" none "$work/$1" 2>/dev/null || { echo "skipped: no file system can be mounted here"; exit 77; }
    mounted+=("$work/$1")
}

disks() {
    mount_here small size=256k
    renders "cache on a full disk" 0 'note: the cache folder .* cannot be written \(No space left on device\)' \
        env PARHELION_CACHE_DIR="$work/small/cache"
    renders "cold cache" 0 - env
    mount_here read size=16m
    cp -r cache read/cache
    mount -o remount,ro "$work/read"
    renders "warm cache, read-only" 0 'kernels: .*, cached' env PARHELION_CACHE_DIR="$work/read/cache"
    renders "cold cache, read-only" 0 'note: the cache folder .* cannot be written \(Read-only file system\)' \
        env PARHELION_CACHE_DIR="$work/read/other"
    mount_here full size=8m
    cp -r cache full/cache
    head -c 9M /dev/zero 2>/dev/null >full/rest
    renders "warm cache, full disk" 0 'kernels: .*, cached' env PARHELION_CACHE_DIR="$work/full/cache"
    renders "temporary folder full" 0 - env TMPDIR="$work/small"
    mount_here plain size=64m,noexec
    renders "temporary folder without programs" 0 - env TMPDIR="$work/plain"
    nobody
}

# A user without a home and without rights.
nobody() {
    local command=(setpriv --reuid=65534 --regid=65534 --clear-groups)
    chmod 755 "$work" && chmod 1777 "$TMPDIR"
    cp "$parhelion" program && chmod 755 program scene.xml
    mkdir -p out && chmod 777 out
    if ! "${command[@]}" ./program --version >/dev/null 2>&1; then
        echo "skipped: no other user can be had here"
        left_out=1
        return
    fi
    env -u PARHELION_CACHE_DIR HOME=/nonexistent "${command[@]}" ./program render scene.xml -o out/nobody.exr >messages 2>&1 ||
        fail "a user without a home" "exit code $?" messages
    grep -q 'note: the cache folder /nonexistent/.cache/parhelion cannot be written (Permission denied)' messages ||
        fail "a user without a home" "no note" messages
    "$parhelion" compare out/nobody.exr first.exr --max 0 >difference 2>&1 || fail "a user without a home" "another image" difference
}

drivers() {
    local offered
    scene=$root/scenes/cornell-box/scene.xml # its programs take long enough to compile to get into each other's way
    renders "cold cache" 0 - env
    mkdir vendors
    renders "no driver" 3 'no driver is registered in .*vendors .*install pocl-opencl-icd' env OCL_ICD_VENDORS="$work/vendors"
    echo /no/such/libpocl.so >vendors/pocl.icd
    renders "a driver that is gone" 3 '/no/such/libpocl.so of .*/pocl.icd cannot be loaded' env OCL_ICD_VENDORS="$work/vendors"
    echo garbage >vendors/garbage.so
    echo "$work/vendors/garbage.so" >vendors/pocl.icd
    renders "a driver that is none" 3 'cannot be loaded: .*(invalid ELF|too short)' env OCL_ICD_VENDORS="$work/vendors"
    renders "a device that is none" 3 "none \(POCL_DEVICES is 'foo'" env POCL_DEVICES=foo
    for offered in basic pthread "basic basic" "pthread basic" "pthread foo"; do
        # Cold each time: two programs compiled in threads beside each other waited for ever.
        rm -rf cache
        renders "devices $offered" 0 - env POCL_DEVICES="$offered"
    done
    renders "one thread" 0 - env POCL_MAX_PTHREAD_COUNT=1
}

# With any amount of memory it ends by itself: with the image, or with one line that says memory.
memory() {
    local limit status
    renders "cold cache" 0 - env
    for limit in 60 150 250 280 300 320 340 360 380 400 430 460 500 600 800; do
        rm -rf cache
        (ulimit -v "$((limit * 1000))" && timeout -k 5 200 "$parhelion" render scene.xml -o image.exr --quiet --force) >messages 2>&1 </dev/null
        status=$?
        if [[ $status == 0 ]]; then
            "$parhelion" compare image.exr first.exr --max 0 >difference 2>&1 || fail "$limit MB" "another image" difference
        elif [[ $status == 3 ]]; then
            grep -Eqi 'memory' messages || fail "$limit MB" "does not say memory" messages
        else
            ((limit < 100)) || fail "$limit MB" "exit code $status" messages # below, not even libraries are loaded
        fi
    done
}

children() {
    local id i
    "$parhelion" render scene.xml -o image.exr --quiet >messages 2>&1 &
    id=$!
    for i in {1..500}; do [[ -z $(pgrep -P "$id" || true) ]] || break; sleep 0.01; done
    local child
    child=$(pgrep -P "$id") || { echo "skipped: nothing is compiled beside (one processor)"; kill -KILL "$id"; exit 77; }
    kill -KILL "$id"
    wait "$id" 2>/dev/null
    for i in {1..100}; do kill -0 "$child" 2>/dev/null || return 0; sleep 0.02; done
    fail "a killed render" "the process that compiles beside it lives on"
}

# examined NAME CODE TEXT COMMAND...: `COMMAND doctor` ends with CODE and says TEXT; as JSON likewise. Its exit code is 0 where
# a render works, and else 3.
examined() {
    local name=$1 code=$2 text=$3 status rendered
    shift 3
    timeout -k 5 120 "$@" "$parhelion" doctor >page 2>messages </dev/null
    status=$?
    [[ $status == "$code" ]] || { fail "doctor: $name" "exit code $status, not $code" page; return; }
    grep -Eq -- "$text" page || { fail "doctor: $name" "nothing like '$text' is said" page; return; }
    [[ ! -s messages ]] || { fail "doctor: $name" "standard error" messages; return; }
    timeout -k 5 120 "$@" "$parhelion" doctor --json >page.json 2>&1 </dev/null
    if ((code == 3)); then grep -q '"prevents": true' page.json; else ! grep -q '"prevents": true' page.json; fi ||
        { fail "doctor: $name" "another verdict as JSON" page.json; return; }
    timeout -k 5 120 "$@" "$parhelion" render "$scene" --spp 1 -o "$work/image.exr" --force >messages 2>&1 </dev/null
    rendered=$?
    ((code == 0 ? rendered == 0 : rendered != 0)) || { fail "doctor: $name" "a render ends with $rendered" messages; return; }
    printf 'doctor: %s: passed\n' "$name"
}

doctor() {
    scene=$work/scene.xml
    examined "all is well" 0 '^nothing is wrong|^worth knowing' env
    examined "no driver" 3 'WRONG: no OpenCL device: no driver is registered' env OCL_ICD_VENDORS=/nonexistent
    examined "no home" 0 'there is no folder for compiled kernels' env -u HOME -u PARHELION_CACHE_DIR
    : >file
    examined "no cache" 0 'the cache folder .*/file/below cannot be written \(Not a directory\)' env PARHELION_CACHE_DIR="$work/file/below"
    examined "a size that is none" 3 "WRONG: PARHELION_CACHE_SIZE is 'x'" env PARHELION_CACHE_SIZE=x
    examined "no temporary folder of that name" 0 'TMPDIR, /nonexistent, cannot be used' env TMPDIR=/nonexistent
    examined "no device of that name" 3 "WRONG: .*POCL_DEVICES is 'foo'" env POCL_DEVICES=foo
    examined "less memory" 0 'ulimit -v allows 3[0-9]* MB' bash -c 'ulimit -v 4000000 && exec "$@"' bash
    SECRET_TOKEN=do-not-tell "$parhelion" doctor >page 2>&1
    ! grep -q do-not-tell page || fail "doctor" "tells other variables" page
    grep -q "PARHELION_CACHE_DIR=$work/cache" page || fail "doctor" "does not tell PARHELION_CACHE_DIR" page
    [[ -z $(ls -A "$TMPDIR") ]] || fail "doctor" "left $(ls "$TMPDIR")"
    command -v taskset >/dev/null && (($(nproc) > 1)) || return 0
    examined "one processor" 0 'this process may run on 1 of [0-9]+ processors' taskset -c 0
}

# with_faults VARIABLE=VALUE... COMMAND...: COMMAND on a device that fails in that way.
with_faults() { env OPENCL_LAYERS="$layer" "$@"; }

# A scene of many waves, to see a device fail in the middle of one: 64 blocks of 160 samples.
needs_layer() {
    [[ -n $layer ]] || { echo "skipped: no layer is given"; exit 77; }
    sed -e 's/"depth"/"path"/' scene.xml >path.xml
    paths=(path.xml --size 32x32 --spp 160)
    "$parhelion" render "${paths[@]}" -o whole.exr --quiet --force >messages 2>&1 || fail "a whole device" "exit code $?" messages
    with_faults "$parhelion" render "${paths[@]}" -o image.exr --quiet --force >messages 2>&1
    cmp -s image.exr whole.exr || fail "a layer without faults" "another image" messages
    # A loader without layers takes no notice of it.
    ! with_faults FAULTY_ROOM=0 "$parhelion" render "${paths[@]}" -o image.exr --quiet --force >messages 2>&1 ||
        { echo "skipped: this OpenCL loader has no layers"; exit 77; }
}

# faulty NAME CODE TEXT VARIABLE=VALUE... -- OPTIONS...: a render on such a device ends with CODE and one line like TEXT, or where
# CODE is 0 with that note and the bits of a whole device. What there was stays; nothing else is left.
faulty() {
    local name=$1 code=$2 text=$3 status faults=()
    shift 3
    while [[ $1 != -- ]]; do faults+=("$1") && shift; done
    rm -f image.exr && echo older >image.exr
    with_faults "${faults[@]}" timeout -k 5 120 "$parhelion" render "${paths[@]}" -o image.exr --force --progress lines "${@:2}" \
        >messages 2>&1 </dev/null
    status=$?
    [[ $status == "$code" ]] || { fail "$name" "exit code $status, not $code" messages; return; }
    grep -Eq -- "$text" messages || { fail "$name" "nothing like '$text' is said" messages; return; }
    if ((code == 0)); then
        cmp -s image.exr whole.exr || { fail "$name" "another image" messages; return; }
    else
        [[ $(grep -c '^parhelion:' messages) == 1 && $(tail -1 messages) == parhelion:* ]] || fail "$name" "more than a line" messages
        [[ $(cat image.exr) == older ]] || fail "$name" "the older image is gone"
    fi
    [[ -z $(ls -A "$TMPDIR") ]] || { fail "$name" "left $(ls "$TMPDIR")"; rm -rf "${TMPDIR:?}"/*; }
    local left
    left=$(printf '%s\n' * .[!.]* | grep -Evx 'cache|home|tmp|messages|(scene|path)\.xml|(image|whole)\.exr|(kept|before)\.film|stats\.json|\.\[!\.\]\*')
    [[ -z $left ]] || fail "$name" "left $left"
    printf '%s: passed\n' "$name"
}

# How many paths are in flight where there was no room for more.
pool_of() { sed -n 's/.*has no room for [0-9]* paths in flight: there are \([0-9]*\) .*/\1/p' messages; }

full_device() {
    local room last=65536 pool halved=0
    needs_layer
    # Down from enough; what is too little even for the smallest pool is refused.
    for room in 9000000 6000000 3000000 2000000 1500000; do
        faulty "room for $room bytes" 0 'no room for [0-9]* paths in flight: there are [0-9]*.* the image is the same' \
            FAULTY_ROOM="$room" --
        pool=$(pool_of)
        ((${pool:-0} > 0 && pool <= last)) || fail "room for $room bytes" "a pool of ${pool:-nothing} after one of $last"
        ((pool == last)) || halved=$((halved + 1))
        last=${pool:-0}
    done
    ((halved >= 3)) || fail "less and less room" "the pool was made smaller $halved times"
    faulty "no room" 3 'parhelion: the device has no room for buffer' FAULTY_ROOM=100000 --
    # A driver that looks for memory when kernels are launched.
    faulty "no room at the first launch" 0 'no room for [0-9]* paths in flight: there are' FAULTY_ITEMS=100 --
    faulty "never room at a launch" 3 'no room for [0-9]* paths at once: CL_OUT_OF_RESOURCES \(-5\) in clEnqueueNDRangeKernel' \
        FAULTY_ITEMS=1 --
    faulty "a film that is more than the device has" 0 'note: the film would take .* the rest is on the disk' FAULTY_MEMORY=100000 --
    faulty "a row of a film that is more than the device has" 2 'there is room for 0\.01 MB' FAULTY_MEMORY=20000 --
}

# lost SILENT: a device that is lost after so many launches, earlier and later.
lost() {
    local fault=$1 launches kept=0
    for launches in 0 3 30 60 200 500; do
        rm -f kept.film
        faulty "$fault=$launches" 3 'CL_[A-Z_]* \(-[0-9]*\) in |no room for buffer' "$fault=$launches" -- \
            --checkpoint kept.film --checkpoint-every 0.001 --pool-paths 4096
        [[ -e kept.film ]] || continue
        grep -q 'the device failed while rendering: CL_.*; --resume kept.film goes on' messages ||
            fail "$fault=$launches" "does not say how to go on" messages
        kept=$((kept + 1))
        cp kept.film before.film
        # Once more, from what was kept: what that was stays.
        faulty "$fault=$launches, again" 3 'failed while rendering: CL_.*; --resume before.film goes on' "$fault=40" -- \
            --resume before.film --pool-paths 4096
        cmp -s kept.film before.film || fail "$fault=$launches" "the checkpoint is another"
        "$parhelion" render "${paths[@]}" -o image.exr --force --quiet --resume before.film >messages 2>&1 ||
            fail "$fault=$launches" "cannot be gone on with" messages
        cmp -s image.exr whole.exr || fail "$fault=$launches" "gone on with, it is another image"
        rm -f before.film
    done
    ((kept >= 2)) || fail "$fault" "there was a checkpoint only $kept times"
    faulty "$fault, nothing kept" 3 'failed while rendering: .*; there is no checkpoint to go on from' "$fault=60" -- --pool-paths 4096
}

lost_device() {
    needs_layer
    lost FAULTY_LOST
    lost FAULTY_LOST_SILENT
}

# number KEY: the largest of that key in stats.json.
largest() { grep -o "\"$1\": [0-9.e-]*" stats.json | sed 's/.* //' | sort -g | tail -1; }

slow_device() {
    local nanoseconds longest
    needs_layer
    # By the device's clock a wave of 65536 paths, in two halves, would take 0.07 to 0.7 s a launch.
    for nanoseconds in 2000 5000 20000; do
        faulty "$nanoseconds ns a path" 0 'rendering' FAULTY_NANOSECONDS="$nanoseconds" -- --stats stats.json
        longest=$(largest longest_launch_seconds)
        awk "BEGIN { exit !($longest < 0.1 && $longest > 0.02) }" || fail "$nanoseconds ns a path" "a launch of $longest s"
    done
    # One that has no clock.
    faulty "no clock" 0 'rendering' FAULTY_NANOSECONDS=0 -- --stats stats.json
    [[ $(largest longest_launch_seconds) == 0* ]] || fail "no clock" "a launch of $(largest longest_launch_seconds) s"
}

case $group in
    caches) caches ;;
    disks) disks ;;
    drivers) drivers ;;
    memory) memory ;;
    children) children ;;
    doctor) doctor ;;
    full_device | lost_device | slow_device) "$group" ;;
    *) echo "no such group: $group" && exit 2 ;;
esac
((failed || !left_out)) || exit 77 # a part of a group is missing: not passed either
exit "$failed"
