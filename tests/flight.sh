#!/bin/sh
# A flight over a made-up place, from the scene file to the dataset: traffic on its roads, behind its walls, in its light.
. "$top_srcdir/tests/tap.sh"
. "$top_srcdir/tests/run/same-dataset.sh"
staffage=$top_builddir/staffage
for helper in compare-changes compare-frame make-place project-box same-pixels; do
    cp "$top_builddir/tests/run/$helper" .
done
cp "$top_srcdir/tests/input/box.obj" .
for model in sedan-middle.glb man-jacket-middle.glb woman-skirt-middle.glb; do
    cp "$(ls "$top_builddir/models/$model" "$top_srcdir/models/$model" 2>/dev/null | head -n 1)" .
done
./make-place . || exit 1

lens='300, 302, 161, 89, -0.05, 0.01, 0.001, -0.0005'
mesh_pose='{scale: 2, quaternion_wxyz: [0.70710678118654757, 0, 0, 0.70710678118654757], translation_m: [3, -2, 1]}'

# begin MESH WORLD_FROM_MESH: what all scenes share.
begin() {
    cat <<YAML
staffage: 1
place: {latitude_deg: 50, longitude_deg: 10}
time: 2022-06-01T15:00:00+02:00
light: {sky: clear, sun: {azimuth_deg: 225, elevation_deg: 40}, fill: 0.05}
ground: {albedo: 0.2}
roads: {osm: map.osm, sidewalk_m: 1.8}
static: {mesh: $1, world_from_mesh: $2}
labels: {palette: uavid}
quality: draft
cameras:
  drone: {model: OPENCV, size_px: [320, 180], params: [$lens]}
models:
  sedan: {file: sedan-middle.glb, class: car}
  man: {file: man-jacket-middle.glb, class: person}
  woman: {file: woman-skirt-middle.glb, class: person}
  box: {file: box.obj, unit_m: 1, up: z, front: x, class: truck}
YAML
}

# shot SECOND EYE TARGET [MORE]: a shot; without a photograph in MORE a new view.
shot() {
    echo "  - {camera: drone, time: 2022-06-01T15:00:0$1+02:00, pose: {look_at: {position_m: [$2], target_m: [$3]}}${4-}}"
}
# flight MORE: the flight's shots; NNNNNN stands for the number of each.
flight() {
    echo 'shots:'
    for number in 0 1 2; do
        case $number in
        0) set -- "$1" 0 '0, -26, 18' '0, 0, 0' ;;
        1) set -- "$1" 2 '18, -20, 18' '2, -2, 0' ;;
        2) set -- "$1" 2 '-16, -22, 16' '2, -3, 0' ;;
        esac
        shot "$2" "$3" "$4" "$(echo "$1" | sed "s/NNNNNN/00000$number/g")"
    done
}
elsewhere() { shot 5 '6, -24, 17' '1, -3, 0'; }
cast() {
    cat <<'YAML'
entities:
  - {name: box, model: box, path: Long Street, start_m: 38, offset_m: -7, speed_m_s: 4}
  - {name: half, model: sedan, at: {world_m: [2, -10.3]}, heading_deg: 90}
traffic:
  vehicles: {count: 3, models: {sedan: {}}, speed_m_s: 7, colors: ["#c9cbce", "#7b1a1d", "#274a7d"]}
  people: {count: 4, models: {man: {}, woman: {}}, speed_m_s: 1.35}
YAML
}

# The photographs, and their semantic and depth images: new views of the place with nobody there.
{ begin labelled.ply "$mesh_pose"; echo 'exposure: {value: 1}'; flight ''; elsewhere; } >before.yaml
run "$staffage" run before.yaml -o before
check "new views of a place with labels: pictures, depth and classes without a pass" \
    test $status = 0 -a -s before/rgb/000003.png -a -s before/semantic/000003.png -a -s before/depth/000003.exr \
    -a "$(find before/frames -name '*.pov' | wc -l)" = 0

taken=', photograph: before/rgb/NNNNNN.png, semantic: before/semantic/NNNNNN.png, depth: before/depth/NNNNNN.exr'
{ begin place.ply "$mesh_pose"; echo 'exposure: {roads: true}'; flight "$taken"; cast; } >flight.yaml
run "$staffage" run flight.yaml -o one -j 1
check "one command makes all frames of a flight" test $status = 0 -a "$(ls one/rgb | wc -l)" = 3

