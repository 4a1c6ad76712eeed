# SPDX-License-Identifier: Apache-2.0
"""The changes of the gates of the ATmega2560's image, executed cycle by cycle at its pins: from each pair to each
other pair and to off. The two gates of a leg are never on together, and between them is at least the dead time. The
pair is always that of the Hall code and the sign of the voltage. As in the simulation, a new sign acts from the TOP
at which the timer loads the on-time. Faults that the test puts into the program are detected."""
import math
import pathlib
import random
import re
import tempfile

import build
from avr_chip import Chip, ZERO
from avr_image import EXAMPLE, built

PERIOD = 1600  # cycles of 100 us
CYCLE_PS = 62_500
SAMPLE_LATE = 32  # cycles; a conversion started by BOTTOM samples its input two clocks of the converter later
# By the Hall code H1 H2 H3 (docs/reference/model.md, 3): the leg that connects the positive pair to the bus, and the leg that
# connects it to ground.
POSITIVE = {0b100: "ab", 0b110: "ac", 0b010: "bc", 0b011: "ba", 0b001: "ca", 0b101: "cb"}
AMPERES_PER_COUNT, D1, K_I = 20 / 1024, 2.30464, 0.37978  # from the example's drive_config.hpp
# The longest delay of a new pair, in cycles. From a Hall edge: a running interrupt, the entry of the Hall interrupt, and the dead
# time. From TOP: the same parts, and a Hall interrupt before.
LATE_HALL, LATE_TOP = 650, 450
AT_ONCE = 16  # a pin changes when the running instruction or interrupt entry ends: TOP may come before it


def upper(leg):
    return 1 << 2 * "abc".index(leg)


def lower(leg):
    return 2 << 2 * "abc".index(leg)


def pair(code, negative):
    source, sink = POSITIVE[code]
    return (sink, source) if negative else (source, sink)


def dead_cycles():
    """The dead time of the header in cycles, rounded up."""
    text = (build.REPOSITORY / EXAMPLE / "drive_config.hpp").read_text(encoding="utf-8")
    return math.ceil(int(re.search(r"dead_time_ps = (\d+);", text)[1]) / CYCLE_PS)


