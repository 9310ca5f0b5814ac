# What there is, and its numbers: models and numbers by name, in impacts and in shots.
carom models | head -n 3
carom models | sed -n '/^numbers/,$p' | head -n 3
try carom models stronge
carom models smooth | grep -c smooth_q
try carom models constant
try carom models u_b
try carom models smoth
echo "--- numbers of one impact, all of which reach it"
reaches() { # MODEL MU NUMBERS
  for with in "$3" ""; do
    carom rail --speed 3 --angle 20 --side right --friction "$2" --model "$1" ${with:+--with "$with"}
  done | sort | uniq -u | grep -q . && echo "$1 reads $3"
}
reaches stronge 0.9 omega_ratio=1.1
reaches han 0.2 restitution_log=-0.1
reaches han 0.2 mu_log=0.2
for one in 0.2,smooth_x=1.3,smooth_t=1.2 0.35,smooth_x=1,smooth_t=1.2 0.35,smooth_x=1.3,smooth_t=1 0.35,smooth_x=1.3,smooth_t=1.2,smooth_a=0.9 \
  0.35,smooth_x=1.3,smooth_t=1.2,smooth_k=0.9; do reaches smooth 0.2 smooth_q=$one; done
try_rows "models, numbers that another model reads"
carom rail --csv --speed 3 --angle 20 --friction 0.9 > rail.csv
carom resolve --cushion --model stronge rail.csv > usual
carom resolve --cushion --model stronge --with omega_ratio=1.1 rail.csv | cmp -s - usual || echo "resolve reads it too"
echo "--- numbers of shots"
shot="--cue 0.5,1 --balls 0.6,1.4 --aim 80"
carom shoot $shot --json > line.jsonl
carom shoot --friction constant --with u_b=0 line.jsonl > slick
carom shoot --friction constant --with mu_ball=0.5 line.jsonl | cmp -s - slick || echo "u_b of --with has an effect"
sed 's/"params": {/"params": {"u_b": 0.5, /' line.jsonl > changed.jsonl
grep -c '"u_b": 0.5' changed.jsonl
try carom shoot --events none changed.jsonl | grep -o '"status": "[a-z]*"\|exit .'
try carom shoot --events none --strict changed.jsonl | grep -o '"status": "[a-z_]*"\|exit .'
try carom shoot --events none --friction constant changed.jsonl | grep -o '"status": "[a-z]*"\|exit .'
carom shoot $shot --cushion stronge --with e_c=0.7,omega_ratio=1.1 --json > own.jsonl
carom shoot --cushion stronge own.jsonl > kept
carom shoot --cushion stronge --with e_c=0.7,omega_ratio=1.1 line.jsonl | cmp - kept && echo "--json and the played line have the numbers of --with"
try_rows "models, misspelt"
carom record --friction constant line.jsonl | sed -n 2p
echo "--- a tip beside the ball"
try_rows "models, a tip beside the ball"
