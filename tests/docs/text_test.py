"""README.md, CONTRIBUTING.md and other pages outside of the site: links lead somewhere, and commits
that are cited as examples are in the history.

Run with ARBOC_SOURCE, the repository.
"""

import os
import pathlib
import re
import subprocess
import unittest

SOURCE = pathlib.Path(os.environ["ARBOC_SOURCE"])
LINK = re.compile(r"\]\((?!https?:)([^)#]*)(?:#([^)]*))?\)")


def prose(page):
    return re.sub(r"^```.*?^```", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)


def places(page):
    """Anchors of the headings, as they are made of them."""
    titles = re.findall(r"^#+ (.+)$", prose(page), re.MULTILINE)
    return {re.sub(r"[-\s]+", "-", re.sub(r"[^\w\s-]", "", title).strip().lower()) for title in titles}


def git(*arguments):
    return subprocess.run(["git", "-C", SOURCE, *arguments], capture_output=True, text=True)


class Text(unittest.TestCase):
    def test_links(self):
        pages = [SOURCE / "README.md", SOURCE / "CONTRIBUTING.md", SOURCE / "bench/README.md",
                 *sorted((SOURCE / "docs").glob("*.md"))]
        count = 0
        for page in pages:
            for path, place in LINK.findall(prose(page)):
                target = (page.parent / path) if path else page
                with self.subTest(page=page.name, link=path):
                    self.assertTrue(target.exists())
                    if place:
                        self.assertIn(place, places(target))
                count += 1
        self.assertGreater(count, 50)

    def test_cited_commits(self):
        cited = re.findall(r"git show ([0-9a-f]{7,})", (SOURCE / "docs/extending.md").read_text())
        self.assertGreaterEqual(len(cited), 5)
        if git("rev-parse", "--is-shallow-repository").stdout.strip() != "false":
            self.skipTest("no history here")
        for commit in cited:
            self.assertEqual(git("merge-base", "--is-ancestor", commit, "HEAD").returncode, 0, commit)


if __name__ == "__main__":
    unittest.main()
