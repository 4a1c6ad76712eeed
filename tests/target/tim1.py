# SPDX-License-Identifier: Apache-2.0
"""TIM1's output stage, clock by clock. It is written from the manual alone (RM0316, 20.3 and 20.4), and independent
of the tested program.

  CCPC = 1         OCxM, CCxE and CCxNE are preloaded; all channels load them at a COM event (EGR.COMG)         20.4.2
  OCxPE            CCRx is preloaded and loaded at the update; without OCxPE at once                             20.4.7
  OCxM             100 low, 101 high, 110 high while CNT < CCRx, 111 the opposite                                20.4.7
  CCxE, CCxNE      with MOE = OSSR = 1. Neither: the timer drives no output. One: this output is OCxREF, and the other is inactive,
                   without dead time. Both: OCx is OCxREF, OCxN its opposite; each rises the dead time after the edge  20.4.9, 20.3.15
  MOE = 0          all off                                                                                        20.4.18

The manual does not define two cases. First: both outputs are enabled while OCxREF is constant. The model adds no dead
time, which is the worse assumption. Second: OCxM changes from a forced level to PWM. The manual says "the level
changes only when the result of the comparison changes". Both interpretations are tested: the level changes at once,
or at the next match (`late`)."""

UPPER, LOWER = 0, 1


class Tim1:
    def __init__(self, late=False):
        self.late = late
        self.registers = {}
        self.t = 0
        self.begun = None  # the time at which CNT was 0
        self.mode, self.enables, self.compare = [0] * 3, [0] * 3, [0] * 3
        self.reference, self.since = [False] * 3, [0] * 3
        self.gates = [[False, False] for _ in range(3)]
        self.edges = []  # (t, leg, gate, level)
        self.let_go = False  # an output was released while MOE was set
        self.match_4 = False

    def word(self, offset):
        return self.registers.get(offset, 0)

    @property
    def period(self):
        return self.word(0x2C) + 1

    def counter(self):
        return 0 if self.begun is None else (self.t - self.begun) % self.period

    def dead(self):
        dtg = self.word(0x44) & 0xFF
        if dtg < 0x80:
            return dtg
        return 2 * (64 + (dtg & 63)) if dtg < 0xC0 else 8 * (32 + (dtg & 31)) if dtg < 0xE0 else 16 * (32 + (dtg & 31))

    # Writes to registers.

    def write(self, offset, value):
        if offset == 0x14:
            if value & 1:
                self.take_compare()
                self.compared(True)
            if value & 1 << 5:
                self.take_modes()
            return
        if offset == 0x10:
            self.match_4 = self.match_4 and bool(value & 1 << 4)
            return
        self.registers[offset] = value
        if offset == 0x00 and value & 1 and self.begun is None:
            self.begun = self.t
        if offset in (0x18, 0x1C, 0x20) and not self.word(0x04) & 1:
            self.take_modes()
        if offset in (0x34, 0x38, 0x3C):
            x = (offset - 0x34) // 4
            if not self.modes_written(x) & 8:
                self.compare[x] = value
                self.compared(True, (x,))
        self.settle()

    def modes_written(self, x):
        return (self.word(0x18) if x < 2 else self.word(0x1C)) >> (8 if x == 1 else 0) & 0xFF

    def take_modes(self):
        for x in range(3):
            mode, before = self.modes_written(x) >> 4 & 7, self.mode[x]
            self.mode[x], self.enables[x] = mode, self.word(0x20) >> 4 * x & 5
            if mode != before:
                self.new_reference(x, mode in (6, 7) and self.late)
        self.settle()

    def take_compare(self):
        self.compare = [self.word(0x34 + 4 * x) & 0xFFFF for x in range(3)]

    # The timer's own actions.

    def new_reference(self, x, keeps=False):
        below = self.counter() < self.compare[x]
        value = {4: False, 5: True, 6: below, 7: not below}.get(self.mode[x], self.reference[x])
        if not keeps and value != self.reference[x]:
            self.reference[x], self.since[x] = value, self.t

    def compared(self, changed, legs=(0, 1, 2)):
        for x in legs:
            if self.mode[x] in (6, 7) and changed:
                self.new_reference(x)
        self.settle()

    def settle(self):
        """Sets the outputs for the present clock."""
        dead, on = self.dead(), bool(self.word(0x44) & 1 << 15)
        for x in range(3):
            reference, waited = self.reference[x], self.t - self.since[x] >= dead
            upper, lower = {0: (False, False), 1: (reference, False), 4: (False, reference),
                            5: (reference and waited, not reference and waited)}[self.enables[x]]
            self.let_go |= on and self.enables[x] == 0
            for gate, level in ((UPPER, on and upper), (LOWER, on and lower)):
                if self.gates[x][gate] != level:
                    self.gates[x][gate] = level
                    self.edges.append((self.t, x, gate, level))

    def next_event(self):
        events = [self.since[x] + self.dead() for x in range(3) if self.enables[x] == 5]
        if self.begun is not None:
            start = self.t - self.counter()
            events += [start + self.period]
            events += [start + self.compare[x] for x in range(3) if 0 < self.compare[x] < self.period]
            events += [start + self.word(0x40)]
        return min((t for t in events if t > self.t), default=None)

    def advance(self, to):
        while (event := self.next_event()) is not None and event <= to:
            self.t = event
            if self.begun is not None and self.counter() == 0:
                self.take_compare()
                self.compared(True)
            elif self.begun is not None:
                self.compared(True, [x for x in range(3) if self.compare[x] == self.counter()])
                self.match_4 |= self.counter() == self.word(0x40)
            self.settle()
        self.t = max(self.t, to)


