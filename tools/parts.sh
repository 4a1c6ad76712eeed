# SPDX-License-Identifier: Apache-2.0
# Measures how long each part takes. ./test and .ci/run include this file.

# part NAME COMMAND..: runs the command. If SIXSTEP_PARTS names a file, writes the seconds into this file.
part() {
  local name=$1 start=$SECONDS status=0
  shift
  "$@" || status=$?
  [ -z "${SIXSTEP_PARTS:-}" ] || printf '%6d s  %s\n' $((SECONDS - start)) "$name" >>"$SIXSTEP_PARTS"
  return $status
}
