"""Reads a solved three-ball-chain job (JSON) and sets it beside the paper and the reference.

The reference was solved on its own, to 1e-9. The paper stops its iteration at an error of 1 % and
takes the restitution at the largest force instead of the largest deformation.
"""

import json
import sys

PAPER_RESTITUTION = {"B1-B2": 0.8067, "B2-B3": 0.7059}
REFERENCE_MU = {"B1-B2": 2.259378079e8, "B2-B3": 4.563828953e8}
REFERENCE_VELOCITY = {"B1": -0.003731206344, "B2": 0.048726255138, "B3": 0.155004951207}


def main():
    job = json.load(sys.stdin)
    print("\nThe ledger beside the paper (section 6.1) and an independent solution")
    print(f"  {'contact':8} {'ε asked':>8} {'ε here':>12} {'ε paper':>8}"
          f" {'μ here':>16} {'μ reference':>16} {'difference':>11}")
    worst = 0.0
    for cycle in job["cycles"]:
        name, mu = cycle["contact"], cycle["mu"]
        difference = mu / REFERENCE_MU[name] - 1
        worst = max(worst, abs(difference))
        print(f"  {name:8} {cycle['restitution_in']:8.4f} {cycle['restitution_out']:12.9f}"
              f" {PAPER_RESTITUTION[name]:8.4f} {mu:16.9e} {REFERENCE_MU[name]:16.9e}"
              f" {difference:11.1e}")
    print(f"  {'body':8} {'v here, m/s':>21} {'v reference, m/s':>23} {'difference':>31}")
    for body in job["final_bodies"]:
        name, velocity = body["name"], body["velocity_m_per_s"]
        difference = velocity - REFERENCE_VELOCITY[name]
        worst = max(worst, abs(difference))
        print(f"  {name:8} {velocity:21.12f} {REFERENCE_VELOCITY[name]:23.12f}"
              f" {difference:31.1e}")
    if worst > 1e-7:
        sys.exit("compare-with-paper: this is not the reference solution")


main()
