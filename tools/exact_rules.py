"""Prints the fixed matrices of the exact solvers from 50 digits: of the patient one, of the swift one and of lanes. Needs mpmath;
what it prints is kept in the tree:

    python3 tools/exact_rules.py patient > src/exact_rules.h
    python3 tools/exact_rules.py swift > src/swift/rules.h
    python3 tools/exact_rules.py lanes > src/batch/arc_rules.h
    cmake --build build --target format

gauss rules: Gauss-Legendre nodes x on [0, 1], integrals of the Lagrange basis up to each node.
stick rules: nodes lambda of the Gauss rule for the weight lambda^4 on [0, 1]; integrals of lambda^4 times the basis from each node
up to 1, and 2 node^2 times those of the basis over lambda^3 (the equation of W). Lanes take the latter without node^2 (the
equation of T), and polynomials in powers of 2 x - 1, whose coefficients stay small enough for single precision; the swift solver's longest
ones are sums of Chebyshev polynomials of 2 x - 1, whose coefficients stay smaller yet."""
import sys

from mpmath import mp, mpf, matrix, polyroots

mp.dps = 50


def times(a, b):
    r = [mpf(0)] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            r[i + j] += x * y
    return r


def gauss_nodes(n, w):
    """Zeros of the monic polynomial of degree n orthogonal on [0, 1] for the weight x^w."""
    A, b = matrix(n, n), matrix(n, 1)
    for i in range(n):
        for j in range(n):
            A[i, j] = mpf(1) / (i + j + w + 1)
        b[i] = -mpf(1) / (i + n + w + 1)
    c = mp.lu_solve(A, b)
    return sorted(r.real for r in polyroots([mpf(1)] + [c[n - 1 - i] for i in range(n)], maxsteps=500, extraprec=300))


def basis(nodes):
    out = []
    for j, x in enumerate(nodes):
        c = [mpf(1)]
        for k, y in enumerate(nodes):
            if k != j:
                c = [v / (x - y) for v in times(c, [-y, mpf(1)])]
        out.append(c)
    return out


def integral(c, w, a, b):
    """Integral of sum c_m s^m times s^w from a to b."""
    t = mpf(0)
    for m, v in enumerate(c):
        e = m + w + 1
        t += v * (mp.log(b / a) if e == 0 else (b ** e - a ** e) / e)
    return t


def centred(c):
    """The polynomial sum c_m x^m in powers of 2 x - 1."""
    out, power = [mpf(0)] * len(c), [mpf(1)]
    for v in c:
        for i, x in enumerate(power):
            out[i] += v * x
        power = times(power, [mpf(1) / 2, mpf(1) / 2])
    return out


def pairs(row):
    """A row of src/exact.c: nodes two by two."""
    text = [mp.nstr(v, 17, min_fixed=-4, max_fixed=4) for v in row]
    return "{ " + ", ".join("{ %s, %s }" % (text[i], text[i + 1]) for i in range(0, len(text), 2)) + " }"


def floats(row):
    text = [mp.nstr(v, 10, min_fixed=-4, max_fixed=4) for v in row]
    return "{ " + ", ".join((t if "." in t or "e" in t else t + ".0") + "f" for t in text) + " }"


def rule(n, kind, lanes):
    numbers = floats if lanes else pairs
    powers = centred if lanes else list
    rows = lambda M: "{ " + ",\n              ".join(numbers(r) for r in M) + " }"
    across = lambda M: [[r[m] for r in M] for m in span]
    one, zero, span = mpf(1), mpf(0), range(n)
    if kind == "gauss":
        x = gauss_nodes(n, 0)
        L = basis(x)
        total = turn = [[integral(L[j], 0, zero, x[k]) for k in span] for j in span]
        whole = [integral(L[j], 0, zero, one) for j in span]
        part = [powers([L[j][m] / (m + 1) for m in span]) for j in span]
    else:
        x = list(reversed(gauss_nodes(n, 4)))
        L = basis(x)
        total = [[integral(L[j], 4, x[k], one) for k in span] for j in span]
        turn = [[2 * (1 if lanes else x[k] ** 2) * integral(L[j], -3, x[k], one) for k in span] for j in span]
        whole = [integral(L[j], 4, zero, one) for j in span]
        part = [powers([L[j][m] / (m + 5) for m in span]) for j in span]
    top = [L[j][n - 1] for j in span]
    most = max(abs(t) for t in top)
    fields = [("node", numbers(x))]
    if kind == "stick":
        fields.append(("away", numbers([-mp.log(v) for v in x])))
    fields += [("sum", rows(total)), ("turn", rows(turn)), ("all", numbers(whole)), ("part", rows(across(part))),
               ("tail", numbers([t / most for t in top]))]
    if kind == "gauss":
        fields += [("last", numbers([sum(L[j]) for j in span])),
                   ("bend", numbers([sum(m * L[j][m] for m in range(1, n)) for j in span])),
                   ("curl", numbers([sum(m * (m - 1) * L[j][m] for m in range(2, n)) for j in span]))]
    elif lanes:
        fields += [("basis", rows(across([centred(L[j]) for j in span])))]
    return "static const rule %s_%d = {\n" % (kind, n) + "".join("    .%-4s = %s,\n" % f for f in fields) + "};\n"


