#compdef carom
# Completion of `carom` for zsh: commands, options and their values, as the program itself lists them; else files.
local -a found
if (( CURRENT == 2 )); then
  found=(${(f)"$($words[1] --complete 2> /dev/null)"})
else
  found=(${(f)"$($words[1] $words[2] --complete "$words[CURRENT-1]" "$words[CURRENT]" 2> /dev/null)"})
fi
if (( $#found )); then
  compadd -a found
else
  _files
fi
