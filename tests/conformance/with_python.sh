#!/bin/sh
# with_python.sh PYTHON SCRIPT [ARGUMENTS...]: runs the script if the interpreter has what it needs.
python=$1
shift
# Looks for the packages: importing them takes most of a second.
is_there='
import sys
from importlib.util import find_spec
sys.exit(not (find_spec("pyRDDLGym") and find_spec("rddlrepository")))'
if ! "$python" -c "$is_there" 2>/dev/null; then
    echo "error: $python has no pyRDDLGym; 'scripts/test.sh' sets it up, or:" >&2
    echo "  python3 -m venv .venv && .venv/bin/pip install -r tests/conformance/requirements.txt" >&2
    exit 1
fi
exec "$python" "$@"
