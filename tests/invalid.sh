#!/bin/sh
# Each folder of tests/invalid holds a scene.yaml that is at fault, itself or in what it names,
# and the exact message that the program prints for it.
. "$top_srcdir/tests/tap.sh"

STAFFAGE_DATADIR=$top_srcdir
export STAFFAGE_DATADIR

for folder in "$top_srcdir"/tests/invalid/*/; do
    name=$(basename "$folder")
    cd "$folder" || exit 1
    run "$top_builddir/staffage-gen" scene.yaml -o "$work/out"
    cd "$work" || exit 1
    is "$status" 1 && cmp -s "$work/log" "$folder/error"
    ok $? "$name: $(cat "$folder/error")"
    rm -rf "$work/out"
done
tap_done
