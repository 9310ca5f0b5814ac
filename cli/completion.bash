# Completion of `carom` for bash: commands and options as the program's own help lists them.
_carom() {
  local word=${COMP_WORDS[COMP_CWORD]} words
  if [ "$COMP_CWORD" = 1 ]; then
    words=$("${COMP_WORDS[0]}" --help 2> /dev/null | sed -n '/^commands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
  elif [ "${word#-}" != "$word" ]; then
    words=$("${COMP_WORDS[0]}" "${COMP_WORDS[1]}" --help 2> /dev/null | sed -n 's/^  \(-[a-z], \)\{0,1\}\(--[a-z-]*\).*/\2/p')
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}
complete -o default -F _carom carom
