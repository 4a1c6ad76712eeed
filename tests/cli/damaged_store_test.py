#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Resumes a damaged store. The result is either a message and exit code 2, or the same bytes as from the undamaged
store. SIXSTEP_DAMAGED is the number of damaged copies, SIXSTEP_SEED the seed."""
import contextlib
import os
import random
import sqlite3
import unittest

import cells
from program import SHORT, ProgramTest

COPIES = int(os.environ.get("SIXSTEP_DAMAGED", "20"))
SEED = int(os.environ.get("SIXSTEP_SEED", random.randrange(2**32)))
RUNS, MORE = 200, 210


class DamagedStore(ProgramTest):
    def setUp(self):
        super().setUp()
        (self.path / "a.toml").write_text(SHORT.format(limit=4) +  # about 3.7 A at 0.1 ms
                                          '[[spread]]\nkey = "motor_override.inductance_mH"\nrelative = 0.2\n')
        self.run_program("run", "a.toml", "--runs", f"{RUNS}", "--store", "s.sqlite", "--quiet", code=1)
        self.good = (self.path / "s.sqlite").read_bytes()
        self.whole = self.resumed(code=1)

    def resumed(self, code):
        told = self.run_program("run", "a.toml", "--runs", f"{MORE}", "--store", "s.sqlite", "--resume", "--csv", "r.csv", "--json",
                                "r.json", "--force", code=code)
        return told.stdout, (self.path / "r.csv").read_bytes(), (self.path / "r.json").read_bytes()

    def refused(self):
        before = self.names()
        told = self.run_program("run", "a.toml", "--runs", f"{MORE}", "--store", "s.sqlite", "--resume", "--csv", "n.csv", code=2)
        self.assertEqual(told.stdout, "")
        self.assertEqual(self.names(), before, "nothing was written")
        return told.stderr

    def change(self, sql):
        (self.path / "s.sqlite").write_bytes(self.good)
        with contextlib.closing(sqlite3.connect(self.path / "s.sqlite")) as db:
            db.execute(sql)
            db.commit()

    def test_is_told_or_does_not_matter(self):
        draw = random.Random(SEED)
        refused = 0
        for copy in range(COPIES):
            data = bytearray(self.good)
            how = ("one bit", "one bit", "twenty bits", "forty bytes", "a sector of zeros", "cut")[copy % 6]
            at = draw.randrange(len(data))
            for _ in range({"one bit": 1, "twenty bits": 20}.get(how, 0)):
                data[draw.randrange(len(data))] ^= 1 << draw.randrange(8)
            if how == "forty bytes":
                data[at:at + 40] = draw.randbytes(len(data[at:at + 40]))
            if how == "a sector of zeros":
                data[at:at + 512] = bytes(len(data[at:at + 512]))
            if how == "cut":
                data = data[:at]
            for part in ("", "-wal", "-shm", "-journal"):
                (self.path / f"s.sqlite{part}").unlink(missing_ok=True)
            (self.path / "s.sqlite").write_bytes(data)
            with self.subTest(how=how, copy=copy, seed=SEED):
                told = self.run_either()
                if told is not None:
                    self.assertIn("s.sqlite", told)
                    refused += 1
        self.assertGreater(refused, COPIES // 5, f"seed {SEED}")

    def run_either(self):
        """Resumes the store. Returns the message of exit code 2, or None if the output is equal to the output of the
        undamaged store."""
        try:
            self.assertEqual(self.resumed(code=1), self.whole)
        except AssertionError:
            return self.run_program("run", "a.toml", "--runs", f"{MORE}", "--store", "s.sqlite", "--resume", "--csv", "r.csv", "--json",
                                    "r.json", "--force", code=2).stderr
        return None

    def test_a_digest_that_was_altered(self):
        self.change("UPDATE run SET digest = '0123456789abcdef' WHERE run = 3")
        self.assertIn("s.sqlite: is damaged: run 3 differs from the written row", self.refused())
        self.assertIn("--force", self.refused())

    def test_a_run_that_is_no_run_of_the_plan(self):
        self.change("UPDATE run SET run = 647 WHERE run = 136")
        self.assertIn("is damaged: run 647", self.refused())
        self.change("UPDATE run SET run = 1000000000000000000 WHERE run = 136")
        self.assertIn("is damaged: run 1000000000000000000", self.refused())

    def test_a_table_that_is_wider_than_its_columns(self):
        self.change("ALTER TABLE run ADD COLUMN f1 REAL")
        self.assertIn("its tables do not match its columns", self.refused())

    def test_rows_beyond_the_plan_are_told(self):
        told = self.run_program("run", "a.toml", "--runs", "50", "--store", "s.sqlite", "--resume", code=1)
        self.assertIn(f"s.sqlite: contains {MORE - 50} more runs than the 50 of this plan", told.stderr)
        self.assertIn("50 drives", told.stdout)

    def test_another_version_or_format_is_named(self):
        self.change("UPDATE about SET value = '0.0.1' WHERE word = 'sixstep'")
        self.assertIn("was begun by sixstep 0.0.1, but this is", self.refused())
        self.change("PRAGMA user_version = 1")
        self.assertIn("was written by an older sixstep without checksums", self.refused())

    def test_a_row_of_another_store_is_no_row(self):
        """The same plan with another scenario has the same columns. A row copied from that store is refused."""
        (self.path / "b.toml").write_text((self.path / "a.toml").read_text().replace("relative = 0.2", "relative = 0.1"))
        self.run_program("run", "b.toml", "--runs", "5", "--store", "b.sqlite", "--quiet", code=None)
        (self.path / "s.sqlite").write_bytes(self.good)
        with contextlib.closing(sqlite3.connect(self.path / "s.sqlite")) as db:
            db.execute("ATTACH ? AS b", (str(self.path / "b.sqlite"),))
            db.execute("DELETE FROM main.run WHERE run = 3")
            db.execute("INSERT INTO main.run SELECT * FROM b.run WHERE run = 3")
            db.commit()
        self.assertIn("run 3 differs from the written row", self.refused())

    def test_the_checksum_has_a_second_implementation(self):
        """The second implementation is in cells.py. It computes the stored checksum of every row."""
        (self.path / "s.sqlite").write_bytes(self.good)
        before = cells.of_store(self.path / "s.sqlite", "run")
        cells.sealed(self.path / "s.sqlite", "UPDATE run SET f0 = f0")
        self.assertEqual(cells.of_store(self.path / "s.sqlite", "run"), before)

    def test_a_store_is_no_standard_output(self):
        for words in (("run", "a.toml", "--runs", "5"), ("compare", "maxon-251601"), ("design", "--optimise", "a.toml")):
            told = self.run_program(*words, "--store", "-", code=2)
            self.assertIn("--store = - means standard output", told.stderr)
        self.assertNotIn("-", self.names())

    def test_a_plan_is_the_same_however_it_is_spelled(self):
        words = ["--store", "p.sqlite", "--quiet"]
        spelled = ("20us,30us", "20e-6,30e-6", "2e-05,0.00003", "0.02 ms,30.0us")
        for resume, values in enumerate(spelled):
            self.run_program("run", "a.toml", "--vary", f"pwm.period_s={values}", *words, *["--resume"][:resume], code=None)
        (self.path / "p.toml").write_text('scenario = "a.toml"\n[[vary]]\nkey = "pwm.period_s"\nvalues = [20e-6, "30 us"]\n')
        self.run_program("run", "p.toml", *words, "--resume", code=None)
        told = self.run_program("run", "a.toml", "--vary", "pwm.period_s=20us,31us", *words, "--resume", code=2)
        self.assertIn("another plan", told.stderr)
        for n, values in enumerate(("soft,hard", '"soft","hard"')):
            self.run_program("run", "a.toml", "--vary", f"pwm.chopping={values}", "--store", "w.sqlite", "--quiet", *["--resume"][:n],
                             code=None)


if __name__ == "__main__":
    unittest.main()
