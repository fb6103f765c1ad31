#!/bin/sh
# Installs the solvers and planners into a folder of their own and builds a project that finds them there.
#   package.sh CMAKE BUILD_FOLDER SOURCE_FOLDER EXAMPLES
set -eu
cmake=$1 build=$2 source=$3 examples=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for component in rddlc solvers; do
    "$cmake" --install "$build" --component $component --prefix "$work/installed" > "$work/log" || { cat "$work/log"; exit 1; }
done
"$cmake" -G Ninja -S "$source/package" -B "$work/project" -DCMAKE_PREFIX_PATH="$work/installed" -DEXAMPLES="$examples" \
    > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }
"$cmake" --build "$work/project" > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }
"$work/project/car" train --out "$work/run" --gens 20
"$work/project/car" evaluate "$work/run/policy.cgp" | grep "^return"
"$work/project/plan" | grep "^planned"
