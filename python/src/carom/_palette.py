"""Written by tools/palette.py from data/palette.csv: colours and sizes of a table from above."""

from __future__ import annotations

CLOTH = {
    "pool": "#0a5568",
    "snooker": "#15592f",
    "carom": "#17508a",
}
CUSHION = {
    "pool": "#073d4b",
    "snooker": "#0f4022",
    "carom": "#103a63",
}
WOOD = {
    "pool": "#5f3721",
    "snooker": "#5f2814",
    "carom": "#3a2418",
}
PART = {
    "nose": "#06181d",
    "pocket": "#111111",
    "mark": "#e8dcc0",
    "text": "#ffffff",
    "aim": "#ffd166",
}
SIZE = {
    "margin": 0.05,
    "corner": 0.045,
    "bed_corner": 0.025,
    "nose": 0.01,
    "path": 0.0055,
    "diamond": 0.01,
    "diamond_width": 0.0075,
    "letters": 0.0184,
}
# the cue ball, 1 to 8, and others of snooker: of the ball, of its path, of its number
BALLS = {
    "white": ("#fbfaf5", "#ffffff", "#111111"),
    "yellow": ("#e3b505", "#faee26", "#111111"),
    "blue": ("#1446a0", "#75b2fb", "#ffffff"),
    "red": ("#c8102e", "#fc7460", "#ffffff"),
    "purple": ("#5b2a86", "#e4d3ff", "#ffffff"),
    "orange": ("#e8702a", "#fead10", "#111111"),
    "green": ("#12664f", "#b7f3a8", "#ffffff"),
    "maroon": ("#7a1f2b", "#cb8ba6", "#ffffff"),
    "black": ("#16181b", "#c0c0c0", "#ffffff"),
    "brown": ("#7b4a21", "#fead10", "#ffffff"),
    "pink": ("#e58fa5", "#cb8ba6", "#111111"),
}
