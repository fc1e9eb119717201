#!/bin/sh
# staffage import, from the command line to a scene that staffage-gen takes.
. "$top_srcdir/tests/tap.sh"
STAFFAGE_DATADIR=$top_srcdir
export STAFFAGE_DATADIR
staffage=$top_builddir/staffage

mkdir -p project/sparse/0 project/images
cp "$top_srcdir/tests/input/street.png" project/images/a.png
cp "$top_srcdir/tests/input/street.png" project/images/b.png
cp "$top_srcdir/tests/input/box.obj" project/
echo '1 PINHOLE 64 48 50 50 32 24' >project/sparse/0/cameras.txt
printf '%s\n' '1 0 1 0 0 -1 0 10 1 a.png' '32 24 1' '2 0 0.6 0.8 0 -3 4 10 1 b.png' '' >project/sparse/0/images.txt
printf '%s\n' '1 1 0 0 0 0 0 0' '2 3 4 0 0 0 0 0' '3 4 -2 0 0 0 0 0' >project/sparse/0/points3D.txt

run "$staffage" import colmap project -o project/flight.yaml --distance '0 0 0 1 0 0 2.5'
check "a project's folder is enough: exit status 0" is $status 0
check "says how well the points reproject" says '^reprojection error: rms 0.000 px'
check "says the scale" says '^scale: 2.5 m to a unit$'
check "warns that there are no times, and says what would give them" says '^staffage-import: warning: .* --utc-offset'
check "photographs are named from the scene's folder" grep -q '^  - photograph: images/a.png$' project/flight.yaml

sed -i -e 's/^# ground: .*/ground: {height_m: 0}/' -e 's/^# light: .*/light: {sky: overcast}/' \
    -e 's/^# exposure: .*/exposure: {value: 1}/' project/flight.yaml
cat >>project/flight.yaml <<'TEXT'
models: {box: {file: box.obj, unit_m: 1, up: z, front: x, class: car}}
entities: [{name: box, model: box, at: {world_m: [2.5, 0]}, heading_deg: 0}]
TEXT
run "$top_builddir/staffage-gen" project/flight.yaml -o out
check "completed, it is a scene that is generated" is $status 0
check "of a frame a photograph" test -f out/frames/000001/frame.json

before=$(cat project/flight.yaml)
run "$staffage" import colmap project -o project/flight.yaml --georeference none
check "a scene file that is there is not overwritten: exit status 1" is $status 1
check "and says why" says '^project/flight.yaml: is there already'
check "nor touched" is "$(cat project/flight.yaml)" "$before"

run "$staffage" import colmap project -o project/none.yaml --georeference none
check "without a georeference: exit status 0" is $status 0
check "the file says that its unit is hardly a metre" grep -q '^# No georeference' project/none.yaml
check "and the frame is the tool's" grep -q '^        translation_m: \[-1, 0, 10\]$' project/none.yaml

run "$staffage" import colmap project -o nowhere/flight.yaml --georeference none
check "a folder that is not there: exit status 1" test $status = 1 -a ! -e nowhere
run "$staffage" import colmap project -o project/x.yaml --georeference none --mesh none.ply
check "a mesh that is not there is named" says '^none.ply: cannot be opened'
check "and nothing is written" test ! -e project/x.yaml

wrong() {
    behaviour=$1
    shift
    run "$staffage" import "$@"
    check "usage: $behaviour" is $status 2
}
wrong "no folder" colmap -o x.yaml
wrong "no scene file" colmap project
wrong "an unknown tool" bundler project -o x.yaml
wrong "an offset without hours and minutes" colmap project -o x.yaml --utc-offset 5
wrong "a distance of six numbers" colmap project -o x.yaml --distance '0 0 0 1 0 0'
wrong "two ways of placing the world" colmap project -o x.yaml --georeference gps --distance '0 0 0 1 0 0 2'
tap_done
