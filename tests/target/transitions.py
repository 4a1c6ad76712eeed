# SPDX-License-Identifier: Apache-2.0
"""Every change of TIM1's legs that a drive can ask for, made by the image's own code on Unicorn's core, with the timer's output stage (tim1.py) behind its
registers: never both switches of a leg on, always the dead time between, and the pair changes when the simulation says.

Time passes where a counter is read again, one clock each: a core so fast that only what waits for a counter takes time. That is the least
distance that the program grants, so that a dead time one clock short is seen."""
import itertools
import random
import struct

import images
import tim1
from tim1 import LOWER, UPPER, Tim1, broken_laws

TIM1, TIM2 = images.TIM1, images.TIM2
SCRATCH = images.RAM + 0x9800
SOFT, HARD, COMPLEMENTARY = range(3)
BY_UPPER, BY_LOWER = range(2)
PERIOD, SAMPLE, DEAD = 2160, 2160 - 72, 36
PAIRS = [(s, k) for s in range(3) for k in range(3) if s != k]
WAYS = [(SOFT, BY_UPPER), (SOFT, BY_LOWER), (HARD, BY_UPPER), (COMPLEMENTARY, BY_UPPER), (COMPLEMENTARY, BY_LOWER)]
OFF = None


class TimedChip(images.Chip):
    """With a timer that makes pulses, and time."""

    def __init__(self, folder, late=False):
        self.tim1 = Tim1(late)
        self.now, self.looked = 0, False
        super().__init__(folder)

    def pass_to(self, t):
        self.now = max(self.now, t)
        self.tim1.advance(self.now)

    def read(self, core, offset, size, begin):
        at = begin + offset
        if at in (TIM1 + 0x24, TIM2 + 0x24):
            self.pass_to(self.now + self.looked)
            self.looked = True
            return self.tim1.counter() if at == TIM1 + 0x24 else self.now & 0xFFFFFFFF
        if at == TIM1 + 0x10:
            return (1 << 4 if self.tim1.match_4 else 0) | self.words.get(at, 0) & ~(1 << 4)
        return super().read(core, offset, size, begin)

    def write(self, core, offset, size, value, begin):
        at = begin + offset
        super().write(core, offset, size, value, begin)
        self.looked = False
        if TIM1 <= at < TIM1 + 0x60:
            self.tim1.advance(self.now)
            self.tim1.write(at - TIM1, value)

    def start(self):
        """Through the set-up, no further: its main loop would miss the conversions."""
        self.core.reg_write(images.arm.UC_ARM_REG_SP, self.stack)
        at = self.begin
        for _ in range(10_000):
            self.run(at & ~1, 1000)
            at = self.core.reg_read(images.arm.UC_ARM_REG_PC)
            if self.words.get(0xE000E100, 0) & 1 << 27:
                return
        raise images.build.Failed("the set-up enables no interrupt")

    def interrupt_amid(self, position, behind, other):
        """An interrupt, and another one behind so many of its instructions, as soon as it lets it; False where it ended before."""
        before = self.core.context_save()
        self.core.reg_write(images.arm.UC_ARM_REG_LR, images.NOWHERE | 1)
        self.run(struct.unpack("<I", self.core.mem_read(images.FLASH + 4 * (16 + position), 4))[0] & ~1, behind)
        while self.core.reg_read(images.arm.UC_ARM_REG_PRIMASK) & 1:
            self.run(self.core.reg_read(images.arm.UC_ARM_REG_PC), 1)
        at = self.core.reg_read(images.arm.UC_ARM_REG_PC)
        amid = at & ~1 != images.NOWHERE
        if amid and self.armed():
            self.interrupt(other)
        if amid:
            self.run(at, 100_000)
        self.core.context_restore(before)
        return amid

    def call(self, name, *arguments):
        """A function of the image, to its end."""
        at = next(a for symbol, a in self.symbols.items() if symbol.startswith(f"firmware::{name}("))
        before = self.core.context_save()
        for register, value in zip((images.arm.UC_ARM_REG_R0, images.arm.UC_ARM_REG_R1, images.arm.UC_ARM_REG_R2), arguments):
            self.core.reg_write(register, value)
        self.core.reg_write(images.arm.UC_ARM_REG_LR, images.NOWHERE | 1)
        self.run(at & ~1, 100_000)
        ended = self.core.reg_read(images.arm.UC_ARM_REG_PC) & ~1 == images.NOWHERE
        self.core.context_restore(before)
        if not ended:
            raise images.build.Failed(f"firmware::{name} did not return")

    def cycle_start(self):
        return self.now - self.tim1.counter()

    def armed(self):
        return bool(self.words.get(TIM1 + 0x0C, 0) & 1 << 4)

    def end_period(self):
        """To the update, with the interrupt of the fourth compare unit before it."""
        update = self.cycle_start() + PERIOD
        if self.tim1.counter() < SAMPLE:
            self.pass_to(update - PERIOD + SAMPLE)
        if self.armed() and not self.interrupt(27):
            raise images.build.Failed("the period's interrupt did not return")
        self.tim1.write(0x10, ~(1 << 4))
        self.pass_to(update)


