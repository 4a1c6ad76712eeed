# SPDX-License-Identifier: Apache-2.0
# Completion of sixstep for bash. In ~/.bashrc:  source <(sixstep completion bash)
_sixstep() {
  local line=${COMP_LINE:0:COMP_POINT} word current prefix=""
  local -a words
  # Without -r: a backslash keeps what is behind it, as in the words that are offered here.
  # shellcheck disable=SC2162
  read -a words <<<"$line"
  [[ $line == *[[:space:]] && $line != *\\[[:space:]] ]] && words+=("")
  # Where bash splits words at = or :, it replaces only what follows the last of them.
  current=${words[-1]}
  [[ $COMP_WORDBREAKS == *[=:]* && $current == *[=:]* ]] && prefix=${current%"${current##*[=:]}"}
  COMPREPLY=()
  while IFS=$'\t' read -r word _; do
    # bash puts a word into the line as it is: one that is not quoted would be run.
    printf -v word %q "${word#"$prefix"}"
    COMPREPLY+=("$word")
  done < <("${words[0]/#\~/$HOME}" __complete "${words[@]:1}" 2>/dev/null)
  # Behind a folder or a key's = more is to come.
  [[ ${#COMPREPLY[@]} == 1 && ${COMPREPLY[0]} == *[=/] ]] && compopt -o nospace
  return 0
}
complete -o default -F _sixstep sixstep
