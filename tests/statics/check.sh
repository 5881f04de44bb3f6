#!/bin/sh
# Studies samples and compares what is written with other programs.
#
#     tests/statics/check.sh RODWRIGHT [PYTHON]
#
# Needs ccx (Debian: calculix-ccx) and a Python with tests/statics/requirements.txt.
set -eu
here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd)
samples=$here/../../samples
program=$1
python=${2:-python3}
home=$(mktemp -d)
trap 'rm -rf "$home"' EXIT

# Name of the study, sample, then options of `rodwright statics`.
study() {
    name=$1 sample=$2
    shift 2
    "$program" build --design "$samples/$sample.toml" -q --only csv -o "$home/$name"
    "$program" statics "$home/$name" -q "$@"
    "$python" "$here/compare.py" "$home/$name/statics.json"
    "$python" "$here/read_mac.py" "$home/$name"
    "$python" "$here/run_ccx.py" "$home/$name"
}

study tied igloo --joint tied --snow 100Pa --load R012:5N
study notched igloo --joint notched --feet fixed --rod-material steel --snow 100Pa
study nailed hut --joint nailed --load top:1kg --combine weight --combine "1.35 weight + 1.5 loads"
study tapered igloo-poles --joint notched --snow 50Pa
