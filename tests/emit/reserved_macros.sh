#!/bin/sh
# Every macro that <rddl/simulator.hpp> brings along is known to compiler/emit/reserved_words.cpp.
#   reserved_macros.sh COMPILER STANDARD SOURCE_FOLDER
set -eu
words=$3/compiler/emit/reserved_words.cpp
missing=$(echo '#include <rddl/simulator.hpp>' |
    "$1" -std="$2" -pthread -I"$3/runtime" -dM -E -x c++ - |
    sed -n 's/^#define \([A-Za-z][A-Za-z0-9_]*\).*/\1/p' | grep -v -e __ -e "^RDDL_" | sort -u |
    while read -r macro; do grep -q "\"$macro\"" "$words" || echo "$macro"; done)
test -z "$missing" || { echo "not in $words: $missing"; exit 1; }
