#!/bin/sh
# Installs this build into a folder of its own and builds a project that finds it there.
#   package.sh CMAKE BUILD_FOLDER SOURCE_FOLDER EXPECTED
set -eu
cmake=$1 build=$2 source=$3 expected=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$cmake" --install "$build" --component rddlc --prefix "$work/installed" > "$work/log" || { cat "$work/log"; exit 1; }
"$cmake" -G Ninja -S "$source/package" -B "$work/project" -DCMAKE_PREFIX_PATH="$work/installed" \
    -DCMAKE_COMPILE_WARNING_AS_ERROR=ON > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }
"$cmake" --build "$work/project" > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }
"$work/project/linked" | diff "$expected" -
"$work/project/included" | diff "$expected" -
"$work/project/loaded" "$work/project/libwrapped.so" | diff "$expected" -

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

# Another compiler is given the flags that it takes without a warning.
if command -v clang++ > /dev/null; then
    CXX=clang++ "$cmake" -G Ninja -S "$source/package" -B "$work/clang" -DCMAKE_PREFIX_PATH="$work/installed" \
        -DCMAKE_COMPILE_WARNING_AS_ERROR=ON > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }
    "$cmake" --build "$work/clang" --target linked > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }
    "$work/clang/linked" | diff "$expected" -
    grep -q -e -ffp-contract=off "$work/clang/build.ninja"
fi

# A wrong call is refused at configuration, in a sentence.
refuses() {
    if "$cmake" -G Ninja -S "$source/package" -B "$work/wrong-$1" -DCMAKE_PREFIX_PATH="$work/installed" \
        -DWRONG="$1" > "$work/log" 2>&1; then echo "$1 is not refused"; exit 1; fi
    tr -s ' \n' ' ' < "$work/log" | grep -q "$2" || { cat "$work/log"; exit 1; }
}
refuses domain "there is no file 'missing.rddl'"
refuses extern "there is no file 'missing.hpp'"
refuses language "simulators are C++, which this project does not enable"
refuses component "rddlc has no component 'pictures'; it has compiler, runtime and solvers"
