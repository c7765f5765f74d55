#!/usr/bin/env bash
# Renders every stored picture anew: export, then render.py. Needs the environment of
# requirements.txt (`PYTHON` names its interpreter); a minute.
#
#     python3 -m venv venv && venv/bin/pip install -r reference/requirements.txt
#     PYTHON=venv/bin/python reference/make.sh [NAME...]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
python=${PYTHON:-python3}
exports=$(mktemp -d)
trap 'rm -rf "$exports"' EXIT

catoptric() {
    cargo run --quiet --release --manifest-path "$here/../Cargo.toml" -p catoptric -- --quiet "$@"
}

names=("$@")
if [[ ${#names[@]} == 0 ]]; then
    for scene in "$here"/scenes/*.toml; do
        names+=("$(basename "$scene" .toml)")
    done
fi

for name in "${names[@]}"; do
    bounces=8
    [[ $name == bowl ]] && bounces=4
    catoptric export "$here/scenes/$name.toml" --mitsuba "$exports/$name" --bounces "$bounces"
    hand_written=()
    [[ -f $here/scenes/$name.xml ]] && hand_written=(--xml "$here/scenes/$name.xml")
    "$python" "$here/render.py" "$exports/$name" -o "$here/$name.exr" "${hand_written[@]}"
    if [[ $name == sphere ]]; then
        "$python" "$here/render.py" "$exports/$name" -o "$here/$name-64-samples.exr" \
            --samples 64 --resolution 64x64
    fi
done
