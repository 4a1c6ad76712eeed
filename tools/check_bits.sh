#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_bits.sh          builds tests/digest with every installed toolchain, runs it, and compares with expected.txt
# check_bits.sh --all    the same, and a missing toolchain is a failure (ctest --preset long)
# check_bits.sh --gate   only WebAssembly, also at -O1, as another compiler (clang) and another machine. The tests use g++ at -O3,
#                        and under the sanitizers at -O1 and -O0; aarch64 is in the long run
# check_bits.sh --renew  writes expected.txt anew from g++ -O3, after an intended change of bits
#
# In WebAssembly text/ is compiled too, and the program reads the scenarios of tests/digest/scenarios.txt. The digests must be
# equal to those of the command line (tests/digest/cli_digests.py renews this table).
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

# Sources that a run needs. analysis/ is above them, and compiling it takes a fifth of the time.
mapfile -t library < <(find sixstep -name '*.cpp' -not -path 'sixstep/analysis/*' -not -path 'sixstep/study/*' -not -path 'sixstep/design/*'
  find sixstep/study/{live,session} -name '*.cpp'; find sixstep/design -name '*_scaling.cpp')
# The other small sources are compiled together, as in cmake/rooms.cmake.
mapfile -t small < <(find sixstep/{design,study} -name '*.cpp' -not -path '*/live/*' -not -path '*/session/*' -not -name '*_scaling.cpp' |
  LC_ALL=C sort)