class Walk:
    """A drive whose Hall pins change to any code at any instant. Its current changes between far above and far below
    the reference, so that the sign of the duty changes."""

    def __init__(self, chip, seed):
        self.chip, self.drawn = chip, random.Random(seed)
        self.halls, self.signs = [(0, chip.hall)], []  # the values, each with the cycle from which it is valid
        self.currents = []  # the cycle of each BOTTOM, and the counts at it
        self.negative, self.left, self.counts, self.sum = False, 0, 0, 0

    def sample(self, cycle, channel, is_control_sample):
        """A current in the leg that is sampled. Half of it returns through each of the other legs."""
        if not is_control_sample:
            if channel < 3:
                self.chip.counts[channel] = ZERO - self.counts // 2
            return
        if self.left == 0:
            self.negative = not self.negative
            # This choice keeps the integral small against the proportional part.
            self.left = self.drawn.randint(1, 3) if (self.sum < 0) == self.negative else 1
        self.left -= 1
        self.counts = (1 if self.negative else -1) * self.drawn.randint(300, 400)
        self.sum += self.counts
        self.chip.counts[channel] = ZERO + self.counts
        self.currents.append((cycle - SAMPLE_LATE, self.counts))
        self.signs.append((cycle - SAMPLE_LATE + 3 * PERIOD // 2, self.negative))

    def go(self, periods):
        chip = self.chip
        chip.run_ms(4)
        chip.at_sample = self.sample
        end = chip.cycle + periods * PERIOD
        while chip.cycle < end:
            chip.run_for(self.drawn.randint(2 * PERIOD, 5 * PERIOD))
            chip.hall = self.drawn.choice([code for code in POSITIVE if code != chip.hall])
            self.halls.append((chip.cycle, chip.hall))
        chip.run_for(PERIOD)
        return self


def shortest_dead_times(moves):
    """The shortest time from the fall of one gate to the rise of the other gate of the same leg, for each of the six
    gates. Also returns the cycles at which both gates were on."""
    both, shortest, fell, before = [], {}, {}, 0
    for cycle, gates in moves:
        if gates & gates >> 1 & 0b010101:
            both.append(cycle)
        for n in range(6):
            bit, other = 1 << n, n ^ 1
            if before & bit and not gates & bit:
                fell[n] = cycle
            if gates & bit and not before & bit and other in fell:
                shortest[n] = min(shortest.get(n, 1 << 60), cycle - fell[other])
        before = gates
    return both, shortest


def trouble_of_pairs(walk):
    """Checks the pair at each change of the gates, and at the end of each interval without a change."""
    trouble, seen = [], set()
    changes = sorted([(at, "hall", value) for at, value in walk.halls] + [(at, "sign", value) for at, value in walk.signs])
    hall, negative = None, None
    moves = [m for m in walk.chip.moves if m[0] > walk.signs[0][0] + PERIOD]
    place, last_hall, last_sign, before = 0, 0, 0, None
    old = set()
    for cycle, gates in moves:
        while place < len(changes) and changes[place][0] <= cycle:
            at, what, value = changes[place]
            place += 1
            if what == "hall":
                old, hall, last_hall = {(hall, negative)} | (old if at - last_hall < LATE_HALL or at - last_sign < LATE_TOP else set()), value, at
            elif value != negative:
                tied = {(code, value) for code, _ in old} if at - last_hall < AT_ONCE else set()
                old, negative, last_sign = {(hall, negative)} | tied | (old if at - last_hall < LATE_HALL else set()), value, at
        settled = cycle - last_hall > LATE_HALL and cycle - last_sign > LATE_TOP
        may = {(hall, negative)} if settled else {(hall, negative)} | old
        allowed = [upper(p[0]) | lower(p[1]) for code, sign in may if code is not None and sign is not None for p in [pair(code, sign)]]
        if not any(gates & ~one == 0 for one in allowed) or (settled and not gates & lower(pair(hall, negative)[1])):
            trouble.append(f"at cycle {cycle} gates {gates:06b}: Hall {hall:03b} for {cycle - last_hall} cycles, "
                           f"{'negative' if negative else 'positive'} for {cycle - last_sign}")
        if settled:
            if before not in (None, (hall, negative)):
                seen.add((pair(*before), pair(hall, negative)))
            before = (hall, negative)
    return trouble[:5], seen


def trouble_of_pulses(walk):
    """Compares each on-time with the PI controller's result for the sample two BOTTOMs before: u = d1 e + K_i (sum of
    the earlier e), with the error e. u is limited to 24 V. At the limit the sum is corrected as in control/pi.hpp."""
    ons, since = [], None
    for cycle, gates in walk.chip.moves:
        on = bool(gates & 0b010101)
        if since is not None and not on:
            ons.append((since, cycle))
        since = (since if since is not None else cycle) if on else None
    trouble, gathered, judged, place = [], 0.0, 0, 0
    edges = [at for at, _ in walk.halls]
    for bottom, counts in walk.currents:
        error = -counts * AMPERES_PER_COUNT
        volts = min(24.0, max(-24.0, D1 * error + gathered))
        wanted = abs(volts) / 24 * PERIOD
        gathered = volts - (D1 - K_I) * error
        begin, end = bottom + 3 * PERIOD // 2, bottom + 5 * PERIOD // 2
        if any(begin - LATE_HALL < at < end for at in edges) or end > walk.chip.cycle or wanted > 0.8 * PERIOD:
            continue
        while place < len(ons) and ons[place][1] <= begin:
            place += 1
        on = sum(min(to, end) - max(at, begin) for at, to in ons[place:place + 4] if at < end and to > begin)
        judged += 1
        if abs(on - wanted) > 8:
            trouble.append(f"about the BOTTOM at cycle {begin + PERIOD // 2} a gate is on for {on} cycles, where {wanted:.1f} are wanted")
    return trouble[:5] + ([] if judged > len(walk.currents) // 6 else [f"{judged} of {len(walk.currents)} pulses judged"])


def missed(walk):
    """The number of periods without a control sample between the first and the last control sample."""
    cycles = [cycle for cycle, channel in walk.chip.samples if channel < 3 and cycle > walk.halls[0][0]]
    return sum(round((b - a) / PERIOD) - 1 for a, b in zip(cycles, cycles[1:]))


def walked(elf, seed, periods):
    with Chip(elf) as chip:
        walk = Walk(chip, seed).go(periods)
        both, shortest = shortest_dead_times(chip.moves)
        trouble, seen = trouble_of_pairs(walk)
        trouble += trouble_of_pulses(walk)
        return {"both": both, "shortest": min(shortest.values(), default=None), "of": len(shortest), "trouble": trouble, "seen": seen,
                "missed": missed(walk), "said": chip.said()[-1], "ended": chip.ended}


PERIODS = 3000
DELAY = '  asm volatile("ldi r24, 34\\n1:\\tdec r24\\n\\tbrne 1b" ::: "r24");\n'
# Deliberate faults: the file of the example, the change, and the message that the test must give.
PLANTED = {
    "a dead time of one cycle less": ("gates.hpp", "loops = (dead_cycles - 1) / 3, rest = (dead_cycles - 1) % 3",
                                      "loops = (dead_cycles - 2) / 3, rest = (dead_cycles - 2) % 3", "shortest"),
    "no dead time where an upper gate goes": ("gates.hpp", "    change_over(stay, to);", "    lowers = to.PORTA;\n    uppers = to.DDRB;", "shortest"),
    "a sign that counts at once": ("main.cpp", "  wanted = state.reversed ?", "  show(hall_pins());\n  shown = wanted = state.reversed ?", "trouble"),
    "a control interrupt 100 cycles longer": ("main.cpp", "  const std::uint8_t last_pins = pins_seen;", f"{DELAY}  const std::uint8_t last_pins = pins_seen;", "missed"),
    "an on-time that is half": ("main.cpp", "set_on_time(counts_of(state.command.duty));", "set_on_time(counts_of(state.command.duty) / 2);", "trouble"),
}


def found_wrong(elf, dead, seed, periods=PERIODS):
    """The errors that the walk finds, or an empty result."""
    got = walked(elf, seed, periods)
    wrong = {}
    if got["both"]:
        wrong["both"] = f"both gates of a leg are on at cycle {got['both'][0]}"
    if got["of"] != 6 or got["shortest"] != dead:
        wrong["shortest"] = f"between one gate and the other one of {got['of'] // 2} legs lie {got['shortest']} cycles at the least, not {dead}"
    if got["trouble"]:
        wrong["trouble"] = "\n".join(got["trouble"])
    if got["missed"]:
        wrong["missed"] = f"{got['missed']} periods go by without a control interrupt"
    if len(got["seen"]) != 36:
        wrong["seen"] = f"{len(got['seen'])} of 36 changes from pair to pair were seen"
    return wrong


def check_planted(case):
    name, (file, old, new, seen_as) = case
    with tempfile.TemporaryDirectory() as folder:
        wrong = found_wrong(built(folder, [(file, old, new)]), dead_cycles(), seed=2, periods=PERIODS // 3)
    return None if seen_as in wrong else f"{name} is not seen: {wrong}"


def check_dead_time(case):
    """The dead time is rounded up to cycles, and is at least four cycles."""
    ps, dead = case
    change = ("drive_config.hpp", f"dead_time_ps = {dead_cycles() * CYCLE_PS};", f"dead_time_ps = {ps};")
    with tempfile.TemporaryDirectory() as folder:
        wrong = found_wrong(built(folder, [change]), dead, seed=3)
    return f"a dead time of {ps} ps: {wrong}" if wrong else None


def check_no_dead_time():
    change = ("drive_config.hpp", f"dead_time_ps = {dead_cycles() * CYCLE_PS};", "dead_time_ps = 0;")
    with tempfile.TemporaryDirectory() as folder:
        try:
            built(folder, [change])
        except build.Failed as failed:
            return [] if "dead" in str(failed) else [f"without a dead time: {failed}"]
    return ["an image without a dead time is built"]


def check_starts(elf):
    """The first pair after off, for each Hall code and each sign of the setpoint."""
    trouble = []
    for code in POSITIVE:
        for setpoint, negative in ((700, False), (324, True)):
            with Chip(elf, code) as chip:
                chip.run_ms(3)
                began = [gates for _, gates in chip.moves]
                chip.counts[3] = setpoint
                chip.run_ms(2)
                source, sink = pair(code, negative)
                seen = {gates for cycle, gates in chip.moves if cycle > 4 * 16_000}
                if began != [lower(pair(code, False)[1])] or seen != {lower(sink), lower(sink) | upper(source)}:
                    trouble.append(f"a start at {code:03b} to {source}{sink}: first {began}, then {sorted(seen)}")
    return trouble


EVERY_DUTY = """  set_up_serial_line();
  bool right = true;
  for (std::uint16_t raw = 0; raw < 32768; ++raw)
    right = right && counts_of(Scalar::from_raw(static_cast<std::int16_t>(raw))) ==
                         static_cast<std::uint16_t>(std::uint32_t{raw} * pwm_counts >> 15);
  put_text(put, right ? "# right\\n" : "# wrong\\n");
"""


def check_counts():
    """The assembler's product for the on-time is right for every duty."""
    begin = "  const Reason before = reason_after_reset("
    with tempfile.TemporaryDirectory() as folder, Chip(built(folder, [("main.cpp", begin, EVERY_DUTY + begin)])) as chip:
        chip.run_ms(2000)
        return [] if "# right" in chip.said() else [f"the on-times of all duties: {chip.said()[:3]}"]


def check():
    with tempfile.TemporaryDirectory() as folder:
        elf = built(folder)
        wrong = check_starts(elf) + check_counts()
        wrong += [found for seed in (1, 2) for found in found_wrong(elf, dead_cycles(), seed).values()]
    answers = build.side_by_side(check_planted, PLANTED.items())
    answers += build.side_by_side(check_dead_time, [(500_000, 8), (1_030_000, 17), (1, 4)])
    trouble = wrong + [str(answer) for answer in answers if answer] + check_no_dead_time()
    print(f"changes from pair to pair on the ATmega2560, both gates off for {dead_cycles()} cycles between, {len(PLANTED)} planted faults "
          f"seen: {'all as they should be' if not trouble else 'trouble'}")
    return trouble
