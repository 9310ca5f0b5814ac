# docs/understanding/published.md has the exit code for the tree's data, which docs/shown compares; here is what can be wrong with data.
mkdir -p bad
row() { head -n 1 "$DATA/measured.csv" > bad/measured.csv && echo "$1" >> bad/measured.csv && try lab published --data bad; }
mass='number_of_ball(""pool"", ""mass"")'
row "sizes,ball mass,0.17,0.16,0.17,,kg,pool,nobody,read,high,\"$mass\""
row "sizes,ball mass,0.17,0.16,0.17,,kg,pool,nobody,read,ok,\"$mass\""
row "sizes,ball mass,0.17,,,,kg,pool,nobody,read,-,\"$mass\""
row "sizes,ball mass,0.17,,,0.001,kg,pool,nobody,read,ok,\"$mass\""
row "sizes,ball mass,0.17,0.18,,,kg,pool,nobody,read,,"
row "sizes,ball mass,0.17,0.18,,,kg,pool,nobody,read,ok,weight(1)"
row "sizes,ball mass,0.17,0.18,,,kg,pool,nobody,read,ok,throw(exit(3))"
row "sizes,ball mass,0.17,0.18,,,kg,pool,nobody,read,ok,ball(0).mass"
row "sizes,ball mass,0.17,heavy,,,kg,pool,nobody,read,ok,\"$mass\""
row "sizes,ball mass,0.17"
try lab published --csv --data bad -o missing/published.csv
lab published --csv --data bad | head -n 2
# Filmed shots, which another program plays: what they say of each number, and two numbers of that program.
python3 "$DATA/../study/tests/lab/films.py" > film.csv
lab published --film film.csv > film.md
sed -n 's/ [0-9.]* mm of/ of/p' film.md
sed -n '/^| snooker/,/^$/p' film.md | cut -d '|' -f 2,3,5,6
awk -F '|' '$2 ~ /mu_roll/ && $6 ~ /whole/ && $4 + 0 > 0.0103 && $4 + 0 < 0.0107 || $2 ~ /restitution / && $6 ~ /whole/ && $4 + 0 > 0.89 && $4 + 0 < 0.92 { print $2 "as in the film" }' film.md
sed -n '/^| impact/,$p' film.md
head -n 1 film.csv > wide.csv && echo s_1,cue,0,0.5,wide >> wide.csv && try lab published --film wide.csv
try lab published --film none.csv
