#!/usr/bin/env bash
# The newcomer's test: in a fresh, minimal Debian with nothing but git, clones the checkout's HEAD
# (what is not committed is not tested) and runs apps/demo.sh and tests/run.sh there.
# The demo's pictures come back to out/in-debian-SUITE/.
#
#   tests/in-debian.sh bookworm|trixie [--data DIR] [--keep-cache DIR]
#
#   --data DIR         shows the recordings in DIR to the tests, read-only; without it they skip
#   --keep-cache DIR   keeps the downloaded packages in DIR for the next run
#
# Needs root and debootstrap. $VANTAGE_DEBIAN_MIRROR names a mirror other than debootstrap's own.
# All mounts are made in a mount namespace of their own, so that they end with it, come what may.
set -euo pipefail
checkout=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

usage() {
  sed -n '/^#   tests/,/^# All/p' "${BASH_SOURCE[0]}" | sed '$d; s/^# \{0,1\}//' >&2
  exit 2
}

fail() {
  echo "tests/in-debian.sh: $*" >&2
  exit 1
}

# Every process inside, then the tree. Waits for the last ones, which may still be writing.
clean_up() {
  trap '' INT TERM
  if [[ -n ${inside:-} ]]; then
    kill -KILL "$inside" 2>/dev/null || true
    wait "$inside" 2>/dev/null || true
  fi
  for _ in 1 2 3 4 5; do
    rm -rf --one-file-system "$work" 2>/dev/null && return
    sleep 1
  done
  echo "tests/in-debian.sh: could not remove $work" >&2
}

# Runs in the namespace: makes the root, then lets the newcomer in.
make_root_and_enter() {
  local cache=()
  if [[ -n $keep_cache ]]; then
    mkdir -p "$keep_cache/$suite"
    cache=(--cache-dir "$keep_cache/$suite")
  fi
  debootstrap --variant=minbase --include=git,ca-certificates "${cache[@]}" \
    "$suite" "$root" ${VANTAGE_DEBIAN_MIRROR:+"$VANTAGE_DEBIAN_MIRROR"} >"$work/debootstrap.log" ||
    { tail -n 20 "$work/debootstrap.log" >&2; fail "debootstrap did not succeed"; }

  # The network as this machine has it.
  cp -L /etc/resolv.conf /etc/hosts "$root/etc/"
  apt-config dump | grep -E '^Acquire::(http|https)::Proxy' >"$root/etc/apt/apt.conf.d/90proxy" || true

  git clone --quiet --bare --no-hardlinks "$checkout" "$root/srv/vantage.git"
  mkdir "$root/data"
  [[ -z $data ]] || mount --bind -o ro "$data" "$root/data"
  [[ -z $keep_cache ]] || mount --bind "$keep_cache/$suite" "$root/var/cache/apt/archives"
  mount -t proc proc "$root/proc"
  mount -t sysfs -o ro sysfs "$root/sys"
  mount --rbind /dev "$root/dev"

  # shellcheck disable=SC2016  # expanded inside
  exec chroot "$root" /usr/bin/env -i HOME=/root LANG=C.UTF-8 TERM="${TERM:-dumb}" \
    PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
    ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} \
    ${data:+VANTAGE_DATA=/data} \
    bash -euo pipefail -c "$(declare -f step newcomer); newcomer"
}

step() {
  SECONDS=0
  echo "== $*"
  "$@"
  echo "== $*: ${SECONDS} s"
}

newcomer() {
  cd /root
  step git clone --quiet /srv/vantage.git vantage
  step vantage/apps/demo.sh
  for picture in overview.png view.png; do
    [[ $(head -c 4 "vantage/out/demo/$picture" | tr -d '\211') == PNG ]] ||
      { echo "the demo left no picture out/demo/$picture" >&2; exit 1; }
  done
  step vantage/tests/run.sh
  step unshare --net vantage/apps/setup.sh --test  # the second time it needs no network …
  step vantage/tests/run.sh                        # … and only seconds
}

suite=${1:-}
[[ $suite == bookworm || $suite == trixie ]] || usage
shift
data='' keep_cache=''
while (( $# )); do
  (( $# >= 2 )) || usage
  case $1 in
    --data) data=$(realpath -e "$2") ;;
    --keep-cache) mkdir -p "$2" && keep_cache=$(realpath "$2") ;;
    *) usage ;;
  esac
  shift 2
done
(( EUID == 0 )) || fail "making a Debian root needs root: sudo tests/in-debian.sh $suite"
command -v debootstrap >/dev/null || fail "please install debootstrap"

work=$(mktemp -d "${TMPDIR:-/tmp}/vantage-in-debian.XXXXXX")
root=$work/root
trap clean_up EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP

export checkout suite root work data keep_cache
export -f fail step newcomer make_root_and_enter
SECONDS=0
unshare --mount --propagation private --pid --fork --kill-child \
  bash -euo pipefail -c make_root_and_enter </dev/null &
inside=$!
wait "$inside" || fail "$suite did not pass"
inside=''

pictures=$checkout/out/in-debian-$suite
mkdir -p "$pictures"
cp "$root"/root/vantage/out/demo/*.png "$pictures/"
echo "$suite passed in $SECONDS s; the demo's pictures: $pictures"
