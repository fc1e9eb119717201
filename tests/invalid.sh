#!/bin/sh
# Each folder of tests/invalid holds a scene.yaml that is at fault, itself or in what it names,
# and the exact message that the program prints for it; or a reconstruction that is, and in a file
# `import` the arguments of staffage-import. Where there is a file `fuse`, the scene is for staffage-fuse.
. "$top_srcdir/tests/tap.sh"

STAFFAGE_DATADIR=$top_srcdir
export STAFFAGE_DATADIR

for folder in "$top_srcdir"/tests/invalid/*/; do
    name=$(basename "$folder")
    cd "$folder" || exit 1
    # shellcheck disable=SC2046
    if [ -f import ]; then run "$top_builddir/staffage-import" $(cat import)
    elif [ -f fuse ]; then run "$top_builddir/staffage-fuse" scene.yaml -o "$work/out.ply"
    else run "$top_builddir/staffage-gen" scene.yaml -o "$work/out"
    fi
    cd "$work" || exit 1
    is "$status" 1 && cmp -s "$work/log" "$folder/error"
    ok $? "$name: $(cat "$folder/error")"
    rm -rf "$work/out"
done
tap_done
