#!/bin/bash
# installed_links.sh BUILD CONFIG: installs into a scratch folder; every link of the installed texts leads to a file there.
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -rf -- "$scratch"' EXIT
cmake --install "$1" --config "$2" --prefix "$scratch" >/dev/null
links=0 dead=0
while IFS=: read -r file link; do
    link=${link#*(}
    link=${link%)}
    [[ $link != *://* && $link != \#* ]] || continue
    links=$((links + 1))
    [[ -e ${file%/*}/${link%%#*} ]] || { echo "${file#"$scratch"/}: $link is not installed"; dead=$((dead + 1)); }
done < <(find "$scratch" -name '*.md' -exec grep -HoE '\]\([^) ]+\)' {} +)
echo "$links links, $dead dead"
((links > 0 && dead == 0))
