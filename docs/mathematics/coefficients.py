"""Derives the polynomials of runtime/rddl/values/math/*.hpp. Needs mpmath.

Weighted least squares at Chebyshev points, which is minimax up to a fraction of a bit. A coefficient
is rounded to double, or to float, the lowest first; those above it are then derived again and make up for it.
Prints them, lowest first, and the greatest weighted error that is left.
"""
import struct

import mpmath as mp

mp.mp.dps = 60


def to_float(c):
    return struct.unpack("f", struct.pack("f", float(c)))[0]


def fit(points, targets, weights, first, count):
    """The coefficients of x^first ... x^(first + count - 1)."""
    rows = [[w * x ** (first + i) for i in range(count)] for x, w in zip(points, weights)]
    a = mp.matrix(rows)
    b = mp.matrix([w * t for w, t in zip(weights, targets)])
    return list(mp.lu_solve(a.T * a, a.T * b))


def show(name, target, weight, low, high, count, exact=(), rounded=float):
    """The error is weight(x) (p(x) - target(x)) on [low, high]."""
    middle, radius = (low + high) / 2, (high - low) / 2
    points = [middle - radius * mp.cos(mp.pi * (i + mp.mpf(1) / 2) / 200) for i in range(200)]
    weights = [weight(x) for x in points]
    rest = [target(x) for x in points]
    coefficients = []
    for done in range(count):
        c = exact[done] if done < len(exact) else fit(points, rest, weights, done, count - done)[0]
        coefficients.append(rounded(c))
        rest = [t - coefficients[done] * x**done for x, t in zip(points, rest)]
    error = max(abs(w * t) for w, t in zip(weights, rest))
    print(f"{name}: error 2^{float(mp.log(error, 2)):.1f}")
    for c in coefficients:
        print(f"    {c!r},")


margin = mp.mpf("1.0001")  # for arguments that rounding puts into the next interval

# e^r = 1 + r + r^2 p(r); the error is relative to e^r.
end = mp.log(2) / 2 * margin
show("exp", lambda r: (mp.expm1(r) - r) / r**2, lambda r: r**2 / mp.exp(r), -end, end, 11, [0.5])

# ln((1 + s) / (1 - s)) = 2 s + s z (2/3 + z p(z)) with z = s^2; the error is relative to the whole.
end = ((mp.sqrt(2) - 1) / (mp.sqrt(2) + 1)) ** 2 * margin
show("ln", lambda z: (2 * mp.atanh(mp.sqrt(z)) / mp.sqrt(z) - 2 - z * 2 / 3) / z**2,
     lambda z: z**2 / 2, 0, end, 7)

# sin r = r + r z p(z), cos r = 1 - z / 2 + z^2 p(z) with z = r^2.
end = (mp.pi / 4) ** 2 * margin
show("sin", lambda z: (mp.sin(mp.sqrt(z)) / mp.sqrt(z) - 1) / z, lambda z: z, 0, end, 6)
show("cos", lambda z: (mp.cos(mp.sqrt(z)) - 1 + z / 2) / z**2, lambda z: z**2, 0, end, 6)

# atan t = t + t z p(z) with z = t^2, up to tan(pi / 8); floats need fewer terms.
end = mp.tan(mp.pi / 8) ** 2 * margin
for name, count in (("atan", 11), ("atan, floats", 6)):
    show(name, lambda z: (mp.atan(mp.sqrt(z)) / mp.sqrt(z) - 1) / z, lambda z: z, 0, end, count)

# asin s = s + s z p(z) with z = s^2, up to 1/2.
end = mp.mpf(1) / 4 * margin
show("asin", lambda z: (mp.asin(mp.sqrt(z)) / mp.sqrt(z) - 1) / z, lambda z: z, 0, end, 13)

# The logarithm to base 2 of (1 + s) / (1 - s) = s p(z) with z = s^2.
end = ((mp.sqrt(2) - 1) / (mp.sqrt(2) + 1)) ** 2 * margin
show("log 2, floats", lambda z: 2 * mp.atanh(mp.sqrt(z)) / mp.sqrt(z) / mp.log(2),
     lambda z: mp.log(2) / 2, 0, end, 6)

# 2^g = 1 + g p(g); the error is relative to 2^g.
end = mp.mpf(1) / 2 * margin
show("exp 2, floats", lambda g: (mp.mpf(2)**g - 1) / g, lambda g: g / mp.mpf(2)**g, -end, end, 7)


def normal_quantile_over_q(w):
    """The normal quantile of p divided by q = p - 1/2, for w = -ln(4 p (1 - p))."""
    x = mp.sqrt(-mp.expm1(-w))  # 2 q
    rest = mp.exp(-w) / (1 + x)  # 1 - x
    z = mp.findroot(lambda z: mp.log(mp.erfc(z)) - mp.log(rest), mp.erfinv(min(x, mp.mpf("0.99999"))))
    return 2 * mp.sqrt(2) * z / x


# Normal quantiles of floats, up to w = 5 and up to 16.
show("quantile, floats", lambda t: normal_quantile_over_q(t + mp.mpf("2.5")),
     lambda t: 1 / normal_quantile_over_q(t + mp.mpf("2.5")), mp.mpf("-2.5"), mp.mpf("2.5"), 10,
     rounded=to_float)
show("quantile's tail, floats", lambda t: normal_quantile_over_q((t + 3) ** 2),
     lambda t: 1 / normal_quantile_over_q((t + 3) ** 2), mp.sqrt(5) - 3, mp.mpf(1), 9,
     rounded=to_float)


def show_constant(name, value, bits):
    """A sum of doubles, each but the last with as many bits as given."""
    for count in bits:
        part = mp.floor(mp.ldexp(value, count - mp.frexp(value)[1]) + mp.mpf(1) / 2)
        part = mp.ldexp(part, mp.frexp(value)[1] - count)
        print(f"{name}: {float(part).hex()}")
        value -= part


show_constant("ln 2", mp.log(2), [42, 53])
show_constant("pi / 2", mp.pi / 2, [29, 29, 29, 53])
show_constant("1 / ln 2", 1 / mp.log(2), [53])
show_constant("2 / pi", 2 / mp.pi, [53])
show_constant("pi / 2", mp.pi / 2, [53, 53])
show_constant("pi / 4", mp.pi / 4, [53, 53])
show_constant("atan(1/2)", mp.atan(mp.mpf(1) / 2), [53, 53])
