# SPDX-License-Identifier: Apache-2.0
"""The ATmega2560's image if a part around it fails. It turns all gates off within a millisecond and sends the reason
about once a second. It stays off, also after a reset by the watchdog and after the end of the fault. It does not
start by itself."""
import functools
import tempfile

import build
from avr_chip import CLOCK_HZ, ZERO, Chip
from avr_image import built

MS = CLOCK_HZ // 1000
POTENTIOMETER = 3
WAITS = "# waits for the potentiometer's middle"
SOURCE, SINK, FREE = 2, 1, 0  # legs c, b and a: source, sink and free leg at the Hall code 101


def driving(elf, setpoint=600):
    """A drive in operation: 2 A flow through the legs c and b."""
    chip = Chip(elf)
    chip.run_ms(3)
    chip.counts[POTENTIOMETER] = setpoint
    chip.run_ms(1)
    chip.counts[SOURCE], chip.counts[SINK] = ZERO + 100, ZERO - 100
    chip.run_ms(1)
    assert chip.gates, chip.said()
    return chip


def reasons(chip):
    return [line[len("# fault: "):] for line in chip.said() if line.startswith("# fault: ")]


def mend(chip):
    """Ends the fault. The potentiometer moves to its middle and away from it."""
    chip.hall, chip.counts = 0b101, [ZERO] * 8
    chip.run_ms(20)
    chip.counts[POTENTIOMETER] = 700
    chip.run_ms(20)


# The part that fails during a run, its failure, and the reported fault.
def reads(counts, *legs):
    def broken(chip):
        for leg in legs:
            chip.counts[leg] = counts
    return broken


def hall(code):
    def broken(chip):
        chip.hall = code
    return broken


def dead_source(chip):
    """The current sensor of the leg that feeds the pair reads zero, while 5 A flow."""
    chip.counts[SOURCE], chip.counts[SINK] = ZERO, ZERO - 256


def doubled(chip):
    """A current sensor reads three times the true current."""
    chip.counts[SINK] = ZERO - 330


BREAKS = {"all transducers at 0 V": (reads(0, 0, 1, 2), "current-sensor"), "all transducers at 5 V": (reads(1023, 0, 1, 2), "current-sensor")}
BREAKS |= {f"transducer {leg} at {counts} counts": (reads(counts, leg), "current-sensor") for leg in range(3) for counts in (0, 1, 1022, 1023)}
BREAKS |= {f"over-current in leg {leg}, {counts} counts": (reads(counts, leg), "over-current") for leg in range(3) for counts in (40, 990)}
BREAKS |= {"the source's transducer at its middle": (dead_source, "current-sensor"), "a transducer off by far": (doubled, "current-sensor"),
           "the potentiometer's wire at 0 V": (reads(0, POTENTIOMETER), "setpoint-wire"),
           "the potentiometer's wire at 5 V": (reads(1023, POTENTIOMETER), "setpoint-wire"),
           "Hall 000": (hall(0), "hall"), "Hall 111": (hall(7), "hall")}


# Cycles until the gates are off. Hall: a running interrupt and the Hall interrupt. Over-current and setpoint wire: three periods,
# because the value is checked in every second period. Any other fault: a millisecond.
WITHIN = {"hall": 640, "over-current": 3 * 1600, "setpoint-wire": 3 * 1600}


def check_break(elf, case):
    name, (broken, reason) = case
    with driving(elf) as chip:
        broken(chip)
        stands = chip.off_within(WITHIN.get(reason, MS))
        chip.run_ms(10)
        mend(chip)
        said = reasons(chip)
        if not stands or chip.gates or said != [reason]:
            return f"{name}: {'off' if stands else 'not off'} in time, gates {chip.gates:06b} at the end, it says {said}"
    return None


def check_sound(elf):
    """Currents up to nine tenths of the range are no fault. A setpoint at either end of the potentiometer's range is
    no fault either."""
    trouble = []
    for counts, setpoint in ((450, 1014), (-450, 10)):
        with driving(elf) as chip:
            chip.counts = [ZERO, ZERO - counts, ZERO + counts, setpoint, *[0] * 4]
            chip.run_ms(20)
            if not chip.gates or reasons(chip):
                trouble.append(f"{counts} counts and a setpoint of {setpoint}: gates {chip.gates:06b}, {chip.said()[-3:]}")
    return trouble


