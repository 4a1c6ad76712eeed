# SPDX-License-Identifier: Apache-2.0
"""The chart of a notebook in Chromium: it shows the values at the pointer and can be zoomed. A title cannot inject
markup."""
import contextlib
import html
import io
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import types
import unittest
from unittest import mock

import numpy as np
from package import current

import sixstep
import sixstep.live

CHROMIUM = shutil.which("chromium")
POINTED = """<script>
const svg = document.querySelectorAll('svg')[1], box = svg.getBoundingClientRect();
const at = (kind, part) => svg.dispatchEvent(new PointerEvent(kind, {clientX: box.left + part * box.width, clientY: box.top + 9, bubbles: true}));
at('pointermove', 0.5);
document.body.append(Object.assign(document.createElement('p'), {id: 'read', textContent: svg.nextElementSibling.textContent}));
at('pointerdown', 0.2); at('pointerup', 0.4);
document.body.append(Object.assign(document.createElement('p'), {id: 'zoomed', textContent: svg.previousElementSibling.textContent}));
svg.dispatchEvent(new MouseEvent('dblclick'));
document.body.append(Object.assign(document.createElement('p'), {id: 'whole', textContent: svg.previousElementSibling.textContent}));
</script>"""


def shown_by_chromium(page):
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "page.html"
        file.write_text(f"<!doctype html><meta charset='utf-8'><body>{page}{POINTED}</body>")
        words = [CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={folder}/profile", "--dump-dom", file.as_uri()]
        return subprocess.run(words, capture_output=True, text=True, timeout=120, check=True).stdout


class NotebookChart(unittest.TestCase):
    @unittest.skipUnless(CHROMIUM, "chromium is not installed")
    def test_the_pointer_reads_the_value_of_the_run_and_a_drag_zooms(self):
        r = sixstep.run(current())
        dom = shown_by_chromium(r._repr_html_())
        said = lambda name: html.unescape(re.search(rf'<p id="{name}">(.*?)</p>', dom)[1])
        t_ms, value, unit = re.fullmatch(r"(\S+) ms: (\S+) (.*)", said("read")).groups()
        self.assertEqual(unit, "A")
        self.assertAlmostEqual(float(t_ms), 2.5, delta=0.05)
        nearest = int(np.abs(r.time - float(t_ms) / 1e3).argmin())
        self.assertAlmostEqual(float(value), float(r.i_a[nearest]), delta=1e-4 * abs(float(value)) + 1e-6)
        begin, end = map(float, re.search(r"from (\S+) to (\S+) ms", said("zoomed")).groups())
        self.assertAlmostEqual(begin, 1.0, delta=0.05)
        self.assertAlmostEqual(end, 2.0, delta=0.05)
        self.assertAlmostEqual(float(re.search(r"to (\S+) ms", said("whole"))[1]), 1e3 * r.time[-1], delta=1e-3)

    def test_few_rows_are_drawn_and_no_peak_is_lost(self):
        r = sixstep.run(sixstep.Scenario(motor="maxon-251601", duration_s=0.2, control={"mode": "speed"}, reference={"value": 100, "unit": "rad/s"}))
        page = r._repr_html_()
        data = json.loads(re.search(r"application/json'>(.*?)</script>", page)[1])
        self.assertLess(len(data["time_ms"]), len(r.time) / 2)
        for column in data["columns"]:
            whole = r[column["label"].split(" ")[0]]
            self.assertAlmostEqual(max(column["values"]), float(whole.max()), delta=1e-6 * abs(float(whole.max())))
            self.assertAlmostEqual(min(column["values"]), float(whole.min()), delta=1e-6 * abs(float(whole.max())))

    def test_a_title_stays_text(self):
        page = sixstep.run(current(title="</script><script>alert(1)</script>"))._repr_html_()
        self.assertNotIn("<script>alert", page)
        self.assertEqual(page.count("<script"), 2)

    def test_a_notebooks_bar_is_updated_and_taken_away(self):
        told = []
        handle = types.SimpleNamespace(update=lambda shown: told.append(shown))
        display = types.ModuleType("IPython.display")
        display.HTML = lambda text: text
        display.display = lambda shown, display_id: told.append(shown) or handle
        ipython = types.ModuleType("IPython")
        ipython.get_ipython = lambda: types.SimpleNamespace(kernel=object())
        ipython.display = display
        with mock.patch.dict(sys.modules, {"IPython": ipython, "IPython.display": display}), contextlib.redirect_stderr(io.StringIO()) as silent:
            sixstep.run(current(duration_s=20.0), progress=True)
        self.assertEqual(silent.getvalue(), "")
        self.assertEqual(told[-1], "")
        parts = [float(re.search(r"value='([\d.]+)'", shown)[1]) for shown in told[:-1]]
        self.assertEqual(parts, sorted(parts))
        self.assertGreater(len(parts), 1)


class Live(unittest.TestCase):
    def setUp(self):
        os.environ["MPLBACKEND"] = "Agg"

    def test_the_chart_holds_what_the_session_had_and_the_run_keeps_its_bits(self):
        s = current()
        session = sixstep.Session(s)
        figure = sixstep.live.watch(session, "i_a_A", "speed_rad_s", to_s=5e-3, step_s=5e-4)
        t_ms, shown = (np.asarray(column) for column in figure.axes[0].lines[0].get_data())
        other = sixstep.Session(s)
        for t, x in zip(t_ms, shown):
            other.advance(t / 1e3)
            self.assertAlmostEqual(other["i_a_A"], x, delta=1e-9)
        self.assertEqual(session.close().digest, sixstep.run(s).digest)

    def test_wrong_words_are_told(self):
        session = sixstep.Session(current())
        with self.assertRaisesRegex(ValueError, "step_s"):
            sixstep.live.watch(session, "i_a_A", to_s=1e-3, step_s=0)
        with self.assertRaisesRegex(KeyError, "not a signal"):
            sixstep.live.watch(session, "nothing", to_s=1e-3, step_s=1e-4)


class Bridge(unittest.TestCase):
    def test_the_path_is_that_of_the_gates_and_the_signs_of_the_currents(self):
        from sixstep.plots import bridge, conducting

        r = sixstep.run(current())
        for at_s in np.linspace(1e-3, 4.9e-3, 7):
            n = int(np.searchsorted(r.time, at_s, side="right")) - 1
            figure = bridge(r, float(at_s))
            words = [text.get_text() for text in figure.axes[0].texts]
            self.assertIn(f"a: {r.i_a[n]:.3g} A", words)
            for k, phase in enumerate("abc"):
                i, u = float(r[f"i_{phase}_A"][n]), float(r[f"u_{phase}_V"][n])
                way = conducting(float(r[f"gate_T{2 * k + 1}"][n]), float(r[f"gate_T{2 * k + 2}"][n]), i)
                if abs(i) > 0.05:  # the terminal of a conducting leg is at the supply rail of its switch or diode
                    self.assertAlmostEqual(u, 24 if way.startswith("upper") else 0, delta=1.0, msg=f"{way} at {at_s}")

    def test_an_instant_outside_the_run_is_told(self):
        from sixstep.plots import bridge

        with self.assertRaisesRegex(ValueError, "within the run"):
            bridge(sixstep.run(current()), 1.0)


if __name__ == "__main__":
    unittest.main()
