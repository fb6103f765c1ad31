#!/bin/sh
# with_python.sh PYTHON SCRIPT [ARGUMENTS...]: runs the script if the interpreter has what it needs.
python=$1
shift
if ! "$python" -c 'import pyRDDLGym, rddlrepository' 2>/dev/null; then
    echo "error: $python has no pyRDDLGym; 'scripts/test.sh' sets it up, or:" >&2
    echo "  python3 -m venv .venv && .venv/bin/pip install -r tests/conformance/requirements.txt" >&2
    exit 1
fi
exec "$python" "$@"
