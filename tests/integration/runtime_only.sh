#!/bin/sh
# Installs the runtime alone, and builds a project with it; then one that fetches the repository.
#   runtime_only.sh CMAKE REPOSITORY RDDLC SOURCE_FOLDER EXPECTED
set -eu
cmake=$1 repository=$2 rddlc=$3 source=$4 expected=$5
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
quietly() { "$@" > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }; }

"$rddlc" "$source/problem.rddl" --extern "$source/functions.hpp" -o "$work/tank.cpp"

quietly "$cmake" -G Ninja -S "$repository" -B "$work/runtime" -DRDDLC_RUNTIME_ONLY=ON
quietly "$cmake" --install "$work/runtime" --prefix "$work/installed"
test ! -e "$work/installed/bin"
quietly "$cmake" -G Ninja -S "$source/runtime_only" -B "$work/found" -DTANK="$work/tank.cpp" \
    -DCMAKE_PREFIX_PATH="$work/installed"
quietly "$cmake" --build "$work/found"
"$work/found/linked" | diff "$expected" -

quietly "$cmake" -G Ninja -S "$source/runtime_only" -B "$work/fetched" -DTANK="$work/tank.cpp" \
    -DSOURCES="$repository"
quietly "$cmake" --build "$work/fetched"
"$work/fetched/linked" | diff "$expected" -

# Asking for the compiler gives a sentence if only the runtime is installed.
sed 's/COMPONENTS runtime/COMPONENTS compiler/' "$source/runtime_only/CMakeLists.txt" > "$work/CMakeLists.txt"
if "$cmake" -G Ninja -S "$work" -B "$work/refused" -DTANK=x -DCMAKE_PREFIX_PATH="$work/installed" \
    > "$work/log" 2>&1; then exit 1; fi
grep -q "compiler" "$work/log"
