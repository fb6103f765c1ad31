#!/bin/sh
# rddlc and c++ by hand: a source file to link, a header to include, a shared object to load.
#   by_hand.sh RDDLC INCLUDE_FOLDER SOURCE_FOLDER EXPECTED
set -eu
rddlc=$1 include=$2 source=$3 expected=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cxx="${CXX:-c++} -std=c++20 -O1 -Wall -Wextra -Werror -ffp-contract=off -I$include -I$source -I$work"

"$rddlc" "$source/problem.rddl" --extern "$source/functions.hpp" -o "$work/tank.cpp"
$cxx "$work/tank.cpp" "$source/linked.cpp" -o "$work/linked" -pthread
"$work/linked" | diff "$expected" -

"$rddlc" "$source/problem.rddl" --extern "$source/functions.hpp" -o "$work/tank.hpp"
$cxx "$source/included.cpp" -o "$work/included" -pthread
"$work/included" | diff "$expected" -

"$rddlc" "$source/problem.rddl" --extern "$source/functions.hpp" -o "$work/tank.so"
$cxx "$source/loaded.cpp" -o "$work/loaded" -ldl
"$work/loaded" "$work/tank.so" | diff "$expected" -
# Nothing but what was asked for.
test "$(ls -A "$work" | tr '\n' ' ')" = "included linked loaded tank.cpp tank.hpp tank.so "
