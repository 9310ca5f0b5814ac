# Bad usage of the study's program: exit 2, and a message that says what would be right.
try lab > said 2>&1
sed -n '1p;$p' said
rm said
try_rows "usage"
lab kernels > /dev/full || echo "exit $?"
for budget in x 0 -1 nan 1x ""; do try lab bench --budget "$budget"; done
