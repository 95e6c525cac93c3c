# SPDX-License-Identifier: MIT
# shellcheck shell=sh disable=SC2013,SC2015,SC2154  # package names are words; die does not return; $root comes from the caller
# What ./run, ./test and .ci/run share: install packages, configure, build. Read by sh; $root is the repository.
# Prints nothing but one line per phase that has work to do, to stderr; the full output of a phase goes to build/<phase>.log.

say() { printf 'swarmfit: %s\n' "$*" >&2; }

die() {
  say "$*"
  exit 1
}

# phase NAME COMMAND...: runs the command with its output in build/NAME.log, and shows the end of that if it fails.
phase() {
  phase_name=$1
  shift
  mkdir -p "$root/build"
  if ! "$@" >"$root/build/$phase_name.log" 2>&1 </dev/null; then
    tail -n 40 "$root/build/$phase_name.log" >&2
    die "$phase_name failed; its whole output is in $root/build/$phase_name.log"
  fi
}

# As many compilers at once as there are cores, and 1.5 GB of free memory for each.
jobs() {
  awk -v cores="$(nproc)" '
    /^MemAvailable:/ { n = int($2 / 1.5e6) }
    END { if (n > cores) n = cores; print (n < 1 ? 1 : n) }' /proc/meminfo
}

# install_packages WHO...: the packages dependencies.txt lists for run, test or ci, as far as they are missing.
install_packages() {
  command -v dpkg-query >/dev/null && command -v apt-get >/dev/null ||
    die "this is not Debian or Ubuntu; install what dependencies.txt lists, then: cmake --preset release && cmake --build --preset release"
  missing=
  for package in $(awk -v who=" $* " '!/^#/ && index(who, " " $1 " ") { print $2 }' "$root/dependencies.txt"); do
    # shellcheck disable=SC2016  # the format is dpkg-query's own
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing="$missing $package"
  done
  [ -n "$missing" ] || return 0

  as_root=
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || die "root or sudo is needed to install:$missing"
    sudo -v || die "sudo was refused; as root, install:$missing"
    as_root=sudo
  fi
  say "installing$missing"
  phase install apt_install
}

# Package lists are fetched only when those on the machine do not do: none at all, or older than the mirror.
apt_install() {
  # shellcheck disable=SC2086  # words: an optional sudo, and several packages
  apt_get install -y --no-install-recommends $missing || {
    apt_get update && apt_get install -y --no-install-recommends $missing
  }
}

apt_get() {
  # shellcheck disable=SC2086
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300 "$@"
}

# configure PRESET [-DNAME=VALUE...]: once; after that only when a value asked for is not the configured one. Later changes of CMake
# files are the build's own business. Without -DSWARMFIT_TESTS=ON the tests are left out, and what they need is not asked for.
configure() {
  preset=$1
  shift
  cache="$root/build/$preset/CMakeCache.txt"
  if [ -f "$root/build/$preset/build.ninja" ]; then
    [ $# -gt 0 ] || return 0
    grep -q '^SWARMFIT_TESTS:BOOL=ON' "$cache" && return 0
  else
    [ $# -gt 0 ] || set -- -DSWARMFIT_TESTS=OFF
  fi
  command -v ccache >/dev/null && set -- "$@" "-DCMAKE_CXX_COMPILER_LAUNCHER=env;CCACHE_SLOPPINESS=pch_defines,time_macros;ccache"
  say "configuring build/$preset"
  cd_root phase configure cmake --preset "$preset" "$@"
}

# build PRESET TARGET: on a terminal with ninja's own progress. Says so only if a file is newer than the last build.
build() {
  dir="$root/build/$1"
  stamp="$dir/built_$2"
  if [ -f "$stamp" ] && [ -z "$(find "$root" \( -path "$root/build" -o -path "$root/runs" -o -path "$root/.git" \) -prune -o -type f -newer "$stamp" -print -quit)" ]; then
    phase build ninja -C "$dir" -j "$(jobs)" "$2"
    return
  fi
  say "building build/$1 ($(jobs) at once)"
  touch "$stamp.begun"
  if [ -t 2 ]; then
    ninja -C "$dir" -j "$(jobs)" "$2" >&2 </dev/null || die "build failed"
  else
    phase build ninja -C "$dir" -j "$(jobs)" "$2"
  fi
  mv "$stamp.begun" "$stamp"
}

# In a subshell at the repository's root, where presets are found; the caller stays where the user called from.
cd_root() { (cd "$root" && "$@"); }