def command(wanted):
    """A BridgeCommand<float>, of (pair, way, duty) or OFF."""
    if wanted is OFF:
        return struct.pack("<BBBxfBBBxfffB3x", 0, 0, 1, 0.0, 0, 0, 0, 0.0, 0.0, 0.0, 0)
    (source, sink), (chopping, chopped), duty = wanted
    return struct.pack("<BBBxfBBBxfffB3x", 1, source, sink, duty, chopping, chopped, 0, 0.0, 0.0, 0.0, 0)


class Bridge:
    """The image's entries by their names, and what the simulation's timer would do at the same calls."""

    def __init__(self, chip):
        self.chip, self.wanted = chip, OFF
        self.reversed = self.reversed_in_effect = False

    def tick(self, wanted, reversed_=False):
        self.chip.core.mem_write(SCRATCH, command(wanted))
        self.chip.call("at_next_period", SCRATCH, reversed_, 0)

    def hall(self, wanted, reversed_=False):
        self.chip.core.mem_write(SCRATCH, command(wanted))
        self.chip.call("at_once", SCRATCH, reversed_)

    def off(self):
        self.chip.call("gates_off")


def sides(wanted, leg, pulse):
    """Of the simulation (docs/model.md 3): None, UPPER or LOWER."""
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


def play(bridge, script):
    """Periods of (wanted for the next one, [(counter, new pair or OFF)]): chip and simulation. The edges of both from the script's begin on."""
    chip = bridge.chip
    chip.tim1.edges.clear()
    simulated, in_effect, begin = Simulated(), OFF, chip.cycle_start()
    for wanted, events in script:
        start = chip.cycle_start()
        bridge.tick(wanted)
        pulse = counts(in_effect[2]) if in_effect else 0
        waiting = wanted
        if wanted is OFF and in_effect is not OFF:
            in_effect = OFF
            for leg in range(3):
                simulated.tell(chip.now, leg, None)
        actions = sorted([(pulse, "end")] + [(c, new) for c, new in events], key=lambda a: a[0])
        for counter, new in actions:
            if new == "end":
                chip_t = start + counter
                if in_effect is not OFF and 0 < counter:
                    for leg in range(3):
                        simulated.tell(chip_t, leg, sides(in_effect, leg, False))
                continue
            chip.pass_to(start + counter)
            at = chip.now
            if new is OFF:
                bridge.off()
                in_effect = waiting = OFF
            else:
                waiting = waiting and (new, *waiting[1:])
                bridge.hall((new, *wanted[1:]) if wanted else OFF)
                in_effect = in_effect and (new, *in_effect[1:])
            for leg in range(3):
                simulated.tell(at, leg, sides(in_effect, leg, counter < pulse))
        chip.end_period()
        if in_effect is OFF and waiting is not OFF:
            simulated.wake(start + PERIOD)
        in_effect = waiting
        for leg in range(3):
            simulated.tell(start + PERIOD, leg, sides(in_effect, leg, in_effect is not OFF and counts(in_effect[2]) > 0))
    simulated.flush(chip.now)
    return begin, simulated.edges


