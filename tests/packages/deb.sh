#!/bin/bash
# deb.sh BUILD: makes the Debian package of a build and installs it in a bare Debian 12, where another user renders from
# another folder without the source tree; then it is removed without leftovers. And `cmake --install` into a prefix.
#
# Needs root, debootstrap, and a mirror (DEBIAN_MIRROR, else that of apt); else it ends with 77, which ctest takes for
# skipped. Minutes: ctest --test-dir build/release -C packages -L packages
set -uo pipefail
build=$(readlink -f -- "$1")
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd)
suite=bookworm
scratch=$(mktemp -d)
system=$scratch/system
mounted=()
finish() {
    for folder in "${mounted[@]}"; do umount "$folder"; done
    rm -rf --one-file-system -- "$scratch"
}
trap finish EXIT
failures=0

wrong() {
    echo "FAILED: $1"
    [[ -z ${2:-} ]] || tail -n 20 "$2" | sed 's/^/    /'
    failures=$((failures + 1))
}

skip() {
    echo "skipped: $1"
    exit 77
}

give_up() {
    wrong "$@"
    exit 1
}

mount_here() {
    mount "$@" 2>/dev/null || skip "nothing can be mounted here"
    mounted=("${@: -1}" "${mounted[@]}")
}

mirror() {
    local found
    found=$(grep -hsE '^(deb |URIs:)' /etc/apt/sources.list /etc/apt/sources.list.d/debian.sources |
        grep -oE 'https?://[^ ]+/debian/?( |$)' | head -n 1)
    echo "${DEBIAN_MIRROR:-${found:-http://deb.debian.org/debian}}"
}

make_package() {
    cmake --build "$build" --target parhelion parhelion-stress >"$scratch/log" 2>&1 || give_up "the build" "$scratch/log"
    (cd "$build" && cpack -G DEB -B "$scratch/package") >"$scratch/log" 2>&1 || give_up "cpack" "$scratch/log"
    package=$(ls "$scratch"/package/*.deb)
    dpkg-deb -f "$package" >"$scratch/fields"
    dpkg-deb -c "$package" | sed -E 's/.* \.\//\//' >"$scratch/contents"
    local field file
    for field in 'Package: parhelion$' 'Section: graphics$' 'Version: [0-9]' 'Description: .' \
        'Depends: .*libc6 \(>= ' 'Depends: .*ocl-icd-libopencl1' 'Depends: .*pocl-opencl-icd \| opencl-icd' 'Depends: .*libtbb12'; do
        grep -qE "^$field" "$scratch/fields" || wrong "no field $field" "$scratch/fields"
    done
    for file in bin/parhelion bin/parhelion-stress share/parhelion/scenes/cornell-box/scene.xml share/man/man1/parhelion.1 \
        share/man/man1/parhelion-stress.1 \
        share/bash-completion/completions/parhelion share/zsh/vendor-completions/_parhelion share/doc/parhelion/README.md; do
        grep -qx "/usr/$file" "$scratch/contents" || wrong "the package has no $file" "$scratch/contents"
    done
}

# hidden COMMAND...: where there is no source tree and no build.
hidden() {
    # shellcheck disable=SC2016 # for the other shell
    unshare -m bash -c 'mount -t tmpfs none "$1" && shift && exec "$@"' bash "$root" "$@"
}

prefix() {
    local image=$scratch/prefix.exr
    cmake --install "$build" --prefix "$scratch/prefix" >"$scratch/log" 2>&1 || wrong "cmake --install" "$scratch/log"
    cd "$scratch" || exit 1
    hidden "$scratch/prefix/bin/parhelion" render "$scratch/prefix/share/parhelion/scenes/cornell-box/scene.xml" \
        --spp 4 -o "$image" >"$scratch/log" 2>&1 || wrong "the installed program without its sources" "$scratch/log"
    hidden "$scratch/prefix/bin/parhelion" stress --list >"$scratch/log" 2>&1 || wrong "the installed stress" "$scratch/log"
    [[ -s $scratch/prefix/share/zsh/site-functions/_parhelion ]] || wrong "no completion for zsh in the prefix"
}

bare_system() {
    debootstrap --variant=minbase "$suite" "$system" "$(mirror)" >"$scratch/log" 2>&1 || skip "debootstrap has no mirror: $(tail -n 1 "$scratch/log")"
    cp /etc/resolv.conf "$system/etc/resolv.conf"
    mount_here -t proc proc "$system/proc"
    mount_here -t sysfs sysfs "$system/sys"
    mount_here -t tmpfs none "$system/dev/shm"
}

inside() { chroot "$system" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive "$@"; }
as_user() { chroot --userspec=painter:painter "$system" env -i PATH=/usr/bin:/bin HOME=/home/painter bash -c "cd /home/painter/elsewhere && $1"; }

# Files of the system but those of packages that stay, caches and logs.
named_files() { (cd "$system" && find . -xdev -iname '*parhelion*' ! -path './home/*' ! -path './var/cache/*' | sort); }

package_in_bare_system() {
    cp "$package" "$system/tmp/parhelion.deb"
    inside apt-get -q update >"$scratch/log" 2>&1 || skip "apt-get has no mirror: $(tail -n 1 "$scratch/log")"
    inside apt-get -q install -y --no-install-recommends /tmp/parhelion.deb >"$scratch/log" 2>&1 || give_up "apt-get install" "$scratch/log"
    rm "$system/tmp/parhelion.deb"
    inside useradd -m painter
    mkdir "$system/home/painter/elsewhere" && chroot "$system" chown painter:painter /home/painter/elsewhere
    as_user "parhelion doctor" >"$scratch/log" 2>&1 || wrong "doctor" "$scratch/log"
    as_user "parhelion render /usr/share/parhelion/scenes/cornell-box/scene.xml --spp 4 -o image.exr" >"$scratch/log" 2>&1 ||
        wrong "another user's render" "$scratch/log"
    # The same bits as where it was built: the same driver.
    "$build/parhelion" compare "$system/home/painter/elsewhere/image.exr" "$scratch/prefix.exr" --max 0 >"$scratch/log" 2>&1 ||
        wrong "another image" "$scratch/log"
    as_user "parhelion stress --list" >"$scratch/log" 2>&1 || wrong "stress" "$scratch/log"
    as_user "source /usr/share/bash-completion/completions/parhelion && complete -p parhelion" >"$scratch/log" 2>&1 ||
        wrong "bash completion" "$scratch/log"
    inside dpkg -L parhelion >"$scratch/listed"
    (($(named_files | wc -l) >= 7)) || wrong "files of the package are not seen in the system"
    inside apt-get -q purge -y parhelion >"$scratch/log" 2>&1 || wrong "apt-get purge" "$scratch/log"
    named_files >"$scratch/left"
    [[ ! -s $scratch/left ]] || wrong "apt-get purge leaves files" "$scratch/left"
    while read -r file; do
        [[ ! -f $system$file ]] || wrong "apt-get purge leaves $file"
    done <"$scratch/listed"
}

((EUID == 0)) || skip "only root makes a bare system"
command -v debootstrap >/dev/null || skip "debootstrap is not installed"
command -v dpkg-shlibdeps >/dev/null || skip "dpkg-shlibdeps (dpkg-dev) is not installed"
make_package
prefix
bare_system
package_in_bare_system
echo "$(basename "$package"): $(stat -c %s "$package") bytes, $(wc -l <"$scratch/contents") entries; $failures went wrong"
sed -n '/^Depends/p' "$scratch/fields"
((failures == 0))
