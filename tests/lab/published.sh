# docs/understanding/published.md has the exit code for the tree's data, which docs/shown compares; here is what can be wrong with data.
mkdir -p bad
row() { head -n 1 "$DATA/measured.csv" > bad/measured.csv && echo "$1" >> bad/measured.csv && try lab published --data bad; }
row "ball mass,0.17,0.16,0.17,kg,pool,nobody,read,high,ball().mass"
row "ball mass,0.17,0.16,0.17,kg,pool,nobody,read,ok,ball().mass"
row "ball mass,0.17,,,kg,pool,nobody,read,-,ball().mass"
row "ball mass,0.17,0.18,,kg,pool,nobody,read,,"
row "ball mass,0.17,0.18,,kg,pool,nobody,read,ok,ball_weight()"
row "ball mass,0.17,0.18,,kg,pool,nobody,read,ok,ball(pool).mass"
row "ball mass,0.17,heavy,,kg,pool,nobody,read,ok,ball().mass"
row "ball mass,0.17"
try lab published --csv --data bad -o missing/published.csv
lab published --csv --data bad | head -n 2
