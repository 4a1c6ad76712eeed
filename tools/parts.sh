# SPDX-License-Identifier: Apache-2.0
# For ./test and .ci/run, which read it in: how long each part took.

# part NAME COMMAND..: runs it; its seconds go to the file that SIXSTEP_PARTS names, where it names one
part() {
  local name=$1 start=$SECONDS status=0
  shift
  "$@" || status=$?
  [ -z "${SIXSTEP_PARTS:-}" ] || printf '%6d s  %s\n' $((SECONDS - start)) "$name" >>"$SIXSTEP_PARTS"
  return $status
}
