#!/bin/sh
# staffage models, from the command line to a scene that uses what was added.
. "$top_srcdir/tests/tap.sh"
STAFFAGE_DATADIR=$top_srcdir XDG_DATA_HOME=$work/data
export STAFFAGE_DATADIR XDG_DATA_HOME
staffage=$top_builddir/staffage
mine=$work/data/staffage/models

run "$staffage" models
check "lists what comes with the program: exit status 0" is $status 0
check "with class, size, triangles and licence" says '^sedan  *car  *4\.[0-9]* x [12]\.[0-9]* x 1\.[0-9]*  *[0-9][0-9].* CC0-1\.0 '
run "$staffage" models --json
check "as JSON" says '"class": "person",'
STAFFAGE_MODELS=$work/none "$staffage" models >log
check "STAFFAGE_MODELS names another folder" is "$(wc -l <log)" 1

# car LIFT TAIL: a car in millimetres, z up, front +x, that stands LIFT above zero; TAIL=0: without lights.
car() {
    awk -v lift="$1" -v lights="$2" '
    function box(m, x0, x1, y0, y1, z0, z1,    i) {
        for (i = 0; i < 8; i++) print "v", (i % 4 == 1 || i % 4 == 2 ? x1 : x0), (i % 4 > 1 ? y1 : y0), (i > 3 ? z1 : z0) + lift
        print "vt 0 0\nvt 1 0\nvt 1 1\nusemtl " m
        split("1 4 3 2 5 6 7 8 1 2 6 5 2 3 7 6 3 4 8 7 4 1 5 8", f)
        for (i = 0; i < 6; i++) printf "f %d/1 %d/2 %d/3 %d/1\n", n + f[4*i+1], n + f[4*i+2], n + f[4*i+3], n + f[4*i+4]
        n += 8
    }
    BEGIN {
        print "mtllib car.mtl"
        box("body", -2200, 2200, -900, 900, 0, 800); box("body", -1600, 1200, -800, 800, 800, 1500)
        if (lights) { box("headlight", 2200, 2250, -800, 800, 500, 700); box("taillight", -2250, -2200, -800, 800, 500, 700) }
    }'
}
mkdir -p model/meshes model/materials/textures
car 0 1 >'model/meshes/My Car.obj'
printf 'newmtl body\nKd 1 1 1\nmap_Kd C:\\art\\paint.png\nnewmtl headlight\nKd 1 1 1\nnewmtl taillight\nKd 1 0 0\n' >model/meshes/car.mtl
cp "$top_srcdir/tests/input/street.png" model/materials/textures/paint.png

run "$staffage" models add 'model/meshes/My Car.obj' --license 'mine alone' --width 32
check "a car is added: exit status 0" is $status 0
check "its unit follows from its size" says '^  unit     0.001 m, by its size (9'
check "its front from its lights" says '^  front    +x, by names of lights (9'
check "its size in metres" says '^  size     4.50 x 1.80 x 1.50 m'
check "its textures" says '^  textures 1, '
check "its surface" says ' 0.0 % of its edges are open, 0.0 % of what is seen of it looks inward'
check "with the files that belong to it, wherever they lay" \
    test -f "$mine/my-car/My Car.obj" -a -f "$mine/my-car/car.mtl" -a -f "$mine/my-car/paint.png"
check "and a picture" test -s "$mine/my-car/four-sides.png"
check "that leaves its textures alone" cmp "$top_srcdir/tests/input/street.png" "$mine/my-car/paint.png"
check "nothing else is left" is "$(ls -A "$mine") $(ls -A "$mine/my-car" | wc -l)" 'my-car 5'
rm -r model/materials
run "$staffage" models
check "it is listed with its licence" says '^my-car  *car  *4.50 x 1.80 x 1.50  .* mine alone  *'"$mine/my-car\$"

cp "$top_srcdir/tests/input/street.png" street.png
cat >scene.yaml <<'TEXT'
staffage: 1
photographs: {files: [street.png]}
camera: {model: PINHOLE, size_px: [64, 48], horizontal_fov_deg: 90, pose: {look_at: {position_m: [0, 0, 5], target_m: [0, 20, 0]}}}
light: {sky: overcast}
ground: {height_m: 0}
exposure: {patch_px: [10, 30, 50, 46]}
entities: [{name: a, model: my-car, at: {world_m: [0, 10]}, heading_deg: 90}]
TEXT
run "$top_builddir/staffage-gen" scene.yaml -o out-scene
check "a scene has it by its short name, with its texture" test $status = 0 -a -z "$(grep warning log)"
tr -d '\n' <out-scene/frames/000000/labels.json >flat
check "at its size" grep -q '"size_m": *\[ *4\.5' flat

run "$staffage" models add 'model/meshes/My Car.obj' --width 32
check "a name that is taken is refused" test $status = 1
check "and says what can be done" says "$mine/my-car: is there already: --replace takes its place"
run "$staffage" models add 'model/meshes/My Car.obj' --replace --width 32
check "--replace takes its place" is $status 0
check "a texture that is not there is named" says '^  !        the texture .*paint.png is neither beside it'
check "and nothing of the old one stays" is "$(ls -A "$mine") $(ls -A "$mine/my-car" | wc -l)" 'my-car 4'

car 1000 0 >model/meshes/floating.obj
run "$staffage" models add model/meshes/floating.obj --width 32
check "one whose front is not sure is refused: exit status 1" is $status 1
check "it says what would be right" says 'which way is its front? .* say --front +x, or --front -x if it is shown from behind'
check "how far it floats" says '^  ground   its lowest point lies 1.00 m above '
check "and shows it" test -s out/models/floating.png
check "but does not add it" is "$(ls -A "$mine")" my-car
run "$staffage" models add street.png
check "a file that is no model is refused" says 'street.png: is no model file by its name'
run "$staffage" models add 'model/meshes/My Car.obj' --class person --name p --width 32
check "a car is no person" says 'no usual unit makes it as large as a person\|which way is '
run "$staffage" models add 'model/meshes/My Car.obj' --name 'any car'
check "a name that no scene could say is refused" says '"any car" is no name for a model'
run "$staffage" models add 'model/meshes/My Car.obj' --unit 0.001 --length 4
check "two sizes are wrong usage" is $status 2
run "$staffage" models --name x
check "options of add are none of the list's" is $status 2

STAFFAGE_MODELS=$work/none
export STAFFAGE_MODELS
run "$staffage" models --pictures pictures --width 32
check "pictures of all" test $status = 0 -a -s pictures/my-car.png -a -s pictures/sheet.png -a -s pictures/index.html
check "and nothing beside" is "$(ls -A pictures | wc -l)" 3
tap_done