def check_power_up(elf):
    """The drive starts only after the potentiometer has been at its middle. It does not start with a broken wire or a
    large offset."""
    trouble = []
    for setpoint in (100, 480, 530, 900):
        with Chip(elf) as chip:
            chip.counts[POTENTIOMETER] = setpoint
            chip.run_ms(200)
            if chip.moves or WAITS not in chip.said() or reasons(chip):
                trouble.append(f"a potentiometer at {setpoint}: gates moved {len(chip.moves)} times, it says {chip.said()[:4]}")
            chip.counts[POTENTIOMETER] = ZERO
            chip.run_ms(1)
            chip.counts[POTENTIOMETER] = setpoint
            chip.run_ms(5)
            if not chip.gates:
                trouble.append(f"a potentiometer at {setpoint} behind its middle: no gate is on, it says {chip.said()[-3:]}")
    at_start = [(leg, counts, "current-sensor") for leg in range(3) for counts in (0, 1023)]
    at_start += [(leg, counts, "calibration") for leg in range(3) for counts in (495, 529)]
    at_start += [(POTENTIOMETER, 0, "setpoint-wire"), (POTENTIOMETER, 1023, "setpoint-wire")]
    for channel, counts, reason in at_start:
        with Chip(elf) as chip:
            chip.counts[channel] = counts
            chip.run_ms(20)
            mend(chip)
            if chip.moves or reasons(chip) != [reason]:
                trouble.append(f"channel {channel} at {counts} from power-up on: {len(chip.moves)} moves of gates, it says {reasons(chip)}")
    return trouble


def check_goes_on(elf):
    """After a fault the line sends the reason once a second, and the rows continue. They show that the board works,
    and what it measures."""
    with driving(elf) as chip:
        chip.hall = 0
        begin = chip.cycle
        chip.run_ms(3100)
        rows = [line for line in chip.said() if not line.startswith(("#", "t "))]
        heads = sum(line.startswith("t [us]") for line in chip.said())
        last_ms = int(rows[-1].split(",")[0]) / 1000
        if len(reasons(chip)) != 4 or set(reasons(chip)) != {"hall"} or heads != 1 or abs(last_ms - (begin / MS + 3100)) > 5:
            return [f"3.1 s behind a fault: it says {reasons(chip)}, {heads} heads, rows up to {last_ms} ms"]
    return []


OPEN_STOP = ("standing.hpp", '  asm volatile("cli" ::: "memory");\n', "")
GLITCH = 40  # cycles
LAST = 170  # cycles from the start of a Hall interrupt to its end, with the dead time


def stopped_by_control(elf, begin, edge=None):
    """Only the control interrupt reads a Hall code 000. The code comes `begin` cycles after BOTTOM's sample, and ends
    before the Hall interrupt can read it. With `edge`, a valid code comes `edge` cycles after the sample. Returns the
    following changes of the gates, and the messages."""
    with driving(elf) as chip:
        while chip.samples[-1][1] >= 3:
            chip.run_for(100)
        seen = len(chip.samples)
        while not any(channel < 3 for _, channel in chip.samples[seen:]):
            chip.run_for(20)
        sample, moved = chip.samples[-1][0], len(chip.moves)
        for at, code in ((begin, 0), (begin + GLITCH, 0b101), *([(edge, 0b100)] if edge else [])):
            chip.run_to(sample + at)
            chip.hall = code
        chip.run_to(sample + MS)
        return [(cycle - sample, gates) for cycle, gates in chip.moves[moved:]], chip.gates, reasons(chip)


def trouble_of_stop(elf):
    """Hall interrupts at each cycle near the stop by the control interrupt, which runs with interrupts enabled. No
    Hall interrupt turns a gate on again."""
    for begin in range(200, 320, 10):
        moves, _, said = stopped_by_control(elf, begin)
        if said == ["hall"] and moves[-1][0] > begin + GLITCH + 60:  # the Hall interrupt would have turned the gates off by then
            off = moves[-1][0]
            break
    else:
        return ["no glitch of the Hall pins stops the drive by its control interrupt"]
    trouble = []
    for edge in range(max(off - 80, begin + GLITCH), off + 20):
        moves, gates, said = stopped_by_control(elf, begin, edge)
        if gates or moves[-1][0] > off + LAST or said != ["hall"]:
            trouble.append(f"a Hall edge {edge - off} cycles behind the stop: gates {gates:06b} a millisecond later, {moves[-3:]}, it says {said}")
    return trouble


