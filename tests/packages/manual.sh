#!/bin/bash
# manual.sh PROGRAM [LEAST]: the manual page formats without warnings, and has every subcommand, option and exit code of
# --help, of which there are LEAST (60) or more.
# Ends with 77, which ctest takes for skipped, where neither man nor groff is installed.
set -uo pipefail
program=$1 least=${2:-60}
scratch=$(mktemp -d)
trap 'rm -rf -- "$scratch"' EXIT
"$program" man >"$scratch/parhelion.1" || exit 1
export MANWIDTH=100 LC_ALL=C.UTF-8 MAN_KEEP_FORMATTING=0
if command -v man >/dev/null; then
    man --warnings -E UTF-8 -l -Tutf8 "$scratch/parhelion.1" >"$scratch/page" 2>"$scratch/warnings"
elif command -v groff >/dev/null; then
    groff -man -ww -Tutf8 "$scratch/parhelion.1" >"$scratch/page" 2>"$scratch/warnings"
else
    echo "skipped: neither man nor groff is installed"
    exit 77
fi
failures=0
[[ ! -s $scratch/warnings ]] || { cat "$scratch/warnings"; failures=1; }
# Without the ways of terminals to show bold and hyphens.
sed -E 's/\x1b\[[0-9;]*m//g; s/.\x08//g; s/[‐−]/-/g' "$scratch/page" >"$scratch/text"
words=0
mapfile -t subcommands < <("$program" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
for name in "${subcommands[@]}"; do
    section=$(sed -n "/^   $name\$/,/^   [a-z]/p" "$scratch/text")
    [[ -n $section ]] || { echo "the manual has no section $name"; failures=1; }
    for option in $("$program" "$name" --help | sed -nE '/^(Examples?|Kernels)/q; s/^  (-[^ ]+).*/\1/p' | tr ',' '\n'); do
        words=$((words + 1))
        [[ $option == -h || $option == --help ]] || grep -qE -- "(^|[ ,])$option([ ,]|\$)" <<<"$section" ||
            { echo "the manual's section $name has no $option"; failures=1; }
    done
done
for code in $("$program" --help | sed -n '/^Exit codes:/,$s/^ *\([0-9]\{1,\}\) .*/\1/p'); do
    words=$((words + 1))
    sed -n '/^EXIT STATUS/,$p' "$scratch/text" | grep -qE "^ *$code( |\$)" ||
        { echo "the manual has no exit code $code"; failures=1; }
done
echo "$words options and codes"
((words > least && failures == 0))
