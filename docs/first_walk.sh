#!/usr/bin/env bash
# The parts of docs/first-walk.md that need no eyes: a fresh clone, a fresh environment, the README's
# commands in their order. Prints the seconds of each.
#
#     bash docs/first_walk.sh [SOURCE]     SOURCE: what is cloned, by default this repository
set -euo pipefail
source=$(realpath "${1:-$(dirname "$0")/..}")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export XDG_CACHE_HOME="$scratch/cache" BELLOWS_CACHE="$scratch/results" NO_COLOR=1
unset PYTHONPATH

step() { # what it is, and the command
    local name=$1 begun=$SECONDS
    shift
    if "$@" >"$scratch/output" 2>&1; then
        printf '%5d s  %s\n' $((SECONDS - begun)) "$name"
    else
        printf '%5d s  %s: FAILED\n' $((SECONDS - begun)) "$name"
        tail -n 20 "$scratch/output"
        exit 1
    fi
}

printf '%s processors, load %s, %s\n' "$(nproc)" "$(cut -d' ' -f1 /proc/loadavg)" "$(date -u +%F)"
step 'clone' git clone --quiet "$source" "$scratch/bellows-design"
cd "$scratch/bellows-design"
step 'environment' python3 -m venv .venv
step 'packages from pip' .venv/bin/pip install --quiet -e .
bellows=.venv/bin/bellows
step 'bellows --help, the first time' $bellows --help
step 'bellows --help, again' $bellows --help
step 'bellows run finger, the first time' $bellows run finger
step 'bellows init design my_finger.toml' $bellows init design my_finger.toml
step 'bellows check my_finger.toml' $bellows check my_finger.toml
step 'bellows evaluate my_finger.toml' $bellows evaluate my_finger.toml --no-cache
step 'bellows design, then check of the STL' bash -euc \
    "$bellows design my_finger.toml -o part.stl && $bellows check part.stl"
sed -n '/^```python$/,/^```$/p' README.md | sed '1d;$d' >"$scratch/ten_lines.py"
step "the README's lines of Python" .venv/bin/python "$scratch/ten_lines.py"
step 'packages of the site' .venv/bin/pip install --quiet -e '.[docs]'
step 'the site' .venv/bin/sphinx-build -W --keep-going -q -b html docs "$scratch/site"
if $bellows run fingr >/dev/null 2>"$scratch/mistake"; then exit 1; fi
printf 'a mistake: %s\n' "$(head -n 1 "$scratch/mistake")"