def tolerance(script):
    """Clocks of a period in which a gate may differ. The event comes up to 12 counts early; a leg that changes sides waits the dead time though
    its other switch was off already; and one that then comes under the timer's own dead time waits that, too."""
    ways = {wanted[1] for wanted, _ in script if wanted is not OFF}
    events = max(len(events) for _, events in script)
    return (1 + events) * (DEAD + 24) + (DEAD if len(ways) > 1 or COMPLEMENTARY in (way[0] for way in ways) else 0)


def check_scripts(chip, scripts, compares=True, dead=DEAD):
    bridge, trouble, ran = Bridge(chip), [], 0
    for name, script in scripts:
        bridge.off()
        chip.end_period()
        chip.end_period()
        begin, simulated = play(bridge, script)
        ran += 1
        trouble += [f"{name}: {what} of leg {'abc'[leg]}, {t - begin} clocks behind its begin" for t, leg, what in broken_laws(chip.tim1.edges, dead)]
        if chip.tim1.let_go:
            trouble.append(f"{name}: an output is let go")
            chip.tim1.let_go = False
        if compares:
            worst = differing(chip.tim1.edges, simulated, begin - 20, len(script))
            if worst > tolerance(script):
                trouble.append(f"{name}: a gate differs from the simulation's for {worst} clocks of a period")
        if len(trouble) > 20:
            return ran, trouble
    return ran, trouble


def said(wanted):
    if wanted is OFF:
        return "off"
    pair, (chopping, chopped), duty = wanted
    return f"{'abc'[pair[0]]}{'abc'[pair[1]]} {('soft', 'hard', 'complementary')[chopping]}/{('upper', 'lower')[chopped]} {duty}"


def states(duties):
    return [OFF] + [(pair, way, duty) for pair in PAIRS for way in WAYS for duty in duties]


def of_ticks(duties):
    """From every command to every other one, at a period's end."""
    for a, b in itertools.product(states(duties), states(duties)):
        yield f"{said(a)} -> {said(b)}", [(a, []), (a, []), (b, []), (b, []), (b, [])]


def of_hall_edges(duties):
    """From every pair to every other one, amid a period: inside the pulse, at its end, in the gap, and right at the period's begin and end."""
    for pair, way, duty, new in itertools.product(PAIRS, WAYS, duties, PAIRS):
        for counter in (50, counts(duty) - 1, counts(duty) + 1, 1500, PERIOD - 100):
            if 40 < counter < PERIOD - 90 and new != pair:
                a, b = (pair, way, duty), (new, way, duty)
                yield f"{said(a)} -> {said(b)} at a Hall edge at {counter}", [(a, []), (a, []), (a, [(counter, new)]), (b, []), (b, [])]


def of_stops(duties):
    for pair, way, duty in itertools.product(PAIRS, WAYS, duties):
        for counter in (40, counts(duty) - 1, counts(duty) + 1, 1800):
            if counter >= 40:
                a = (pair, way, duty)
                yield f"{said(a)} off at {counter}", [(a, []), (a, []), (a, [(counter, OFF)]), (OFF, []), (OFF, [])]


def of_edges_at_once(duties, firsts=PAIRS):
    """Two Hall edges with nothing between them, inside the pulse and in the gap: a leg that has just been let off is not turned on by the next
    event."""
    for first, second, third in itertools.permutations(PAIRS, 3):
        if first not in firsts:
            continue
        for way, duty in itertools.product(WAYS, duties):
            a, c = (first, way, duty), (third, way, duty)
            for counter in (200, 1500):
                yield f"{said(a)} -> {second} -> {third} at {counter}", [(a, []), (a, []), (a, [(counter, second), (counter, third)]), (c, [])]


