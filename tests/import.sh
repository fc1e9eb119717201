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
check "says that pictures without EXIF have no times" says '^staffage-import: warning: .* no times: 2 of 2 photographs'
check "and does not advise what would not help" not grep -q -e --utc-offset log project/flight.yaml
check "says what is to be filled in" says '^scene: .* light, exposure, lens '
check "photographs are named from the scene's folder" grep -q '^  - photograph: images/a.png$' project/flight.yaml

# The #, and nothing else, is taken away from every key in a comment.
sed -i -e 's/^#ground:/ground:/' -e 's/^#lens:/lens:/' \
    -e 's/^#light: .*/light: {sky: overcast}/' -e 's/^#exposure: .*/exposure: {value: 1}/' project/flight.yaml
cat >>project/flight.yaml <<'TEXT'
entities: [{name: car, model: any car, at: {world_m: [2.5, 0]}, heading_deg: 0}]
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
check "nor does the program promise light and traffic" not says 'who comes by'
check "but says what comes first" says '^scene: .* before it is in metres'
check "and the frame is the tool's" grep -q '^        translation_m: \[-1, 0, 10\]$' project/none.yaml

run "$staffage" import colmap project -o project/x.yaml --georeference gsp
check "a way of georeferencing that is none is told from those that are" says '^gsp: there is no such file; .* gps, none or a file'
run "$staffage" import colmap project -o project/x.yaml --georeference none --images nowhere
check "a folder of photographs that is not there is named" says '^nowhere: is no folder; --images'
run "$staffage" import colmap project -o project/x.yaml --georeference none --mesh project/images/a.png
check "a mesh must be one by its name" says '^project/images/a.png: is no mesh .*\.ply or \.obj'
run "$staffage" import colmap project -o project/x.yaml --georeference none --roads project/box.obj
check "and a map too" says '^project/box.obj: is no map .*\.osm'

run "$staffage" import colmap project -o nowhere/flight.yaml --georeference none
check "a folder that is not there: exit status 1" test $status = 1 -a ! -e nowhere
run "$staffage" import colmap project -o project/x.yaml --georeference none --mesh none.ply
check "a mesh that is not there is named" says '^none.ply: cannot be opened'
check "and nothing is written" test ! -e project/x.yaml

# Two pictures whose EXIF has a local time and nothing else, placed by control points at 8 degrees east.
mkdir -p clock/images
for image in a b; do
    printf '\377\330\377\341\000\110Exif\000\000II*\000\010\000\000\000' >clock/images/$image.png
    printf '\001\000\151\207\004\000\001\000\000\000\032\000\000\000\000\000\000\000' >>clock/images/$image.png
    printf '\001\000\003\220\002\000\024\000\000\000\054\000\000\000\000\000\000\000' >>clock/images/$image.png
    printf '2016:06:23 16:31:59\000\377\331' >>clock/images/$image.png
done
cat >clock/points.txt <<'TEXT'
A 0 0 0 47 8 500
B 0 1 0 47.001 8 500
C 1 0 0 47 8.0014617 500
D 1 1 0 47.001 8.0014617 500
TEXT
run "$staffage" import colmap project --images clock/images -o clock/none.yaml --georeference clock/points.txt
check "local times without an offset: --utc-offset is advised" says '^staffage-import: warning: .* give --utc-offset'
run "$staffage" import colmap project --images clock/images -o clock/far.yaml --georeference clock/points.txt --utc-offset=-05:00
check "an offset far from the place's longitude is warned of" says '^staffage-import: warning: --utc-offset -05:00 is 5.5 h .* of the place?$'
check "and taken" grep -q 'time: 2016-06-23T16:31:59-05:00' clock/far.yaml
run "$staffage" import colmap project --images clock/images -o clock/near.yaml --georeference clock/points.txt --utc-offset +02:00
check "one that is near is not" test $status = 0 -a "$(grep -c warning log)" = 0

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
