# Kinds of arguments, each as a table: ranges, lists, numbers of --with, and options that one another would ignore.
echo "--- one range in both forms, of every option that has one"
lines() { "$CAROM" "$@" | cksum; }
for pair in "hit --speed 1:3:1" "hit --cut 0:60:20" "hit --spin -50:50:50%" "hit --side 0:100:50%" "hit --friction 0:0.1:0.05" "hit --mass 150:170:10g" "hit --object-mass 150:170:10g" \
  "rail --angle 0:60:20" "rail --height 30:40:5mm" "shoot --json --speed 1:3:1" "shoot --json --aim 80:90:5" "shoot --json --elevation 0:4:2" "shoot --json --tip 0,-0.4:0.4:0.2" \
  "shoot --json --tip -0.2:0.2:0.2,0:0.4:0.2" "shoot --json --tip 0,-0.4:0.4"; do
  # shellcheck disable=SC2046,SC2086
  [ "$(lines $pair)" = "$(lines $(echo $pair | sed 's/:/../g'))" ] && [ "$(carom $pair | wc -l)" -gt 2 ] || echo "$pair: not the same"
done
echo "--- too many, told as that"
for words in "hit --cut 0:60:0.01" "hit --cut $(seq -s , 0 0.01 12)" "hit --cut $(seq -s , 0 0.1 60)" "shoot --tip 0,-0.4:0.4:0.01" "shoot --aim 0:90:1" "hit --speed 1:9:0.01 --cut $(seq -s , 0 9) --side $(seq -s , 0 99)% --spin $(seq -s , 0 9)%"; do
  # shellcheck disable=SC2086
  try carom $words
done
echo "--- a list and a range of every option that takes a number: played, or refused in a sentence that says why"
{
  head -n 1 "$DATA/collisions-204.csv"
  sed -n 2p "$DATA/collisions-204.csv"
} > row.csv
carom shoot --cue 0.6,0.8 --balls 0.5,1.6 --json > two.jsonl
for all in "resolve row.csv" hit rail "shoot --balls 0.5,1.6" "ways --balls 0.5,1.6 --ball 1 --pocket foot-left" "plan --balls 0.5,1.6 --rules potting --shots 100" "break --racks 1" "record two.jsonl"; do
  for option in $(carom ${all%% *} --complete x -- | sed 's/^--//' | sort); do
    case $option in output | id | at-ball | data | ball | pocket | via | stop) continue ;; esac
    for one in 0.5:0.6:0.1 1:2:1 0.001:0.002:0.001 500:501:1 100:200:100; do
      # shellcheck disable=SC2086
      carom $all --$option ${one%%:*} > said 2>&1 || continue
      last=${one%:*}
      for list in "${one%%:*},${last#*:}" "$one"; do
        carom $all --$option "$list" > said 2>&1 && echo "${all%% *} --$option: lists" && continue
        grep -q -- "--$option.*one value" said && echo "${all%% *} --$option: one value" || {
          echo "$all --$option $list"
          cat said
        }
      done
      break
    done
  done
done | sort | uniq -c | sed 's/^ *[0-9]* //'
try_rows "together, one value"
carom shoot --tip-time 0,0.001 --tip-restitution 0.7:0.8:0.1 --elevation 2,3.5 --csv | sed -n 's/^[0-9]*,"\(.*\)",cue,leaves,,0,[^,]*,[^,]*,\([0-9.]\{6\}\).*/\1: \2 m\/s/p'
echo "--- lists of models, frictions, masses"
carom rail --model han,mathavan --angle 30,60 --quantity rebound --csv | cut -c 1-16
for model in han mathavan; do carom rail --model $model --angle 30,60 --quantity rebound --csv | cut -c 1-8; done
carom hit --object-mass 150g,170g,same --friction 0.05 --quantity object-speed --csv | cut -c 1-14
carom hit --friction 0 --restitution 1 --cut 10,30,60 --csv --quantity angle-between
carom hit --friction 0 --cut 10,30 --csv --quantity throw
echo "--- what --with takes of every number that is listed"
carom shoot --cue 0.6,0.8 --json > line.jsonl
for name in $(carom models | sed -n '/^numbers of/,$s/^  \([a-z_]*[0-9]*\) .*/\1/p' | sort -u) M; do
  for command in "rail" "resolve --cushion -" "shoot --cue 0.6,0.8" "shoot line.jsonl" "ways line.jsonl"; do
    # shellcheck disable=SC2086
    carom $command --with $name=nothing < /dev/null 2>&1 | sed -n "1{s/^.*'$name=nothing': not a number.*/taken/;s/^carom: --with '$name'//;p}"
  done | uniq -c | tr -s ' \n' ' '
  echo "$name"
