"""The first problem in Emacs without a display, by eglot: Debian's packages emacs-nox and elpa-eglot.

    RDDLC_BIN=build/bin test_emacs.py
"""

import sys

from real_editor import HERE, repair_in

if __name__ == "__main__":
    sys.exit(repair_in("emacs", "emacs-nox, and elpa-eglot before Emacs 29", "elisp", "--batch", "-l", HERE / "emacs.el"))
