#!/bin/sh
# staffage with stand-ins for generating and posting, and the real makefile and POV-Ray.
. "$top_srcdir/tests/tap.sh"

# The programs are looked for beside the script.
mkdir -p bin share/staffage/templates templates
cp "$top_builddir/staffage" "$top_builddir/staffage-povray" bin/
cp "$top_srcdir/tests/run/stand-in-gen" bin/staffage-gen
cp "$top_srcdir/tests/run/stand-in-post" bin/staffage-post
cp "$top_builddir/tests/run/write-makefile" "$top_builddir/tests/run/same-pixels" .
echo 'global_settings { assumed_gamma 1.0 }' >templates/settings.inc
TOOLS=$work
export TOOLS
staffage=$work/bin/staffage

same_frames() {
    for picture in "$1"/frames/*/*.exr; do
        cmp -s "$picture" "$2/${picture#"$1"/}" || ./same-pixels "$picture" "$2/${picture#"$1"/}" || return 1
    done
}
stamps() { find "$1" -type f -printf '%p %T@\n' | sort; }
files() { find "$1"/frames -name "*[a-z].$2" ! -name '*.part.*' 2>/dev/null | wc -l; }

printf '000001 0.9\n000002 0.7\n000003 0\n' >balls.yaml
run "$staffage" run balls.yaml -j 1
check "run: a scene becomes pictures" is $status 0
check "run: the default folder is out/ and the scene's name" test -f out/balls/rgb/000002.png
check "run: an empty frame has a picture and no passes" test -f out/balls/rgb/000003.png
check "run: three passes a frame" is "$(files out/balls exr)" 6
check "run: says how many frames, and where they are" says '^3 frames in .*out/balls/rgb'
check "run: nothing of POV-Ray's own talk is shown" not says -i 'povray\|persistence\|configuration'
check "run: no log, no unfinished file is left" is "$(ls out/balls/frames/*/*.log out/balls/frames/*/*part* 2>/dev/null)" ''

before=$(stamps out/balls)
run "$staffage" run balls.yaml
check "run again: says that nothing is to do" says '^nothing to do'
check "run again: exit status 0" is $status 0
check "run again: no file is touched" is "$(stamps out/balls)" "$before"

run "$staffage" run balls.yaml -o two -j 2
check "-j 2: the pixels of -j 1" same_frames out/balls two

rm two/frames/000001/plane.exr two/rgb/000002.png
before=$(stat -c %Y.%y two/frames/000001/object.exr)
run "$staffage" run balls.yaml -o two
check "a pass that is missing is made again" says '^2 frames in'
check "what is there is left alone" is "$(stat -c %Y.%y two/frames/000001/object.exr)" "$before"

rm two/labels/000001.json two/depth/000003.exr
run "$staffage" run balls.yaml -o two
check "labels that are missing are made again" test $status = 0 -a -f two/labels/000001.json -a -f two/depth/000003.exr

printf '000001 0.9\n000002 0.6\n000003 0\n' >balls.yaml
run "$staffage" run balls.yaml -o two
check "a frame that changed is made again, the others are not" says '^1 frame in'

if command -v script >/dev/null; then
    rm -rf two
    run script -qec "$staffage run balls.yaml -o two" /dev/null
    tr '\r' '\n' <log >lines
    check "on a terminal: one line that is written over" is "$(grep -c '^.\[Kframes' lines)" 10
    check "on a terminal: frames, passes, rate and time left" \
        grep -q '^.\[Kframes [0-3]/3  passes [0-6]/6  [0-9.]* s/frame  [0-9:]* left$' lines
else
    skip "on a terminal: one line that is written over" "no script(1)"
fi
run "$staffage" run balls.yaml -o three
check "elsewhere: plain lines" says '^to do: 3 frames, 6 passes$'
check "elsewhere: nothing is written over" not grep -q "$(printf '\r')" log

mkdir 'o dd $(x) #1;"'
run "$staffage" run balls.yaml -o 'o dd $(x) #1;"/b'
check "an output folder may have any name" is $status 0

rm -rf out
printf '000001 0.9\n000002 broken\n000003 0.7\n' >bad.yaml
run "$staffage" run bad.yaml -j 2
check "a broken scene: exit status 1" is $status 1
check "a broken scene: POV-Ray's own words, with the scene's path" \
    says "$work/out/bad/frames/000002/object.pov: POV-Ray: .*undeclared identifier 'broken'"
check "a broken scene: the other frames are done" test -f out/bad/rgb/000001.png -a -f out/bad/rgb/000003.png
check "a broken scene: the frame has no picture" test ! -e out/bad/rgb/000002.png -a ! -e out/bad/frames/000002/object.exr
check "a broken scene: says how many failed" says '1 of 3 frames failed'
check "a broken scene: make's own talk is not shown" not says '^make'
run "$staffage" render out/bad
check "render: says how many passes failed" says '3 of 3 passes failed'
printf '000001 0.9\n000002 0.8\n000003 0.7\n' >bad.yaml
run "$staffage" run bad.yaml
check "a scene that is mended: only its frame is made" says '^1 frame in'

rm -r out/bad/frames/000002 out/bad/rgb/000001.png
run "$staffage" post out/bad
check "a scene that is gone: is named and counted" says "No rule to make target 'frames/000002/.*pov'"
check "a scene that is gone: the other frames are done" test $status = 1 -a -f out/bad/rgb/000001.png
check "a scene that is gone: is counted" says '1 of 2 frames failed'

printf '000001 0.9\n000002 0.5\n' >refused.yaml
run "$staffage" run refused.yaml
check "a frame that post refuses: post's words, exit status 1" says 'radius 0.5 is refused'
check "a frame that post refuses: is counted" says '1 of 2 frames failed'

printf '000001 0.9\n000002 0\n' >stages.yaml
run "$staffage" generate stages.yaml --frames 0:7 --seed=3 --quality draft -o s
check "generate: options are handed on" is "$(cat gen-options)" 'stages.yaml -o s --frames 0:7 --seed 3 --quality draft'
check "generate: renders nothing" is "$(files s exr)" 0
run "$staffage" render s -j2
check "render: the passes, and no pictures" test $status = 0 -a -f s/frames/000001/object.exr -a ! -e s/rgb
run "$staffage" post stages.yaml -o s
check "post: the pictures" test $status = 0 -a -f s/rgb/000001.png -a -f s/rgb/000002.png

# A scene that would reach out of its folder is refused by name and changes nothing.
for reach in '#fopen F "/etc/passwd" read' '#fopen F "../../../reached" write' '#include "/etc/hostname"'; do
    printf '000001 0.9\n' >reach.yaml
    run "$staffage" generate reach.yaml -o reach
    echo "$reach" >>reach/frames/000001/object.pov
    run "$staffage" render reach
    if bin/staffage-povray --confined >/dev/null; then
        check "a scene with $reach is refused" says 'frames/000001/object.pov: POV-Ray: .*Cannot open'
    else
        skip "a scene with $reach is refused" "this kernel has no Landlock"
    fi
done
check "a scene that would write elsewhere has not" test ! -e reached -a ! -e ../reached
run "$staffage" generate reach.yaml -o reach
cat >reach/povray.ini <<'TEXT'
Pre_Scene_Command=touch frames/000001/shell
Width=3
TEXT
rm -f reach/frames/000001/object.pov
run "$staffage" run reach.yaml -o reach
check "a scene cannot run a program" test ! -e reach/frames/000001/shell

# Killing: the pictures of a run that was killed and finished are those of an undisturbed one.
seq -f '%06.0f 0.9' 1 9 >many.yaml
SIZE='480 360'
export SIZE
run "$staffage" run many.yaml -o whole
"$staffage" run many.yaml -o killed -j 2 >log 2>&1 &
pid=$!
until [ "$(files killed exr)" -ge 3 ] || ! kill -0 $pid 2>/dev/null; do sleep 0.05; done
kill -KILL $pid
wait $pid 2>/dev/null
# Of each job the make that ends may take the picture back whose recipe it had not seen the end of.
made=$(files killed exr)
echo "# $made of 27 pictures; $(tail -n 1 log | tr '\r' ' ')"
check "killed: it was in the middle" test "$made" -ge 1 -a "$made" -lt 27
run "$staffage" run many.yaml -o killed -j 2
check "killed: nothing goes on in its back" test "$(files killed exr)" = 27 -a $status = 0
check "frames are finished one after the other, not all in the end" \
    test whole/rgb/000001.png -ot whole/frames/000009/shadow.exr
check "killed and run again: the same pixels" same_frames whole killed
check "killed and run again: no unfinished file is left" is "$(ls killed/frames/*/*part* 2>/dev/null)" ''

