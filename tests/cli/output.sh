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
