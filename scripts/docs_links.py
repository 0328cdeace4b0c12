"""MkDocs hook: links from docs/ to files of the repository, which are no pages of the site.

`[text](../models/ur5/ur5.urdf)` becomes the text and the path in the clone; a file that is not there
is an error, as dead links between pages are.
"""

import os
import re

from mkdocs.exceptions import PluginError

LINK = re.compile(r"\[([^\]]+)\]\((\.\./[^)#]+)(#[^)]*)?\)")
FENCE = re.compile(r"^(```.*?^```[ ]*$)", re.MULTILINE | re.DOTALL)


def on_page_markdown(markdown, page, config, files):
    root = os.path.dirname(config["docs_dir"])

    def replace(link):
        text, path = link[1], os.path.normpath(link[2][len("../"):])
        if not os.path.exists(os.path.join(root, path)):
            raise PluginError(f"{page.file.src_path}: no {path} in the repository")
        return f"{text} (`{path}`)" if text.strip("`") not in (path, path + "/") else f"`{path}`"

    parts = FENCE.split(markdown)
    return "".join(part if part.startswith("```") else LINK.sub(replace, part) for part in parts)
