# Pictures appear whole or not at all, however the program that draws them is ended, and nothing stays behind.
mkdir bin temporary
export TMPDIR="$PWD/temporary"
# A gnuplot that says that it has begun, and goes on when it may.
mkfifo begun go_on
cat > bin/gnuplot << 'END'
#!/bin/sh
echo half
echo > begun
cat go_on
END
chmod +x bin/gnuplot
nothing_else() {
  ls temporary
  ls ./*.svg* | tr '\n' ' '
  cat kept.svg
}
for signal in TERM KILL; do
  for words in "hit --cut 0:60 --plot kept.svg" "rail --angle 0:60 --plot kept.svg"; do
    echo old > kept.svg
    # shellcheck disable=SC2086
    PATH="$PWD/bin:$PATH" "$CAROM" $words &
    read -r _ < begun
    kill -$signal $!
    wait $! 2> /dev/null || echo "ended: ${words%% *}"
    : > go_on
    nothing_else
  done
done
# A gnuplot that fails, one that draws nothing, and none: the old picture stays.
printf '#!/bin/sh\necho half\necho "no such terminal" >&2\nexit 1\n' > bin/gnuplot
PATH="$PWD/bin:$PATH" try "$CAROM" hit --cut 0:60 --plot kept.svg 2>&1 | sed 's/on .*\/curves.gp/on curves.gp/'
printf '#!/bin/sh\nexit 0\n' > bin/gnuplot
PATH="$PWD/bin:$PATH" try "$CAROM" hit --cut 0:60 --plot kept.svg
nothing_else
# shoot: ended while it plays; a picture that cannot be written; one that is no file is written in place.
mkfifo shots
"$CAROM" shoot --plot kept.svg -o kept.jsonl shots &
exec 3> shots
cat "$DATA/break-nineball.jsonl" >&3
kill $!
wait $! 2> /dev/null || echo "ended: shoot"
exec 3>&-
nothing_else
ls kept.jsonl 2> /dev/null || echo "no shots"
# What would draw is missing: that is said before anything is played.
PATH="$PWD/bin" try "$CAROM" shoot --plot break.png -o kept.jsonl "$DATA/break-nineball.jsonl"
PATH="$PWD/bin" try "$CAROM" shoot --plot break.pdf --cue 0.6,0.8
ls kept.jsonl 2> /dev/null || echo "nothing was played"
# shellcheck disable=SC1007
(
  cp "$(command -v rsvg-convert)" . && PATH= try "$CAROM" shoot --events none --plot break.png -o /dev/null "$DATA/break-nineball.jsonl"
  rm rsvg-convert
)
head -c 4 break.png | tail -c 3 && echo
try carom shoot --events none --plot usual.png -o /dev/null "$DATA/break-nineball.jsonl"
head -c 4 usual.png | tail -c 3 && echo
ln -s /dev/full full.svg
try_rows "pictures, a full disk"
ln -sf link_to.svg linked.svg
try carom shoot --events none --plot linked.svg -o /dev/null "$DATA/break-nineball.jsonl"
test -L linked.svg && tail -n 1 link_to.svg
# With the standard places closed files take none of them.
for closed in "<&-" ">&-" "2>&-" "<&- >&- 2>&-"; do
  rm -f closed.svg closed.csv
  eval "\"\$CAROM\" hit --cut 0:60 --plot closed.svg -o closed.csv $closed" || echo "exit $?"
  echo "closed $closed: $(grep -c '</svg>' closed.svg) $(wc -l < closed.csv)"
done
# Letters have 9 pixels in a picture that is 500 wide, and no label lies over a rail.
carom hit --cut 0:80 --speed 1,3,7mph --plot curves.svg
python - << 'PYTHON'
import os, random, subprocess
from drawn import labels_on_rails, small_letters

def plot(*words):
    subprocess.run([os.environ["CAROM"], *words, "--plot", "drawn.svg", "-o", "/dev/null"], check=True)
    return small_letters("drawn.svg"), labels_on_rails("drawn.svg")

print(small_letters("curves.svg"))
print({str(plot("rail", "--angle", angle, "--side", side)) for angle in ("1", "30", "75", "89") for side in ("left", "none", "right")})
random.seed(1)
sizes = {"7ft": (0.9906, 1.9812), "8ft": (1.1176, 2.2352), "9ft": (1.27, 2.54), "snooker": (1.7785, 3.569), "threecushion": (1.42, 2.84)}
seen = set()
for table, (width, length) in sizes.items():
    for _ in range(8):
        cue, ball = ([f"{random.uniform(0.1, 0.9) * width:.3f},{part * length:.3f}" for part in (random.uniform(0.1, 0.4), random.uniform(0.6, 0.9))])
        seen.add(str(plot("shoot", "--table", table, "--cue", cue, "--balls", f"a_long_name={ball}", "--aim", f"{random.uniform(0, 360):.1f},{random.uniform(0, 360):.1f}", "--speed", "6")))
print(seen)
PYTHON