# Nothing but entities and their light changes.
for frame in 000000 000001 000002; do
    ./compare-frame one $frame before/rgb/$frame.png before/semantic/$frame.png before/depth/$frame.exr >figures
    cat figures >>all
    # figure NAME COLUMN
    figure() { awk -v name="$1" -v column="$2" '$1 == name { print $column }' figures; }
    check "$frame: entities and shadows are put in" test "$(figure rgb 2)" -gt 1000 -a "$(figure semantic 2)" -gt 500
    check "$frame: where the passes change nothing, each bit is the photograph's ($(figure rgb 3) px within the window)" \
        test "$(figure rgb 3)" -gt 1000 -a "$(figure rgb 4)" = 0
    check "$frame: its own semantic image, entities' pixels in UAVid's colours" is "$(figure semantic 3)" 0
    check "$frame: its own depth image, entities before the place" is "$(figure depth 3)" 0
done

check "the place stands round in each object pass, in files that are there" sh -c 'cd one && for f in frames/*/object.pov; do
    d=${f%/object.pov}; grep -q "Sky_Map *= *\"$d/far.exr\"" $f && grep -q "Relief_Map *= *\"$d/panorama.exr\"" $f &&
    grep -q "\"$d/relief.inc\"" $f && test -s $d/far.exr -a -s $d/panorama.exr -a -s $d/relief.inc || exit 1; done'

# One world, whoever looks at it when.
poses() { sed -n -e '/^   "id"/p' -e '/^   "world_from_entity"/,/^   }/p' "one/labels/$1.json"; }
check "two shots of one moment: everybody is at the same place" \
    test "$(poses 000001)" = "$(poses 000002)" -a "$(poses 000001 | grep -c '"id"')" -ge 6
