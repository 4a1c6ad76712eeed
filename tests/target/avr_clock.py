# SPDX-License-Identifier: Apache-2.0
"""The rows of the ATmega2560's log. Each row has the instant of its sample. The clock continues during interrupts,
and in periods without a control interrupt. The row states the number of these periods."""
import tempfile

import build
from avr_chip import CLOCK_HZ, Chip, ZERO
from avr_image import built

MA_PER_COUNT = 20_000 / 1024
STEPS = 301  # number of different counts: the current of a row identifies its sample


class Stairs:
    """A current that has a new value at each sample of BOTTOM."""

    def __init__(self, chip):
        self.chip, self.given = chip, []
        chip.run_ms(2)
        chip.at_sample = self.sample

    def sample(self, cycle, channel, is_control_sample):
        counts = self.chip.counts
        if is_control_sample:
            counts[channel] = ZERO + len(self.given) % STEPS - STEPS // 2
            self.given.append((cycle, counts[channel] - ZERO))
        elif channel < 3 and self.given:
            counts[channel] = ZERO - self.given[-1][1] // 2


def check_rows(period_us, run_ms):
    period = period_us * 16
    changes = [("drive_config.hpp", "pwm_period_ps = 100000000;", f"pwm_period_ps = {period_us}000000;")] if period_us != 100 else []
    with tempfile.TemporaryDirectory() as folder, Chip(built(folder, changes)) as chip:
        stairs = Stairs(chip)
        chip.run_ms(run_ms)
        rows = [[float(cell) for cell in line.split(",")] for line in chip.said() if line[0] not in "#t"][1:]
        trouble, places = [], []
        for row in rows:
            counts = round(row[1] / MA_PER_COUNT)
            near = [(abs(row[0] * 16 - cycle), place) for place, (cycle, given) in enumerate(stairs.given) if abs(given - counts) <= 1]
            off, place = min(near, default=(1 << 60, 0))
            places.append(stairs.given[place][0] if near else 0)
            if off > 16 * 8:
                trouble.append(f"{period_us} us: a row at {row[0]} us, whose sample is {off / 16} us off")
        for (row, at), before in zip(list(zip(rows, places))[1:], places):
            came = sum(before < cycle <= at for cycle, _ in stairs.given)
            if abs(round((at - before) / period) - came - row[5]) > 1:
                trouble.append(f"{period_us} us: the row at {row[0]} us says that {row[5]} periods were missed, of {(at - before) / period:.1f} "
                               f"{came} came")
        if len(rows) < 3 or (period_us == 30 and sum(row[5] for row in rows) < 100):
            trouble.append(f"{period_us} us: {len(rows)} rows")
        return trouble[:4]


def check():
    answers = build.side_by_side(lambda of: check_rows(*of), [(100, 200), (30, 200)])
    trouble = [line for answer in answers for line in (answer if isinstance(answer, list) else [str(answer)])]
    print(f"instants of the ATmega2560's rows, and periods missed between: {'those of its samples' if not trouble else 'trouble'}")
    return trouble
