#compdef sixstep
# SPDX-License-Identifier: Apache-2.0
# Completion of sixstep for zsh. In ~/.zshrc, below compinit:  source <(sixstep completion zsh)
_sixstep() {
  local line word meaning
  local -a lines done shown open
  lines=("${(@f)$("${(Q)words[1]/#\~/$HOME}" __complete "${(@Q)words[2,CURRENT]}" 2>/dev/null)}")
  for line in $lines; do
    word=${line%%$'\t'*} meaning=${line#*$'\t'}
    if [[ $word == *[=/] ]]; then
      open+=("$word")  # behind a folder or a key's = more is to come
    else
      done+=("$word") shown+=("$word${meaning:+  -- $meaning}")
    fi
  done
  compadd -S '' -a open
  compadd -l -d shown -a done
}
# If the file is installed, zsh reads it at the first Tab as the body of the function, which must then answer.
if [[ ${funcstack[1]} == _sixstep ]]; then
  _sixstep "$@"
else
  compdef _sixstep sixstep
fi