"$staffage" run many.yaml -o stopped -j 2 >log 2>&1 &
pid=$!
until [ "$(files stopped exr)" -ge 2 ] || ! kill -0 $pid 2>/dev/null; do sleep 0.05; done
kill -TERM $pid
wait $pid
status=$?
check "stopped: exit status 130, and says that nothing is lost" test $status = 130 -a "$(grep -c 'nothing is lost' log)" = 1
check "stopped: a failure is not made of it" not says 'object.pov'
check "stopped: no unfinished file is left" is "$(ls stopped/frames/*/*part* 2>/dev/null)" ''
unset SIZE

# What Ctrl-C sends goes to all processes of the terminal; a shell that tests starts one in has to give it INT back.
stop_generating() {
    rm -rf at-work early
    setsid env --default-signal=INT "$staffage" "$2" many.yaml ${3:-} >log 2>&1 &
    pid=$!
    until [ -s at-work ] || ! kill -0 $pid 2>/dev/null; do sleep 0.05; done
    began=$(date +%s)
    if [ "$1" = Ctrl-C ]; then kill -INT -$pid; else kill "-$1" $pid; fi
    wait $pid
    status=$?
    [ $status = 130 ] && [ $(($(date +%s) - began)) -lt 20 ] || return 1
    not kill -0 "$(cat at-work)" 2>/dev/null
}
: >slow
for signal in Ctrl-C INT TERM; do
    check "stopped while generating by $signal: at once, exit status 130" stop_generating $signal run '-o early'
    check "stopped while generating by $signal: says that nothing is lost" is "$(cat log)" \
        'stopped; nothing is lost: the same command goes on from here'
    check "stopped while generating by $signal: an empty folder is not left" test ! -e early
