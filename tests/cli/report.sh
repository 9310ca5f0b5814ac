# report --from: figures and page from a stored run, the same bytes each time, whole, and without what is not there.
stored=${script%/cli/*}/report
try carom report --from "$stored" one
carom report --from "$stored" two > /dev/null
diff -r one two && echo "the same bytes twice"
carom report --from one one > /dev/null
diff -r one two && echo "and from its own files"
ls one
echo "--- the page"
grep -o -e '<figure id="[a-z-]*"' -e '<h2 id="[a-z-]*"' one/index.html
grep -c '<svg' one/index.html
grep -o -e ' src=' -e '<link' -e '<script' -e 'url([^#)]*)' -e 'href="[^#"][^"]*"' one/index.html || echo "nothing from outside"
grep -c '<title>Gnuplot' one/index.html one/*.svg | grep -v ':0$' || echo "every picture says what it is"
grep -o -e '[^<>]* than the paper.s</td>' -e 'as in the paper, [^<]*' -e 'Best of all: <b>[^<]*</b>' -e '[^<>]* operations than the paper' one/index.html
cat > wellformed.py <<'P'
import collections, sys, xml.etree.ElementTree as tree
for name in sys.argv[1:]:
    page = tree.parse(name)
    ids = collections.Counter(e.get("id") for e in page.iter() if e.get("id"))
    twice = [i for i, n in ids.items() if n > 1]
    print(name, "is well-formed;", "ids twice: " + " ".join(twice) if twice else "no id twice")
P
python3 wellformed.py one/*.svg one/index.html
echo "--- as PNG"
carom report --png --from one png > /dev/null
for picture in png/*.png; do printf '%s ' "$picture"; head -c 4 "$picture" | tail -c 3; echo; done
echo "--- without gnuplot"
(PATH=/nowhere && try "$CAROM" report --from "$stored" bare) 2>&1 | sed '/^speedup/,/^$/d'
grep -c 'could not be drawn: gnuplot is not installed' bare/index.html
grep -o '<h2 id="[a-z-]*"' bare/index.html
ls bare
echo "--- with a part of the data"
mkdir part
cp "$stored"/ladder.csv "$stored"/steps.csv part
try carom report --from part some 2>&1 | grep -e '^carom: no' -e '^carom: the' -e '^exit' -e '^report' | sort
grep -o -e '<p class="missing">[^<]*' some/index.html
sed '$s/,[^,]*$//' "$stored/steps.csv" > part/steps.csv
try carom report --from part broken 2>&1 | grep -e 'steps.csv:' -e exit
echo "--- usage"
try carom report
try carom report one two
try carom report --budget 0 one
try carom report --from one wellformed.py
try carom report --from nowhere nowhere
try carom report ""
ls nowhere 2> /dev/null || echo "nothing made"