def check_late_ticks(chip, dead):
    """A Hall edge and then a control tick, both right before the period's end."""
    bridge, trouble = Bridge(chip), []
    for (first, second, third), way in itertools.product(itertools.permutations(PAIRS, 3), WAYS):
        bridge.off()
        for _ in range(2):
            chip.end_period()
        chip.tim1.edges.clear()
        for _ in range(2):
            bridge.tick((first, way, 0.95))
            chip.end_period()
        chip.pass_to(chip.cycle_start() + SAMPLE - 1)
        bridge.hall((second, way, 0.95))
        bridge.tick((third, way, 0.95))
        chip.end_period()
        chip.pass_to(chip.now + PERIOD)
        trouble += [f"{first} -> {second} -> late {third}: {what} of leg {'abc'[leg]}" for _, leg, what in broken_laws(chip.tim1.edges, dead)]
    return trouble[:5]


def check_drawn(chip, calls, seed):
    """Anything behind anything, at once or later: the laws hold."""
    draw, bridge = random.Random(seed), Bridge(chip)
    chip.tim1.edges.clear()
    everything = states((0.0, 0.01, 0.3, 0.97, 1.0))
    for _ in range(calls):
        what, wanted = draw.randrange(4), draw.choice(everything)
        if what == 0:
            bridge.off()
        elif what == 1:
            bridge.tick(wanted, draw.random() < 0.5)
        elif what == 2:
            bridge.hall(wanted, draw.random() < 0.5)
        else:
            chip.end_period()
        if draw.random() < 0.5:
            chip.pass_to(chip.now + draw.randrange(200 if draw.random() < 0.7 else 3000))
    return [f"drawn calls: {what} of leg {'abc'[leg]} at {t}" for t, leg, what in broken_laws(chip.tim1.edges, DEAD)][:5]


def check(folder, whole=False):
    """Of an image: how many changes were made, and what was wrong."""
    trouble, ran = [], 0
    for late in (False, True):
        chip = TimedChip(folder, late)
        chip.hall(0b101)
        chip.start()
        pulses = (0.02, 0.5, 1.0) if whole else (0.5,)
        for scripts in (of_ticks((0.0, 0.3, 1.0) if whole else (0.3,)), of_hall_edges(pulses), of_stops(pulses)):
            if not late or whole:
                some, wrong = check_scripts(chip, scripts, compares=not late)
                ran, trouble = ran + some, trouble + wrong
        some, wrong = check_scripts(chip, of_edges_at_once((0.95,), PAIRS if whole else PAIRS[:2]), compares=False)
        ran, trouble = ran + some, trouble + wrong
        trouble += check_drawn(chip, 20_000 if whole else 2000, 20261127)
    return ran, trouble


class Ride:
    """The image's interrupts as a turning rotor calls them, with its own drive in between; the currents are told, not simulated."""
    codes = (0b101, 0b001, 0b011, 0b010, 0b110, 0b100)
    fed = ((0, 1), (0, 2), (1, 2), (1, 0), (2, 0), (2, 1))  # the positive pair of each

    def __init__(self, folder, sector_clocks):
        self.chip = TimedChip(folder)
        self.at, self.sector_clocks = 0, sector_clocks
        self.chip.hall(self.codes[0])
        self.chip.start()
        self.next_edge = self.chip.now + sector_clocks

    def conversions(self, amperes):
        counts = [2048] * 3
        source, sink = self.fed[self.at % 6]
        counts[source], counts[sink] = round(2048 + amperes / 33 * 2048), round(2048 - amperes / 33 * 2048)
        for n, count in enumerate((*counts, round(24 / 52.8 * 4096))):
            self.chip.words[images.ADC1 + 0x80 + 4 * n] = count

    def edge(self):
        self.at += 1
        self.chip.hall(self.codes[self.at % 6])
        self.chip.words[TIM2 + 0x34] = self.chip.now - 256 & 0xFFFFFFFF
        if not self.chip.interrupt(28):
            raise images.build.Failed("the Hall interrupt did not return")
        self.next_edge += self.sector_clocks

    def go(self, periods, amperes=0.0):
        chip = self.chip
        for _ in range(periods):
            update = chip.cycle_start() + PERIOD
            self.conversions(amperes)
            if not chip.interrupt(18):
                raise images.build.Failed("the control interrupt did not return")
            while self.next_edge < update - 80:
                chip.pass_to(self.next_edge)
                self.edge()
            chip.end_period()

    def type(self, text):
        self.chip.type(text)
        self.chip.call("listen")