done
rm -f at-work
"$staffage" run many.yaml -o early >log 2>&1 &
pid=$!
until [ -s at-work ] || ! kill -0 $pid 2>/dev/null; do sleep 0.05; done
kill -KILL "$(cat at-work)"
wait $pid
check "killed by somebody else, as when memory runs out: the signal is told" says '^staffage: staffage-gen was ended by signal 9$'
mkdir tmp
TMPDIR=$work/tmp
export TMPDIR
check "light: stopped at once" stop_generating TERM light
check "light: leaves nothing behind, to go on from either" is "$(cat log; ls tmp)" stopped
unset TMPDIR
rm slow

# Usage.
usage_error() {
    run "$staffage" "$@"
    [ $status = 2 ] && [ "$(wc -l <log)" = 1 ]
}
check "usage: an unknown command" usage_error paint x.yaml
check "usage: an unknown option" usage_error run x.yaml --fast
check "usage: -j wants a count" usage_error run x.yaml -j many
check "usage: an option without its value" usage_error run x.yaml -o
check "usage: no scene" usage_error run
check "usage: two scenes" usage_error run a.yaml b.yaml
check "usage: light writes nothing: it takes no -o" usage_error light x.yaml -o out
check "usage: render takes no --seed" usage_error render out --seed 3
run "$staffage" run nowhere.yaml
check "a scene that is not there: gen's words and status" test $status = 1 -a ! -e out/nowhere
run "$staffage" render .
check "a folder without frames: says what makes them" says 'staffage generate'
run "$staffage" --help
check "--help: status 0" is $status 0

tap_done
