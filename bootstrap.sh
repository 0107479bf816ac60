#!/usr/bin/env bash
# Sets everything up on Debian 12 or 13 and runs the program or its tests; see usage() below.
set -euo pipefail
started_in=$PWD
cd "$(dirname "$0")"

usage() {
  cat <<'TEXT'
Usage: ./bootstrap.sh run [FILE.prm] [OPTIONS of rollwave]   (default: figure 4 of the paper)
       ./bootstrap.sh test [OPTIONS of ctest]
       ./bootstrap.sh test --long                            (only random scenes and forces, 300 each)
       ./bootstrap.sh debug [OPTIONS of ctest]               (the fast tests with deal.II's assertions)
       ./bootstrap.sh sanitize [OPTIONS of ctest]            (the tests under sanitizers)
       ./bootstrap.sh benchmark
       ./bootstrap.sh scaling [PROCESSES]                    (on 1, 2, 4 ... processes; default 4)

Each command installs missing Debian packages and builds in the directory build of this script
(debug: build-debug, sanitize: build-sanitize). run starts the program in the current directory, and
paths are relative to it.
TEXT
}

# mold is the linker that Debian 13's deal.II asks for.
program_packages=(g++ cmake ninja-build mold libdeal.ii-dev libsuitesparse-dev
  libopenblas0-pthread nlohmann-json3-dev gnuplot-nox openmpi-bin libmuparser-dev)
test_packages=(libgtest-dev python3-vtk9)

install_missing() {
  local missing=() package
  for package in "$@"; do
    dpkg-query -W -f '${db:Status-Abbrev}' "$package" 2>/dev/null | grep -q '^ii' ||
      missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return
  echo "Installing: ${missing[*]}" >&2
  local as_root=()
  [ "$(id -u)" -eq 0 ] || as_root=(sudo)
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq \
    --no-install-recommends "${missing[@]}" >/dev/null
}

# build TARGET [DIRECTORY] [OPTIONS of cmake]
build() {
  local target=$1 directory=${2:-build}
  echo "Building (two or three minutes the first time) ..." >&2
  # One unity file for each core: each reads deal.II's headers once, which takes a quarter of the
  # time. BUILD_TESTING does not change the objects of the program, so they are not compiled again.
  local sources=(source/*/*.cc) cores
  cores=$(nproc)
  cmake -S . -B "$directory" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON \
    -DCMAKE_UNITY_BUILD_BATCH_SIZE=$(((${#sources[@]} + cores - 1) / cores)) \
    -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON "${@:3}" >build.log 2>&1 &&
    cmake --build "$directory" --target "$target" >>build.log 2>&1 || {
    cat build.log >&2
    exit 1
  }
  rm -f build.log
}

case "${1:-}" in
run)
  shift
  install_missing "${program_packages[@]}"
  build rollwave build -DBUILD_TESTING=OFF
  root=$PWD
  [ $# -gt 0 ] || set -- "$root/prm/figure-4.prm"
  cd "$started_in"
  "$root/build/rollwave" "$@"
  ;;
test)
  shift
  install_missing "${program_packages[@]}" "${test_packages[@]}"
  build all build -DBUILD_TESTING=ON
  if [ "${1:-}" = --long ]; then
    export ROLLWAVE_RANDOM_SCENES=300
    set -- -R random "${@:2}"
  fi
  exec ctest --test-dir build --output-on-failure -j "$(nproc)" "$@"
  ;;
debug)
  shift
  install_missing "${program_packages[@]}" "${test_packages[@]}"
  build all build-debug -DCMAKE_BUILD_TYPE=Debug
  exec ctest --test-dir build-debug -L fast --output-on-failure -j "$(nproc)" "$@"
  ;;
sanitize)
  shift
  install_missing "${program_packages[@]}" "${test_packages[@]}"
  build all build-sanitize -DROLLWAVE_SANITIZE=ON
  exec ctest --test-dir build-sanitize --output-on-failure -j "$(nproc)" "$@"
  ;;
benchmark)
  install_missing "${program_packages[@]}" "${test_packages[@]}"
  build rollwave_benchmark build -DBUILD_TESTING=ON
  exec build/tests/rollwave_benchmark
  ;;
scaling)
  install_missing "${program_packages[@]}" "${test_packages[@]}"
  build rollwave build
  exec tests/scaling.py build/rollwave prm/figure-4.prm "${2:-4}"
  ;;
*)
  usage >&2
  exit 1
  ;;
esac