done
leaves() { carom shoot --cue 0.6,0.8 --tip 0.4,0 "$@" --csv | sed -n 2p; }
[ "$(leaves)" != "$(leaves --with end_mass=0.02)" ] && echo "squirt by the cue"
carom shoot --tip-time -1 --with M=0.5,end_mass=0.02,tip_restitution=0 --json | grep -o '"M.*tip_restitution": 0,\|"tip_time": -1'
carom ways line.jsonl --with u_b=2 2>&1 | head -n 1
echo "--- options that would be ignored"
try_rows "together, options that would be ignored"
echo "--- numbers of a fit"
echo '{"constants": {"mu_slide": 0.3, "smooth_q": 0.0, "law_a": 0.02}, "radius": 0.03, "cushion_model": "mathavan", "bands": [[0, 0.01, 0.03], [2, 0.02, 0.05]]}' > fit.json
for words in "fit.json" "fit.json,u_s=0.4"; do carom shoot --cue 0.3,0.5 --with $words --json | grep -o '"R": [0-9.]*\|"u_s": [0-9.]*\|"law_a[^,]*'; done
carom shoot --cue 0.3,0.5 --with fit.json | tail -n 1
carom shoot --speed 0.3 --with fit.json | tail -n 1
[ "$(carom shoot --cue 0.3,0.5 --with fit.json | sed '$d')" = "$(carom shoot --cue 0.3,0.5 --with mu_slide=0.3,law_a=0.02,radius=0.03 --cushion mathavan)" ] && echo "its cushion"
# the slope of a fit is one of its table
sed 's/"law_a"/"slope_x": 0.001, "slope_y": -0.0005, "law_a"/' fit.json > sloped.json
[ "$(carom shoot --cue 0.3,0.5 --with sloped.json)" = "$(carom shoot --cue 0.3,0.5 --with fit.json --table 9ft,slope_x=0.001,slope_y=-0.0005)" ] && echo "its slope"
try carom shoot --with sloped.json line.jsonl
echo '{"constants": {"mu_slide": "0.3"}}' > text.json
echo '{"constants": [0.3]}' > other.json
for file in text other no; do carom shoot --cue 0.3,0.5 --with $file.json 2>&1 | head -n 1; done
echo "--- a result is a layout: a break goes to a plan, a plan to a shot, a shot to its ways"
carom break --rules nineball --racks 2 --seed 1 --json > breaks.jsonl
sed -n 2p breaks.jsonl | carom plan --rules nineball --from final --shots 200 --json - > plan.jsonl
head -n 1 plan.jsonl | carom shoot --events none - > shot.jsonl
# the plan's balls are those at rest after the break, and the shot's those of the plan, digit by digit
states() { python3 -c 'import json, sys
line = json.loads(sys.stdin.readline())
states = line["final"]["balls"] if sys.argv[1] == "final" else {str(b["id"]): b["state"] for b in line["balls"]}
print(json.dumps(states, sort_keys=True))' "$1" | cksum; }
[ "$(sed -n 2p breaks.jsonl | states final)" = "$(states balls < plan.jsonl)" ] && echo "break to plan"
[ "$(states balls < plan.jsonl)" = "$(states balls < shot.jsonl)" ] && echo "plan to shot"
[ "$(states final < shot.jsonl)" = "$(carom ways --from final --json shot.jsonl | states balls)" ] && echo "shot to ways"
[ "$(carom shoot --from final --events none shot.jsonl | states balls)" = "$(states final < shot.jsonl)" ] && echo "shot to shot"
[ "$(carom shoot --events none shot.jsonl)" = "$(cat shot.jsonl)" ] && echo "again from the start"
carom record --from final shot.jsonl | carom verify - | tail -n 1
for words in plan ways "plan --from begin"; do
  # shellcheck disable=SC2086
  try carom $words shot.jsonl
done
try carom ways --from final plan.jsonl
for words in "plan --csv" "plan --why" "break --csv"; do
  # shellcheck disable=SC2086
  try carom $words --json
done
