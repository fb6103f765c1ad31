#!/bin/sh
# make_dictionary.sh OUTPUT GRAMMAR VOCABULARY...: a dictionary for libFuzzer.
set -eu
output=$1 grammar=$2
shift 2
{
    grep -v '^//' "$grammar" | grep -o "'[^' \\]*'" | tr -d "'"
    cat "$@" | grep -o '"[A-Za-z]*"' | tr -d '"'
    printf '%s\n' '?x' '@a' "x'" "x'(?x)" '_{?x : t}' '[?x]' '0' '9223372036854775807' '0.5'
} | sort -u | sed '/^$/d; s/.*/"&"/' > "$output"
