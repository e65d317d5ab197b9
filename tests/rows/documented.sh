#!/bin/bash
# documented.sh PROGRAM: the page on accuracy names every row of the catalogue.
set -euo pipefail
page=$(dirname -- "${BASH_SOURCE[0]}")/../../docs/accuracy.md
failures=0
rows=$("$1" stress --brief --list | cut -d ' ' -f 1 | sort -u)
for row in $rows; do
    grep -qw -- "$row" "$page" || { echo "docs/accuracy.md does not name the row $row"; failures=$((failures + 1)); }
done
echo "$(wc -l <<<"$rows") rows, $failures not named"
((failures == 0 && $(wc -l <<<"$rows") > 40))
