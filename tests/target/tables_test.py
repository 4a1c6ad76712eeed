#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests of the checks in this folder, without a core. They must report a more expensive entry by its name, and a
library call that no page lists. Every measured case must have its row."""
import sys
import unittest

sys.dont_write_bytecode = True
import blocks  # noqa: E402
import cores  # noqa: E402
import cost  # noqa: E402
import sizes  # noqa: E402
import walk  # noqa: E402

KEY = ("Cortex-M0", "product", "q15", "tick")


class Costs(unittest.TestCase):
    def test_a_count_six_percent_above_is_told_with_core_and_drive(self):
        told = cost.judge(KEY, (80001, 1000, 1100, 1200), (80001, 1060, 1100, 1200))
        self.assertEqual(told, "Cortex-M0, product in q15, tick: mean 1000 -> 1060 (+6.0 %)")

    def test_one_six_percent_below_asks_for_a_new_table(self):
        self.assertIn("99.9 % 1100 -> 1030 (-6.4 %), cheaper: renew", cost.judge(KEY, (80001, 1000, 1100, 1200), (80001, 1000, 1030, 1200)))

    def test_less_than_five_percent_passes(self):
        self.assertIsNone(cost.judge(KEY, (80001, 1000, 1100, 1200), (80001, 1049, 1060, 1250)))

    def test_what_is_missing_on_either_side_is_told(self):
        self.assertIn("not in the table", cost.judge(KEY, None, (80001, 1, 1, 1)))
        self.assertIn("not measured", cost.judge(KEY, (80001, 1, 1, 1), None))


class Tables(unittest.TestCase):
    def test_every_case_has_its_rows(self):
        cases = {(core.name, drive, scalar) for core, drive, scalar in cost.cases()}
        self.assertEqual({key[:3] for key in cost.expected()}, cases)
        self.assertEqual(set(sizes.expected()), cases)

    def test_every_block_of_the_walk_has_its_rows_on_every_core(self):
        cases = {(core.name, scalar) for core, scalar, _ in blocks.cases()}
        found = cost.expected(blocks.TABLE)
        self.assertEqual({(key[0], key[2]) for key in found}, cases)
        walked = {block for block, scalar, _ in walk.expected() if ":" not in block and "+" not in block}
        self.assertEqual({key[1] for key in found}, walked - {"arithmetic"})

    def test_every_part_of_the_walk_has_blocks_and_observers_are_not_the_rotors(self):
        blocks_of = {block for block, _, _ in walk.expected()}
        self.assertEqual({walk.part_of(block) for block in blocks_of}, set(walk.PARTS))
        self.assertEqual([walk.part_of(block) for block in ("pi", "sensorless/lock", "sensorless/observer", "commissioning/pulse_start",
                                                      "field/field_drive")],
                         ["", "rotor", "observers", "pulses", "field"])

    def test_a_block_that_got_dearer_is_told_with_block_and_core(self):
        told = cost.judge(("ATmega2560", "pi", "q15", "pi_step"), (10000, 1005, 1086, 1086), (10000, 1060, 1086, 1086))
        self.assertEqual(told, "ATmega2560, pi in q15, pi_step: mean 1005 -> 1060 (+5.5 %)")

    def test_every_row_counts_at_least_80000_ticks(self):
        self.assertTrue(all(row[0] >= 80000 for key, row in cost.expected().items() if key[3].startswith("tick")))

    def test_digests_cover_every_scalar(self):
        self.assertEqual({scalar for _, scalar, _ in walk.expected()}, set(walk.programs(cores.HOSTS[0])))


class LibraryCalls(unittest.TestCase):
    def test_the_page_decides(self):
        avr, m4 = cores.BY_NAME["ATmega2560"], cores.BY_NAME["Cortex-M4F"]
        self.assertEqual(sizes.not_listed(avr, {"memcpy", "__mulsi3", "malloc"}), ["malloc"])
        self.assertEqual(sizes.not_listed(m4, {"__aeabi_fadd", "__aeabi_uldivmod"}), ["__aeabi_fadd"])


if __name__ == "__main__":
    unittest.main()
