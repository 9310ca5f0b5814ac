# Help, version and the lists, as a user sees them.
try carom --help
carom --version | sed 's/[0-9][0-9]*/N/g'
for command in resolve hit rail trace sweep; do
  echo "--- $command"
  try carom "$command" --help
done
echo "--- lines of more than 80 columns"
for command in "" resolve hit rail shoot trace sweep; do carom $command --help | awk -v command="$command" 'length > 80 { print command ": " $0 }'; done
echo "--- a page of the manual is the help"
for command in "" resolve; do
  sed '1,/^\.nf/d; $d; s/\\-/-/g; s/^\\&//' "$(dirname "$CAROM")/man/carom${command:+-$command}.1" > page
  carom $command --help | cmp - page && echo "the same: $command"
done
rm page
echo "--- the examples do what they show"
cp "$DATA/collisions-204.csv" before.csv
for command in "" resolve trace sweep; do
  example=$(carom $command --help | tail -n 1)
  [ "${example#  carom }" != "$example" ] && eval "$example" || echo "the example of '$command' fails"
done
ls
