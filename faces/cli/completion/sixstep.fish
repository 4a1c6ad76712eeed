# SPDX-License-Identifier: Apache-2.0
# Completion of sixstep for fish. In ~/.config/fish/completions/sixstep.fish:  sixstep completion fish | source
function __sixstep_complete
    set -l words (commandline -opc)
    $words[1] __complete $words[2..-1] (string unescape -- (commandline -ct)) 2>/dev/null
end
complete -c sixstep -f -a '(__sixstep_complete)'
