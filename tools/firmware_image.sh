#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# firmware_image.sh BOARD [HEADER [OUT]] [--despite]   an image to flash: the board's program (faces/firmware/example/) with the drive of HEADER,
#                                          which `sixstep export header` writes. Default: the example's header. BOARD: stm32f303, atmega2560.
#                                          Writes OUT/image.elf, .hex and .bin. Default of OUT: build/firmware/BOARD; if installed, firmware/BOARD in
#                                          this folder. --despite also builds a header that its run did not clear for a bridge.
#
# tools/install.sh target installs the compilers.
set -eu
cd "$(dirname "$0")/.."
root=$PWD
usage() { sed -n 's/^# \{0,1\}//; 3,6p' "$0" >&2; exit 2; }
despite=() words=()
for word; do
  if [ "$word" = --despite ]; then despite=(-DSIXSTEP_DESPITE); else words+=("$word"); fi
done
[ ${#words[@]} -ge 1 ] && [ ${#words[@]} -le 3 ] || usage
board=${words[0]}
case $board in
  stm32f303) example=faces/firmware/example/cortex_m binutils=arm-none-eabi compilers=(arm-none-eabi-g++) ;;
  atmega2560) example=faces/firmware/example/avr binutils=avr compilers=(clang++-19 avr-gcc) ;;
  *) usage ;;
esac
for compiler in "${compilers[@]}"; do
  command -v "$compiler" >/dev/null || { echo "$compiler is missing; tools/packages.txt lists its package under [target]" >&2; exit 1; }
done
cd "$OLDPWD"
header=$(realpath "${words[1]:-$root/$example/drive_config.hpp}")
# An installed copy has no build folder.
if [ -e "$root/CMakeLists.txt" ]; then images=$root/build/firmware; else images=$PWD/firmware; fi
out=$(realpath -m "${words[2]:-$images/$board}")
cd "$root"
# Short messages for faults that the compiler would report at length.
refuse() { echo "$header: $1" >&2; exit 1; }
[ -r "$header" ] || refuse "cannot be read"
grep -q 'constexpr bool cleared = ' "$header" || refuse "does not say whether its drive is cleared for a bridge; export it anew with this sixstep"
if [ "$board" = stm32f303 ]; then
  grep -q '^using Scalar = float;' "$header" || refuse "is not in float, which this board's program computes in; export it with --arithmetic float"
  grep -q 'ProtectedConfig<Scalar> product = ' "$header" ||
    refuse "has no product drive, which this board's program runs; set control.drive = \"product\" in the scenario"
fi
if grep -q 'constexpr std::uint64_t dead_time_ps = 0;' "$header"; then
  refuse "has no dead time: both switches of a leg would be on at each reversal; give the scenario bridge.dead_time_s and export it anew"
fi
if grep -q 'constexpr bool cleared = false;' "$header"; then
  sed -n '/^\/\/ NOT CLEARED/,/^\/\/ Its run/p' "$header" >&2
  [ ${#despite[@]} -gt 0 ] || refuse "its drive is not cleared for a bridge; --despite builds the image all the same"
  echo "$header: built because of --despite, although it is not cleared for a bridge" >&2
fi
mkdir -p "$out"
if [ "$header" != "$out/drive_config.hpp" ]; then cp "$header" "$out/drive_config.hpp"; fi
include=("-I$root" "-I$root/faces/firmware/bare" "-I$out" ${despite[@]+"${despite[@]}"})
if [ "$board" = stm32f303 ]; then
  arm-none-eabi-g++ "@$example/compile.flags" "${include[@]}" -Wall -Wextra -Wpedantic -Wshadow -Wdouble-promotion -Werror \
    "$example"/{main.cpp,start.cpp,start.S} faces/firmware/bare/memory.cpp -nostdlib -T "$example/stm32f303.ld" -o "$out/image.elf" -lgcc
else
  clang++-19 "@$example/compile.flags" "${include[@]}" -Wall -Wextra -Werror -c "$example/main.cpp" -o "$out/main.o"
  avr-gcc -mmcu=atmega2560 "$out/main.o" -o "$out/image.elf"
fi
"$binutils-objcopy" -O ihex "$out/image.elf" "$out/image.hex"
"$binutils-objcopy" -O binary "$out/image.elf" "$out/image.bin"
"$binutils-size" "$out/image.elf"
echo "$out/image.elf, .hex and .bin"
