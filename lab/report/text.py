"""Numbers as the page writes them; NA for what is not known."""

import math


def of(format, x):
    """printf's format, "%.2f"."""
    return "NA" if math.isnan(x) else format % x


def general(x, digits):
    return of(f"%.{digits}g", x)


def count(x):
    """Whole, grouped by thousands."""
    return "NA" if math.isnan(x) else f"{x:,.0f}"


def nanoseconds(x):
    """Grouped by thousands, or with four digits."""
    return count(x) if x >= 1000.0 else general(x, 4)


def spread(x):
    """Two digits or, from a hundred, whole and grouped by thousands."""
    return count(x) if x >= 100.0 else general(x, 2)


def ratio(x):
    """Two decimals or, from a hundred, whole."""
    return of("%.2f" if x < 100.0 else "%.0f", x)


def percent(x):
    """A share, "12.3 %"; nothing where there is none."""
    return "" if math.isnan(x) else f"{100.0 * x:.1f} %"
