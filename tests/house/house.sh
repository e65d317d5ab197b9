#!/bin/bash
# House rules no compiler checks. Usage: house.sh includes|numerics|files|faults [ROOT]; prints one line per offence.
set -euo pipefail
check=$1
cd -- "${2:-$(dirname -- "${BASH_SOURCE[0]}")/../..}"

# offend RULE: what stands on stdin, one "where: what" a line, offends RULE. Whatever is printed makes the check fail.
offend() { sed "s#\$# [$1]#"; }

# code FILE...: every line as "file:number:text", without comments (and without what follows // in a string).
code() {
    (($# == 0)) || awk '
        FNR == 1 { inside = 0 }
        {
            line = $0; kept = ""
            while (line != "") {
                if (inside) {
                    end = index(line, "*/")
                    if (!end) break
                    inside = 0; line = substr(line, end + 2)
                } else if (match(line, /\/\/|\/\*/)) {
                    kept = kept substr(line, 1, RSTART - 1)
                    if (substr(line, RSTART, 2) == "//") break
                    inside = 1; line = substr(line, RSTART + 2)
                } else { kept = kept line; break }
            }
            if (kept !~ /^[ \t]*$/) print FILENAME ":" FNR ":" kept
        }' "$@"
}

# files_in FOLDER PATTERN...: existing files below FOLDER, into the array `found`.
files_in() {
    local folder=$1 names=()
    shift
    for pattern in "$@"; do names+=(-o -name "$pattern"); done
    found=()
    [[ ! -d $folder ]] || mapfile -t found < <(find "$folder" -type f \( "${names[@]:1}" \) | sort)
}

# includes_in FOLDER: its #include lines as "file:number:#include ...", spacing made plain.
includes_in() {
    files_in "$1" '*.h' '*.cpp' '*.cl'
    code "${found[@]}" | sed -nE 's/^([^:]+:[0-9]+:)[ \t]*#[ \t]*include[ \t]*/\1#include /p'
}

# ------------------------------------------------------------------------------------------ includes

# The floor a shared header stands on; nothing for a list, which may stand anywhere.
floor_of() {
    case $1 in
        lane.h) echo 0 ;;
        math.h) echo 1 ;;
        bsdf.h | emitter.h | camera.h | roulette.h) echo 4 ;;
        bsdf_types.h | emitter_types.h) echo 2 ;;
        bsdf_*.h | emitter_*.h) echo 3 ;;
        records.h) ;;
        *) echo 2 ;;
    esac
}

# shared.h alone includes the shared headers: each once, lower floors first. It is compiled once a precision; what does
# not depend on the precision (types.h, features.h, materials.h) is included by others.
check_shared_list() {
    local list=kernels/shared/shared.h top=0 floor name header
    includes_in kernels/shared | grep -v "^$list:" | grep -v '"shared/materials.h"' | offend "shared headers are included by shared.h only" || true
    [[ -f $list ]] || return 0
    local listed
    listed=$(includes_in kernels/shared | grep "^$list:" | grep -v '#include <' |
        sed -E 's|.*#include "([^"]*/)?([^"/]+)".*|\2|' || true)
    for header in kernels/shared/*.h; do
        [[ $header == */shared.h || $header == */types.h || $header == */features.h ||
            $header == */materials.h ]] && continue
        [[ $(grep -cx "${header##*/}" <<<"$listed") == 1 ]] ||
            echo "$header: not exactly once in $list" | offend "shared.h lists every shared header"
    done
    for name in $listed; do
        floor=$(floor_of "$name")
        [[ -n $floor ]] || continue
        ((floor >= top)) || echo "$list: $name (floor $floor) after a header of floor $top" | offend "floors go upward"
        top=$((floor > top ? floor : top))
    done
}

# Folder, then what it may not include (an extended regular expression after #include ").
forbidden_includes=(
    "kernels     [^\"]*\.cl\""
    "kernels     host/"
    "host        [^\"]*\.\./"
    "kernels     [^\"]*\.\./"
)

