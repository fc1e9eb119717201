#!/bin/sh
# The tracer's masks of real vehicles against POV-Ray's, of the scene that is rendered: one ray a pixel, no light.
. "$top_srcdir/tests/tap.sh"
shared=${STAFFAGE_SHARED:-$top_srcdir/../shared}
what="four vehicles at Craig Street"
if [ ! -f "$shared/data/README.md" ]; then
    skip "$what: traced and rendered masks agree" "no ../shared or STAFFAGE_SHARED"
    tap_done
fi
shared=$(cd "$shared" && pwd)
sed "s|@SHARED@|$shared|g" "$top_srcdir/tests/bench/craig-1000x750-4.yaml" >craig.yaml

run "$top_builddir/staffage" generate craig.yaml -o out
check "$what: a frame is generated" is $status 0

compare=$top_builddir/tests/run/compare-masks
size=$("$compare" out/frames/000000/frame.json)
sed -i 's/#declare Radiosity = 1;/#declare Radiosity = 0;/' out/frames/000000/object.pov
cd out || exit 1
# shellcheck disable=SC2086 # two options
run povray +Iframes/000000/object.pov +O../object.exr $size +FE +UA -A -D -GA +WT1 +Ltemplates
cd ..
check "$what: POV-Ray renders it" is $status 0

"$compare" out/frames/000000/frame.json object.exr out/frames/000000/instance.png >log 2>&1
large=0
while read -r id pixels iou stray; do
    [ "$pixels" -gt 1000 ] || continue
    large=$((large + 1))
    check "entity $id, $pixels pixels: IoU $iou" awk "BEGIN { exit !($iou >= 0.995) }"
    check "entity $id: pixels that disagree are at an edge" is "$stray" 0
done <log
check "$what: each of more than 1000 pixels" is "$large" 4
tap_done
