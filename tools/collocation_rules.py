"""Prints the quadrature rules of the collocation steps, computed with 50 digits.

Needs mpmath; what it prints is kept in the tree:

    python3 tools/collocation_rules.py ball_ball > core/src/ball_ball/quadrature.h
    python3 tools/collocation_rules.py contact_law > core/src/contact_law/quadrature.h
    tools/format

For contact_law: Gauss's rule of 8 nodes on [0, 1] in double precision, described in that file. For
ball_ball, in both precisions:

Gauss rules of n nodes on [0, 1], and one of Gauss and Jacobi for the weight (1 - x)^4, for steps to
stick; each has what the steps over its nodes need. With L_j the Lagrange basis on the nodes x_k:

    node[k]        x_k, ascending
    end[k], bend[k], third[k]   the first Taylor coefficients of the integral of L_k beyond 1: L_k,
                                L_k' / 2 and L_k'' / 6 at 1
    all[k]         integral of (the weight times) L_k over [0, 1]
    sum[j][k]      integral of (the weight times) L_j from 0 to x_k
    part[m][k]     integral of L_k from 0 to x, divided by x, as powers m of 2 x - 1, whose
                   coefficients stay small
    twice[m][k]    the integral of that integral from 0 to x, divided by x^2, as such powers
    powers[k][m]   part[m][k], to sum over k; for the rule to stick, with the weight: from x to 1,
                   divided by (1 - x)^5, as powers
                   of 1 - 2 x
    basis[k][m]    for the rule to stick: L_k as such powers
    turn[j][k]     for the rule to stick, with l = 1 - x, whose node is l_k: 2 l_k^2 times the
                   integral of L_j l^-3 from l_k to 1
    lambda[k], lambda_2[k], lambda_5[k], log[k], gone[k], gone_mean[k]   for the rule to stick: l,
        l^2, l^5, log l, 1 - l^6, 1 - m^6
                   with m = 2 l / (1 + l)
"""

import sys

from mpmath import matrix, mp, mpf, polyroots

mp.dps = 50


def times(a, b):
    product = [mpf(0)] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            product[i + j] += x * y
    return product


def gauss_nodes(n, w):
    """Zeros of the polynomial of degree n that is orthogonal on [0, 1] for the weight x^w."""
    A = matrix(n, n)
    b = matrix(n, 1)
    for i in range(n):
        for j in range(n):
            A[i, j] = mpf(1) / (i + j + w + 1)
        b[i] = -mpf(1) / (i + n + w + 1)
    c = mp.lu_solve(A, b)
    roots = polyroots([mpf(1)] + [c[n - 1 - i] for i in range(n)], maxsteps=500, extraprec=300)
    return sorted(root.real for root in roots)


def lagrange_basis(nodes):
    basis = []
    for x in nodes:
        c = [mpf(1)]
        for y in nodes:
            if y != x:
                c = [v / (x - y) for v in times(c, [-y, mpf(1)])]
        basis.append(c)
    return basis


def integral(c, w, a, b):
    """Of sum c_m x^m times x^w from a to b."""
    return sum(v * (b ** (m + w + 1) - a ** (m + w + 1)) / (m + w + 1) for m, v in enumerate(c))


def centred(c):
    """The polynomial sum c_m x^m in powers of 2 x - 1."""
    out, power = [mpf(0)] * len(c), [mpf(1)]
    for v in c:
        for i, x in enumerate(power):
            out[i] += v * x
        power = times(power, [mpf(1) / 2, mpf(1) / 2])
    return out


def text(row):
    numbers = [mp.nstr(v, 18, min_fixed=-4, max_fixed=4) for v in row]
    return "{" + ", ".join(t if "." in t or "e" in t else t + ".0" for t in numbers) + "}"


