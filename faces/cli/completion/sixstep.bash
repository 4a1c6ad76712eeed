# SPDX-License-Identifier: Apache-2.0
# Completion of sixstep for bash. In ~/.bashrc:  source <(sixstep completion bash)
_sixstep() {
  local line=${COMP_LINE:0:COMP_POINT} word current prefix=""
  local -a words
  # Without -r, a backslash escapes the next character, as in the completed words.
  # shellcheck disable=SC2162
  read -a words <<<"$line"
  [[ $line == *[[:space:]] && $line != *\\[[:space:]] ]] && words+=("")
  # If bash splits words at = or :, it replaces only the text after the last of these characters.
  current=${words[-1]}
  [[ $COMP_WORDBREAKS == *[=:]* && $current == *[=:]* ]] && prefix=${current%"${current##*[=:]}"}
  COMPREPLY=()
  while IFS=$'\t' read -r word _; do
    # bash inserts a word unchanged. Without quotes, a command substitution in the word would be executed.
    printf -v word %q "${word#"$prefix"}"
    COMPREPLY+=("$word")
  done < <("${words[0]/#\~/$HOME}" __complete "${words[@]:1}" 2>/dev/null)
  # After a folder or after a key's =, the user continues the word.
  [[ ${#COMPREPLY[@]} == 1 && ${COMPREPLY[0]} == *[=/] ]] && compopt -o nospace
  return 0
}
complete -o default -F _sixstep sixstep
