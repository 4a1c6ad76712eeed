#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# firmware_image.sh BOARD [HEADER [OUT]]   an image to flash: the board's program (faces/firmware/example/) around the drive of HEADER, which
#                                          `sixstep export header` writes; without it the example's own. BOARD: stm32f303, atmega2560.
#                                          OUT/image.elf, .hex and .bin; without it build/firmware/BOARD
#
# tools/install.sh target installs the compilers.
set -eu
cd "$(dirname "$0")/.."
root=$PWD
usage() { sed -n 's/^# \{0,1\}//; 3,5p' "$0" >&2; exit 2; }
[ $# -ge 1 ] && [ $# -le 3 ] || usage
case $1 in
  stm32f303) example=faces/firmware/example/cortex_m binutils=arm-none-eabi compilers=(arm-none-eabi-g++) ;;
  atmega2560) example=faces/firmware/example/avr binutils=avr compilers=(clang++-19 avr-gcc) ;;
  *) usage ;;
esac
for compiler in "${compilers[@]}"; do
  command -v "$compiler" >/dev/null || { echo "$compiler is missing; tools/install.sh target installs it" >&2; exit 1; }
done
cd "$OLDPWD"
header=$(realpath "${2:-$root/$example/drive_config.hpp}")
out=$(realpath -m "${3:-$root/build/firmware/$1}")
cd "$root"
mkdir -p "$out"
if [ "$header" != "$out/drive_config.hpp" ]; then cp "$header" "$out/drive_config.hpp"; fi
include=("-I$root" "-I$root/faces/firmware/bare" "-I$out")
if [ "$1" = stm32f303 ]; then
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
