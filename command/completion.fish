# Completion of `carom` for fish: commands, options and their values, as the program itself lists them, beside files.
function __carom_complete
    set -l words (commandline -opc)
    if test (count $words) -lt 2
        $words[1] --complete 2>/dev/null
    else
        $words[1] $words[2] --complete $words[-1] (commandline -ct) 2>/dev/null
    end
end
complete -c carom -f -n 'test (count (__carom_complete)) -gt 0' -a '(__carom_complete)'
