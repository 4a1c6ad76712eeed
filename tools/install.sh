#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# install.sh SECTION..: installs the missing packages of these sections of tools/packages.txt, then the
# browser parts of package-lock.json. Prints each action; if all is installed it prints nothing and takes milliseconds.
set -eu
cd "$(dirname "$0")/.."

say() { printf 'install: %s\n' "$*"; }

# The lines of one section as "package substitute"; the substitute is a command that makes it unnecessary.
listed() {
  awk -v wanted="[$1]" '
    { sub(/#.*/, ""); gsub(/[ \t]+$/, "") }
    /^\[/ { inside = ($0 == wanted); next }
    inside && NF { substitute = ""; package = $1
      if (match(package, /\(.*\)/)) {
        substitute = substr(package, RSTART + 1, RLENGTH - 2); package = substr(package, 1, RSTART - 1) }
      print package, substitute }' tools/packages.txt
}

# dpkg-query instead of apt, because it is faster and needs no package lists.
missing_packages() {
  local section package substitute wanted=()
  for section in "$@"; do
    while read -r package substitute; do
      if [ -n "$substitute" ] && command -v "$substitute" >/dev/null; then continue; fi
      wanted+=("$package")
    done < <(listed "$section")
  done
  [ ${#wanted[@]} -gt 0 ] || return 0
  local installed
  installed=" $(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null |
    awk '$1 == "installed" { print $2 }' | tr '\n' ' ') "
  for package in "${wanted[@]}"; do
    case "$installed" in *" $package "*) ;; *) echo "$package" ;; esac
  done
}

as_root() {
  if [ "$(id -u)" = 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    say "sudo $*"
    sudo "$@"
  else
    say "these packages are missing and neither root nor sudo is at hand; please run as root:"
    say "  $*"
    exit 1
  fi
}

install_packages() {
  local wanted=("$@")
  if ! command -v apt-get >/dev/null; then
    say "no apt-get here; please install the counterparts of: ${wanted[*]}"
    exit 1
  fi
  say "missing Debian packages: ${wanted[*]}"
  # A machine that has never fetched its package lists, or whose lists are too old, needs an update first.
  local get="env DEBIAN_FRONTEND=noninteractive apt-get -qq -y -o Dpkg::Use-Pty=0"
  local log
  log=$(mktemp)
  if ! as_root $get install --no-install-recommends "${wanted[@]}" </dev/null >"$log" 2>&1; then
    say "fetching Debian's package lists"
    as_root $get update </dev/null >>"$log" 2>&1 || { tail -n 20 "$log"; exit 1; }
    say "installing (minutes on a bare machine)"
    as_root $get install --no-install-recommends "${wanted[@]}" </dev/null >>"$log" 2>&1 ||
      { tail -n 20 "$log"; say "apt-get failed; its last lines are above"; exit 1; }
  fi
  rm -f "$log"
  say "${#wanted[@]} packages installed"
}

# npm ci empties node_modules, so it runs only when the lock has changed since it last finished.
install_browser_parts() {
  local done_for=node_modules/.installed-lock
  cmp -s package-lock.json "$done_for" && return 0
  say "npm ci: the report's chart library"
  # Extra certificates for node are used for npm too, because npm reads only its own setting. Installing Debian's npm renews the
  # bundle, into which a company may have put its own certificate.
  if [ -n "${NODE_EXTRA_CA_CERTS:-}" ]; then export npm_config_cafile=$NODE_EXTRA_CA_CERTS; fi
  npm ci --no-audit --no-fund --ignore-scripts --loglevel=error </dev/null
  cp package-lock.json "$done_for"
}

mapfile -t wanted < <(missing_packages "${@:-run}")
[ ${#wanted[@]} -eq 0 ] || install_packages "${wanted[@]}"
install_browser_parts
