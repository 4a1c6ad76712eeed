# SPDX-License-Identifier: Apache-2.0
"""Every change of TIM1's legs that a drive can request, made by the image's code (timed_chip.py). The two switches of
a leg are never on together, and between them is always the dead time. The pair changes when the simulation's pair
changes (simulated_legs.py)."""
import itertools
import random

from simulated_legs import Simulated, counts, differing, sides
from tim1 import broken_laws
from timed_chip import COMPLEMENTARY, DEAD, OFF, PAIRS, PERIOD, SAMPLE, WAYS, Bridge, TimedChip


def play(bridge, script):
    """Plays periods on chip and simulation. Each is (command for the next period, [(counter, new pair or OFF)]).
    Returns the edges of both from the begin of the script."""
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
    """The clocks of a period in which a gate may differ from the simulation. The event may come 12 counts early. A
    leg that changes its switch waits the dead time, even if the other switch is already off. If a second change comes
    during this dead time, it waits again."""
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
    """From every command to every other command, at the end of a period."""
    for a, b in itertools.product(states(duties), states(duties)):
        yield f"{said(a)} -> {said(b)}", [(a, []), (a, []), (b, []), (b, []), (b, [])]


def of_hall_edges(duties):
    """From every pair to every other pair within a period: in the pulse, at its end, in the gap, and near the begin
    and the end of the period."""
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
    """Two Hall edges directly one after the other, in the pulse and in the gap. A leg that was just turned off is not
    turned on by the next event."""
    for first, second, third in itertools.permutations(PAIRS, 3):
        if first not in firsts:
            continue
        for way, duty in itertools.product(WAYS, duties):
            a, c = (first, way, duty), (third, way, duty)
            for counter in (200, 1500):
                yield f"{said(a)} -> {second} -> {third} at {counter}", [(a, []), (a, []), (a, [(counter, second), (counter, third)]), (c, [])]


def check_late_ticks(chip, dead):
    """A Hall edge and then a control tick, both shortly before the end of the period."""
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
    """Random commands and events in any order, directly one after the other or later. The laws are always satisfied."""
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
    """Checks an image. Returns the number of changes, and the errors."""
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
