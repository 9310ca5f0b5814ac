# Help, version and the lists, as a user sees them.
try carom --help
carom --version | sed 's/[0-9][0-9]*/N/g'
for command in resolve hit rail trace sweep; do
  echo "--- $command"
  try carom "$command" --help
done
echo "--- lines of more than 80 columns"
for command in "" resolve hit rail shoot trace sweep; do carom $command --help | awk -v command="$command" 'length > 80 { print command ": " $0 }'; done
echo "--- pages of the manual: their sections, the options that help has and they have not, what man and roff say of them"
for command in "" resolve hit rail shoot trace sweep; do
  page=$(dirname "$CAROM")/man/carom${command:+-$command}.1
  sed -n 's/^\.S[HS] //p' "$page" | tr '\n' ','
  sed 's/\\-/-/g; s/\\fR//g; s/\\://g' "$page" > page
  for option in $(carom $command --help | sed -n 's/^  *\(-., \)\{0,1\}\(--[a-z-]*\).*/\2/p'); do grep -q "^[^ ]*\(-., \)*$option" page || echo "no $option"; done
  grep -A 2 '^\.SH EXAMPLES' page | tail -n 1
  grep -c "^\.BR carom.*(1)" page
  ! command -v man > /dev/null || man --warnings -l "$page" 2>&1 > /dev/null
  ! command -v groff > /dev/null || groff -man -Tascii -ww "$page" 2>&1 > /dev/null
done
rm page
echo "--- the examples do what they show"
cp "$DATA/collisions-204.csv" before.csv
for command in "" resolve trace sweep; do
  example=$(carom $command --help | tail -n 1)
  [ "${example#  carom }" != "$example" ] && eval "$example" || echo "the example of '$command' fails"
done
ls
