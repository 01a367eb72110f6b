#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Says "running", "success" or "failed" of a Slurm job, for snakemake: status.py JOB. Asks the
controller, which knows jobs for some minutes after their end, and then the accounting."""
import re
import subprocess
import sys

RUNNING = {"PENDING", "CONFIGURING", "RUNNING", "COMPLETING", "SUSPENDED", "REQUEUED", "REQUEUE_HOLD"}


def output_of(command):
    try:
        return subprocess.run(command, capture_output=True, text=True, timeout=60).stdout
    except (OSError, subprocess.TimeoutExpired):
        return ""


def state_of(job):
    match = re.search(r"JobState=([A-Z_]+)", output_of(["scontrol", "show", "job", job]))
    if match:
        return match.group(1)
    lines = output_of(["sacct", "-X", "-n", "-P", "-o", "State", "-j", job]).split()
    return lines[0].strip("+") if lines else "RUNNING"  # not known yet: asked again


state = state_of(sys.argv[1])
print("success" if state == "COMPLETED" else "running" if state in RUNNING else "failed")
