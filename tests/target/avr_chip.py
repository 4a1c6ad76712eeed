# SPDX-License-Identifier: Apache-2.0
"""An ATmega2560 with its firmware (faces/loop/avr/) and without a plant. The test sets the Hall pins and the inputs
of the converter. Each change of the gates is recorded with its cycle."""
import fcntl
import os
import pathlib
import struct
import subprocess
import tempfile

import build

BOARD = build.REPOSITORY / "build/dev/sixstep-avr-board"
CLOCK_HZ = 16_000_000
RUN, ANSWER, GREETING = struct.Struct("<Q8HII"), struct.Struct("<QIIII"), struct.Struct("<6I")  # the messages of sixstep/rig/chip_port.hpp
INTERRUPT = struct.Struct("<QQ3I64II")
TIMES = struct.Struct(f"<{2 * INTERRUPT.size + 16}s")
GATES, SAMPLE, ENDED = 1, 2, 3
BETWEEN = 4  # added to the channel, if a current is sampled and the sample is not a control sample
ZERO = 512  # counts at zero current


class Chip:
    """The inputs: channels 0 to 2 are the currents of the legs a, b, c; channel 3 is the potentiometer."""

    def __init__(self, elf, hall=0b101):
        self.hall, self.counts = hall, [ZERO] * 8
        self.cycle, self.gates, self.moves, self.samples, self.ended = 0, 0, [], [], False
        self.at_sample = lambda cycle, channel, is_control_sample: None
        self.folder = tempfile.TemporaryDirectory()
        self.log = pathlib.Path(self.folder.name) / "serial.log"
        down, self.runs = os.pipe()
        self.answers, up = os.pipe()

        def place():
            taken = [fcntl.fcntl(end, fcntl.F_DUPFD, 10) for end in (down, up)]  # neither descriptor may be 3 or 4
            os.dup2(taken[0], 3)
            os.dup2(taken[1], 4)
        self.process = subprocess.Popen([str(BOARD), f"--serial={self.log}", str(elf)], preexec_fn=place, close_fds=False)
        os.close(down)
        os.close(up)
        assert GREETING.unpack(self.read(GREETING.size))[4] == CLOCK_HZ

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.close(self.runs)
        os.close(self.answers)
        self.process.wait(timeout=10)
        self.folder.cleanup()

    def read(self, size):
        data = b""
        while len(data) < size:
            more = os.read(self.answers, size - len(data))
            assert more, "the board has ended"
            data += more
        return data

    def run_to(self, until):
        """Runs to the cycle `until` with the present pins and inputs. `at_sample`, if set, may change them at each
        sample."""
        while self.cycle < until and not self.ended:
            os.write(self.runs, RUN.pack(until, *self.counts, self.hall, 0))
            self.cycle, event, gates, channel, _ = ANSWER.unpack(self.read(ANSWER.size))
            if gates != self.gates:
                self.moves.append((self.cycle, gates))
            self.gates = gates
            if event == SAMPLE:
                self.samples.append((self.cycle, channel))
                self.at_sample(self.cycle, channel % BETWEEN, channel < 3)
            self.ended = event == ENDED

    def run_for(self, cycles):
        self.run_to(self.cycle + cycles)

    def run_ms(self, ms):
        self.run_for(round(ms * CLOCK_HZ / 1000))

    def times(self):
        """For the control interrupt and the Hall interrupt: the number of calls, and the total, smallest and largest
        number of cycles."""
        os.write(self.runs, RUN.pack(0, *[0] * 8, 0, 1))
        data = self.read(TIMES.size)
        return [INTERRUPT.unpack_from(data, INTERRUPT.size * n)[:4] for n in (0, 1)]

    def off_within(self, cycles):
        """Whether all gates are off after `cycles`, and stay off for ten periods."""
        self.run_for(cycles)
        was_off, begin = self.gates == 0, len(self.moves)
        self.run_ms(1)
        return was_off and len(self.moves) == begin

    def said(self):
        """The complete lines on the serial line so far."""
        text = self.log.read_text(encoding="ascii", errors="replace") if self.log.exists() else ""
        return text[:text.rfind("\n") + 1].splitlines()
