# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# What examples/run.sh and tests/run.sh share; sourced, not run.
# Sets `repository`; offers say, stop, need_packages and gfs_file, which stop with one clear line.

repository=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

say() { printf '\n== %s\n' "$*"; }
stop() { printf '%s: %s\n' "$(basename "$0")" "$*" >&2; exit 1; }

# packages_of GROUP...: their names in packages.txt.
packages_of() {
  local group
  for group in "$@"; do awk -v group="$group" '$1 !~ /^#/ && $2 == group {print $1}' "$repository/packages.txt"; done
}

# missing_packages NAME...: those that dpkg does not call installed.
missing_packages() {
  local installed
  installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "$@" 2>/dev/null | awk '$1 == "installed" {print $2}')
  comm -23 <(printf '%s\n' "$@" | sort -u) <(sort -u <<<"$installed")
}

# need_packages GROUP...: installs what is missing, by apt-get; asks nothing of the network when all is there.
need_packages() {
  local groups=("$@") wanted missing as_root=()
  command -v node >/dev/null && command -v npm >/dev/null || groups+=(web)
  mapfile -t wanted < <(packages_of "${groups[@]}")
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    say "This is no Debian: going on with what is here. Needed are the equivalents of: ${wanted[*]}"
    return 0
  fi
  mapfile -t missing < <(missing_packages "${wanted[@]}")
  [ ${#missing[@]} -gt 0 ] || { say "All Debian packages are there"; return 0; }
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || stop "needs root or sudo to run: apt-get install ${missing[*]}"
    as_root=(sudo)
  fi
  say "Installing ${#missing[@]} Debian packages: ${missing[*]}"
  local log="$repository/build/apt.log"
  mkdir -p "$repository/build"
  "${as_root[@]}" apt-get update -qq || stop "apt-get update failed: is the network there?"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >"$log" 2>&1 ||
    { tail -20 "$log"; stop "apt-get install failed (all of it is in $log)"; }
}

# gfs_file: prints the path of the GFS forecast of Debian's python-grib-doc. Systems that leave out /usr/share/doc get it from the
# package itself.
gfs_file() {
  local inside=usr/share/doc/python-grib-doc/examples/gfs.t12z.pgrbf120.2p5deg.grib2 unpacked="$repository/build/data"
  if [ -r "/$inside" ]; then
    echo "/$inside"
    return 0
  fi
  if [ ! -r "$unpacked/$inside" ]; then
    mkdir -p "$unpacked"
    (cd "$unpacked" && apt-get download -qq python-grib-doc >&2 && dpkg-deb -x python-grib-doc_*.deb . && rm -f python-grib-doc_*.deb) ||
      stop "cannot fetch the forecast of Debian's package python-grib-doc"
  fi
  echo "$unpacked/$inside"
}

# The two skies of the first GFS forecast that everything here uses: one bay, and half of North America.
theatre_box=-122.6,36.2,-121.2,37.2
regional_box=-100,25,-60,50
