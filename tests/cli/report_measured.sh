# report: the whole way, measured as briefly as can be. Figures are not looked at; report.sh does that.
carom report --budget 1 all > said 2> complaints
code=$?
[ $code -le 1 ] && echo "done"
sed -n 's/^\([a-z]*\.csv\): carom \([a-z]*\) .*/\1 by \2/p' said
for file in verify ladder steps accuracy configs cycles isas batch experiments speedup; do
  [ "$(grep -vc '^#' all/$file.csv)" -gt 1 ] && echo "$file has rows"
done
grep -c '<figure' all/index.html
grep -q '^exact,library,scalar,double,1,0,' all/accuracy.csv && echo "exact is in the figure of errors"
grep -q '^exact,library,[^,]*,single,1,0,' all/accuracy.csv && echo "and its batches are"
