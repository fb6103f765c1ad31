"""Whether a program has printed what a page says."""

import re

# Output that differs between machines: times and rates, numbers of threads, vector registers.
TIME = r"(?<![\w.])\d[\d.,]* (?:ns|µs|us|ms|s|min)\b"
RATE = r"(?<![\w.])\d[\d.,]*(?: [kMG])? steps/s"
THREADS = r"with \d+ threads?\b"
REGISTERS = r"AVX-512|AVX2|SSE2"
OF_THE_MACHINE = re.compile(f"{RATE}|{TIME}|{THREADS}|{REGISTERS}")

NUMBER = re.compile(r"(?<![\w.])-?\d[\d,]*(?:\.\d+)?(?:e[-+]?\d+)?(?: [kMG]\b)?")


def comparable(text: str, loosely: bool) -> str:
    text = OF_THE_MACHINE.sub("#", text)
    text = "\n".join(line.rstrip() for line in text.strip("\n").split("\n"))
    return "".join(NUMBER.sub("#", text).split()) if loosely else text


def agree(written: str, printed: str, loosely: bool = False) -> bool:
    """`...` on the page stands for anything; `loosely` takes any number for another, and any white space."""
    parts = comparable(written, loosely).split("...")
    return re.fullmatch(".*?".join(map(re.escape, parts)), comparable(printed, loosely), re.S) is not None