rm -f "$out"/batch_*.cpp
for ((n = 0; n < ${#small[@]}; n += 16)); do
  printf '#include "%s"\n' "${small[@]:n:16}" >"$out/batch_$n.cpp"
  library+=("$out/batch_$n.cpp")
done
mapfile -t above < <(find sixstep/analysis -name '*.cpp' | LC_ALL=C sort)
table=(tests/digest/main.cpp tests/digest/cases.cpp tests/digest/sessions.cpp)
sources=("${library[@]}" "${table[@]}")
# Sources that read a scenario, and the rest of text/, which is only compiled.
mapfile -t reader < <(find text/sources.cpp text/keys text/toml text/motor/motor_library.cpp \
  text/recording/{bench_columns,cells,column_formula,columns,decimal_marks,encoding,heading,known_names,preamble,recording,row_reader,table_head,times}.cpp \
  text/scenario/{scenario_file,scenario_family,sheet_source,reference_file,motion_words}.cpp -name '*.cpp' | LC_ALL=C sort)
mapfile -t rest < <(find text -name '*.cpp' | LC_ALL=C sort | grep -vxF "$(printf '%s\n' "${reader[@]}")")
# The flags that influence bits are the product's flags in CMakeLists.txt. The other flags show that no exception is needed.
flags=(-DSIXSTEP_POSITION_PROFILE -std=c++20 -ffp-contract=off -fno-math-errno -fno-trapping-math -fno-exceptions -fno-rtti -I.)

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

# Optimisation of the other two compilers. Compiling takes nearly all of the time, and the level has never changed a bit.
level=-O2
[ "$task" != --gate ] || level=-O1

# ask NAME COMPILE.. -- RUN..: builds, runs and compares. The first word of its answer is same, differs or failed.
ask() {
  local file=$out/$1 compile=()
  shift
  while [ "$1" != -- ]; do compile+=("$1"); shift; done
  shift
  compile+=("${flags[@]}" "${sources[@]}" -o "$file")
  if "${compile[@]}" >"$file.log" 2>&1; then
    answer "$file" "$golden" "$@" "$file"
  else
    { echo failed; head -n 20 "$file.log"; } >"$file.answer"
  fi
}

# answer FILE EXPECTED PROGRAM..: compares the program's output with a table. It takes seconds, even in an
# emulator; a program that runs for minutes will never end.
answer() {
  local file=$1 expected=$2
  shift 2
  if ! timeout 300 "$@" >"$file.txt" 2>"$file.log"; then
    { echo failed; head -n 20 "$file.log"; } >"$file.answer"
  elif python3 tests/digest/compare.py "$expected" "$file.txt" >"$file.log" 2>&1; then
    { echo same; cat "$file.log"; } >"$file.answer"
  else
    { echo differs; cat "$file.log"; } >"$file.answer"
  fi
}

# The third-party headers of text/ belong to no target. Of the host's headers, only these are visible.
text_headers() {
  local name
  mkdir -p "$out/include" "$out/text"
  for name in fmt toml++ nlohmann; do ln -sfn "/usr/include/$name" "$out/include/$name"; done
  python3 tools/embed.py --namespace text::motors --out "$out/text/motors.hpp" data/motors/*.toml
}

# side_by_side FOLDER SOURCE.. -- COMPILE..: an object of each source in the folder, as many at a time as there are cores
side_by_side() {
  local folder=$1 files=()
  shift
  while [ "$1" != -- ]; do files+=("$1"); shift; done
  shift
  rm -rf "$folder" && mkdir -p "$folder"
  printf '%s\0' "${files[@]}" | xargs -0 -P "$(nproc)" -I{} sh -c 'name=$1; shift; "$@" -c "$name" -o "$0/$(echo "$name" | tr / -).o"' "$folder" {} "$@"
}

# ask_wasm TABLE READER: builds the library once, then the table's program and the program that reads texts
ask_wasm() {
  local log=$out/$1.log
  # node 18 needs the switch, later versions accept it. A run has its plant and series on the stack, and wasm-ld's default of
  # 64 KiB is too small. The stack is placed first, so that an overflow leaves the memory and traps. After the data, an overflow
  # would overwrite the data.
  local node=(node --no-warnings --experimental-wasi-unstable-preview1 tests/digest/wasi.mjs)
  local cxx=(clang++-14 --target=wasm32-wasi "${flags[@]}") link=(-Wl,--stack-first -Wl,-z,stack-size=1048576)
  # Reading is fast enough without optimisation. Integers of 128 bits are avoided, because the runtime lacks them at -O0.
  local text=(-O0 -I"$out" -isystem "$out/include" -DFMT_HEADER_ONLY -DFMT_USE_INT128=0 -DJSON_HAS_FILESYSTEM=0
    -DJSON_HAS_EXPERIMENTAL_FILESYSTEM=0 -DSIXSTEP_VERSION='"0"')
  local scenarios
  mapfile -t scenarios < <(grep -v '^#' tests/digest/scenarios.txt | cut -d' ' -f1)
  if { text_headers && side_by_side "$out/wasm" "${library[@]}" -- "${cxx[@]}" $level &&
       "${cxx[@]}" "$out"/wasm/*.o -nostdlib -Wl,--relocatable -o "$out/$1.o" &&
       "${cxx[@]}" $level "${link[@]}" "${table[@]}" "$out/$1.o" -o "$out/$1"; } >"$log" 2>&1; then
    answer "$out/$1" "$golden" "${node[@]}" "$out/$1"
  else
    { echo failed; head -n 20 "$log"; } >"$out/$1.answer"
  fi
  # Only the long check compiles the rest of text/ and analysis/ there, because they hardly ever fail.
  [ "$task" != --gate ] || rest=() above=()
  if { "${cxx[@]}" "${text[@]}" "${link[@]}" "${reader[@]}" tests/digest/read_scenarios.cpp "$out/$1.o" -o "$out/$2" &&
       { [ ${#above[@]} = 0 ] || "${cxx[@]}" -fsyntax-only "${above[@]}"; } &&
       { [ ${#rest[@]} = 0 ] || printf '%s\0' "${rest[@]}" | xargs -0 -n 1 "${cxx[@]}" "${text[@]}" -fsyntax-only; }; } \
       >"$log" 2>&1; then
    answer "$out/$2" tests/digest/scenarios.txt "${node[@]}" "$out/$2" "${scenarios[@]}"
  else
    { echo failed; head -n 20 "$log"; } >"$out/$2.answer"
  fi
}

# platform "WORDS" "NEEDED PROGRAMS AND FILES" COMPILE.. -- RUN..: checks a platform; at most two run at the same time
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
  if [ "$1" = ask_wasm ]; then ask_wasm "$name" "$2" & else ask "$name" "$@" & fi
}

native=$(uname -m)
wasm_runtime=$(clang++-14 --print-resource-dir 2>/dev/null || echo clang-14)/lib/wasi/libclang_rt.builtins-wasm32.a
if [ "$task" != --gate ]; then
  platform "$native g++ -O1" g++ g++ -O1 -- env
  platform "$native g++ -O3" g++ g++ -O3 -- env
  platform "$native clang++-14 -O1" clang++-14 clang++-14 -O1 -- env
  platform "$native clang++-14 -O3" clang++-14 clang++-14 -O3 -- env
fi
rm -f "$out"/scenarios-from-*.answer
wasm="wasm32 clang++-14 $level in node" wasm_text="scenarios from their text in node"
platform "$wasm" \
  "clang++-14 wasm-ld-14 /usr/include/wasm32-wasi /usr/include/wasm32-wasi/c++/v1 $wasm_runtime node \
   /usr/include/fmt /usr/include/toml++ /usr/include/nlohmann" \
  ask_wasm "${wasm_text//[^A-Za-z0-9+]/-}"
[ "$task" = --gate ] || platform "aarch64 g++ $level in qemu" "aarch64-linux-gnu-g++ qemu-aarch64-static" \
  aarch64-linux-gnu-g++ $level -static -- qemu-aarch64-static
wait
# Two answers of one compiler.
if [ -e "$out/${wasm_text//[^A-Za-z0-9+]/-}.answer" ]; then platforms+=("$wasm_text"); fi

same=0 other=0 left_out=0
for words in "${platforms[@]}"; do
  { read -r answer; mapfile -t lines; } <"$out/${words//[^A-Za-z0-9+]/-}.answer"
  [ "$answer" = same ] && answer_words='' || answer_words="$answer: "
  printf '%-32s %s%s\n' "$words" "$answer_words" "${lines[0]:-}"
  [ ${#lines[@]} -lt 2 ] || printf '%s\n' "${lines[@]:1}"
  case $answer in same) same=$((same + 1)) ;; left-out) left_out=$((left_out + 1)) ;; *) other=$((other + 1)) ;; esac
done
# Drawn scenarios run through every interface. The C library and the units come from build/dev.
reader_program=$out/${wasm_text//[^A-Za-z0-9+]/-}
if [ -e "$reader_program" ] && [ -e build/dev/lib/libsixstep.so ]; then
  python3 tests/digest/drawn_faces.py build/dev/sixstep . build/dev/lib/libsixstep.so "$out/drawn" \
    node --no-warnings --experimental-wasi-unstable-preview1 tests/digest/wasi.mjs "$reader_program" || other=$((other + 1))
elif [ -n "$task" ]; then
  echo "drawn scenarios: build/dev is missing (./test builds it)"
  other=$((other + 1))
fi
echo "$same of ${#platforms[@]} platforms give the bits of $golden, $other do not, $left_out left out"
[ "$other" = 0 ] && [ "$same" -gt 0 ] && { [ -z "$task" ] || [ "$left_out" = 0 ]; }
