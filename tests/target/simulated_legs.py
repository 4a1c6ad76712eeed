# SPDX-License-Identifier: Apache-2.0
"""The outputs of the simulation's timer for a pair and a duty (docs/reference/model.md 3 and 11), and the difference
between a chip's edges and these outputs."""
import itertools

from tim1 import LOWER, UPPER
from timed_chip import BY_UPPER, COMPLEMENTARY, DEAD, HARD, OFF, PERIOD


def sides(wanted, leg, pulse):
    """The switch of a leg that is on in the simulation (docs/reference/model.md 3): None, UPPER or LOWER."""
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
    """The legs of the simulation. A switch turns off at once. It turns on no earlier than the dead time after the
    turn-off command of the other switch."""

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
    """The clocks of a period in which a gate differs from the simulation's gate: the largest number of all gates and
    periods."""
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