# Rooms of the host, lowest first: a folder, then the others that it may include. What lies in host itself knows none.
host_rooms=(
    "image"
    "scene image"
    "cl"
    "bvh"
    "flatten image scene bvh"
    "film scene image flatten"
    "waves scene cl flatten film"
    "twin scene bvh flatten film waves"
    "render scene image flatten film waves twin"
    "numerics scene image cl bvh flatten film waves twin render"
    "commands scene image cl bvh flatten film waves twin render"
    "catalogue scene image cl bvh flatten film waves twin render numerics commands"
)

# No circle and no arrow upwards: a room includes what stands before it.
check_rooms() {
    local entry room may below known=" " folder
    for entry in "${host_rooms[@]}"; do
        read -r room may <<<"$entry"
        for below in $may; do
            [[ $known == *" $below "* ]] || echo "host_rooms: $room may include $below" | offend "rooms go upward"
        done
        known+="$room "
        includes_in "host/$room" | grep -E '#include "host/[^/"]+/' |
            grep -vE "#include \"host/($room${may:+|${may// /|}})/" | offend "host/$room may not include this" || true
    done
    for folder in host/*/; do
        folder=${folder#host/}
        [[ $known == *" ${folder%/} "* ]] || echo "host/$folder" | offend "a room has its floor in host_rooms"
    done
    includes_in host | grep -E "#include (<(host|kernels)/|\"(${known// /|}x)/)" |
        offend "host includes its own by \"host/...\"" || true
    includes_in host | grep -E '^host/[^/]+:' | grep -v '^host/main.cpp:' | grep -E '#include "host/[^/"]+/' |
        offend "host itself includes no room" || true
}

check_includes() {
    local rule folder pattern
    check_shared_list
    check_rooms
    for rule in "${forbidden_includes[@]}"; do
        read -r folder pattern <<<"$rule"
        includes_in "$folder" | grep -E ":#include \"$pattern" | offend "$folder may not include this" || true
    done
}

# ------------------------------------------------------------------------------------------ numerics

# Uses of epsilon, clamp or double literals in kernels that are right, as "file text reason".
allowed=(
    "kernels/shared/lane.h HALF_ULP half a unit in the last place, for bounds of rounding errors"
    "kernels/shared/materials.h X( values of parameters, for the host alone"
)

not_allowed() {
    local line entry file text _reason
    while IFS= read -r line; do
        for entry in "${allowed[@]}"; do
            read -r file text _reason <<<"$entry"
            [[ $line == "$file:"*"$text"* ]] && continue 2
        done
        printf '%s\n' "$line"
    done
}

# Literals without f: outside R(...), which adds it, and outside "#define NAME number", which R(...) gets to see.
double_literals() {
    sed -E 's/\bR\(([^()]|\(([^()]|\([^()]*\))*\))*\)//g; /:[ \t]*#[ \t]*define[ \t]+[A-Za-z_0-9]+[ \t]+[-(]*[0-9.eE+-]+\)*[ \t]*$/d' |
        grep -E ':[0-9]+:(.*[^A-Za-z0-9_.])?(([0-9]+\.[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?|[0-9]+[eE][+-]?[0-9]+|0[xX][0-9a-fA-F.]+[pP][+-]?[0-9]+)([^A-Za-z0-9_.+-]|[+-]|$)'
}

check_numerics() {
    local kernels host
    files_in kernels '*.h' '*.cl'
    kernels=$(code "${found[@]}")
    files_in host '*.h' '*.cpp'
    host=$(code "${found[@]}")
    grep -E '\bnative_|\bmad\(|\bhalf_(cos|divide|exp|exp2|exp10|log|log2|log10|powr|recip|rsqrt|sin|sqrt|tan)\(|\bfast_(distance|length|normalize)\(' \
        <<<"$kernels" | offend "inexact built-in" || true
    grep -E -e '-cl-(fast-relaxed-math|mad-enable|unsafe-math-optimizations|finite-math-only|no-signed-zeros|denorms-are-zero)' \
        <<<"$kernels"$'\n'"$host" | offend "compiler option that changes results" || true
    double_literals <<<"$kernels" | not_allowed | offend "double literal: write 1.5f or R(1.5)" || true
    grep -iE 'epsilon|\bclamp[A-Za-z_0-9]*\(' <<<"$kernels" | not_allowed | offend "epsilon or clamp in a kernel" || true
}

# ------------------------------------------------------------------------------------------ files

# long_functions FILE...: product functions of more than 60 lines. By indentation, which clang-format sees to: a function
# begins where a statement does, at the margin or in a struct, and ends with a brace in the same column.
long_functions() {
    (($# == 0)) || awk '
        FNR == 1 { in_struct = in_nested = 0; begin[0] = begin[4] = begin[8] = 0 }
        function starts(column) { begin[column] = FNR; text[column] = $0 }
        function ends(column) {
            lines = FNR - begin[column] + 1
            if (begin[column] && lines > 60 && text[column] ~ /\(/)
                print FILENAME ":" begin[column] ": " lines " lines"
            begin[column] = 0
        }
        /^}/ { ends(0); in_struct = in_nested = 0; next }
        /^    }/ { if (in_struct && !in_nested) ends(4); in_nested = 0; next }
        /^        }/ { if (in_nested) ends(8); next }
        in_struct && /^    (struct|class|union|enum) .*[^;]$/ { in_nested = 1; next }
        /^(struct|class|union|enum|template<.*> *(struct|class)) .*[^;]$/ { in_struct = 1; begin[0] = 0; next }
        /^(namespace|extern|#|\/\/|private:|public:|typedef|using)/ { next }
        /^[A-Za-z_\[]/ { starts(0); next }
        in_struct && !in_nested && /^    [A-Za-z_~\[]/ { starts(4); next }
        in_nested && /^        [A-Za-z_~\[]/ { starts(8) }' "$@"
}

check_files() {
    local file first lines folder most
    # They can be closed, full or a pipe that nobody reads; results must be checked, messages must not throw.
    files_in host '*.h' '*.cpp'
    code "${found[@]}" | grep -v '^host/streams.cpp:' |
        grep -E '\bstd(out|err)\b|\bcout\b|\bcerr\b|\bclog\b|fmt::print\(|\bf?printf\(|\bputs\(|STD(OUT|ERR)_FILENO' |
        grep -vE '^host/(child_process|progress|cl/driver_watch)\.cpp:.*STD(OUT|ERR)_FILENO' |
        offend "host/streams.h alone writes to standard streams" || true
    for folder in host kernels; do
        files_in "$folder" '*.h' '*.cpp' '*.cl'
        long_functions "${found[@]}" | offend "a function has at most 60 lines"
    done
    for folder in host kernels tests benchmarks; do
        files_in "$folder" '*.h' '*.cpp' '*.cl' '*.sh' '*.py' '*.cmake' CMakeLists.txt
        for file in "${found[@]}"; do
            first=$(head -c 4 "$file")
            case $file in
                *.h | *.cpp | *.cl) [[ $first == //* || $first == '/*'* ]] ;;
                *.py) [[ $first == \#* || $first == '"""'* ]] ;;
                *) [[ $first == \#* ]] ;;
            esac || echo "$file:1: the first line" | offend "a file opens with a comment on what it holds"
            lines=$(wc -l <"$file")
            most=320
            [[ $folder == tests ]] && most=450
            ((lines <= most)) || echo "$file: $lines lines" | offend "a file has at most $most lines"
        done
    done
}

# ------------------------------------------------------------------------------------------ faults

check_faults() {
    local file
    files_in tests/mutations '*.patch'
    for file in "${found[@]}"; do
        patch -p1 --dry-run --quiet <"$file" >/dev/null 2>&1 ||
            echo "$file" | offend "a fault applies to the sources as they are"
        grep -q '^Row: ' "$file" || echo "$file" | offend "a fault names the row that notices it"
    done
}

offences=$("check_$check")
[[ -z $offences ]] || { printf '%s\n' "$offences"; exit 1; }
