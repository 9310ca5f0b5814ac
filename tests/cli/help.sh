# Help, version and the lists, as a user sees them.
try carom --help
carom --version | sed 's/[0-9][0-9]*/N/g'
for command in resolve trace sweep; do
  echo "--- $command"
  try carom "$command" --help
done
echo "--- the examples do what they show"
cp "$DATA/collisions-204.csv" before.csv
for command in "" resolve trace sweep; do
  example=$(carom $command --help | tail -n 1)
  [ "${example#  carom }" != "$example" ] && eval "$example" || echo "the example of '$command' fails"
done
ls
