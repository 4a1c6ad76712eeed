#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_bits.sh          builds tests/digest with every toolchain at hand, runs it, and compares with expected.txt
# check_bits.sh --renew  writes expected.txt anew from g++ -O3: after a change that is meant to change bits
#
# A toolchain that this machine lacks is named and left out; tools/install.sh faces installs them all.
set -eu
cd "$(dirname "$0")/.."
case "${1:-}" in
  '') renew=no ;;
  --renew) renew=yes ;;
  *) echo "usage: tools/check_bits.sh [--renew]   (unknown: $*)" >&2; exit 2 ;;
esac
golden=tests/digest/expected.txt
out=build/bits
mkdir -p "$out"

mapfile -t sources < <(find sixstep tests/digest -name '*.cpp' | LC_ALL=C sort)
# What decides about bits is what CMakeLists.txt gives the product. The rest shows that no exception is needed.
flags=(-std=c++20 -ffp-contract=off -fno-math-errno -fno-trapping-math -fno-exceptions -fno-rtti -I.)

# platform NAME "COMPILE COMMAND" "PROGRAMS IT NEEDS" [RUN WITH ..]: one line of the answer
ran=0 left_out=0 failed=0
platform() {
  local name=$1 compiler=$2 needs=$3 program
  shift 3
  for program in $needs; do
    if ! command -v "$program" >/dev/null && [ ! -e "$program" ]; then
      printf '%-34s left out: %s is missing\n' "$name" "$program"
      left_out=$((left_out + 1))
      return 0
    fi
  done
  local file=$out/${name//[^A-Za-z0-9]/-}
  if ! { $compiler "${flags[@]}" "${sources[@]}" -o "$file" && "$@" "$file" >"$file.txt"; } 2>"$file.log"; then
    printf '%-34s FAILED to build or run\n' "$name"
    head -n 20 "$file.log"
    failed=$((failed + 1))
  elif python3 tests/digest/compare.py "$golden" "$file.txt" >"$file.log"; then
    printf '%-34s %s\n' "$name" "$(cat "$file.log")"
    ran=$((ran + 1))
  else
    printf '%-34s DIFFERS\n' "$name"
    cat "$file.log"
    failed=$((failed + 1))
  fi
}

if [ "$renew" = yes ]; then
  g++ -O3 "${flags[@]}" "${sources[@]}" -o "$out/renew"
  "$out/renew" >"$out/renew.txt"
  python3 tests/digest/compare.py "$golden" "$out/renew.txt" || true
  cp "$out/renew.txt" "$golden"
  echo "$golden is new: commit it with the change that moved the bits"
  exit 0
fi

native=$(uname -m)
for level in -O1 -O3; do
  platform "$native g++ $level" "g++ $level" g++ env
  platform "$native clang++-14 $level" "clang++-14 $level" clang++-14 env
done
platform "wasm32 clang++-14 -O2, node" "clang++-14 --target=wasm32-wasi -O2" \
  "clang++-14 wasm-ld-14 /usr/include/wasm32-wasi /usr/lib/llvm-14/lib/clang/14.0.6/lib/wasi/libclang_rt.builtins-wasm32.a node" \
  node --no-warnings tests/digest/wasi.mjs
platform "aarch64 g++ -O2, qemu" "aarch64-linux-gnu-g++ -O2 -static" \
  "aarch64-linux-gnu-g++ qemu-aarch64-static" qemu-aarch64-static
echo "$ran platforms give the same bits, $failed do not, $left_out left out"
[ "$failed" = 0 ] && [ "$ran" -gt 0 ]
