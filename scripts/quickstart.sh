#!/usr/bin/env bash
# Installs what rddlc needs (Debian 12), builds it, compiles the mountain car of examples/ to C++
# and runs 1,000 random episodes of it. Running it again costs only the episodes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source scripts/lib.sh

step "1/3 packages"
install_packages "${build_packages[@]}"

step "2/3 build (a few minutes the first time)"
cmake -S . -B build -G Ninja --log-level=WARNING
# The programs, and the libraries that `cmake --install` needs besides.
cmake --build build --target rddlc_installed

step "3/3 the mountain car: compile to C++, build, run 1,000 random episodes"
domain=examples/mountain_car/domain.rddl
instance=examples/mountain_car/instance.rddl
build/bin/rddlc "$domain" "$instance" -o build/mountain_car.cpp
echo "the simulator as C++: build/mountain_car.cpp"
build/bin/rddl run "$domain" "$instance" --episodes 1000
