"""The site of docs/ builds without a warning, stands alone, and has no dead links; planted faults are
found.

Run with ARBOC_SOURCE, the repository, and MKDOCS.
"""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["ARBOC_SOURCE"])


class Site(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name)
        for name in ("docs", "scripts"):
            shutil.copytree(SOURCE / name, self.root / name)
        for path in SOURCE.iterdir():  # what pages may speak of
            if path.name not in ("docs", "scripts", "build", ".git"):
                (self.root / path.name).symlink_to(path)

    def tearDown(self):
        self.folder.cleanup()

    def build(self):
        built = subprocess.run([os.environ["MKDOCS"], "build", "--clean", "-d", "site"],
                               cwd=self.root, capture_output=True, text=True)
        if built.returncode != 0:
            return built
        return subprocess.run([self.root / "scripts/check_site", self.root / "site"],
                              capture_output=True, text=True)

    def plant(self, text):
        with open(self.root / "docs/limbs.md", "a") as page:
            page.write(text)

    def test_builds(self):
        built = self.build()
        self.assertEqual(built.returncode, 0, built.stdout + built.stderr)
        for page in (self.root / "site").rglob("*.html"):
            loaded = re.findall(r"<(?:script|img|link)[^>]*(?:src|href)=\"?(https?:[^\s\">]*)",
                                page.read_text())
            self.assertEqual([url for url in loaded if "fonts" in url or ".js" in url], [], page)

    def test_every_page_is_in_the_navigation(self):
        (self.root / "docs/novel.md").write_text("# Something new\n")
        built = self.build()
        self.assertEqual(built.returncode, 0, built.stdout + built.stderr)
        index = (self.root / "site/index.html").read_text()
        for page in (self.root / "docs").glob("*.md"):
            self.assertIn(f'href="{page.stem}.html"', index.replace('href="./"', 'href="index.html"'))

    def test_dead_links_are_errors(self):
        for fault, said in (("\n[x](nothing.md)\n", "nothing.md"),
                            ("\n[x](pages.md#nowhere)\n", "#nowhere"),
                            ("\n[x](../models/nobody.urdf)\n", "nobody.urdf"),
                            ("\n![x](images/nothing.png)\n", "nothing.png")):
            with self.subTest(fault=fault):
                shutil.copy(SOURCE / "docs/limbs.md", self.root / "docs/limbs.md")
                self.plant(fault)
                built = self.build()
                self.assertNotEqual(built.returncode, 0)
                self.assertIn(said, built.stdout + built.stderr)


if __name__ == "__main__":
    unittest.main()
