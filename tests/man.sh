#!/bin/sh
# The manual and the programs' --help name the same options, and the manual's example is a scene.
. "$top_srcdir/tests/tap.sh"

# The options that head a line of --help: "  -o, --output OUT    text".
help_options() { sed -n 's/^ *\(-.*\)/\1/p' log | sed 's/   *[^-].*//' | grep -o -e '--*[A-Za-z][A-Za-z-]*' | sort -u; }
# The options that head an entry of the page: ".It Fl o , Fl -output Ar OUT".
page_options() { sed -n 's/^\.It \(Fl .*\)/\1/p' "$1" | grep -o -e 'Fl -*[A-Za-z][A-Za-z-]*' | sed 's/^Fl /-/' | sort -u; }

for program in staffage staffage-fuse staffage-gen staffage-import staffage-models staffage-post staffage-povray staffage-stats; do
    page=$top_srcdir/man/$program.1
    run "$top_builddir/$program" --help
    help_options >help
    page_options "$page" >page
    check "$program: --help names options" test $status = 0 -a -s help
    diff help page >log
    ok $? "$program: --help and the manual name the same options"
    run "$top_builddir/$program" --version
    check "$program: --version" says "^$program [0-9]*\.[0-9]*\.[0-9]*\$"
    run "$top_builddir/$program" --no-such-option
    check "$program: an unknown option is wrong usage" is $status 2
    if command -v groff >/dev/null; then
        run groff -mandoc -Tascii -ww -z "$page"
        check "$program: the page is formatted without a warning" test $status = 0 -a ! -s log
    else
        skip "$program: the page is formatted without a warning" "no groff"
    fi
done

# Each command has a page of its own, with its line of the synopsis and the options that it takes.
run "$top_builddir/staffage" --help
cp log whole
for command in run generate render post import fuse stats light models; do
    run "$top_builddir/staffage" $command --help
    check "staffage $command --help: its own page" test $status = 0 -a \
        "$(head -n 1 log | grep -c "^Usage: staffage $command ")" = 1 -a "$(grep -c 'staffage-' log)" = 0
    case $command in run|generate|render|post|light)
        check "staffage $command --help: its line is that of staffage --help" \
            is "$(sed -n 's/^Usage: *//p' log)" "$(sed -n "s/^[Usage: ]*\(staffage $command .*\)/\1/p" whole)"
        head -n 1 log | grep -o -e '--*[a-z][a-z]*' | sort -u >line
        help_options | grep -v '^--help$' >page
        check "staffage $command --help: explains the options of this line" cmp -s line page ;;
    esac
done

sed -n '/^\.Bd/,/^\.Ed/p' "$top_srcdir/man/staffage-scene.5" | grep -v '^\.' >scene.yaml
cp "$top_srcdir/tests/input/street.png" street.jpg
cp "$top_srcdir/tests/input/box.obj" hatchback.obj
sed -i 's/2000, 1500/64, 48/; s/900, 1000, 1100, 1100/10, 30, 50, 46/; s/700, 900/32, 36/' scene.yaml
STAFFAGE_DATADIR=$top_srcdir
export STAFFAGE_DATADIR
run "$top_builddir/staffage-gen" scene.yaml -o out
check "staffage-scene: its example is a scene" is $status 0

# What frames there are is told before the light is measured.
sed -i 's/sky: clear/sky: auto/' scene.yaml
run "$top_builddir/staffage-gen" scene.yaml -o out --frames 5:9
check "--frames without any: says which there are, and measures nothing" \
    is "$status $(cat log)" '1 staffage-gen: --frames 5:9: the scene has one frame, 0'
sed -i 's/files: .*jpg]/files: [street.jpg, street.jpg, street.jpg]/' scene.yaml
run "$top_builddir/staffage-gen" scene.yaml -o out --frames 5:9
check "--frames without any of several: says from which to which" says 'the scene has 3 frames, from 0 to 2, and none of them there$'
tap_done
