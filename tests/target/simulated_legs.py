# SPDX-License-Identifier: Apache-2.0
"""What the simulation's timer does with a pair and a duty (docs/reference/model.md 3 and 11), and how far a chip's edges are from it."""
import itertools

from tim1 import LOWER, UPPER
from timed_chip import BY_UPPER, COMPLEMENTARY, DEAD, HARD, OFF, PERIOD


def sides(wanted, leg, pulse):
    """Of the simulation (docs/reference/model.md 3): None, UPPER or LOWER."""
    if wanted is OFF:
        return None
    (source, sink), (chopping, chopped), _ = wanted
    if leg not in (source, sink):
        return None
    own, other = (UPPER, LOWER) if leg == source else (LOWER, UPPER)
    chops = chopping == HARD or (leg == source) == (chopped == BY_UPPER)
    if pulse or not chops:
        return own
    return other if chopping == COMPLEMENTARY else None


class Simulated:
    """The simulation's legs: off at once, on no earlier than the dead time behind the other's turn-off command."""

    def __init__(self):
        self.edges, self.told, self.free = [], [None] * 3, [[0, 0] for _ in range(3)]
        self.pending = []

    def tell(self, t, leg, side, entered=False):
        was = self.told[leg]
        if side == was:
            return
        self.flush(t)
        if was is not None:
            self.edges.append((t, leg, was, False))
            self.pending = [p for p in self.pending if p[1] != leg]
            self.free[leg][1 - was] = t + DEAD
        self.told[leg] = side
        if side is not None:
            self.pending.append((max(t, self.free[leg][side]), leg, side, True))

    def flush(self, t):
        due = sorted(p for p in self.pending if p[0] <= t)
        self.pending = [p for p in self.pending if p[0] > t]
        self.edges += due

    def wake(self, t):
        self.free = [[t + DEAD, t + DEAD] for _ in range(3)]


def differing(chip, simulated, begin, periods):
    """The clocks of each period in which a gate is not what the simulation's is: the worst gate's, of the worst period."""
    worst = 0
    for leg, gate in itertools.product(range(3), range(2)):
        of_gate = sorted([(t, 0, on) for t, x, g, on in chip if (x, g) == (leg, gate)] +
                         [(t, 1, on) for t, x, g, on in simulated if (x, g) == (leg, gate)], key=lambda e: e[0])
        level, since, differs = [False, False], begin, [0] * (periods + 1)
        for t, which, on in [*of_gate, (begin + periods * PERIOD, 0, False)]:
            while level[0] != level[1] and since < t:
                period = max(0, (since - begin) // PERIOD)
                until = min(t, begin + (period + 1) * PERIOD)
                differs[min(period, periods)] += until - since
                since = until
            since = max(since, t)
            level[which] = on
        worst = max(worst, *differs[:periods])
    return worst


def counts(duty):
    return min(int(duty * PERIOD), PERIOD - 108)
