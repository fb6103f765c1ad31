#!/usr/bin/env bash
# Installs what the tests need (Debian 12), builds everything and passes all tests: once as
# released, and the tests of bad input again under the address and undefined-behaviour sanitizers.
# Running it again builds and installs only what has changed.
#
#   scripts/test.sh [--all] [CTEST ARGUMENTS...]      e.g. scripts/test.sh -R conformance
#
# --all is for releases, and takes longer: it adds the tests of every instruction set, random models
# and names, and the programs of benchmarks/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source scripts/lib.sh

all_tests=OFF
# Tests of bad input that take long run under the sanitizers alone.
once=(--exclude-regex '^(fuzz\.files|robustness\.(Bytes|Files|Mutations|Numbers|Pictures|SceneFiles|Sizes))$')
if [ "${1:-}" = --all ]; then
    all_tests=ON
    once=()
    shift
fi

times=""
began=$SECONDS
# time_of NAME: notes the seconds since the last call.
time_of() {
    times+="${times:+, }$1 $((SECONDS - began)) s"
    began=$SECONDS
}

step "1/4 packages"
install_packages "${build_packages[@]}" "${test_build_packages[@]}"
# These come while the sanitized build runs, which needs none of them: they wait mostly for the network.
install_rest() {
    install_packages "${test_packages[@]}"
    # The Python environment of the conformance tests, and of the Python package.
    [ -x .venv/bin/python ] || python3 -m venv .venv
    .venv/bin/pip install --quiet --disable-pip-version-check --requirement tests/conformance/requirements.txt
}
install_rest &
rest=$!
# If the build fails, they still come to an end: an installation that is cut off has to be repaired by hand.
trap wait EXIT
time_of packages

step "2/4 build with sanitizers"
# clang++ compiles in two thirds of the time of g++, and shows that it takes our sources without a warning. lld links
# sanitized programs, of up to 170 MB, in a fifth of the time of the default linker.
cmake -S . -B build/sanitize-clang -G Ninja --log-level=WARNING -DRDDLC_BUILD_TESTS=ON -DRDDLC_WARNINGS_AS_ERRORS=ON \
    -DRDDLC_SANITIZE=ON -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS="-O0 -g1" \
    -DCMAKE_EXE_LINKER_FLAGS=-fuse-ld=lld
cmake --build build/sanitize-clang --target sanitized_tests
wait "$rest"
time_of "sanitized build"

step "3/4 build"
cmake -S . -B build -G Ninja --log-level=WARNING -DRDDLC_BUILD_TESTS=ON -DRDDLC_WARNINGS_AS_ERRORS=ON \
    -DRDDLC_ALL_TESTS="$all_tests"
cmake --build build
time_of build

step "4/4 tests"
# Some tests read all of rddlrepository, where they find it.
RDDL_REPOSITORY=$(.venv/bin/python -c 'import rddlrepository; print(rddlrepository.__path__[0])')
export RDDL_REPOSITORY
# Tests that start with an empty cache of simulators compile the same again and again: once is enough,
# also for the precompiled header (https://ccache.dev/manual/4.7.html#_precompiled_headers).
export PATH="/usr/lib/ccache:$PATH" CCACHE_DIR="$PWD/build/ccache" CCACHE_MAXSIZE=1G
export CCACHE_SLOPPINESS=pch_defines,time_macros
# Tests wait for more than a hundred simulators. What the runtime always inlines is half of the time of the compiler,
# and makes simulators faster, not other ones. Tests of what the documentation shows and of the problems of
# rddlrepository have them as users do, and so have all with --all.
[ "$all_tests" = ON ] || export CXX="c++ -Dalways_inline=unused"
# One more than there are processors: some tests wait for a time limit, a browser or a child.
jobs=$(($(nproc) + 1))
# The end of a long log says what failed, and how.
show_failures() {
    local log=$1/Testing/Temporary test
    [ -f "$log/LastTestsFailed.log" ] || return 0
    cut -d: -f2- "$log/LastTestsFailed.log" | while read -r test; do
        echo "failed: $test"
        awk -v test="$test" '/^[0-9]+\/[0-9]+ Test: /{ shown = $3 == test } shown' "$log/LastTest.log" |
            tail -n 60
    done
}
rm -f build/Testing/Temporary/LastTestsFailed.log build/sanitize-clang/Testing/Temporary/LastTestsFailed.log
# Both sets run, even if the first fails; the exit status reports either failure.
status=0
ctest --test-dir build --parallel "$jobs" --output-on-failure ${once[@]+"${once[@]}"} "$@" || status=1
time_of tests
# The frames of sanitized code are several times as large: what just fits 8 MB of stack needs more. Short call
# stacks of allocations save a tenth of the time.
(
    ulimit -S -s 65536
    export ASAN_OPTIONS=malloc_context_size=3
    ctest --test-dir build/sanitize-clang --label-regex sanitize --parallel "$jobs" --output-on-failure "$@"
) || status=1
time_of "sanitized tests"
show_failures build
show_failures build/sanitize-clang
echo "took: $times"
[ "$status" -eq 0 ] || echo "error: some tests failed" >&2
exit "$status"
