"""What the report says on standard output at its end: the speedups in a table of a few columns."""

from .derive import default_config
from .tables import library_calls
from .text import of


def line(kernel, ns, speedup, says):
    return f"{kernel:<17} {of('%.0f' if ns >= 1000.0 else '%.1f', ns):>9} {of('%.2f' if speedup < 100.0 else '%.0f', speedup):>9}  {says}"


def lines(data):
    """The rungs, the library's single calls, and its batches with the highest instruction set, which comes last."""
    rungs, ladder = data["speedup"], data["ladder"]
    if not rungs.rows:
        return
    processor = rungs.note("processor") or "processor unknown"
    yield f"speedup over {rungs.rows[0]['kernel']}, {default_config(ladder)}, N = 1000, {processor}"
    yield f"{'kernel':<17} {'ns':>9} {'speedup':>9}  paper"
    for row in rungs.rows:
        yield line(row["kernel"], row.number("ns"), row.number("speedup"), row["paper_text"])
    for row in library_calls(ladder):
        yield line(row["kernel"], row.number("ns_median"), row.number("speedup"), "the library's")
    batches = [row for row in ladder.rows if row["config"] == "library" and row["isa"] != "scalar"]
    for row in batches:
        if row["isa"] == batches[-1]["isa"]:
            says = f"in batches, {row['isa']}, {row['precision']}, {row['threads']} thread{'' if row['threads'] == '1' else 's'}"
            yield line(row["kernel"], row.number("ns_median"), row.number("speedup"), says)
