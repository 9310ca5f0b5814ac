# NumPy arrays in and out: files that NumPy writes are read, files that are written NumPy reads; the rest is refused.
cat > make.py << 'PYTHON'
import csv, sys, numpy as np
names = "r1x r1y r1z v1x v1y v1z w1x w1y w1z R M u_s1 r2x r2y r2z v2x v2y v2z w2x w2y w2z R M u_s2 u_b e_b".split()
rows = list(csv.DictReader(open(sys.argv[1])))
a = np.array([[float(row[name]) for name in names] for row in rows])
np.save("f8.npy", a)
np.save("f4.npy", a.astype("<f4"))
np.save("empty.npy", a[:0])
bad = a[:5].copy(); bad[1, 3] = np.nan; bad[3, 9] = -1
np.save("bad.npy", bad)
np.save("big_endian.npy", a.astype(">f8"))
np.save("integers.npy", np.ones((3, 26), dtype=int))
np.save("fortran.npy", np.asfortranarray(a))
np.save("narrow.npy", a[:, :25])
np.save("flat.npy", a.ravel())
with open("f8.npy", "rb") as f: data = f.read()
open("cut.npy", "wb").write(data[:-8])
open("short.npy", "wb").write(data[:40])
open("other.npy", "wb").write(b"id,r1x\n" * 20)
with open("version2.npy", "wb") as f: np.lib.format.write_array(f, a, version=(2, 0))
PYTHON
python make.py "$DATA/collisions-204.csv"
carom resolve --solver euler -o csv.csv "$DATA/collisions-204.csv"
for name in f8 version2; do
  try carom resolve --solver euler -o out.npy $name.npy
  cat > same.py << 'PYTHON'
import csv, numpy as np
out = np.load("out.npy")
text = np.array([[float(x) for x in row[1:13]] for row in list(csv.reader(open("csv.csv")))[1:]])
print(out.dtype, out.shape, "same as CSV" if out.tobytes() == text.tobytes() else "differs")
PYTHON
  python same.py
done
try carom resolve --solver euler -o single.npy f4.npy
python -c 'import numpy as np; a, b = np.load("out.npy"), np.load("single.npy"); print(b.dtype, b.shape, np.abs(a - b).max() < 0.5)'
try carom resolve --solver euler --precision double -o wide.npy f4.npy
python -c 'import numpy as np; a = np.load("wide.npy"); print(a.dtype, a.shape)'
try carom resolve --solver euler --precision single -o narrow_out.npy f8.npy
python -c 'import numpy as np; a, b = np.load("single.npy"), np.load("narrow_out.npy"); print(b.dtype, (a == b).all())'
try carom resolve --solver euler -o from_csv.npy "$DATA/collisions-204.csv"
cmp from_csv.npy out.npy && echo "CSV to array: same"
carom resolve --solver euler f8.npy | cut -d, -f2- > a
cut -d, -f2- csv.csv | cmp - a && echo "array to CSV: same"
try carom resolve -o empty_out.npy empty.npy
python -c 'import numpy as np; print(np.load("empty_out.npy").shape)'
try carom resolve -o bad_out.npy bad.npy
python -c 'import numpy as np; print(np.isnan(np.load("bad_out.npy")).all(axis=1))'
for name in big_endian integers fortran narrow flat cut short other missing; do
  try carom resolve -o refused.npy $name.npy
done
ls refused.npy* 2> /dev/null || echo "nothing written"
# A shape that wraps around to the right one.
python -c "
text = b\"{'descr': '<f8', 'fortran_order': False, 'shape': (5, -18446744073709551590), }\".ljust(117) + b'\n'
open('wrapped.npy', 'wb').write(b'\x93NUMPY\x01\x00' + len(text).to_bytes(2, 'little') + text + bytes(5 * 26 * 8))"
try carom resolve -o /dev/null wrapped.npy
