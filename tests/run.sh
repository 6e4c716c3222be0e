#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# All tests, from a clean clone: bash tests/run.sh
# Installs the Debian packages that are missing, builds with warnings as errors (build/dev), runs ctest (unit tests, the rules of
# the house, the command line, the fuzzers' seeds), compiles skies and opens them in the viewers that people use.
# The last line counts: "N passed, N failed". The exit code is 0 only if nothing failed.
set -uo pipefail
# shellcheck source=tools/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../tools/setup.sh"
cd "$repository" || exit 1
started=$SECONDS passed=0 failed=0 failures=()

pass() { passed=$((passed + $1)); }
fail() { failed=$((failed + $1)); failures+=("$2"); }
finish() {
  say "Summary, after $((SECONDS - started)) s"
  [ ${#failures[@]} -eq 0 ] || printf 'FAILED  %s\n' "${failures[@]}"
  echo "$passed passed, $failed failed"
  [ "$failed" -eq 0 ]
  exit
}
# part NAME COMMAND...: one check of its own.
part() {
  local name=$1
  shift
  if "$@"; then pass 1; else fail 1 "$name"; fi
}

need_packages build test
forecast=$(gfs_file) || exit 1
export CLOUDGEN_GFS=$forecast
[ -d ../shared ] || echo "skipped: the tests on the data of ../shared, which is not there"

say "Building (build/dev, warnings are errors)"
mkdir -p build
cmake --preset dev >build/dev.log 2>&1 || { cat build/dev.log; fail 1 "cmake --preset dev"; finish; }
cmake --build --preset dev || { fail 1 "cmake --build --preset dev"; finish; }
cloudgen=build/dev/src/cli/cloudgen

say "Unit tests, rules of the house, command line, fuzzers' seeds"
ctest --preset dev -j "$(nproc)" --timeout 1500 2>&1 | tee build/ctest.log
counts=$(grep -oE '[0-9]+ tests failed out of [0-9]+' build/ctest.log | tail -1)
if [ -n "$counts" ]; then
  read -r broken _ _ _ _ all <<<"$counts"
  pass $((all - broken))
  [ "$broken" -eq 0 ] || fail "$broken" "ctest: $(sed -n 's/^\t *[0-9]* - \([^ ]*\) .*/\1/p' build/ctest.log | paste -sd' ')"
else
  fail 1 "ctest: no result"
fi

say "What each real input gave (cli_Inputs)"
printf '| file | format, model | levels | times | grid | found | clouds | warnings |\n|---|---|---|---|---|---|---|---|\n'
grep -a '^| ' build/dev/Testing/Temporary/LastTest.log || echo "nothing: ../shared/data is not there"

say "Skies, and what the validator says of them"
scenes=build/scenes
rm -rf "$scenes"
mkdir -p "$scenes"
made=()
make_sky() {
  local name=$1
  shift
  if "$cloudgen" build "$@" -o "$scenes/$name"; then
    pass 1
    made+=("$scenes/$name")
  else
    fail 1 "build of the sky $name"
    return
  fi
  part "validate $name" "$cloudgen" validate "$scenes/$name"/scene.*
  part "preview $name" "$cloudgen" preview "$scenes/$name" -o "$scenes/$name/preview.png"
}
make_sky theatre "$forecast" --bbox "$theatre_box"
make_sky regional "$forecast" --bbox "$regional_box"
# Browsers render in software here: two heaps of clouds in less detail, without the page that the first two have.
for name in cumulus cumulonimbus; do
  special=(--fly '36.76,-122.09,1500;36.82,-122,2500;36.89,-121.92,900' --x3d-profile geo)
  [ "$name" = cumulus ] || special=(--splat-quantize)
  make_sky "$name" "examples/gallery/$name.sky.json" --max-puffs 10000 --formats x3d,vrml,splats,glb "${special[@]}"
done
make_sky levels_altocumulus examples/gallery/altocumulus.sky.json --max-puffs 4000 --formats x3d,splats
# Tilesets of few clouds, that each can be told from the others: for CesiumJS, whose splats are narrow, and for three.js.
for content in spz cards splats; do
  sky=examples/gallery/cumulus.sky.json
  [ "$content" != spz ] || sky=tests/web/humilis.sky.json
  make_sky "tiles_$content" "$sky" --max-puffs 30000 --formats splats,tiles --tiles "$content"
  part "validate tiles_$content/tileset.json" "$cloudgen" validate "$scenes/tiles_$content/tileset.json"
done
# A sky that moves, and one of its times alone, for the page.
moving=../shared/data/era5_cirrus_16x8x4x13.nc
if [ -r "$moving" ]; then
  part "build of a sky that moves" "$cloudgen" build "$moving" --bbox=-32,52,-26,56 --time all --formats pack,page -o "$scenes/moving"
  part "build of one of its times" "$cloudgen" build "$moving" --bbox=-32,52,-26,56 --time 2019-01-01T12:00:00Z --formats pack,page -o "$scenes/moving.still"
  [ ! -e "$scenes/moving/index.html" ] || made+=("$scenes/moving")
  part "build of a film" "$cloudgen" build "$moving" --bbox=-32,52,-26,56 --time all --sun 200,40 --max-puffs 2000 --formats x3d,vrml,glb -o "$scenes/film"
  part "validate the film" "$cloudgen" validate "$scenes"/film/scene*.x3d "$scenes/film/scene.wrl" "$scenes/film/scene.glb"
  [ ! -e "$scenes/film/scene.x3d" ] || made+=("$scenes/film")
fi

say "In browsers and viewers"
lock=tests/web/package-lock.json installed=tests/web/node_modules/.package-lock.json
if [ ! "$installed" -nt "$lock" ]; then
  npm ci --prefix tests/web --no-audit --no-fund --loglevel=error || { fail 1 "npm ci of tests/web: is the registry there?"; finish; }
fi
if [ ${#made[@]} -gt 0 ]; then
  node tests/web/run.mjs --spread --scenes "${made[@]}" 2>&1 | tee build/web.log
  counts=$(grep -E '^[0-9]+ passed, [0-9]+ failed' build/web.log | tail -1)
  if [ -n "$counts" ]; then
    read -r good _ broken _ <<<"$counts"
    pass "$good"
    [ "$broken" -eq 0 ] || fail "$broken" "browser: $(sed -n 's/^FAILED  //p' build/web.log | paste -sd';')"
  else
    fail 1 "browser tests: no result"
  fi
fi
finish
