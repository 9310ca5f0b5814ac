# Completion of `carom` for bash: commands, options and their values, as the program itself lists them.
_carom() {
  local word=${COMP_WORDS[COMP_CWORD]} words
  if [ "$COMP_CWORD" = 1 ]; then
    words=$("${COMP_WORDS[0]}" --complete 2> /dev/null)
  else
    words=$("${COMP_WORDS[0]}" "${COMP_WORDS[1]}" --complete "${COMP_WORDS[COMP_CWORD - 1]}" "$word" 2> /dev/null)
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}
complete -o default -F _carom carom
