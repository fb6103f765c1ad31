#!/usr/bin/env bash
# Plays the protocol of IPPC with the programs that also speak it (docs/planning.md): PROST and rddlsim's client against
# `rddl serve`, and `rddl play` against rddlsim's server.
#
#   scripts/ippc.sh PROST RDDLSIM [ROUNDS]
#
# PROST is a folder of github.com/prost-planner/prost after its build.py, RDDLSIM one of github.com/ssanner/rddlsim after its
# compile. `rddl` is found by the PATH or $RDDL; the problem is the first instance of Elevators of IPPC 2011, from rddlrepository.
set -euo pipefail

prost=$(realpath "$1"); rddlsim=$(realpath "$2"); rounds=${3:-5}
rddl=${RDDL:-rddl}
repository=${RDDL_REPOSITORY:-$(python3 -c 'import rddlrepository, os; print(os.path.dirname(rddlrepository.__file__))')}
problem=$repository/archive/competitions/IPPC2011/Elevators/MDP
instance=elevators_inst_mdp__1
seconds=$((rounds * 20))

folder=$(mktemp -d)
server=
trap 'kill $server 2>/dev/null || true; rm -rf "$folder"' EXIT

# wait_for FILE TEXT: until a server has printed it
wait_for() {
  for _ in $(seq 300); do
    if grep -q "$2" "$1" 2>/dev/null; then return; fi
    sleep 0.2
  done
  echo "no server: $(cat "$1")" >&2
  exit 1
}
classes=$rddlsim/bin
for jar in "$rddlsim"/lib/*.jar; do classes=$classes:$jar; done

# rddlsim finds a problem by the names of its files.
mkdir "$folder/problems"
cp "$problem/domain.rddl" "$folder/problems/elevators_mdp.rddl"
cp "$problem/instance1.rddl" "$folder/problems/$instance.rddl"

echo "== clients of others against rddl serve"
"$rddl" serve "$problem" 1 --port 0 --rounds "$rounds" --time "$seconds" --sessions 2 > "$folder/serve" 2>&1 &
server=$!
wait_for "$folder/serve" " at "
port=$(sed -n '1s/.*://p' "$folder/serve")
cp "$prost/builds/release/rddl_parser/rddl-parser" "$folder/rddl-parser-release"
(cd "$folder" && "$prost/builds/release/search/search" $instance -p "$port" "[PROST -s 1 -tm UNI -se [IPC2014]]" > prost.log)
(cd "$rddlsim" && java -cp "$classes" rddl.competition.Client "$folder/problems" localhost rddlsim \
  rddl.policy.NoopPolicy "$port" 1 $instance > "$folder/client.log" 2>&1)
wait $server
cat "$folder/serve"

echo "== rddl play against rddlsim's server"
# Its arguments: problems, port, rounds, seed, one session, seconds.
(cd "$rddlsim" && exec java -cp "$classes" rddl.competition.Server "$folder/problems" 2331 "$rounds" 0 1 "$seconds" \
  > "$folder/server" 2>&1) &
server=$!
wait_for "$folder/server" Initialized
"$rddl" play localhost:2331 --problem-name $instance --policy plan:uct,iterations=200
