#!/usr/bin/env bash
# Runs a command, by default all tests, on another release of Debian in a chroot; see usage() below.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: tests/debian.sh RELEASE [DIRECTORY [COMMAND ...]]

Makes a chroot of Debian's RELEASE, such as trixie, in DIRECTORY (default: /var/tmp/rollwave-RELEASE),
or takes the one that is there, copies the files of this repository to its /srv/rollwave, and runs
COMMAND in that directory (default: ./bootstrap.sh test). The exit code is that of COMMAND.

It needs root and the package debootstrap. The package server is the variable MIRROR or, if it is not
set, the one that apt uses here. /proc, /dev, /dev/pts and /dev/shm are mounted in a name space of
their own, which ends with the command: nothing stays mounted, whatever ends this script.
TEXT
}

if [ $# -eq 0 ] || [ "$1" = --help ]; then
  usage >&2
  exit 1
fi
release=$1
root=$(realpath -m "${2:-/var/tmp/rollwave-$release}")
command=("${@:3}")
[ ${#command[@]} -gt 0 ] || command=(./bootstrap.sh test)
copy=$root/srv/rollwave
cd "$(dirname "$0")/.."

if [ ! -e "$copy" ]; then
  mirror=${MIRROR:-$(apt-get indextargets --format '$(SITE)' 'Origin: Debian' 'Label: Debian' | sed -n 1p)}
  debootstrap --variant=minbase --include=ca-certificates "$release" "$root" "$mirror"
  mkdir "$copy"
fi

# Builds of earlier calls stay, so that only changed files are compiled again.
find "$copy" -mindepth 1 -maxdepth 1 ! -name 'build*' -exec rm -r {} +
git ls-files -z --cached --others --exclude-standard | xargs -0 ls -d 2>/dev/null |
  tar --create --files-from=- | tar --extract --no-same-owner --directory "$copy"

exec unshare --mount bash -euc '
  root=$1
  mount -t proc proc "$root/proc"
  mount --bind /dev "$root/dev"
  mount -t devpts -o ptmxmode=666 devpts "$root/dev/pts"
  mount -t tmpfs tmpfs "$root/dev/shm"
  exec chroot "$root" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin TERM="${TERM:-dumb}" \
    bash -c "cd /srv/rollwave && exec \"\$@\"" bash "${@:2}"
' bash "$root" "${command[@]}"
