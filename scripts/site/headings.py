"""The anchors of headings, as GitHub makes them: the pages are read in both places."""

import re


def slug(text: str, separator: str = "-") -> str:
    return re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", separator)