def check_open_stop(_):
    with tempfile.TemporaryDirectory() as folder:
        return None if trouble_of_stop(built(folder, [OPEN_STOP])) else "a stop that lets interrupts in is not seen"


HANGS = "  if (++calls == 100) { asm volatile(\"cli\"); for (;;) asm volatile(\"\"); }\n"
CALLS = "  static std::uint8_t calls = 0;\n"
TICK = "  const std::uint8_t pins = hall_pins();\n  const bool looks_at_legs"
STANDS = "  if (phase == Phase::calibrates)\n"
BOTTOM = "  byte(ADCSRA) = converter_on | ADATE | ADIE | ADIF;\n"
# A boot loader has cleared the register.
HIDDEN = ("set_up.hpp", "const std::uint8_t cause = byte(MCUSR);", "const std::uint8_t cause = 0;")


def hanging(place, condition=""):
    return ("main.cpp", place, f"{CALLS}  {condition}{HANGS.strip()}\n{place}")


# Programs with a deliberate fault: the fault, the part that fails during the run, the longest time with gates on, and the last
# message.
PROGRAMS = {
    "a converter that starts no more": ([("converter.hpp", BOTTOM, f"{CALLS}  if (calls < 100) ++calls;\n  byte(ADCSRA) = calls < 100 ? "
                                          "converter_on | ADATE | ADIE | ADIF : converter_on;\n")], None, 1, "converter"),
    "a control interrupt that hangs": ([hanging(TICK)], None, 17, "watchdog"),
    "a control interrupt that hangs, behind a boot loader": ([hanging(TICK), HIDDEN], None, 17, "watchdog"),
    "a main loop that hangs": ([("main.cpp", "    tell_phase();\n", "    if (heart >= 200) for (;;) asm volatile(\"\");\n    tell_phase();\n")],
                               None, 17, "watchdog"),
    "a program that hangs behind a fault": ([hanging(STANDS, "if (phase == Phase::stands) ")], 0, 1, "hall"),
    "a program that hangs behind a fault, behind a boot loader": ([hanging(STANDS, "if (phase == Phase::stands) "), HIDDEN], 0, 1, "hall"),
}


def check_program(case):
    name, (changes, code, on_ms, reason) = case
    with tempfile.TemporaryDirectory() as folder:
        elf = built(folder, changes)
        with Chip(elf) as chip:
            chip.run_ms(3)
            chip.counts[POTENTIOMETER] = 600
            chip.run_ms(3)
            began = bool(chip.gates)
            if code is not None:
                chip.hall = code
            chip.run_ms(50)
            on = [cycle for cycle, gates in chip.moves if gates]
            off = [cycle for cycle, gates in chip.moves if not gates]
            fed = chip.samples[-1][0]
            mend(chip)
            chip.run_ms(20)
            if "converter" not in name and chip.samples[-1][0] == fed:
                return f"{name}: it samples no more"
            last = [line for line in chip.said() if line.startswith("#")][-1]
            if not began or chip.gates or len(off) != 1 or on[-1] > off[0] or last != f"# fault: {reason}":
                return f"{name}: began {began}, gates {chip.gates:06b}, off at {off}, it says {[s for s in chip.said() if s[0] in '#t']}"
            before = on[-1] if on_ms > 1 else max(c for c, _ in chip.samples if c < off[0]) if code is None else None
            if before is not None and off[0] - before > on_ms * MS:
                return f"{name}: off {(off[0] - before) / MS:.2f} ms later"
    return None


def check():
    with tempfile.TemporaryDirectory() as folder:
        elf = built(folder)
        answers = build.side_by_side(functools.partial(check_break, elf), BREAKS.items())
        trouble = check_sound(elf) + check_power_up(elf) + check_goes_on(elf) + trouble_of_stop(elf)
    answers += build.side_by_side(check_open_stop, [None])
    answers += build.side_by_side(check_program, PROGRAMS.items())
    trouble += [str(answer) for answer in answers if answer]
    print(f"{len(BREAKS)} breaks around the ATmega2560 and {len(PROGRAMS)} programs that hang: "
          f"{'each stops the drive for good and is told' if not trouble else 'trouble'}")
    return trouble