def print_rule(name, n, w):
    zero, unit, span = mpf(0), mpf(1), range(n)
    y = gauss_nodes(n, w)  # with a weight: 1 - x
    if w:
        y.reverse()
    L = lagrange_basis(y)
    part = [centred([v / (m + w + 1) for m, v in enumerate(c)]) for c in L]
    weighted_integral = (
        (lambda c, node: integral(c, w, node, unit))
        if w
        else (lambda c, node: integral(c, 0, zero, node))
    )
    print("static const %s_rule %s_%d = {" % ("stick" if w else "gauss", name, n))
    if not w:
        print("    .node = %s," % text(y))
        print("    .end = %s," % text([sum(c) for c in L]))
    if n == 4:
        print("    .bend = %s," % text([sum(m * v for m, v in enumerate(c)) / 2 for c in L]))
    if not w and n < 8:
        print(
            "    .third = %s,"
            % text([sum(m * (m - 1) * v for m, v in enumerate(c)) / 6 for c in L])
        )
    print("    .whole = %s," % text([integral(c, w, zero, unit) for c in L]))
    print(
        "    .sum = {%s}," % ",\n".join(text([weighted_integral(c, node) for node in y]) for c in L)
    )

    def by_node(rows):
        return ",\n".join(text([row[m] for m in span]) for row in rows)

    if not w and n < 8:
        twice = [centred([v / ((m + 1) * (m + 2)) for m, v in enumerate(c)]) for c in L]
        print("    .part = {%s}," % ",\n".join(text([p[m] for p in part]) for m in span))
        print("    .twice = {%s}," % ",\n".join(text([p[m] for p in twice]) for m in span))
    if n == 8 or w:
        print("    .powers = {%s}," % by_node(part))
    if w:

        def turn(c, node):
            return (
                2
                * node**2
                * sum(
                    v * (-mp.log(node) if m == 2 else (1 - node ** (m - 2)) / (m - 2))
                    for m, v in enumerate(c)
                )
            )

        mean = [2 * node / (1 + node) for node in y]
        print("    .basis = {%s}," % by_node([centred(c) for c in L]))
        print("    .turn = {%s}," % ",\n".join(text([turn(c, node) for node in y]) for c in L))
        print("    .lambda = %s," % text(y))
        print("    .lambda_2 = %s," % text([node**2 for node in y]))
        print("    .lambda_5 = %s," % text([node**5 for node in y]))
        print("    .log = %s," % text([mp.log(node) for node in y]))
        print("    .gone = %s," % text([1 - node**6 for node in y]))
        print("    .gone_mean = %s," % text([1 - node**6 for node in mean]))
    print("};")


def print_ball_ball():
    print('#include "ball_ball/carrier.h"\n')
    print("/* The compiler rounds the numbers to the precision of the build. */")
    print("#ifdef __clang__\n#pragma clang diagnostic push")
    print('#pragma clang diagnostic ignored "-Wimplicit-float-conversion"')
    print("#else\n#pragma GCC diagnostic push")
    print('#pragma GCC diagnostic ignored "-Wfloat-conversion"\n#endif\n')
    print_rule("gauss", 4, 0)
    print_rule("gauss", 6, 0)
    print_rule("gauss", 8, 0)
    print_rule("jacobi", 6, 4)
    print("#ifdef __clang__\n#pragma clang diagnostic pop")
    print("#else\n#pragma GCC diagnostic pop\n#endif")


def print_impact():
    zero, unit, x = mpf(0), mpf(1), gauss_nodes(8, 0)
    L = lagrange_basis(x)
    weight = [integral(c, 0, zero, unit) for c in L]
    highest = [15 * w * mp.legendre(7, 2 * node - 1) for w, node in zip(weight, x)]

    def text(row):
        return "{" + ", ".join(repr(float(v)) for v in row) + "}"

    row = "\n/* %s */\nstatic const double __attribute__((aligned(64))) %s = %s;"
    print("enum { NODES = 8 };")
    print(row % ("Nodes on [0, 1], and weights.", "NODE[NODES]", text(x)))
    print("static const double __attribute__((aligned(64))) WEIGHT[NODES] = %s;" % text(weight))
    print(
        row
        % (
            "Sum with the values at the nodes: the coefficient of the Legendre polynomial of degree 7.",
            "HIGHEST[NODES]",
            text(highest),
        )
    )
    at_end = [sum(c) for c in L]
    print(
        row % ("Sum with the values at the nodes: the value at 1.", "AT_END[NODES]", text(at_end))
    )
    sums = ",\n".join(text([integral(c, 0, zero, node) for node in x]) for c in L)
    print(
        row
        % (
            "[j][k]: integral of the Lagrange polynomial of node j from 0 to node k.",
            "INTEGRAL[NODES][NODES]",
            "{%s}" % sums,
        )
    )


room = sys.argv[1] if len(sys.argv) == 2 else ""
if room not in ("ball_ball", "contact_law"):
    sys.exit("usage: collocation_rules.py ball_ball|contact_law")
guard = "CAROM_SRC_%s_QUADRATURE_H" % room.upper()
print(
    "/* The quadrature rules of the collocation steps: see tools/collocation_rules.py, which printed\n"
    " * them. */"
)
print("#ifndef %s\n#define %s\n" % (guard, guard))
(print_ball_ball if room == "ball_ball" else print_impact)()
print("\n#endif")
