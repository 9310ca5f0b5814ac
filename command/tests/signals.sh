# A signal that ends a run leaves the old file and nothing beside it, whichever signal it is; one that was ignored when the command
# began is ignored. A file whose folder may not be written, and another user's file, are as safe.
chmod 755 .. .
cp "$CAROM" carom
# The sanitizers have handlers of their own for some signals; here the command's are tested.
export ASAN_OPTIONS="handle_segv=0:handle_sigbus=0:handle_sigfpe=0:${ASAN_OPTIONS:-}"
python - << 'PYTHON'
import os, resource, signal, subprocess, time

rows = open(f"{os.environ['DATA']}/collisions-204.csv", "rb").read().splitlines(True)
OLD, ROOT = b"old\n", os.getuid() == 0
# By default the others stop a process, or do nothing; 32 and 33 belong to the C library.
others = "KILL STOP CHLD CONT TSTP TTIN TTOU URG WINCH".split()
ENDING = sorted(set(range(1, signal.SIGRTMAX + 1)) - {32, 33} - {getattr(signal, f"SIG{name}") for name in others})
resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def run(path, number=None, before=None, user=None):
    """Sends the signal once the output has been opened; the exit code, what stands in the folder and in the file, and the messages."""
    folder = os.path.dirname(path) or "."
    at_first = sorted(os.listdir(folder))
    with open(path, "wb") as file:
        file.write(OLD)
    os.chmod(path, 0o666)
    as_user = {"user": user, "group": user, "extra_groups": []} if user else {}
    command = subprocess.Popen(
        ["./carom", "resolve", "-o", path, "-"], stdin=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=before, **as_user
    )
    command.stdin.write(b"".join(rows[:6]))
    command.stdin.flush()
    # It opens the output when it has read the header.
    descriptors = f"/proc/{command.pid}/fd"
    while command.poll() is None and len(os.listdir(descriptors)) < 4:
        time.sleep(0.001)
    time.sleep(0.005)
    if number is not None:
        command.send_signal(number)
    try:
        _, messages = command.communicate(b"".join(rows[6:]) if number is None or before else None)
    except BrokenPipeError:
        messages = b""
    new = sorted(set(os.listdir(folder)) - set(at_first) - {os.path.basename(path)})
    return command.returncode, new, open(path, "rb").read(), messages.decode()


def is_old(seen, number):
    return seen[:3] == (-number, [], OLD)


def is_new(seen):
    return seen[:2] == (0, []) and len(seen[2].splitlines()) == len(rows)


print("ends the run, and the old file stays:", len(ENDING) >= 50, [n for n in ENDING if not is_old(run("kept.csv", n), n)])
ignored = lambda n: run("kept.csv", n, before=lambda: signal.signal(n, signal.SIG_IGN))
print("ignored, as nohup and & have it:", [n for n in ENDING if not is_new(ignored(n))])
blocked = lambda n: run("kept.csv", n, before=lambda: signal.pthread_sigmask(signal.SIG_BLOCK, {n}))
print("blocked:", [n for n in ENDING if not is_new(blocked(n))])

# Root may write everywhere: there the command runs as another user. Where there is no root, there is no other user's file.
os.mkdir("sealed", 0o755), os.mkdir("open", 0o777)
os.chmod("open", 0o777)
open("sealed/file.csv", "wb").close()
user = 65534 if ROOT else None
if not ROOT:
    os.chmod("sealed", 0o555)
for place in ("sealed/file.csv", "open/file.csv"):
    print(place, [n for n in ENDING if not is_old(run(place, n, user=user), n)], is_new(run(place, user=user)))
    same = os.stat(place)
    print("the file is the same one:", is_new(run(place, user=user)), os.stat(place).st_ino == same.st_ino or place == "open/file.csv" and not ROOT)


# A text that does not fit leaves the old file too.
def no_room():
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))


for place in ("kept.csv", "sealed/file.csv"):
    code, new, text, message = run(place, before=no_room, user=user if "/" in place else None)
    print(code, new, text == OLD, message.strip())
os.chmod("sealed", 0o755)
PYTHON
