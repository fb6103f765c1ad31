#!/bin/sh
# No macro that <rddl/simulator.hpp> brings along can be the name of something of the user's: it has
# a capital that no small letter follows, a '_' at an end, two of them inside, or begins with rddl
# (which identifiers.hpp excludes), or is known to compiler/emit/names/reserved_words.cpp.
#   reserved_macros.sh COMPILER STANDARD SOURCE_FOLDER
set -eu
command -v "$1" >/dev/null || { echo "skipped: no $1"; exit 77; }
words=$3/compiler/emit/names/reserved_words.cpp
macros=$(echo '#include <rddl/simulator.hpp>' |
    "$1" -std="$2" -pthread -I"$3/runtime" -dM -E -x c++ - |
    sed -n 's/^#define \([A-Za-z_][A-Za-z0-9_]*\).*/\1/p')
test "$(echo "$macros" | wc -l)" -gt 1000
missing=$(echo "$macros" | grep -E '^([a-z]|[A-Z][a-z])' | grep -v -e __ -e '_$' -e '^rddl' | sort -u |
    while read -r macro; do grep -q "\"$macro\"" "$words" || echo "$macro"; done)
test -z "$missing" || { echo "not in $words: $missing"; exit 1; }
