# Shapes of files that mean the same: order of columns, unknown columns, CRLF, byte-order mark, blank lines, quotes, M1 and M2.
header=id,r1x,r1y,r1z,v1x,v1y,v1z,w1x,w1y,w1z,r2x,r2y,r2z,v2x,v2y,v2z,w2x,w2y,w2z,R,M,u_s1,u_s2,u_b,e_b
good="0,0,0.03,0.3,1,0,-33,10,0,0,0.06,0.03,0,0,0,0,0,0,0.03,0.17,0.2,0.2,0.05,0.95"
printf '%s\na,%s\nb,%s\n' "$header" "$good" "$good" > plain.csv
carom resolve --solver euler plain.csv > plain.out
cat plain.out
same() { carom resolve --solver euler "$1" | cmp - plain.out && echo "same: $1"; }
sed 's/$/\r/' plain.csv > crlf.csv; same crlf.csv
tr '\n' '\r' < plain.csv > cr.csv; same cr.csv
{ printf '\357\273\277'; cat plain.csv; } > mark.csv; same mark.csv
sed 's/$/\n\n/' plain.csv > blank.csv; same blank.csv
sed 's/\([^,]*\)/"\1"/g' plain.csv > quoted.csv; same quoted.csv
printf %s "$(cat plain.csv)" > no_end.csv; same no_end.csv
sed 's/^/7,/; 1s/^7/note/' plain.csv > unknown.csv; same unknown.csv
awk -F, '{for (i = NF; i > 0; i--) printf("%s%s", $i, (i > 1) ? "," : "\n")}' plain.csv > reversed.csv; same reversed.csv
sed 's/$/,/' plain.csv > trailing.csv; same trailing.csv
sed '1s/,M,/,M1,/; 1s/$/,M2/; 2,$s/$/,0.17/' plain.csv > masses.csv; same masses.csv
echo "without id, with an id that needs quotes, a header alone:"
cut -d, -f2- plain.csv | carom resolve --solver euler - | cut -d, -f1
sed 's/^a,/"a ""1"", b",/' plain.csv | carom resolve --solver euler - | cut -c1-30
head -n 1 plain.csv | carom resolve --solver euler -
