#!/bin/sh
# Installs this build into a folder of its own and builds a project that finds it there.
#   package.sh CMAKE BUILD_FOLDER SOURCE_FOLDER EXPECTED
set -eu
cmake=$1 build=$2 source=$3 expected=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$cmake" --install "$build" --component rddlc --prefix "$work/installed" > "$work/log" || { cat "$work/log"; exit 1; }
"$cmake" -G Ninja -S "$source/package" -B "$work/project" -DCMAKE_PREFIX_PATH="$work/installed" \
    > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }
"$cmake" --build "$work/project" > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }
"$work/project/linked" | diff "$expected" -
"$work/project/included" | diff "$expected" -

# The project names no build type: its simulator is compiled for speed all the same, and rightly.
for flag in -O3 -ffp-contract=off; do grep -q -e "$flag" "$work/project/build.ninja"; done

# The installed program finds the installed headers.
unset RDDLC_INCLUDE
"$work/installed/bin/rddlc" "$source/problem.rddl" --extern "$source/functions.hpp" -o "$work/tank.so"
test -f "$work/tank.so"

# Nothing is made again unless its files change.
"$cmake" --build "$work/project" > "$work/log" 2>&1
! grep -q "Compiling" "$work/log"
grep -q "functions.hpp" "$work/project/tank_simulator.rddl/tank_simulator.cpp.d"