check "two shots of two moments: they moved" not test "$(poses 000000)" = "$(poses 000001)"
commas() { echo "$1" | tr -d ','; }
for seen in '000001 18 -20 18 2 -2 0' '000002 -16 -22 16 2 -3 0'; do
    off=$(./project-box "one/labels/${seen%% *}.json" 1 ${seen#* } $(commas "$lens"))
    check "${seen%% *}: the box of a moving entity is where a camera by the book sees it (off by $off px)" \
        awk -v off="$off" 'BEGIN { exit !(off != "" && off < 1) }'
done

# Behind a wall.
sed -n '/^   "id": 2,/,/^  }/p' one/labels/000000.json >half
fraction=$(sed -n 's/.*"visible_fraction": \([0-9.]*\).*/\1/p' half)
check "half behind a wall: seen in part ($fraction)" awk -v f="$fraction" 'BEGIN { exit !(f > 0.3 && f < 0.95) }'
check "half behind a wall: the place hides it" grep -q '"kind": "place"' half
check "half behind a wall: what is hidden and what is seen add up" awk -F '[:,]' '
    /"pixels_visible"/ { seen = $2 } /"pixels_amodal"/ { all = $2 } /"pixels":/ { hidden += $2 }
    END { exit !(all > 0 && seen + hidden == all) }' half
check "half behind a wall: its edge is soft in the picture" awk '$1 == "soft" { soft += $3 } END { exit !(soft >= 10) }' all
{ begin place.ply "$mesh_pose"; echo 'exposure: {roads: true}'; flight "$taken" | sed -n 1,2p
  echo 'entities: [{name: behind, model: sedan, at: {world_m: [-14, 21]}, heading_deg: 45}]'; } >hidden.yaml
run "$staffage" run hidden.yaml -o hidden
check "wholly hidden, with its shadow: no pass is rendered" \
    test $status = 0 -a "$(find hidden/frames \( -name '*.pov' -o -name object.exr \) | wc -l)" = 0
check "wholly hidden: the photograph as it was" ./same-pixels before/rgb/000000.png hidden/rgb/000000.png
check "wholly hidden: the labels know of it" grep -q '"visible_fraction": 0.0' hidden/labels/000000.json

# The same again.
run "$staffage" run flight.yaml -o part --frames 2:3
( cd part && find . -path ./frames/home -prune -o -name '*000002*' -type f -print -o -path '*/000002/*' -type f -print ) >names
check "one frame alone: the same as among the others" test $status = 0 -a -s part/rgb/000002.png -a "$(ls part/rgb | wc -l)" = 1
check "one frame alone: the same pixels and labels" same_files one part <names
run "$staffage" generate flight.yaml -o other --seed 7 --frames 0:1
check "another seed: another scenario" not cmp -s one/frames/000000/labels.json other/frames/000000/labels.json
"$staffage" run flight.yaml -o killed -j 2 >log 2>&1 &
pid=$!
until [ "$(find killed/frames -name object.exr 2>/dev/null | wc -l)" -ge 1 ] || ! kill -0 $pid 2>/dev/null; do sleep 0.05; done
kill -KILL $pid
wait $pid 2>/dev/null
check "killed with -9: in the middle" test ! -e killed/rgb/000002.png
run "$staffage" run flight.yaml -o killed -j 2
check "killed and run again, -j 2: the same pixels and labels as undisturbed, -j 1" same_dataset one killed

# with NAME YAML REACH: the flight's first frame, with more keys; compare-changes goes to figures.
with() {
    { cat flight.yaml; echo "$2"; } >"$1.yaml"
    run "$staffage" run "$1.yaml" -o "$1" --frames 0:1
    ./compare-changes before/rgb/000000.png one/rgb/000000.png "$1/rgb/000000.png" "$3" >figures
}
changes() { awk -v column="$1" '{ print $column }' figures; }
same_labels() {
    ( cd "$1" && find . -path ./frames -prune -o -path ./rgb -prune -o -name '*000000*' -type f -print -o -path '*/000000/*' -type f -print ) >names
    test "$(wc -l <names)" -ge 8 && same_files one "$1" <names
}
with mist 'weather: {visibility_m: 300, haze: "#8a9096"}' 1
check "mist: a frame, otherwise than without" test $status = 0 -a "$(changes 3)" -gt 1000
check "mist: nothing that was still changes" is "$(changes 5)" 0
check "mist: the same labels" same_labels mist
with blur 'lens: {exposure_s: 0.02, defocus_px: 3, focus_m: 10, softness_px: 0.7}' 10
check "lens: a frame, otherwise than without" test $status = 0 -a "$(changes 3)" -gt 500
check "lens: blur reaches beyond what was put in, and ends" test "$(changes 2)" -gt "$(changes 1)" -a "$(changes 5)" = 0
check "lens: the same labels" same_labels blur

# The paper's own transfer and mask.
{ sed 's/^labels: .*/labels: {palette: uavid, mask: dilated}/' flight.yaml; echo 'transfer: {method: threshold}'; } >threshold.yaml
run "$staffage" run threshold.yaml -o threshold --frames 0:1
./compare-changes before/instance/000000.png one/instance/000000.png threshold/instance/000000.png 1 >figures
check "thresholds and dilated masks: a frame" test $status = 0 -a -s threshold/rgb/000000.png
check "dilated masks grow by one pixel at most" test "$(changes 2)" -gt "$(changes 1)" -a "$(changes 5)" = 0
./compare-frame threshold 000000 before/rgb/000000.png before/semantic/000000.png before/depth/000000.exr >figures
check "thresholds: where the passes change nothing, each bit is the photograph's" \
    test "$(figure rgb 2)" -gt 1000 -a "$(figure rgb 4)" = 0
check "dilated masks: semantic image by them" is "$(figure semantic 3)" 0

# From photographs to poses without one.
run "$staffage" fuse flight.yaml -o semantic.ply
check "semantic images are fused onto the mesh" test $status = 0 -a -s semantic.ply
{ begin semantic.ply '{}'; echo 'exposure: {value: 1}'; echo 'shots:'; elsewhere; cast; } >view.yaml
run "$staffage" run view.yaml -o view
./compare-frame view 000000 before/rgb/000003.png before/semantic/000003.png before/depth/000003.exr >figures
check "a new view of it, with traffic: picture, depth, classes" \
    test $status = 0 -a -s view/rgb/000000.png -a "$(figure semantic 2)" -gt 300
check "its picture is the mesh's own where the passes change nothing, bit for bit" test "$(figure rgb 3)" -gt 1000 -a "$(figure rgb 4)" = 0
check "its classes are those of the place for 97 of 100 pixels" test "$(figure semantic 3)" -lt 1728

# Table I.
cat all >figures
covered=$(awk '$1 == "semantic" { n += $2 } END { print n }' figures)
run "$staffage" stats one
check "stats: a table of classes before and after" test $status = 0 -a "$(grep -c -e '^moving car  *0.000 ' -e '^human  *0.000 ' log)" = 2
run "$staffage" stats one --json
check "stats: its pixels are those of the masks" is "$(awk -F '[:,]' '
    /"name"/ { ours = /moving car|human/ } /"pixels_after"/ { if (ours) n += $2 } END { print n }' log)" "$covered"
tap_done
