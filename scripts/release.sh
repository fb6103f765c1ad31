#!/usr/bin/env bash
# Packs the commit that is checked out, with the parser that ANTLR makes of its grammar, so that who
# builds it needs neither ANTLR's tool nor Java:
#
#   scripts/release.sh [BUILD_FOLDER]      makes BUILD_FOLDER/rddlc-VERSION.tar.gz (build/...)
set -euo pipefail
source=$(realpath "$(dirname "${BASH_SOURCE[0]}")/..")
build=$(realpath "${1:-$source/build}")
cd "$source"

cmake -S . -B "$build" -G Ninja --log-level=WARNING
cmake --build "$build" --target rddlc_parser >&2

name=rddlc-$(sed -n 's/^project(rddlc VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
parser=$build/grammar/generated/grammar
# The grammar beside the parser shows later from which grammar it was made.
git archive --output="$build/$name.tar.gz" --prefix="$name/grammar/parser/" \
    --add-file="$parser/RDDLLexer.h" --add-file="$parser/RDDLLexer.cpp" \
    --add-file="$parser/RDDLParser.h" --add-file="$parser/RDDLParser.cpp" \
    --add-file=grammar/RDDL.g4 --prefix="$name/" HEAD
echo "$build/$name.tar.gz"
