"""refusals PROGRAM: gives each option of each command a wrong value. The message must be one line of
at most 160 characters that begins with the option and the value in quotes, and says what to try. Prints
what is not so.
"""

import re
import subprocess
import sys

LONGEST = 160
WRONG = "no such"
ANY_TEXT = {"data", "id", "output"}  # options that take any text
LAYOUT = {"--cue": "0.6,0.8", "--balls": "0.5,1.6:0.9,1.2"}
SHOTS = {"shoot", "ways"}  # commands that can use a layout
NEEDS = {"via": ["--pocket", "1:foot-left"]}

program = sys.argv[1]


def run(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([program, *arguments], capture_output=True, text=True, check=False)


def options_of(command: str) -> list[str]:
    listed = run(command, "--complete", "x", "--").stdout.split()
    return [option.removeprefix("--") for option in listed]


def context_of(command: str, option: str) -> list[str]:
    """Options that a late complaint needs."""
    if command not in SHOTS:
        return []
    layout = [word for pair in LAYOUT.items() if pair[0] != f"--{option}" for word in pair]
    return layout + NEEDS.get(option, [])


checked = 0
for command in run("--complete").stdout.split():
    for option in options_of(command):
        if option in ANY_TEXT:
            continue
        arguments = [*context_of(command, option), f"--{option}={WRONG}"]
        said = run(command, *arguments)
        message = said.stderr.removesuffix("\n")
        checked += 1
        faults = []
        if said.returncode != 2 or said.stdout:
            faults.append(f"exit code {said.returncode}")
        if not message.startswith(f"carom: --{option} '{WRONG}': "):
            faults.append("does not begin with the option and its value")
        if "\n" in message or len(message) > LONGEST:
            faults.append(f"{len(message)} characters, {message.count(chr(10)) + 1} lines")
        if not re.search(r"; (try|give) \S", message):
            faults.append("suggests nothing")
        if faults:
            print(f"{command} --{option}: {', '.join(faults)}: {message}")
print("more than 200 options:", checked > 200)
