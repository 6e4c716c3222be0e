#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Every genus from the ground, from beside it and from above, at noon, at a sun 25 degrees high and in the evening (2): a sheet
# of nine pictures each, and contact.jpg with one of each.  bash examples/gallery/make.sh [PROGRAM [NAME...]]
# Needs what the browser tests need (tests/web: npm ci) to write the sheets.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
cloudgen=${1:-$here/../../build/release/src/cli/cloudgen}
shift || true
work=${GALLERY_WORK:-$(mktemp -d)}
[ -n "${GALLERY_WORK:-}" ] || trap 'rm -rf "$work"' EXIT
suns=(noon:190,66 25:235,25 evening:286,2)

# name | puffs | from the ground | from the side | from above
while IFS='|' read -r name puffs ground side above; do
  [ -n "$name" ] || continue
  if [ $# -gt 0 ] && [[ " $* " != *" $name "* ]]; then continue; fi
  pictures=()
  for sun in "${suns[@]}"; do
    scene=$work/$name
    "$cloudgen" build "$here/$name.sky.json" -o "$scene" --formats splats --sun "${sun#*:}" --max-puffs "$puffs" --overwrite --quiet
    for view in ground side above; do
      picture=$work/$name-${sun%:*}-$view.png
      "$cloudgen" preview "$scene" -o "$picture" --size 480x270 --view="${!view}" --quiet
      pictures+=("$view, sun: ${sun%:*}" "$picture")
    done
  done
  rm -rf "$scene"
  node "$here/sheet.mjs" "$here/$name.jpg" 3 "${pictures[@]}"
  echo "$name"
done < "$here/views.txt"

names=(cumulus cumulonimbus stratocumulus stratus nimbostratus altocumulus altostratus cirrus cirrocumulus cirrostratus fog)
pictures=()
for name in "${names[@]}"; do
  view=ground
  case $name in cumulonimbus | fog) view=side ;; esac
  [ -f "$work/$name-25-$view.png" ] && pictures+=("$name" "$work/$name-25-$view.png")
done
if [ ${#pictures[@]} -eq $((2 * ${#names[@]})) ]; then node "$here/sheet.mjs" "$here/contact.jpg" 4 "${pictures[@]}"; fi
