"""What the pictures of all examples share: colours, sizes of letters, and how a file is written.

Colours are those of Okabe and Ito, which those who see red and green alike tell apart too.
"""

from __future__ import annotations

from typing import Any

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

BLUE, ORANGE, GREEN, RED, PURPLE = "#0072b2", "#e69f00", "#009e73", "#d55e00", "#aa4499"
INK, GREY, PALE = "#222222", "#8c8c8c", "#d9d9d9"


def start(columns: int, size: tuple[float, float], **more: Any) -> tuple[Figure, list[Axes]]:
    """A figure with panels side by side."""
    plt.rcParams.update({
        "font.family": "DejaVu Sans", "font.size": 9.5, "axes.titlesize": 10.5, "axes.titleweight": "bold", "axes.titlelocation": "left",
        "axes.titlepad": 9, "axes.edgecolor": GREY, "axes.labelcolor": INK, "axes.spines.top": False, "axes.spines.right": False,
        "axes.grid": True, "grid.color": "#ececec", "xtick.color": GREY, "ytick.color": GREY, "xtick.labelcolor": INK,
        "ytick.labelcolor": INK, "text.color": INK, "lines.linewidth": 1.8, "svg.hashsalt": "carom", "savefig.facecolor": "white",
    })  # fmt: skip
    figure, axes = plt.subplots(1, columns, figsize=size, layout="constrained", squeeze=False, **more)
    figure.get_layout_engine().set(w_pad=0.08, h_pad=0.06, wspace=0.04)
    return figure, list(axes[0])


def save(figure: Figure, out: str) -> None:
    """Write the picture, .svg or .png by its name; the same bytes from the same numbers."""
    figure.savefig(out, dpi=150, metadata={"Date": None} if out.endswith(".svg") else None)
    plt.close(figure)
    print(f"wrote {out}")