def chebyshev(c):
    """The polynomial sum c_m x^m as a sum of Chebyshev polynomials of 2 x - 1."""
    n, power, out = len(c), [mpf(1)] + [mpf(0)] * (len(c) - 1), [mpf(0)] * len(c)
    for v in centred(c):
        out = [o + v * p for o, p in zip(out, power)]
        power = [(power[1] / 2 if n > 1 else 0)] + [(power[m - 1] * (2 if m == 1 else 1) + (power[m + 1] if m + 1 < n else 0)) / 2
                                                   for m in range(1, n)]
    return out


def quads(rows):
    """Rows of 4 n numbers as one array of quads."""
    text = [floats(r[i:i + 4]) for r in rows for i in range(0, len(r), 4)]
    return "{ " + ",\n    ".join(text) + " }"


def swift_rule(n, kind):
    one, zero, span = mpf(1), mpf(0), range(n)
    across = lambda M: [[r[m] for r in M] for m in span]
    if kind == "gauss":
        x = gauss_nodes(n, 0)
        L = basis(x)
        fields = [("node", [x]), ("sum", [[integral(L[j], 0, zero, x[k]) for k in span] for j in span]),
                  ("all", [[integral(L[j], 0, zero, one) for j in span]]),
                  ("part", across([[L[j][m] / (m + 1) for m in span] for j in span])),
                  ("last", [[sum(L[j]) for j in span]]),
                  ("bend", [[sum(m * L[j][m] for m in range(1, n)) for j in span]])]
    else:
        x = list(reversed(gauss_nodes(n, 4)))
        L = basis(x)
        most = max(abs(L[j][n - 1]) for j in span)
        fields = [("node", [x]), ("away", [[-mp.log(v) for v in x]]),
                  ("sum", [[integral(L[j], 4, x[k], one) for k in span] for j in span]),
                  ("turn", [[2 * x[k] ** 2 * integral(L[j], -3, x[k], one) for k in span] for j in span]),
                  ("all", [[integral(L[j], 4, zero, one) for j in span]]),
                  ("part", across([chebyshev([L[j][m] / (m + 5) for m in span]) for j in span])),
                  ("basis", across([chebyshev(L[j]) for j in span])), ("tail", [[L[j][n - 1] / most for j in span]])]
    name = "%s_%d" % (kind, n)
    text = "".join("static const quad %s_%s[] = %s;\n" % (name, f, quads(rows)) for f, rows in fields)
    return text + "static const %s_rule %s = { %s };\n" % (kind, name, ", ".join("%s_%s" % (name, f) for f, _ in fields))


what = sys.argv[1]
if what == "swift":
    print("/* The rules of impulse_arc.h and stick_arc.h, printed by tools/exact_rules.py. */")
    for n, kind in ((4, "gauss"), (4, "stick"), (8, "stick")):
        print(swift_rule(n, kind), end="")
else:
    lanes = what == "lanes"
    print("/* The rules of %s, printed by tools/exact_rules.py. */" % ("arcs.h" if lanes else "exact.c"))
    for n, kind in ((2, "gauss"), (4, "gauss"), (6, "gauss"), (4, "stick"), (6, "stick")) if lanes else ((6, "gauss"), (6, "stick")):
        print(rule(n, kind, lanes), end="")
