#!/bin/sh
# make_dictionary.sh GRAMMAR VOCABULARY OUTPUT: a dictionary for libFuzzer.
set -eu
{
    grep -v '^//' "$1" | grep -o "'[^' \\]*'" | tr -d "'"
    grep -o '"[A-Za-z]*"' "$2" | tr -d '"'
    printf '%s\n' '?x' '@a' "x'" "x'(?x)" '_{?x : t}' '[?x]' '0' '9223372036854775807' '0.5'
} | sort -u | sed '/^$/d; s/.*/"&"/' > "$3"
