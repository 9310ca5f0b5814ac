# What a report of a bug needs; machines differ.
carom --report | sed -e 's/[0-9][0-9.]*/N/g' -e 's/^compiled by [gc].*/compiled by COMPILER/' -e 's/^on [A-Z].*, N processors/on SYSTEM/' -e 's/sets plain.*; in force: [a-z0-9N]*/SETS/' -e '/^[A-Z_]*=/d' -e '/^Report at /d'
CAROM_ISA=plain carom --report | grep -c 'in force: plain$'
CAROM_ISA=plain carom --report | grep 'CAROM_ISA='
