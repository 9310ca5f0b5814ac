"""defaults.py CAROM DATA: what the help names as the default of an option is what runs without it.

Each option whose help ends with "(default VALUE" is given VALUE, in the first of the subcommand's
lines below that takes it, and the output must be that of the line alone.
"""

import re
import subprocess
import sys
import tempfile

CAROM = sys.argv[1]
POT = "--cue 0.6,0.8 --balls 0.8,1.9"
LINES = {
    "shoot": [f"{POT} --at-ball 1", POT, "--balls nineball"],
    "ways": [
        f"{POT} --rails 1 --scan 2000",
        POT,
        "--balls nineball --ball 1 --rails 0 --scan 2000",
    ],
    "plan": [f"{POT} --rules potting --shots 100", "--balls 8=0.8,1.9:1=0.4,0.6 --shots 100"]
    + ["--rules nineball --balls nineball --shots 100", f"{POT} --rules nineball --shots 100"],
    "break": ["--racks 20", ""],
    "match": ["--shots 100 --strokes 1", "--strokes 1"],
    "odds": ["--players 600,500"],
    "practice": ["GAME"],
    "rating": ["RESULTS"],
    "calibrate": ["--read 4.7,5.6,5.6"],
    "hit": ["", "--solver euler", "--friction 0.06"],
    "rail": ["", "--model han", "--model euler"],
    "record": ["SHOTS"],
    "replay": ["RECORDING"],
    "resolve": ["COLLISIONS", "--solver euler COLLISIONS", "--cushion IMPACTS"]
    + ["--cushion --model euler IMPACTS"],
}


def run(words, folder):
    done = subprocess.run(
        [CAROM, *words], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    return done.returncode, done.stdout


def defaults(command):
    """Option and default, for each option of the help that names a value."""
    text = run([command, "--help"], ".")[1]
    rows = re.split(r"^  (?:-\w, )?--(?=[a-z])", text, flags=re.M)[1:]
    found = []
    for row in rows:
        usual = re.search(r"\(default ([^:;)]+)[;)]", re.sub(r"\s+", " ", row))
        if usual:
            found.append((re.match(r"[a-z-]+", row)[0], usual[1]))
    return found


def main(data, work):
    files = {
        "SHOTS": f"{data}/break-nineball.jsonl",
        "COLLISIONS": f"{data}/collisions-204.csv",
        "IMPACTS": f"{data}/cushion-mathavan2010.csv",
        "RECORDING": f"{work}/recording.jsonl",
        "RESULTS": f"{work}/results.csv",
        "GAME": f"{work}/game.jsonl",
    }
    assert run(["record", files["SHOTS"], "-o", files["RECORDING"]], work)[0] == 0
    with open(files["RESULTS"], "w") as results:
        results.write("500,3,2\n")
    played = run(["match", "--shots", "100", "--players", "300,300", "-o", files["GAME"]], work)
    assert played[0] == 0
    count, wrong = 0, []
    for command, lines in LINES.items():
        for name, value in defaults(command):
            taken = False
            for line in lines:
                words = [command, *(files.get(word, word) for word in line.split())]
                if f"--{name}" in words:
                    continue
                code, came = run([*words, f"--{name}={value}"], work)
                if code == 2:
                    continue
                taken = True
                if (code, came) != run(words, work):
                    wrong.append(f"carom {command} {line}: --{name} {value} is not its default")
                break
            if not taken:
                wrong.append(f"carom {command}: no line takes --{name} {value}")
            count += 1
    if wrong:
        sys.exit("\n".join(wrong))
    assert count >= 40, count
    print(f"{count} defaults are those that run")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        main(sys.argv[2], folder)
