#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""cases.py PROGRAM FOLDER   small inputs as people's tools write them: what is expected of each, and what the program does.

FOLDER holds cases.tsv: file, flags after `swarmfit describe`, expectation, why. "ok key=value ...": exit 0, and describe --json says so;
"refuse": exit 2 and one line; "warn": exit 0 and a note or suspicion; "a|b": either. Exit code 1 when one fails.
"""
import json
import shlex
import subprocess
import sys


def outcome(program, folder, file, flags):
    command = [program, "describe", f"{folder}/{file}", *shlex.split(flags), "--json"]
    done = subprocess.run(command, capture_output=True, text=True)
    summary = json.loads(done.stdout) if done.returncode == 0 else {}
    return done.returncode, summary, done.stderr.strip()


def differs(summary, key, wanted):
    seen = summary["data"]["dt"] if key == "dt" else summary[key]
    return abs(seen / float(wanted) - 1) > 1e-3


def verdict(expectation, code, summary, message):
    words = expectation.replace("|", " ").split()
    kinds = [word for word in words if "=" not in word]
    numbers = [word.split("=") for word in words if "=" in word]
    if code == 2 and "refuse" in kinds:
        return "\n" not in message and ";" in message
    if code != 0 or kinds == ["refuse"] or any(differs(summary, *number) for number in numbers):
        return False
    return "ok" in kinds or bool(summary["data"]["notes"] or summary["suspicions"])


def main(program, folder):
    failed = 0
    for line in open(f"{folder}/cases.tsv", encoding="utf-8"):
        file, flags, expectation, _ = line.rstrip("\n").split("\t")
        code, summary, message = outcome(program, folder, file, flags)
        good = verdict(expectation, code, summary, message)
        failed += not good
        seen = f"tracks={summary['tracks']} frames={summary['frames']} dt={summary['data']['dt']:.6g}" if summary else message
        print(f"{'ok  ' if good else 'FAIL'} {file:40} {expectation:45} {seen}")
        for note in summary.get("data", {}).get("notes", []):
            print(f"{'':10}{note}")
    print(f"{failed} fail")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
