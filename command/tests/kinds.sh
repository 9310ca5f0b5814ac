# Files as other programs write them: read, or named for what they are; and what is mistyped is named.
head -n 3 "$DATA/collisions-204.csv" | cut -d, -f1,3- > plain.csv
carom resolve plain.csv > plain.out
same() { carom resolve "$1" | cmp - plain.out && echo "same: $1"; }
tr , ';' < plain.csv > semicolons.csv
same semicolons.csv
tr , '\t' < plain.csv > tabs.csv
same tabs.csv
{
  echo "# collision: 1"
  echo "#"
  cat plain.csv
} > notes.csv
same notes.csv
{
  cat plain.csv
  echo ",,,,"
  sed -n 2p plain.csv | sed 's/[^,]//g'
} > empty_rows.csv
same empty_rows.csv
sed 's/\r*$/\r/' semicolons.csv > crlf.csv
same crlf.csv
# Columns in any order, unknown ones, an empty one behind the last, M1 and M2.
awk -F, '{for (i = NF; i > 0; i--) printf("%s%s", $i, (i > 1) ? "," : "\n")}' plain.csv > reversed.csv
same reversed.csv
sed 's/^/7,/; 1s/^7/note/' plain.csv > unknown.csv
same unknown.csv
sed 's/$/,/' plain.csv > trailing.csv
same trailing.csv
awk -F, 'NR == 1 { for (m = 1; $m != "M"; m++); $m = "M1"; print $0 ",M2"; next } { print $0 "," $m }' OFS=, plain.csv > masses.csv
same masses.csv
echo "without id, with an id that needs quotes, a header alone:"
cut -d, -f2- plain.csv | carom resolve - | cut -d, -f1
sed '2s/^[^,]*/"a ""1"", b"/' plain.csv | carom resolve - | sed -n 2p | cut -c1-20
head -n 1 plain.csv | carom resolve -
# Decimal commas are read between semicolons only: elsewhere a comma may part thousands.
tr , ';' < plain.csv | tr . , > commas.csv
same commas.csv
tr , ';' < plain.csv | tr . , | sed '1s/$/;note (m, m)/; 2,3s/$/;a, b/' > noted.csv
same noted.csv
tr , ';' < plain.csv | sed '2s/\./,/' > mixed.csv
same mixed.csv
tail -n 2 commas.csv > headless.csv
try carom resolve headless.csv
tr , ';' < plain.csv | sed '2s/;[-0-9.]*/;1.234,5/; 3s/;[-0-9.]*/;1,234,5/' > thousands.csv
try carom resolve -o /dev/null thousands.csv
tr , '\t' < plain.csv | tr . , > comma.csv
try carom resolve -o /dev/null comma.csv
tail -n 2 plain.csv > headless.csv
try carom resolve headless.csv
tail -n 2 plain.csv | cut -d, -f2- > headless.csv
try carom resolve headless.csv
{
  printf '\377\376'
  sed 's/./&\x00/g' plain.csv
} > utf16.csv
try carom resolve utf16.csv
python -c "
import numpy
a = numpy.loadtxt('plain.csv', delimiter=',', skiprows=1, usecols=range(1, 25))
numpy.savez('a.npz', a)
numpy.save('a.npy', a)
numpy.savetxt('numpy.csv', a, delimiter=',', header=open('plain.csv').readline().strip())"
try carom resolve a.npz
try carom resolve - < a.npy
try carom resolve numpy.csv
try carom resolve --cushion a.npz
sed 1d "$DATA/cushion-stronge.csv" > headless.csv
try carom resolve --cushion headless.csv
sed 's/./&\x00/g' plain.csv > utf16.csv
try carom resolve utf16.csv
gzip plain.csv -c > plain.csv.gz
try carom resolve plain.csv.gz
head -n 1 "$DATA/break-nineball.jsonl" > shots.jsonl
try carom resolve shots.jsonl
head -n 2 "$DATA/cushion-stronge.csv" > rail.csv
try carom resolve rail.csv
try carom resolve --cushion plain.csv
try carom resolve - <&-
echo "whole shots:"
: > empty
try carom shoot empty
try carom shoot - < plain.csv
try carom shoot plain.csv.gz
try carom shoot utf16.csv
python -c "
import json, sys
lines = [json.loads(line) for line in open(sys.argv[1])]
json.dump(lines, open('array.json', 'w'))
json.dump(lines[0], open('pretty.json', 'w'), indent=1)" "$DATA/break-nineball.jsonl"
try carom shoot array.json
try carom shoot pretty.json
head -c 400 "$DATA/break-nineball.jsonl" > cut.jsonl
try carom shoot -o cut.out cut.jsonl
try carom shoot .
echo "what is mistyped:"
sed '1s/v1y/V1Y/' plain.csv > case.csv
try carom resolve case.csv
sed '1s/u_b/mu_b/; 1s/e_b/eb/' plain.csv > near.csv
try carom resolve near.csv
sed '1s/u_b/friction/' plain.csv > far.csv
try_rows "kinds, mistyped"
echo "messages have a limit:"
{
  head -n 1 plain.csv
  yes "x,1,2" | head -n 1500
} > bad.csv
try carom resolve -o bad.out bad.csv 2> said
wc -l < said
sed -n '1p;1000p;$p' said
grep -c missing_value bad.out
{
  cat "$DATA/break-nineball.jsonl"
  yes "{" | head -n 1500
} > bad.jsonl
try carom shoot --events none -o bad.out bad.jsonl 2> said
wc -l < said
sed -n '1p;1000p;$p' said
grep -c bad_line bad.out
