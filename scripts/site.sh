#!/usr/bin/env bash
# Makes the documentation site in build/site/html, with the programs of build/bin. MkDocs Material comes from PyPI,
# into build/site/venv; the build of rddlc does not need it. `scripts/site.sh --serve` also shows the site at
# http://127.0.0.1:8000.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
folder=build/site
mkdir -p "$folder"

if ! cmp --silent scripts/site/requirements.txt "$folder/venv/installed.txt"; then
    python3 -m venv "$folder/venv"
    "$folder/venv/bin/pip" install --quiet --requirement scripts/site/requirements.txt
    cp scripts/site/requirements.txt "$folder/venv/installed.txt"
fi
"$folder/venv/bin/python" scripts/site/make_pages.py --bin build/bin "$folder"
export PYTHONPATH=scripts/site NO_MKDOCS_2_WARNING=1
"$folder/venv/bin/python" -m mkdocs build --strict --quiet --clean --config-file "$folder/mkdocs.yml"
echo "the site: $folder/html/index.html"
if [ "${1:-}" = --serve ]; then
    exec "$folder/venv/bin/python" -m http.server --bind 127.0.0.1 --directory "$folder/html" 8000
fi
