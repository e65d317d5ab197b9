#!/bin/bash
# Proves that house.sh can fail: in a scratch tree, each offence must be found, and the tree without it must pass.
set -euo pipefail
house=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)/house.sh
scratch=$(mktemp -d)
trap 'rm -rf -- "$scratch"' EXIT
failures=0

good_tree() {
    rm -rf -- "$scratch/tree"
    mkdir -p "$scratch"/tree/{kernels/{shared,device},host/{scene,cl,bvh,film,render,image},tests/mutations}
    cd "$scratch/tree"
    echo '// lane' >kernels/shared/lane.h
    printf '// math: 1.5 and epsilon and native_sin( in a comment are fine\n/* so is\n 2.5 mad( */\nfloat x = 1.5f + 1e3f + .5f; %s\n' \
        'Real y = R(2.5) * R(1. - G((7.)) + 2.); v.s0 = 0x1.0p-24f + 3;' >kernels/shared/math.h
    echo '#define PI 3.14159265' >>kernels/shared/math.h
    echo '// bsdf' >kernels/shared/bsdf.h
    printf '// list\n#include "shared/lane.h"\n#include "shared/math.h"\n#include "shared/bsdf.h"\n' >kernels/shared/shared.h
    printf '// stage\n#include "shared/shared.h"\n' >kernels/shade.cl
    for folder in scene cl bvh film render image; do echo '// code' >host/$folder/code.cpp; done
}

# must_find CHECK TEXT LINE FILE: with LINE appended to FILE, CHECK fails and says TEXT.
must_find() {
    local output status=0
    good_tree
    mkdir -p "$(dirname -- "$4")"
    printf '%b\n' "$3" >>"$4"
    output=$("$house" "$1" "$scratch/tree") || status=$?
    if ((status == 0)) || [[ $output != *"$2"* ]]; then
        echo "not found by $1: '$3' in $4 (exit $status): $output"
        failures=$((failures + 1))
    fi
}

for check in includes numerics files faults; do
    good_tree
    "$house" "$check" "$scratch/tree" || { echo "$check fails on a tree without offences"; exit 1; }
done

must_find includes "by shared.h only" '#include "shared/math.h"' kernels/shared/bsdf.h
must_find includes "lists every" '// not listed' kernels/shared/warp.h
must_find includes "lists every" '#include "shared/math.h"' kernels/shared/shared.h
must_find includes "floors go upward" '#include "shared/lane.h"' kernels/shared/shared.h
must_find includes "kernels may not" '#include "shade.cl"' kernels/intersect.cl
must_find includes "kernels may not" '  # include "host/error.h"' kernels/device/film.h
must_find includes "kernels may not" '#include "../host/error.h"' kernels/device/film.h
must_find includes "host/scene may not" '#include "host/cl/device.h"' host/scene/code.cpp
must_find includes "host/cl may not" '#include "host/scene/scene.h"' host/cl/code.cpp
must_find includes "host/bvh may not" '#include "host/cl/device.h"' host/bvh/code.cpp
must_find includes "host/bvh may not" '#include "host/render/film.h"' host/bvh/code.cpp
must_find includes "host/image may not" '#include "host/cl/device.h"' host/image/code.cpp
must_find includes "host/film may not" '#include "host/waves/pipeline.h"' host/film/code.cpp
must_find includes "host/render may not" '#include "host/commands/render.h"' host/render/code.cpp
must_find includes "host/numerics may not" '#include "host/catalogue/rows.h"' host/numerics/code.cpp
must_find includes "host/commands may not" '#include "host/numerics/shapes.h"' host/commands/code.cpp
must_find includes "host includes its own" '#include <host/error.h>' host/scene/code.cpp
must_find includes "host includes its own" '#include "cl/device.h"' host/code.cpp
must_find includes "host itself" '#include "host/cl/device.h"' host/error.h
must_find includes "has its floor" '// a room' host/attic/code.cpp
must_find includes "host may not" '#include "../cl/device.h"' host/scene/code.cpp
must_find numerics "inexact" 'x = native_sin(y);' kernels/shade.cl
must_find numerics "inexact" 'x = mad(a, b, c);' kernels/shade.cl
must_find numerics "inexact" 'x = half_sqrt(a);' kernels/shade.cl
must_find numerics "inexact" 'x = fast_normalize(a);' kernels/shade.cl
must_find numerics "compiler option" 'o = "-cl-fast-relaxed-math";' host/cl/code.cpp
must_find numerics "compiler option" 'o = "-cl-mad-enable";' host/cl/code.cpp
for literal in 1.5 1. .5 1e5 1.5e-3 0x1.8p-3; do
    must_find numerics "double literal" "x = $literal;" kernels/shade.cl
    must_find numerics "double literal" "x = $literal*y;" kernels/shared/math.h
    must_find numerics "double literal" "x = y-$literal" kernels/shared/math.h
done
must_find numerics "double literal" '#define HALF_PLUS(x) (x + 0.5)' kernels/shade.cl
must_find numerics "double literal" '/* c */ x = 0.5; // c' kernels/shade.cl
must_find numerics "epsilon or clamp" 'float epsilon = 1e-4f;' kernels/shade.cl
must_find numerics "epsilon or clamp" '#define RAY_EPSILON 3' kernels/shade.cl
must_find numerics "epsilon or clamp" 'x = clamp(y, 0.f, 1.f);' kernels/shade.cl
must_find files "opens with a comment" 'int x;' host/new.cpp
must_find files "opens with a comment" 'int x;' kernels/new.cl
must_find files "opens with a comment" 'set -e' tests/new.sh
must_find files "at most 320" "$(printf '//\\n%.0s' {1..320})" host/new.cpp
must_find files "at most 60" "int f(int x) {\n$(printf '    x++;\\n%.0s' {1..59})}" host/scene/code.cpp
must_find files "at most 60" "struct S {\n    int f(int x)\n        const {\n$(printf '        x++;\\n%.0s' {1..58})    }\n};" host/scene/code.cpp
must_find files "at most 60" "kernel void f(int x) {\n    if (x) {\n$(printf '        x++;\\n%.0s' {1..57})    }\n}" kernels/shade.cl
must_find files "at most 60" "[[nodiscard]] int f(int x) {\n$(printf '    x++;\\n%.0s' {1..59})}" host/scene/code.cpp
must_find files "at most 60" "struct S {\n    struct T {\n        int f(int x) {\n$(printf '            x++;\\n%.0s' {1..59})        }\n    };\n};" host/scene/code.cpp
must_find files "standard streams" 'fmt::print(stderr, "x");' host/scene/code.cpp
must_find files "standard streams" 'fmt::print("x");' host/bvh/code.cpp
must_find files "standard streams" 'std::cout << 1;' host/cl/code.cpp
must_find faults "applies" 'Row: x\n--- a/kernels/shade.cl\n+++ b/kernels/shade.cl\n@@ -1 +1 @@\n-not there\n+fault' tests/mutations/new.patch
must_find faults "names the row" '--- a/kernels/shade.cl\n+++ b/kernels/shade.cl\n@@ -1 +1 @@\n-// stage\n+fault' tests/mutations/new.patch
echo "$failures offences were not found"
((failures == 0))
