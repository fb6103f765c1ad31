#!/bin/sh
# Both programs of rddl_add_solver: train, evaluate, resume, and refuse.
#   program.sh PPO_PROGRAM CGP_PROGRAM
set -e
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
ppo=$1 cgp=$2

"$ppo" train --out "$folder/ppo" --steps 40000 --envs 16 --rollout 64 --minibatch 256 --seed 1
"$ppo" evaluate "$folder/ppo/policy.json" --episodes 5 | grep "of 5 terminated, 0 faults"
"$ppo" train --out "$folder/recurrent" --steps 8192 --envs 8 --rollout 64 --minibatch 256 --recurrent 8
grep -q '"recurrent":{"units":8,' "$folder/recurrent/policy.json"
"$ppo" evaluate "$folder/recurrent/policy.json" --episodes 5 | grep "0 faults"
"$ppo" train --out "$folder/relu" --steps 8192 --envs 8 --rollout 64 --minibatch 256 --activation relu
grep -q '"activation":"relu",' "$folder/relu/policy.json"
"$ppo" evaluate "$folder/relu/policy.json" --episodes 5 | grep "0 faults"
"$cgp" train --out "$folder/cgp" --gens 60
"$cgp" evaluate "$folder/cgp/policy.cgp" --episodes 1 | tee "$folder/evaluation"
grep "^return [89][0-9].* 1 of 1 terminated" "$folder/evaluation"  # it reaches the flag
"$cgp" train --out "$folder/cgp" --gens 80 --resume

# The widest registers do what narrower ones do.
for set in avx2 avx512; do
  RDDL_INSTRUCTION_SET=$set "$ppo" train --out "$folder/$set" --steps 20000 --envs 16 --rollout 64 --minibatch 256
done
cmp "$folder/avx2/last.json" "$folder/avx512/last.json"

if "$ppo" train --out "$folder/ppo" 2> "$folder/err"; then exit 1; fi
grep "holds a run already" "$folder/err"
if "$ppo" evaluate "$folder/cgp/policy.cgp" 2> "$folder/err"; then exit 1; fi
grep "error" "$folder/err"
if "$ppo" train --steps many --out "$folder/x" 2> "$folder/err"; then exit 1; fi
grep "'many' is not a number" "$folder/err"
if "$ppo" train --activation gelu --out "$folder/x" 2> "$folder/err"; then exit 1; fi
grep "'gelu' is not one of tanh, relu" "$folder/err"
for option in "--clip nan" "--gamma 2" "--epochs -1" "--minibatch 0" "--hidden 64,0" "--seed -1" "--envs 1e99"; do
  if "$ppo" train $option --out "$folder/x" 2> "$folder/err"; then exit 1; fi
  grep -- "${option% *}: '.*' is not " "$folder/err"
done
if "$ppo" train --minibach 5 --out "$folder/x" 2> "$folder/err"; then exit 1; fi
grep "there is no option '--minibach'; did you mean '--minibatch'?" "$folder/err"
for option in "--cols -1" "--lambda 0" "--islands 99999" "--lifted maybe"; do
  if "$cgp" train $option --out "$folder/x" 2> "$folder/err"; then exit 1; fi
  grep -- "${option% *}: '.*' is not " "$folder/err"
done
test ! -e "$folder/x"
# The preset comes first wherever it stands, and every option is there.
"$ppo" train --out "$folder/preset" --steps 4096 --minibatch 128 --preset sb3 --epochs 1 --squash on --noise white
"$cgp" train --out "$folder/functions" --gens 5 --functions add,logic --time-input --fitness min
