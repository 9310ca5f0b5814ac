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
from matplotlib.patches import Circle, Rectangle

import carom

BLUE, ORANGE, GREEN, RED, PURPLE, SKY = "#0072b2", "#e69f00", "#009e73", "#d55e00", "#aa4499", "#56b4e9"
INK, GREY, PALE = "#222222", "#8c8c8c", "#d9d9d9"
CLOTH, RAIL = "#e9f2ec", "#b9c9bf"


def start(columns: int, size: tuple[float, float], **more: Any) -> tuple[Figure, list[Axes]]:
    """A figure with panels side by side."""
    plt.rcParams.update(
        {
            "font.family": "DejaVu Sans",
            "font.size": 9.5,
            "axes.titlesize": 10.5,
            "axes.titleweight": "bold",
            "axes.titlelocation": "left",
            "axes.titlepad": 9,
            "axes.edgecolor": GREY,
            "axes.labelcolor": INK,
            "axes.spines.top": False,
            "axes.spines.right": False,
            "axes.grid": True,
            "grid.color": "#ececec",
            "xtick.color": GREY,
            "ytick.color": GREY,
            "xtick.labelcolor": INK,
            "ytick.labelcolor": INK,
            "text.color": INK,
            "lines.linewidth": 1.8,
            "svg.hashsalt": "carom",
            "savefig.facecolor": "white",
        }
    )
    figure, axes = plt.subplots(1, columns, figsize=size, layout="constrained", squeeze=False, **more)
    figure.get_layout_engine().set(w_pad=0.08, h_pad=0.06, wspace=0.04)
    return figure, list(axes[0])


def save(figure: Figure, out: str) -> None:
    """Write the picture, .svg or .png by its name; the same bytes from the same numbers."""
    figure.savefig(out, dpi=150, metadata={"Date": None} if out.endswith(".svg") else None)
    plt.close(figure)
    print(f"wrote {out}")


def draw_table(axes: Axes, table: carom.Table) -> None:
    """The table from above, its long side across the page: x of the page is y of the table, y of the page is -x."""
    margin = 0.06
    outside = (table.length + 2 * margin, table.width + 2 * margin)
    axes.add_patch(Rectangle((-margin, -table.width - margin), *outside, color=RAIL, lw=0, zorder=0))
    axes.add_patch(Rectangle((0, -table.width), table.length, table.width, color=CLOTH, lw=0, zorder=0))
    for pocket in table.pockets:
        axes.add_patch(Circle((pocket["centre"][1], -pocket["centre"][0]), pocket["radius"], color="#555555", zorder=1))
    axes.set_aspect("equal")
    axes.set_xlim(-margin - 0.03, table.length + margin + 0.03)
    axes.set_ylim(-table.width - margin - 0.03, margin + 0.03)
    axes.grid(False)
    axes.set_axis_off()
