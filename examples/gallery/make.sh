#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds every sky of this folder and takes its pictures: bash examples/gallery/make.sh [PROGRAM [NAME...]]
# Each genus is seen as an observer on the ground (or beside it) and a pilot above would see it.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
cloudgen=${1:-$here/../../build/release/src/cli/cloudgen}
shift || true
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# name | sun | puffs | view from below or beside | view from above
while IFS='|' read -r name sun puffs below above; do
  [ -n "$name" ] || continue
  if [ $# -gt 0 ] && [[ " $* " != *" $name "* ]]; then continue; fi
  echo "$name"
  "$cloudgen" build "$here/$name.sky.json" -o "$work/$name" --formats splats --sun "$sun" --max-puffs "$puffs" --quiet
  "$cloudgen" preview "$work/$name" -o "$here/$name-below.png" --size 720x405 --view="$below" --quiet
  "$cloudgen" preview "$work/$name" -o "$here/$name-above.png" --size 720x405 --view="$above" --quiet
done <<'VIEWS'
cumulus|235,38|500000|-122.0,36.735,20:-122.0,36.83,1900|-122.0,36.70,3400:-122.0,36.84,1200
stratocumulus|235,38|500000|-122.0,36.75,20:-122.0,36.90,2400|-122.0,36.64,3400:-122.0,36.85,1000
stratus|235,38|300000|-122.0,36.80,20:-122.0,36.90,1300|-122.0,36.66,1500:-122.0,36.85,400
nimbostratus|235,38|300000|-122.0,36.70,20:-122.0,36.95,3500|-122.0,36.42,7500:-122.0,36.80,3200
altostratus|235,30|300000|-122.0,36.80,20:-122.1,36.744,6000|-122.0,36.45,8500:-122.0,36.80,4000
altocumulus|235,38|500000|-122.0,36.78,20:-122.0,36.88,4600|-122.0,36.62,6500:-122.0,36.86,4000
cirrocumulus|235,38|500000|-122.0,36.80,20:-122.0,36.89,7500|-122.0,36.58,11000:-122.0,36.85,8000
cirrostratus|235,30|300000|-122.0,36.80,20:-122.1,36.744,6500|-122.0,36.45,13000:-122.0,36.80,8500
cirrus|235,38|400000|-122.0,36.72,20:-122.0,36.84,7500|-122.0,36.45,13000:-122.0,36.82,8000
cumulonimbus|235,38|700000|-122.0,36.48,300:-121.98,36.82,6000|-122.1,36.44,14500:-122.0,36.82,6500
fog|235,30|300000|-122.0,36.67,90:-122.0,36.82,160|-122.0,36.68,900:-122.0,36.82,50
all|235,24|500000|-122.0,36.74,20:-122.0,36.83,3600|-122.0,36.70,3400:-122.0,36.84,2200
VIEWS

if command -v montage > /dev/null; then
  names=(cumulus stratocumulus stratus nimbostratus altostratus altocumulus cirrocumulus cirrostratus cirrus cumulonimbus fog all)
  pictures=()
  for name in "${names[@]}"; do pictures+=(-label "$name" "$here/$name-below.png" -label "" "$here/$name-above.png"); done
  montage "${pictures[@]}" -tile 4x6 -geometry 360x203+3+3 -depth 8 -font DejaVu-Sans "$here/contact.png" 2> /dev/null || montage "${pictures[@]}" -tile 4x6 -geometry 360x203+3+3 -depth 8 "$here/contact.png"
fi