def changes_of_side(edges):
    """How often a leg's one switch came on where its other one had been the last that was."""
    last, changes = [None] * 3, 0
    for _, leg, gate, level in edges:
        if level:
            changes += last[leg] not in (None, gate)
            last[leg] = gate
    return changes


def check_drive(folder, name):
    """Started, at 300 rad/s, then 70: the drive brakes with the pair reversed; then the other way round, stopped, and a lost Hall line."""
    ride = Ride(folder, round(72e6 * 0.1309 / 300))
    ride.go(300)
    ride.type("r300\r")
    ride.go(700, 0.55)
    begin = len(ride.chip.tim1.edges)
    ride.type("70\r")
    ride.go(300, 0.55)
    reversals = changes_of_side(ride.chip.tim1.edges[begin:])
    ride.type("-300\r")
    ride.go(100, -0.4)
    ride.type("300\r")
    ride.go(100, 0.4)
    ride.type("s")
    ride.go(100, 0.2)
    ride.type("r")
    ride.go(100, 0.2)
    ride.chip.hall(0)
    ride.chip.interrupt(28)
    trouble = [f"{name}: {what} of leg {'abc'[leg]} at {t}" for t, leg, what in broken_laws(ride.chip.tim1.edges, DEAD)][:5]
    if ride.chip.tim1.let_go:
        trouble.append(f"{name}: an output is let go")
    if reversals == 0:
        trouble.append(f"{name}: no leg changed sides at the reversal, so that nothing was tried")
    if any(any(gates) for gates in ride.chip.tim1.gates):
        trouble.append(f"{name}: a gate is on behind the Hall interrupt of an impossible code")
    return trouble


def check_amid(folder):
    """The period's end comes amid the Hall interrupt, and amid the control tick, behind any of its instructions."""
    chip, trouble = TimedChip(folder), []
    chip.hall(0b101)
    chip.start()
    bridge, forward, other = Bridge(chip), (PAIRS[0], WAYS[0], 0.5), (PAIRS[2], WAYS[0], 0.5)
    for handler, behind in itertools.product((28, 18), range(1, 2000, 13)):
        bridge.off()
        for _ in range(2):
            chip.end_period()
        chip.tim1.edges.clear()
        for wanted in (forward, forward):
            bridge.tick(wanted)
            chip.end_period()
        bridge.tick(other)
        chip.pass_to(chip.cycle_start() + SAMPLE)
        if chip.interrupt_amid(handler, behind, 27):
            chip.pass_to(chip.now + 3 * PERIOD)
        trouble += [f"period's end {behind} instructions into interrupt {handler}: {what} of leg {'abc'[leg]}"
                    for _, leg, what in broken_laws(chip.tim1.edges, DEAD)][:2]
        if len(trouble) > 5:
            return trouble
    return trouble


