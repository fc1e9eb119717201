#!/bin/sh
# The real programs from scene file to dataset: the same pictures however a run went.
. "$top_srcdir/tests/tap.sh"
. "$top_srcdir/tests/run/same-dataset.sh"
staffage=$top_builddir/staffage
cp "$top_srcdir"/tests/input/* "$top_builddir/tests/run/same-pixels" .

for i in 1 2 3; do cp street.png "street$i.png"; done
sed 's/files: .*/files: [street1.png, street2.png, street3.png]}/' minimal.yaml >street.yaml
echo 'quality: draft' >>street.yaml

stamps() { find "$1" -printf '%p %T@ %i\n' | sort; }
passes() { find "$1/frames" -name object.exr -o -name plane.exr -o -name shadow.exr 2>/dev/null | wc -l; }

run "$staffage" run street.yaml -o one -j 1
check "a scene becomes a dataset" is $status 0
for output in rgb/000000.png semantic/000001.png semantic_id/000002.png instance/000000.png depth/000001.exr \
    depth/000002.png amodal/000000.json labels/000001.json run.json; do
    check "there is $output" test -s "one/$output"
done
run "$staffage" run street.yaml -o two -j 2
check "-j 2: the same as with -j 1" same_dataset one two

before=$(stamps one)
run "$staffage" run street.yaml -o one
check "a second run: nothing to do" says '^nothing to do'
check "a second run: no file is touched" is "$(stamps one)" "$before"

# Another way to merge needs no other passes.
of_passes() { stamps "$1" | grep -E '/(object|plane|shadow)\.exr '; }
run "$staffage" run street.yaml -o merged -j 2
before=$(of_passes merged/frames) picture=$(cat merged/rgb/000000.png | md5sum) labels=$(md5sum <merged/labels/000000.json)
cp street.yaml kept.yaml
echo 'transfer: {method: alpha} # as in the papers' >>street.yaml
run "$staffage" run street.yaml -o merged -j 2
check "another transfer: no pass is rendered again" is "$(of_passes merged/frames)" "$before"
check "another transfer: another picture" test "$(cat merged/rgb/000000.png | md5sum)" != "$picture"
check "another transfer: the same labels" is "$(md5sum <merged/labels/000000.json)" "$labels"
cp kept.yaml street.yaml
echo 'lens: {grain: 4}' >>street.yaml
run "$staffage" run street.yaml -o merged -j 2
check "other grain: no pass is rendered again" is "$(of_passes merged/frames)" "$before"
sed 's/height_m: 0/height_m: 0, albedo: 0.3/' kept.yaml >street.yaml
run "$staffage" run street.yaml -o merged -j 2
check "other ground: its passes are rendered again" test $status = 0 -a -z "$(of_passes merged/frames | grep -F -x "$before")"
cp kept.yaml street.yaml
run "$staffage" run street.yaml -o merged -j 2
( cd one && find rgb labels frames/*/object.exr frames/*/shadow.exr -type f ) >names
back() { same_files one merged <names; }
check "back to the first scene: its passes, pictures and labels" back

"$staffage" run street.yaml -o killed -j 2 >log 2>&1 &
pid=$!
until [ "$(passes killed)" -ge 2 ] || ! kill -0 $pid 2>/dev/null; do sleep 0.05; done
kill -KILL $pid
wait $pid 2>/dev/null
check "killed with -9: in the middle" test ! -e killed/rgb/000002.png
run "$staffage" run street.yaml -o killed -j 2
check "killed and run again: the same as undisturbed" same_dataset one killed

echo 'sphere { 0, Nothing }' >>two/frames/000001/shadow.pov
rm -f two/rgb/000002.png
run "$staffage" run street.yaml -o two -j 2
check "a failed render: exit status 1, POV-Ray's words and the scene's path" \
    test $status = 1 -a "$(grep -c "^$work/two/frames/000001/shadow.pov: POV-Ray: .*identifier 'Nothing'" log)" = 1
check "a failed render does not stop the other frames" test -s two/rgb/000002.png

# A name that would be more than a name.
sed 's/name: car-1/name: "x\\" #fopen F \\"hacked\\" write \/\/"/' minimal.yaml >hostile.yaml
{ echo 'mtllib hostile.mtl'; sed '/^o box/a usemtl x" #fopen F "hacked" write' box.obj; } >hostile.obj
echo 'newmtl x" #fopen F "hacked" write' >hostile.mtl
sed -i 's/box\.obj/hostile.obj/' hostile.yaml
run "$staffage" run hostile.yaml -o hostile
check "names with quotes and scene language in them: a dataset as any other" is $status 0
check "names with quotes and scene language in them: nothing is written" \
    is "$(find . -name 'hacked*')" ''
check "the dataset keeps the entity's name as it is" grep -q 'x\\" #fopen F \\"hacked\\" write //' hostile/labels/000000.json

# Whatever a frame was made from is noticed when it changes, in whichever file it lies.
echo 'Kd 0.9 0.1 0.1' >>hostile.mtl
run "$staffage" generate hostile.yaml -o hostile
check "a material file beside the model is edited: its frames are generated again" says 'generated 1 frame, 0 unchanged'
run "$staffage" generate "$work/hostile.yaml" -o "$work/hostile"
check "the same scene by another path: nothing changed" says 'generated 0 frames, 1 unchanged'
cp street.png film.png
sed 's/files: .*/video: film.png, frames: [0]}/' minimal.yaml >film.yaml
run "$staffage" generate film.yaml -o film
check "a film: its frames are taken out" is "$(find film/frames -name 000000.png | wc -l)" 1
touch film.png
run "$staffage" generate film.yaml -o film
check "a film that changed: its frames are taken out again" is "$(find film/frames -name 000000.png | wc -l)" 2

# A frame that nothing changes in.
{ sed '/^entities:/,$d' minimal.yaml; echo 'entities: []'; } >nobody.yaml
run "$staffage" run nobody.yaml -o nobody
check "a scene without entities: a picture all the same" test $status = 0 -a -s nobody/rgb/000000.png
run "$staffage" run nobody.yaml -o nobody
check "a scene without entities, a second run: nothing to do" says '^nothing to do'

# An entity beside the picture is a mistake, mostly; in a part of the frames nobody has to be.
sed 's/at: {pixel: .*}, h/at: {world_m: [90, 20]}, h/' minimal.yaml >beside.yaml
for time in first second; do
    run "$staffage" generate beside.yaml -o beside
    check "an entity in no frame is warned of, the $time time" test $status = 0 -a "$(grep -c 'warning: car-1 is in no frame$' log)" = 1
done
sed 's/street.png/street.png, street.png/' beside.yaml >twice.yaml
run "$staffage" generate twice.yaml -o twice --frames 0:1
check "--frames: nobody is warned of" test $status = 0 -a "$(grep -c warning log)" = 0

# Installed elsewhere than configured, all works.
if make -C "$top_builddir" --no-print-directory -s install DESTDIR="$work/root" >log 2>&1; then
    installed=$(find "$work/root" -name staffage -type f)
    run "$installed" run minimal.yaml -o installed
    check "installed: a scene becomes a dataset" is $status 0
    run "$staffage" run minimal.yaml -o built
    check "installed: the same as from the build tree" same_dataset installed built
else
    ok 1 "make install DESTDIR"
fi
tap_done
