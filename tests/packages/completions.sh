#!/bin/bash
# completions.sh PROGRAM: what bash completes, by the script that the program prints; every option that --help lists is
# among it. That zsh can read its script, where there is zsh.
set -uo pipefail
program=$(readlink -f -- "$1")
scratch=$(mktemp -d)
trap 'rm -rf -- "$scratch"' EXIT
cd -- "$scratch" || exit 2
failures=0 asked=0
# shellcheck source=/dev/null
source <("$program" completion bash) || exit 1

wrong() {
    echo "$*"
    failures=$((failures + 1))
}

# completed WORD...: of a command line that ends with the last word, sorted, in one line.
completed() {
    COMP_WORDS=(parhelion "$@") COMP_CWORD=$# COMPREPLY=()
    _parhelion
    printf '%s\n' "${COMPREPLY[@]}" | sort | tr '\n' ' '
}

# expect "COMPLETIONS" WORD...
expect() {
    local wanted=$1 got
    shift
    asked=$((asked + 1))
    got=$(completed "$@")
    [[ ${got% } == "$wanted" ]] || wrong "parhelion $*: completed to '$got', not '$wanted'"
}

touch "two words.xml" scene.xml
mkdir folder
expect "render" ren
expect "compare compile completion" com
expect "" render --no-such
expect "--spp" render scene.xml --sp
expect "faure independent" render --sampler ""
expect "faure independent" render --sampler =
expect "faure" render --sampler = fa
expect "independent" render scene.xml --spp 4 --sampler ind
expect "auto json lines terminal" render --progress ""
expect "albedo" render --aov alb
expect "albedo,depth" render --aov albedo,de
expect "" render --spp ""
expect "folder scene.xml two words.xml" render ""
expect "two words.xml" render tw
expect "scene.xml" render --output sc
expect "folder" stress --report ""
expect "bash zsh" completion ""
expect "" doctor ""
expect "--help --json" doctor --

# Every option of every subcommand's help, and no other.
mapfile -t subcommands < <("$program" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
((${#subcommands[@]} > 5)) || wrong "no list of subcommands in --help: ${subcommands[*]}"
for name in "${subcommands[@]}"; do
    options=$("$program" "$name" --help | sed -nE '/^(Examples?|Kernels)/q; s/^  (-[^ ]+).*/\1/p' | tr ',' '\n' |
        grep -E '^--' | sort | tr '\n' ' ')
    expect "${options% }" "$name" --
done

if command -v zsh >/dev/null; then
    { "$program" completion zsh >_parhelion && zsh -n _parhelion; } || wrong "zsh cannot read its script"
else
    echo "zsh is not installed: its script is not read"
fi
echo "$asked asked, $failures went wrong"
((failures == 0))
