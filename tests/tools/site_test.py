#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tools/site.sh makes one site of all pages. It has every page, the search finds each page by its words, and the
first page lists all of them."""
import json
import pathlib
import re
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.site = pathlib.Path(folder.name)
        subprocess.run([ROOT / "tools/site.sh", cls.site], check=True, capture_output=True, text=True)
        cls.pages = [file.relative_to(ROOT).with_suffix("") for file in (ROOT / "docs").rglob("*.md")]
        script = (cls.site / "searchindex.js").read_text(encoding="utf-8")
        cls.index = json.loads(re.sub(r"(?<=[{,])(\w+):", r'"\1":', script.removeprefix("Search.setIndex(").removesuffix(")")))

    def test_every_page_is_there_and_in_the_list_at_the_side(self):
        contents = (self.site / "README.html").read_text(encoding="utf-8")
        for page in self.pages:
            self.assertTrue((self.site / page).with_suffix(".html").is_file(), page)
            self.assertIn(f'href="{page}.html"', contents)

    def test_the_search_finds_a_page_by_its_words(self):
        for word, page in (("supercapacitor", None), ("hysteresi", "docs/gallery/current"), ("commiss", "docs/howto/commission-a-drive")):
            numbers = [self.index[of].get(word, []) for of in ("terms", "titleterms")]
            found = {self.index["docnames"][n] for group in numbers for n in (group if isinstance(group, list) else [group])}
            self.assertEqual(page in found, page is not None, (word, found))


if __name__ == "__main__":
    unittest.main()
