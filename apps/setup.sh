#!/usr/bin/env bash
# Installs with apt what building vantage needs and this machine lacks.
# Nothing missing: says nothing, changes nothing, needs no network.
#
#   apps/setup.sh [--test] [--bench] [--docs] [--dev]
#
#   --test    also what tests/ needs beyond that: an independent reader of what vantage writes, and
#             the compiler of the sanitizers
#   --bench   also what tests/bench needs
#   --docs    also what docs/build.sh needs
#   --dev     also the formatter and the linters
set -euo pipefail

packages=(
  g++ cmake ninja-build ccache mold
  libembree-dev libtbb-dev libeigen3-dev
  libopencv-dev libopencv-contrib-dev
  libopenvdb-dev libboost-iostreams-dev libceres-dev coinor-libclp-dev
  libassimp-dev libqhull-dev libnanoflann-dev libpng-dev libopenexr-dev libpugixml-dev libssl-dev
  libcli11-dev nlohmann-json3-dev libyaml-dev libvalijson-dev
  libspdlog-dev libfmt-dev doctest-dev
)
for option in "$@"; do
  case $option in
    --test) packages+=(python3-openvdb python3-numpy python3-pil clang libclang-rt-dev) ;;
    --bench) packages+=(libbenchmark-dev libcgal-dev) ;;
    --docs) packages+=(doxygen graphviz python3-sphinx python3-breathe python3-myst-parser furo) ;;
    --dev) packages+=(clang-format clang-tidy shellcheck) ;;
    *) echo "usage: apps/setup.sh [--test] [--bench] [--docs] [--dev]" >&2; exit 2 ;;
  esac
done

if ! command -v apt-get >/dev/null; then
  cat >&2 <<'END'
apps/setup.sh: there is no apt here, so please install these yourself, with their headers:
  a C++20 compiler (GCC 12 or later), CMake 3.25, Ninja (and, to build faster, ccache and mold),
  Embree 3.13 or 4, oneTBB 2021, Eigen 3.4, OpenCV 4.6 with contrib, OpenVDB 10 and Boost.Iostreams,
  Ceres 2.1, Clp 1.17, assimp 5, Qhull 2020, nanoflann 1.4, libpng, OpenEXR 3, pugixml 1.13, OpenSSL 3, CLI11 2,
  nlohmann-json 3.11, libyaml 0.2, valijson, spdlog, fmt 9, doctest 2.4.
Then build without this script: cmake --preset release && cmake --build --preset release
END
  exit 1
fi

installed=" $(dpkg-query -W -f '${db:Status-Status}:${Package} ' "${packages[@]}" 2>/dev/null || true)"
missing=()
for package in "${packages[@]}"; do
  [[ $installed == *" installed:$package "* ]] || missing+=("$package")
done
(( ${#missing[@]} )) || exit 0

as_root=(env DEBIAN_FRONTEND=noninteractive DEBCONF_NOWARNINGS=yes)
if (( EUID != 0 )); then
  if ! command -v sudo >/dev/null; then
    echo "apps/setup.sh: neither root nor sudo. Please run as root:" >&2
    echo "  apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo "${as_root[@]}")
fi

update() { "${as_root[@]}" apt-get -qq update; }
apt_install() {
  "${as_root[@]}" apt-get -qq -o Dpkg::Use-Pty=0 install --yes --no-install-recommends \
    "${missing[@]}" >"$log" 2>&1
}

log=$(mktemp)
trap 'rm -f "$log"' EXIT
echo "Installing with apt (a few minutes the first time): ${missing[*]}" >&2
compgen -G '/var/lib/apt/lists/*_Packages*' >/dev/null || update
if ! apt_install; then
  echo "apps/setup.sh: once more, with fresh package lists" >&2
  update
  if ! apt_install; then
    cat "$log" >&2
    echo "apps/setup.sh: apt could not install: ${missing[*]}" >&2
    exit 1
  fi
fi
