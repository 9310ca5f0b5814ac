# Bad usage of the study's program: exit 2, and a message that says what would be right.
try lab > said 2>&1
sed -n '1p;$p' said
rm said
try lab sweep
try lab kernels now
try lab kernels --csv -o nowhere/kernels.csv
try lab verify now
try lab verify --kernel rough
try lab verify --data nowhere
try lab resolve
try lab resolve --kernel rough x.csv
try lab resolve --solver exact x.csv
lab kernels > /dev/full || echo "exit $?"
for budget in x 0 -1 nan 1x ""; do try lab bench --budget "$budget"; done
