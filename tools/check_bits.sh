#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_bits.sh          builds tests/digest with every toolchain at hand, runs it, and compares with expected.txt
# check_bits.sh --all    the same, and a missing toolchain is a failure (ctest --preset long)
# check_bits.sh --gate   those that no other part of .ci/run asks, likewise: the tests ask g++ at -O3, and at -O1 under
#                        the sanitizers; a compiler whose -O3 agrees has not yet differed at -O1
# check_bits.sh --renew  writes expected.txt anew from g++ -O3: after a change that is meant to change bits
#
# tools/install.sh faces installs all toolchains.
set -eu
cd "$(dirname "$0")/.."
case "$*" in
  '' | --all | --gate | --renew) task=${1:-} ;;
  *) echo "usage: tools/check_bits.sh [--all | --gate | --renew]   (unknown: $*)" >&2; exit 2 ;;
esac
golden=tests/digest/expected.txt
out=build/bits
mkdir -p "$out"

mapfile -t sources < <(find sixstep tests/digest -name '*.cpp' | LC_ALL=C sort)
# What decides about bits is what CMakeLists.txt gives the product. The rest shows that no exception is needed.
flags=(-std=c++20 -ffp-contract=off -fno-math-errno -fno-trapping-math -fno-exceptions -fno-rtti -I.)

if [ "$task" = --renew ]; then
  g++ -O3 "${flags[@]}" "${sources[@]}" -o "$out/renew"
  "$out/renew" >"$out/renew.txt"
  python3 tests/digest/compare.py "$golden" "$out/renew.txt" | grep -v 'tools/check_bits' || true
  {
    echo "# SPDX-License-Identifier: Apache-2.0"
    echo "# case, digest of its trajectory, of its figures, segments; written by tools/check_bits.sh --renew"
    cat "$out/renew.txt"
  } >"$out/renewed.txt"
  mv "$out/renewed.txt" "$golden"
  echo "$golden is new: commit it with the change that moved the bits"
  exit 0
fi

# ask NAME COMPILE.. -- RUN..: builds, runs, compares; its answer's first word: same, differs, failed
ask() {
  local file=$out/$1 compile=()
  shift
  while [ "$1" != -- ]; do compile+=("$1"); shift; done
  shift
  compile+=("${flags[@]}" "${sources[@]}" -o "$file")
  # Seconds, even in an emulator; what runs for minutes will never end.
  if ! { "${compile[@]}" && timeout 300 "$@" "$file" >"$file.txt"; } >"$file.log" 2>&1; then
    { echo failed; head -n 20 "$file.log"; } >"$file.answer"
  elif python3 tests/digest/compare.py "$golden" "$file.txt" >"$file.log" 2>&1; then
    { echo same; cat "$file.log"; } >"$file.answer"
  else
    { echo differs; cat "$file.log"; } >"$file.answer"
  fi
}

# platform "WORDS" "NEEDED PROGRAMS AND FILES" COMPILE.. -- RUN..: asks it beside at most one other
platforms=()
platform() {
  local words=$1 needed program
  local name=${words//[^A-Za-z0-9+]/-}
  needed=$2
  shift 2
  platforms+=("$words")
  for program in $needed; do
    if ! command -v "$program" >/dev/null && [ ! -e "$program" ]; then
      printf 'left-out\n%s is missing (tools/install.sh faces)\n' "$program" >"$out/$name.answer"
      return 0
    fi
  done
  while [ "$(jobs -rp | wc -l)" -ge 2 ]; do wait -n || true; done
  ask "$name" "$@" &
}

native=$(uname -m)
wasm_runtime=$(clang++-14 --print-resource-dir 2>/dev/null || echo clang-14)/lib/wasi/libclang_rt.builtins-wasm32.a
if [ "$task" != --gate ]; then
  platform "$native g++ -O1" g++ g++ -O1 -- env
  platform "$native g++ -O3" g++ g++ -O3 -- env
  platform "$native clang++-14 -O1" clang++-14 clang++-14 -O1 -- env
fi
platform "$native clang++-14 -O3" clang++-14 clang++-14 -O3 -- env
# node 18 asks for the switch, later ones know it. A run keeps its plant and series on the stack, of which wasm-ld
# gives 64 KiB: too little, and an overflow there is silent.
platform "wasm32 clang++-14 -O2 in node" \
  "clang++-14 wasm-ld-14 /usr/include/wasm32-wasi /usr/include/wasm32-wasi/c++/v1 $wasm_runtime node" \
  clang++-14 --target=wasm32-wasi -O2 -Wl,-z,stack-size=1048576 -- \
  node --no-warnings --experimental-wasi-unstable-preview1 tests/digest/wasi.mjs
platform "aarch64 g++ -O2 in qemu" "aarch64-linux-gnu-g++ qemu-aarch64-static" \
  aarch64-linux-gnu-g++ -O2 -static -- qemu-aarch64-static
wait

same=0 other=0 left_out=0
for words in "${platforms[@]}"; do
  { read -r answer; mapfile -t lines; } <"$out/${words//[^A-Za-z0-9+]/-}.answer"
  [ "$answer" = same ] && answer_words='' || answer_words="$answer: "
  printf '%-32s %s%s\n' "$words" "$answer_words" "${lines[0]:-}"
  [ ${#lines[@]} -lt 2 ] || printf '%s\n' "${lines[@]:1}"
  case $answer in same) same=$((same + 1)) ;; left-out) left_out=$((left_out + 1)) ;; *) other=$((other + 1)) ;; esac
done
echo "$same of ${#platforms[@]} platforms give the bits of $golden, $other do not, $left_out left out"
[ "$other" = 0 ] && [ "$same" -gt 0 ] && { [ -z "$task" ] || [ "$left_out" = 0 ]; }
