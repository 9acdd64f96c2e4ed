# SPDX-License-Identifier: GPL-3.0-or-later
"""Seeded faults: would the tests notice if the code were wrong?

mutate.py write NAME OUTPUT     writes the faulty header of a fault below the folder OUTPUT, to be included before the
                                true one; an error unless the text to be replaced occurs once
mutate.py check NAME PROGRAM    runs the test cases of a fault with the program that was compiled with it; an error
                                unless they fail
mutate.py list                  one line for each fault: its name, the source of its test, its header, and whether it is among
                                the few that every run of the tests looks at (quick) or not (slow)
mutate.py apply                 an error unless the text of every fault occurs once in its header
"""
import json
import pathlib
import resource
import subprocess
import sys

here = pathlib.Path(__file__).resolve().parent


def header_with(fault):
    """The text of the header, where the fault's occurs once."""
    text = (here.parents[1] / "include" / fault["header"]).read_text()
    if text.count(fault["text"]) != 1:
        sys.exit(f"{fault['name']}: its text occurs {text.count(fault['text'])} times in {fault['header']}")
    return text


def write(fault, output):
    text = header_with(fault)
    target = pathlib.Path(output) / fault["header"]
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(text.replace(fault["text"], fault["fault"]))


def limit_memory():
    """A fault may make a run go on for ever; 4 GB are ten times what the tests need."""
    resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))


def check(fault, program):
    # Catch2 itself says which test failed: a crash or an exception counts, a program that ran nothing does not.
    try:
        run = subprocess.run([program, fault["cases"]], capture_output=True, text=True, timeout=120, preexec_fn=limit_memory)
    except subprocess.TimeoutExpired:
        sys.exit(f"{fault['name']}: not caught, the test does not end: a time-out says nothing about what is wrong")
    if "No test" in run.stdout or run.returncode == 0:
        sys.exit(f"{fault['name']}: not caught\n{run.stdout}{run.stderr}")
    lines = [line for line in run.stdout.splitlines() if "FAILED" in line or "SIG" in line]
    print(f"{fault['name']}: caught. {fault['what']}\n  {lines[0] if lines else run.returncode}")


def main():
    faults = {fault["name"]: fault for fault in json.loads((here / "faults.json").read_text())}
    if len(sys.argv) == 2 and sys.argv[1] == "list":
        print("\n".join(f"{name} {fault['test']} {fault['header']} {'quick' if fault.get('quick') else 'slow'}" for name, fault in faults.items()))
    elif len(sys.argv) == 2 and sys.argv[1] == "apply":
        for fault in faults.values():
            header_with(fault)
    elif len(sys.argv) == 4 and sys.argv[1] in ("write", "check") and sys.argv[2] in faults:
        {"write": write, "check": check}[sys.argv[1]](faults[sys.argv[2]], sys.argv[3])
    else:
        sys.exit(__doc__)


main()
