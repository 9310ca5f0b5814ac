# Every option says the same way what is wrong with its value: refusals.py has the rules. Then what players mistype.
python -m refusals "$CAROM"
try_rows "refusals, mistyped"
