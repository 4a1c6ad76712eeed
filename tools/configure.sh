#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# configure.sh PRESET: configures build/PRESET if it is not configured yet. In a copy of a checkout the copied folder
# would still build the original's sources, so the script makes it anew and prints a message.
# Programs and libraries that were missing at the last configuration are searched again.
set -eu
cd "$(dirname "$0")/.."
build=build/$1 log=build/$1.log
mkdir -p build
home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$build/CMakeCache.txt" 2>/dev/null || true)
if [ -n "$home" ] && ! [ "$home" -ef . ]; then
  echo "$build was made for $home, not for this copy of it: making it anew"
  rm -rf "$build"
fi
# If the list of installed parts has not changed since the last configuration, nothing is searched.
parts=/var/lib/dpkg/status looked=$build/looked-for-parts
newer() { [ ! -e "$parts" ] || [ ! -e "$looked" ] || [ "$parts" -nt "$looked" ]; }
lacks() { grep -q -- '-NOTFOUND$' "$build/CMakeCache.txt" 2>/dev/null; }
if [ ! -f "$build/build.ninja" ] || { lacks && newer; }; then
  echo "configuring ($build)"
  cmake --preset "$1" >"$log" 2>&1 || { cat "$log"; exit 1; }
  touch "$looked"
fi
