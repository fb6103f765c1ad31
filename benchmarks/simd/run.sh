#!/bin/sh
# run.sh: compares rddl/lanes/simd.hpp with SIMD libraries, at each level that this processor has. Needs
# Debian's libxsimd-dev and libhwy-dev; std::experimental::simd comes with g++.
set -eu
here=$(dirname "$0")
program=$(mktemp)
trap 'rm -f "$program"' EXIT
for level in x86-64-v3 x86-64-v4; do
    # Highway accepts a target only if AES is also there.
    ${CXX:-g++} -std=c++20 -O3 -ffp-contract=off -march=$level -maes -mpclmul \
        -I"$here/../../runtime" -o "$program" "$here/main.cpp"
    echo "$level"
    "$program" || echo "  this processor does not have $level"
done