def check_latency(folder):
    """From the fourth compare unit's match to the update 72 clocks pass, of which the core takes 12 to come in. A look at the counter must come
    before they have."""
    chip, begun, counted = TimedChip(folder), [0], []
    chip.hall(0b101)
    chip.start()
    bridge = Bridge(chip)
    for wanted in ((PAIRS[0], WAYS[0], 0.5), (PAIRS[0], WAYS[0], 0.5), (PAIRS[2], WAYS[0], 0.5)):
        bridge.tick(wanted)
        if wanted[0] == PAIRS[0]:
            chip.end_period()
    chip.pass_to(chip.cycle_start() + SAMPLE)

    def one_more(*_):
        begun[0] += 1

    def looked(_, access, at, *rest):
        if at == TIM1 + 0x24 and not counted:
            counted.append(begun[0])
    chip.core.hook_add(images.unicorn.UC_HOOK_CODE, one_more)
    chip.core.hook_add(images.unicorn.UC_HOOK_MEM_READ, looked)
    if not chip.interrupt(27) or not counted or counted[0] > 40:
        return [f"the period's interrupt looks at the counter behind {counted} instructions, too late for the update"]
    return []


def check_load(folder):
    """The control tick and a Hall interrupt, whose instructions have to go into the clocks of a period."""
    ride, count, most = Ride(folder, round(72e6 * 0.1309 / 300)), [0], {}
    ride.chip.core.hook_add(images.unicorn.UC_HOOK_CODE, lambda *_: count.__setitem__(0, count[0] + 1))
    interrupt = ride.chip.interrupt

    def counted(position):
        count[0] = 0
        ended = interrupt(position)
        most[position] = max(most.get(position, 0), count[0])
        return ended
    ride.chip.interrupt = counted
    ride.go(250)
    ride.type("r300\r")
    ride.go(400, 0.55)
    ride.type("70\r")
    ride.go(150, 0.55)
    if most[18] + most[28] > PERIOD or len(most) < 4:
        return [f"a control tick of {most.get(18)} and a Hall interrupt of {most.get(28)} instructions do not go into {PERIOD} clocks"]
    return []


def changed_image(folder, name, *changes):
    header = (images.build.REPOSITORY / images.EXAMPLES["stm32f303"] / "drive_config.hpp").read_text()
    for old, new in changes:
        if header.count(old) != 1:
            raise images.build.Failed(f"the example's header has {old!r} {header.count(old)} times")
        header = header.replace(old, new)
    (folder / name).mkdir(exist_ok=True)
    (folder / f"{name}.hpp").write_text(header)
    images.build.told([images.build.REPOSITORY / "tools/firmware_image.sh", "stm32f303", folder / f"{name}.hpp", folder / name])
    return folder / name


def check_drives(folder):
    """Whole drives of each chopping; and that a dead time one clock short does not pass."""
    chopping = "c.chopping = Chopping::soft;"
    trouble = tim1.check_itself() + check_latency(folder / "arm") + check_load(folder / "arm") + check_amid(folder / "arm") + check_drive(folder / "arm", "soft")
    for way in ("hard", "complementary"):
        trouble += check_drive(changed_image(folder, way, (chopping, f"c.chopping = Chopping::{way};")), way)
    long = TimedChip(changed_image(folder, "long", ("dead_time_ps = 500000;", "dead_time_ps = 2000000;")))
    long.hall(0b101)
    long.start()  # its dead time is longer than the way from the last instant of a period to its end
    trouble += check_scripts(long, of_edges_at_once((0.95,), PAIRS[:1]), compares=False, dead=144)[1] + check_late_ticks(long, 144)
    short = changed_image(folder, "short", ("dead_time_ps = 500000;", "dead_time_ps = 486000;"))
    for way in WAYS:
        forward, back = ((0, 1), way, 0.3), ((1, 0), way, 0.3)
        chip = TimedChip(short)
        chip.hall(0b101)
        chip.start()
        amid_pulse = [(forward, []), (forward, []), (forward, [(300, back[0])]), (back, [])]
        if not check_scripts(chip, [("", amid_pulse)], compares=False)[1]:
            trouble.append(f"a dead time of 35 clocks instead of 36 is not seen in {said(forward)} -> {said(back)}")
    return trouble
