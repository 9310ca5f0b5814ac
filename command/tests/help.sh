# Help, version and the lists, as a user sees them: one sample whole, and of the others how they are wrapped.
commands=$(carom --complete | tr "\n" " ")
try carom --help
carom --version | sed 's/[0-9][0-9]*/N/g'
try carom resolve --help
# shellcheck disable=SC2086
python -m wrapped "$CAROM" $commands
echo "--- pages of the manual: their sections, and what man and roff say of them"
cp "$(dirname "$CAROM")"/man/carom*.1 .
for page in *.1; do
  sed -n 's/^\.S[HS] //p' "$page" | tr '\n' ',' && echo
  [ "$(grep -c "^\.BR carom.*(1)" "$page")" = "$(echo "$commands" | wc -w)" ] || echo "$page: not all the other pages are named"
  ! command -v man > /dev/null || man --warnings -l "$page" 2>&1 > /dev/null
  ! command -v groff > /dev/null || groff -man -Tascii -ww "$page" 2>&1 > /dev/null
done | sort | uniq -c
rm ./*.1
echo "--- the examples do what they show"
cp "$DATA/collisions-204.csv" before.csv
for command in "" resolve; do
  example=$(carom $command --help | sed -n '/^example:$/{n;p;q;}')
  [ "${example#  carom }" != "$example" ] && eval "$example" || echo "the example of '$command' fails"
done
ls
echo "--- what a report of a bug needs; machines differ"
carom --report | sed -e 's/[0-9][0-9.]*/N/g' -e 's/^compiled by [gc].*/compiled by COMPILER/' -e 's/^on [A-Z].*, N processors/on SYSTEM/' -e 's/sets plain.*; in force: [a-z0-9N]*/SETS/' -e '/^[A-Z_]*=/d' -e '/^Report at /d'
CAROM_ISA=plain carom --report | grep -c 'in force: plain$'
CAROM_ISA=plain carom --report | grep 'CAROM_ISA='