def broken_laws(edges, dead):
    """(t, leg, what) for each error: both switches of a leg are on, or a switch turns on earlier than the dead time
    after the other."""
    on = [[False, False] for _ in range(3)]
    off_since = [[-(1 << 40)] * 2 for _ in range(3)]
    broken = []
    for begin in range(len(edges)):
        t, leg, gate, level = edges[begin]
        on[leg][gate] = level
        if not level:
            off_since[leg][gate] = t
        elif on[leg][1 - gate] and (t, leg, 1 - gate, False) not in edges[begin + 1:begin + 4]:
            broken.append((t, leg, "both switches on"))
        elif on[leg][1 - gate] or t - off_since[leg][1 - gate] < dead:
            gap = 0 if on[leg][1 - gate] else t - off_since[leg][1 - gate]
            broken.append((t, leg, f"{'upper lower'.split()[gate]} switch on {gap} clocks behind the other, of {dead}"))
    return broken


def check_itself():
    """The model must detect two errors: a single COM event that moves a leg from its lower to its upper switch, and a
    dead time that is one clock too short."""
    trouble = []
    for late in (False, True):
        for dead, short in ((36, 36), (36, 35)):
            timer = Tim1(late)
            for offset, value in ((0x2C, 2159), (0x04, 1), (0x44, 0x8800 | short), (0x18, 0x4868), (0x1C, 0x48), (0x20, 0x005), (0x34, 1000)):
                timer.write(offset, value)
            timer.write(0x14, 0x21)
            timer.write(0x00, 0x81)
            timer.advance(10 * 2160)
            if bool(broken_laws(timer.edges, dead)) != (short < dead) or len(timer.edges) < 36:
                trouble.append(f"complementary pulses with {short} clocks of dead time, {dead} wanted: {broken_laws(timer.edges, dead)[:2]}")
        timer.write(0x18, 0x4848)
        timer.write(0x14, 0x20)
        timer.advance(timer.t + 500)  # the lower switch is on
        timer.write(0x18, 0x4858)
        timer.write(0x20, 0x001)
        timer.write(0x14, 0x20)
        if not broken_laws(timer.edges, 35):
            trouble.append("lower off and upper on at one COM event is not seen")
    return trouble
