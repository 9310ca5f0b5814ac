# docs/understanding/published.md has the table, which docs/shown compares; here is what can be wrong with its data.
mkdir -p bad
row() { head -n 1 "$DATA/measured.csv" > bad/measured.csv && echo "$1" >> bad/measured.csv && try lab published --data bad; }
row "ball mass,0.17,0.16,0.17,kg,pool,nobody,read,ball_mass:0"
row "ball mass,0.17,0.16,0.165,kg,pool,nobody,read,ball_mass:0"
row "ball mass,0.17,,,kg,pool,nobody,read,ball_mass:0"
row "ball mass,0.17,0.18,,kg,pool,nobody,read,"
row "ball mass,0.17,0.18,,kg,pool,nobody,read,ball_weight:0"
row "ball mass,0.17,0.18,,kg,pool,nobody,read,ball_mass:pool"
row "ball mass,0.17,heavy,,kg,pool,nobody,read,ball_mass:0"
row "ball mass,0.17"
try lab published --csv --data bad -o missing/published.csv
lab published --csv | head -n 2
