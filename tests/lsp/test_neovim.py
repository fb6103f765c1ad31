"""The first problem in a headless Neovim.

    RDDLC_BIN=build/bin test_neovim.py
"""

import sys

from real_editor import HERE, repair_in

if __name__ == "__main__":
    sys.exit(repair_in("nvim", "neovim", "lua", "--headless", "-u", "NONE", "-n", "-c", f"luafile {HERE / 'neovim.lua'}"))
