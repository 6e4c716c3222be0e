#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# From a clean clone to two skies that open in a browser: bash examples/run.sh
# Installs the Debian packages that are missing, builds, and compiles a GFS forecast over Monterey Bay (out/theatre) and over
# eastern North America (out/regional). Run it again at will: what is there already is not made again, but for the skies.
set -euo pipefail
# shellcheck source=tools/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../tools/setup.sh"
cd "$repository"

need_packages build

say "Building (build/release)"
mkdir -p build
cmake --preset release -DCLOUDGEN_TESTS=OFF >build/release.log 2>&1 || { cat build/release.log; stop "cmake failed (see above)"; }
cmake --build --preset release ||
  stop "the build failed (see above). Without npm's registry: cmake --preset release -DCLOUDGEN_VIEWER=OFF, and run this again"
cloudgen=build/release/src/cli/cloudgen

forecast=$(gfs_file)
mkdir -p out
make_sky() {
  local name=$1 box=$2
  shift 2
  say "Compiling out/$name: the clouds of $(basename "$forecast") in $box"
  "$cloudgen" build "$forecast" --bbox "$box" -o "out/$name" --overwrite "$@"
  "$cloudgen" validate "out/$name/scene.x3d"
  "$cloudgen" preview "out/$name" -o "out/$name/preview.png"
}
make_sky theatre "$theatre_box"
# There it is night at the time of the forecast.
make_sky regional "$regional_box" --sun 215,30

say "Done. Open in a browser (a double-click will do):"
for name in theatre regional; do
  echo "  $repository/out/$name/index.html   (a picture: preview.png; any X3D viewer: scene.x3d; glTF: scene.glb, scene.splats.glb)"
done
